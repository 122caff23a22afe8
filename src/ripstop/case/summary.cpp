#include "ripstop/case/summary.h"

#include <limits>
#include <numbers>

#include "ripstop/case/assemble.h"

namespace ripstop {
namespace {

double length_of(const Mesh& mesh, const std::vector<int>& springs) {
  double sum = 0;
  for (int spring : springs) sum += mesh.springs[spring].rest_length;
  return sum;
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

CaseSummary summarize(const Case& value) {
  CaseSummary summary;
  const CanopyMesh mesh = parachute_mesh(value);
  for (const Patch& patch : mesh.patches) {
    summary.cloth_nodes += patch.rows * patch.columns;
    for (double area : patch.cell_area) summary.cloth_area += area;
  }
  summary.computed_area = computed_area(value.parachute);
  summary.nominal_area = nominal_area(value.parachute);
  const CanopyFacts canopy = facts(value.parachute);
  summary.vent_area = canopy.vent_area;
  summary.slot_area = canopy.slot_area;
  summary.geometric_porosity = canopy.geometric_porosity();

  for (double mass : mesh.mass) summary.total_mass += mass;
  summary.cloth_mass = summary.cloth_area * canopy_fabric(value).areal_density_kg_m2;
  for (const LineRun& line : mesh.rigging.lines)
    summary.line_mass += length_of(mesh, line.springs) * suspension_line(value).linear_density_kg_m;
  summary.riser_mass = length_of(mesh, mesh.rigging.riser_springs) * riser_line(value).linear_density_kg_m;
  // Tape lies on springs of its own kind only, so what is left is tape.
  summary.tape_mass = summary.total_mass - summary.cloth_mass - summary.line_mass - summary.riser_mass;

  summary.nodes = mesh.node_count();
  summary.resolved_cloth_nodes = experience(value.parachute).cloth_nodes;
  count_springs(mesh, summary);
  ClothOptions options;
  options.linear = value.coupling.linear;
  const ClothPtr cloth = make_cloth(mesh, options);
  summary.step = step_bound(*cloth, start_state(*cloth));

  const FlowGrid grid = flow_problem(value).grid;
  summary.flow_cells = static_cast<long long>(grid.nx) * grid.ny * grid.nz;
  summary.flow_spacing = grid.spacing();
  const double diameter = start_diameter(value.parachute);
  summary.blockage = std::numbers::pi / 4 * diameter * diameter / (grid.size.x * grid.size.y);
  summary.air = air(value);
  return summary;
}

}  // namespace ripstop
