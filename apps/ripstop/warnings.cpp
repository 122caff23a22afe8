#include "warnings.h"

#include <fmt/format.h>

#include "ripstop/material/fit_material.h"

namespace ripstop {

void print_mesh_warning(const Case& value) {
  const int asked = value.parachute.mesh.cloth_nodes;
  const int enough = experience(value.parachute).cloth_nodes;
  if (asked < enough)
    fmt::print(stderr,
               "warning: parachute.mesh.cloth_nodes = {}: the projected diameter of this type may come out "
               "more than "
               "1 % too large with fewer than {} nodes (docs/guide/canopies.md, How fine a mesh)\n",
               asked, enough);
}

void print_porosity_warning(const Case& value) {
  const Fabric& cloth = canopy_fabric(value);
  if (value.flow.porosity_model == cloth.porosity_model) return;
  const auto word = [](PorosityModel model) { return model == PorosityModel::paper ? "paper" : "sheet"; };
  fmt::print(
      stderr,
      "warning: flow.porosity_model = \"{}\", but darcy and forchheimer of materials.{} are for \"{}\" "
      "(materials/README.md)\n",
      word(value.flow.porosity_model), cloth.name, word(cloth.porosity_model));
}

void print_material_warnings(const Case& value, double largest_cloth_strain) {
  for (const auto& [name, material] : value.materials) {
    const double strain = name == value.parachute.canopy_material ? largest_cloth_strain : 0.0;
    for (const std::string& text : material_warnings(material, strain))
      fmt::print(stderr, "warning: {}\n", text);
  }
}

}  // namespace ripstop
