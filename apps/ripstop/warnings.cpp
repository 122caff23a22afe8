#include "warnings.h"

#include <fmt/format.h>

#include "ripstop/case/resolve.h"
#include "ripstop/material/fit_material.h"

namespace ripstop {

void print_mesh_warning(const Case& given) {
  const int asked = given.parachute.mesh.cloth_nodes;
  const int enough = experience(given.parachute).cloth_nodes;
  if (asked < enough)
    fmt::print(stderr,
               "warning: parachute.mesh.cloth_nodes = {}: the projected diameter of this type may come out "
               "more than "
               "1 % too large with fewer than {} nodes (docs/guide/canopies.md, How fine a mesh)\n",
               asked, enough);
}

void print_grid_warning(const Case& given) {
  constexpr double enough = 10;  // on five, of-flow jumps between shapes; docs/theory/coupling.md
  const Resolved resolved = resolve(given);
  if (resolved.coupling.load != CanopyLoad::of_flow) return;
  const FlowGrid grid = flow_grid(resolved.flow);
  const double across =
      inflated_diameter(given.parachute) / grid.spacing({0, 0, resolved.flow.canopy_position_m}).x;
  if (across < enough)
    fmt::print(
        stderr,
        "warning: {:.0f} cells of the flow across the inflated canopy: with fewer than {:.0f} the air's "
        "own load jumps as cloth passes from cell to cell, and the coupling may not converge; more "
        "flow.cells, or "
        "coupling.load = \"uniform\"\n",
        across, enough);
}

void print_porosity_warning(const Case& given) {
  const Fabric& cloth = canopy_fabric(given);
  const PorosityModel used = resolve(given).flow.porosity_model;
  if (used == cloth.resistance.model) return;
  const auto word = [](PorosityModel model) { return model == PorosityModel::paper ? "paper" : "sheet"; };
  fmt::print(
      stderr,
      "warning: flow.porosity_model = \"{}\", but darcy and forchheimer of materials.{} are for \"{}\" "
      "(materials/README.md)\n",
      word(used), cloth.name, word(cloth.resistance.model));
}

void print_material_warnings(const Case& given, double largest_cloth_strain) {
  for (const auto& [name, material] : given.materials) {
    const double strain = name == given.parachute.canopy_material ? largest_cloth_strain : 0.0;
    for (const std::string& text : material_warnings(material, strain))
      fmt::print(stderr, "warning: {}\n", text);
  }
}

}  // namespace ripstop
