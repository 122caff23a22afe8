#include "ripstop/case/summary.h"

#include <limits>
#include <numbers>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cluster.h"
#include "ripstop/case/cost.h"
#include "ripstop/case/opening.h"
#include "ripstop/case/tape.h"
#include "ripstop/parachute/own_mesh.h"

namespace ripstop::inline cases {
namespace {

void count_springs(const Mesh& mesh, CaseSummary& summary) {
  summary.smallest_spring = std::numeric_limits<double>::infinity();
  const auto count = [&](double rest_length, const std::string& part) {
    ++summary.springs;
    if (rest_length >= summary.smallest_spring) return;
    summary.smallest_spring = rest_length;
    summary.smallest_part = part;
  };
  for (const Patch& patch : mesh.patches)
    for (int d = 0; d < direction_count; ++d)
      for (std::size_t i = 0; i < patch.width[d].size(); ++i)
        if (patch.width[d][i] > 0) count(patch.rest_length[d][i], patch.name);
  for (const Spring& spring : mesh.springs) count(spring.rest_length, mesh.parts[spring.part]);
}

}  // namespace

CaseSummary summarize(const Settings& resolved) {
  CaseSummary summary;
  const CanopyMesh mesh = parachute_mesh(resolved);
  const Cost cost = steady_cost(resolved);
  summary.memory = cost.memory, summary.core_time = cost.time;
  for (const Patch& patch : mesh.patches) summary.cloth_nodes += patch.rows * patch.columns;
  summary.cloth_area = cloth_area(mesh);
  summary.computed_area = computed_area(resolved.parachute());
  summary.nominal_area = nominal_area(resolved.parachute());
  const CanopyFacts canopy = facts(resolved.parachute());
  summary.vent_area = canopy.vent_area;
  summary.slot_area = canopy.slot_area;
  summary.geometric_porosity = canopy.geometric_porosity();
  summary.mass = parachute_masses(resolved);

  summary.nodes = mesh.node_count();
  summary.resolved_cloth_nodes = experience(resolved.parachute()).cloth_nodes;
  count_springs(mesh, summary);
  ClothOptions options;
  options.linear = resolved.coupling().linear;
  const ClothPtr cloth = make_cloth(mesh, options);
  summary.step = stability_limit(*cloth, start_state(*cloth));

  const FlowGrid grid = flow_grid(resolved.flow());
  summary.flow_cells = static_cast<long long>(grid.nx) * grid.ny * grid.nz;
  summary.flow_spacing = grid.spacing();
  const double diameter = start_diameter(resolved.parachute());
  const TunnelSettings& tunnel = resolved.flow().tunnel;
  const bool jet = tunnel.kind == TunnelKind::open_jet;
  summary.blockage = area_ratio(resolved.written()) * std::numbers::pi / 4 * diameter * diameter /
                     (jet ? nozzle_area(tunnel.nozzle) : grid.size.x * grid.size.y);
  summary.of_jet = jet;
  summary.air = {resolved.flow().speed_m_s, resolved.flow().density_kg_m3};
  summary.air_source = opening_air(resolved).from;
  const UsualOpening opening = usual_opening(resolved.written());
  summary.deployment = {opening.speed, opening.from};
  return summary;
}

}  // namespace ripstop::inline cases
