#include "ripstop/case/summary.h"

#include <limits>
#include <numbers>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cost.h"

namespace ripstop {
namespace {

double length_of(const Mesh& mesh, const std::vector<int>& springs) {
  double sum = 0;
  for (int spring : springs) sum += mesh.springs[spring].rest_length;
  return sum;
}

void weigh(const Case& given, const CanopyMesh& mesh, CaseSummary& summary) {
  const Rigging& rigging = mesh.rigging;
  for (double mass : mesh.mass) summary.mass.total += mass;
  summary.mass.cloth = summary.cloth_area * canopy_fabric(given).areal_density_kg_m2;
  double lines = length_of(mesh, rigging.vent_line_springs);
  for (const LineRun& line : rigging.lines) lines += length_of(mesh, line.springs);
  summary.mass.lines = lines * suspension_line(given).linear_density_kg_m;
  summary.mass.riser = length_of(mesh, rigging.riser_springs) * riser_line(given).linear_density_kg_m;
  if (const Tape* tape = reinforcement_tape(given))
    summary.mass.tape = length_of(mesh, rigging.tape_springs) * tape->linear_density_kg_m;
}

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

CaseSummary summarize(const Case& given) {
  CaseSummary summary;
  const Cost cost = cost_of(given);
  summary.memory = cost.memory, summary.core_time = cost.time;
  const CanopyMesh mesh = parachute_mesh(given);
  for (const Patch& patch : mesh.patches) {
    summary.cloth_nodes += patch.rows * patch.columns;
    for (double area : patch.cell_area) summary.cloth_area += area;
  }
  summary.computed_area = computed_area(given.parachute);
  summary.nominal_area = nominal_area(given.parachute);
  const CanopyFacts canopy = facts(given.parachute);
  summary.vent_area = canopy.vent_area;
  summary.slot_area = canopy.slot_area;
  summary.geometric_porosity = canopy.geometric_porosity();
  weigh(given, mesh, summary);

  summary.nodes = mesh.node_count();
  summary.resolved_cloth_nodes = experience(given.parachute).cloth_nodes;
  count_springs(mesh, summary);
  ClothOptions options;
  options.linear = given.coupling.linear;
  const ClothPtr cloth = make_cloth(mesh, options);
  summary.step = stability_limit(*cloth, start_state(*cloth));

  const FlowGrid grid = flow_problem(given).grid;
  summary.flow_cells = static_cast<long long>(grid.nx) * grid.ny * grid.nz;
  summary.flow_spacing = grid.spacing();
  const double diameter = start_diameter(given.parachute);
  const TunnelSettings tunnel = resolve(given).flow.tunnel;
  const bool jet = tunnel.kind == TunnelKind::open_jet;
  summary.blockage = std::numbers::pi / 4 * diameter * diameter /
                     (jet ? nozzle_area(tunnel.nozzle) : grid.size.x * grid.size.y);
  summary.of_jet = jet;
  summary.air = air(given);
  return summary;
}

}  // namespace ripstop
