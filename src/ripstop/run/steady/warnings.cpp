#include "ripstop/run/steady/warnings.h"

#include <fmt/format.h>

#include "ripstop/case/settings.h"
#include "ripstop/material/fit_material.h"

namespace ripstop {

std::vector<std::string> mesh_warnings(const Settings& resolved) {
  const int asked = resolved.parachute().mesh.cloth_nodes;
  const int enough = experience(resolved.parachute()).cloth_nodes;
  if (asked >= enough) return {};
  return {fmt::format(
      "parachute.mesh.cloth_nodes = {}: the projected diameter of this type may come out more than "
      "1 % too large with fewer than {} nodes (docs/guide/canopies.md, How fine a mesh)",
      asked, enough)};
}

std::vector<std::string> grid_warnings(const Settings& resolved) {
  constexpr double enough = 10;  // on five, of-flow jumps between shapes; docs/theory/coupling.md
  if (resolved.coupling().load != CanopyLoad::of_flow) return {};
  const FlowGrid grid = flow_grid(resolved.flow());
  const double across =
      inflated_diameter(resolved.parachute()) / grid.spacing({0, 0, resolved.flow().canopy_position_m}).x;
  if (across >= enough) return {};
  return {
      fmt::format("{:.0f} cells of the flow across the inflated canopy: with fewer than {:.0f} the air's "
                  "own load jumps as cloth passes from cell to cell, and the coupling may not converge; more "
                  "flow.cells, or "
                  "coupling.load = \"uniform\"",
                  across, enough)};
}

std::vector<std::string> porosity_warnings(const Settings& resolved) {
  const Fabric& cloth = resolved.materials().canopy;
  const PorosityModel used = resolved.flow().porosity_model;
  if (used == model_of(cloth.resistance)) return {};
  const auto word = [](PorosityModel model) { return model == PorosityModel::paper ? "paper" : "sheet"; };
  return {
      fmt::format("flow.porosity_model = \"{}\", but the permeability of materials.{} is for \"{}\" "
                  "(materials/README.md)",
                  word(used), cloth.name, word(model_of(cloth.resistance)))};
}

std::vector<std::string> strain_warnings(const Settings& resolved, double largest_cloth_strain) {
  std::vector<std::string> all;
  for (const auto& [name, material] : resolved.written().materials) {
    const double strain = name == resolved.parachute().canopy_material ? largest_cloth_strain : 0.0;
    for (const std::string& text : material_warnings(material, strain)) all.push_back(text);
  }
  return all;
}

std::vector<std::string> case_warnings(const Settings& resolved) {
  std::vector<std::string> all = mesh_warnings(resolved);
  for (const std::vector<std::string>& more : {grid_warnings(resolved), porosity_warnings(resolved)})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<std::string> warnings_of(const Settings& resolved, double largest_cloth_strain) {
  std::vector<std::string> all = case_warnings(resolved);
  const std::vector<std::string> strain = strain_warnings(resolved, largest_cloth_strain);
  all.insert(all.end(), strain.begin(), strain.end());
  return all;
}

}  // namespace ripstop
