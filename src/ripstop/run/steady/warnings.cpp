#include "ripstop/run/steady/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ripstop/case/bodies.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/words.h"
#include "ripstop/flight/validity.h"
#include "ripstop/flow/extent.h"
#include "ripstop/material/fit_material.h"
#include "ripstop/material/permeability.h"
#include "ripstop/parachute/profile.h"
#include "ripstop/run/quality.h"

namespace ripstop::inline run {

std::vector<std::string> mesh_warnings(const Settings& resolved) {
  const int asked = resolved.parachute().mesh.cloth_nodes;
  const int enough = experience(resolved.parachute()).cloth_nodes;
  if (asked >= enough) return {};
  return {fmt::format(
      "parachute.mesh.cloth_nodes = {}: the projected diameter of this canopy family can be more than 1 % "
      "too large with fewer than {} nodes (docs/guide/canopies.md)",
      asked, enough)};
}

std::vector<std::string> grid_warnings(const Settings& resolved) {
  const QualityLimit& enough = quality_limit("cells_across");
  if (resolved.coupling().load != CanopyLoad::of_flow) return {};
  const double across = cells_across(resolved);
  if (!enough.beyond(across, enough.warn)) return {};
  const bool refused = enough.beyond(across, enough.refuse);
  const auto [cells, limit] = rounded_apart(across, refused ? enough.refuse : enough.warn, 2);
  const std::string meaning =
      refused ? fmt::format("the result {} (limit {}; fewer than {:g} cause a warning)", refused_text, limit,
                            enough.warn)
              : fmt::format(
                    "with fewer than {} the local load becomes discontinuous as cloth crosses grid "
                    "cells, and the coupling may not converge",
                    limit);
  return {
      fmt::format("{} flow cells across the inflated canopy: {}; increase flow.cells, or set coupling.load = "
                  "\"uniform\"",
                  cells, meaning)};
}

std::vector<std::string> body_warnings(const Settings& resolved, const FlowGrid& grid, bool in_time,
                                       const char* finer) {
  constexpr double enough = 8;  // cells
  std::vector<std::string> warnings;
  for (const FlowBody& body : rigid_bodies(resolved)) {
    warnings.push_back(
        in_time
            ? fmt::format("body.{}: rigid bodies are experimental; alone in the unsteady stream the drag of "
                          "bodies with a flat front was 1.0 to 1.12 times the published value, of round ones "
                          "1.3 to 2.1 times (docs/guide/wake.md)",
                          body.name)
            : fmt::format("body.{}: the steady drag of round and long bodies alone in the stream was 1.1 to "
                          "3.7 times the published value, and the loss of drag behind them follows it; use "
                          "--unsteady or flow.unsteady = true (docs/guide/wake.md)",
                          body.name));
    const Extent e = extent_of(body.surface);
    const double cell = grid.width(0, grid.cell_at(0, 0.5 * (e.low[0] + e.high[0])));
    const double across = std::min(e.high[0] - e.low[0], e.high[1] - e.low[1]) / cell;
    if (across < (1 - 1e-9) * enough) {
      const auto [cells, least] = rounded_apart(across, enough, 2);
      warnings.push_back(fmt::format("body.{}: {} flow cells across, at least {} are needed; {}", body.name,
                                     cells, least, finer));
    }
  }
  return warnings;
}

namespace {

constexpr double open_cfm =
    10;  // tighter cloth changes by less than 40 % from 124.5 to 1000 Pa (assumed b / a)

/// Pressures beyond those at which open cloth was measured.
std::vector<std::string> pressure_warnings(const Settings& resolved) {
  const ClothResistance& cloth = resolved.materials().canopy.resistance;
  if (model_of(cloth) != PorosityModel::sheet || cfm(as_sheet(cloth)) < open_cfm) return {};
  const FlowSettings& flow = resolved.flow();
  return outside_range(permeability_model,
                       {{"dynamic pressure", 0.5 * flow.density_kg_m3 * flow.speed_m_s * flow.speed_m_s}});
}

/// Open cloth with a linear law: one reading of a permeability tester does not determine the flow at other pressures.
std::vector<std::string> linear_law_warnings(const Fabric& cloth) {
  if (model_of(cloth.resistance) != PorosityModel::sheet) return {};
  const PressureDrop law = as_sheet(cloth.resistance);
  if (!(law.linear > 0) || law.quadratic > 0 || cfm(law) < open_cfm) return {};
  return {
      fmt::format("materials.{}: {:.3g} CFM/ft2 with a linear law (pressure_drop_quadratic_pa_s2_m2 = 0): "
                  "at 1000 Pa the measured air flow through open cloth is up to 2.6 times smaller; give both "
                  "coefficients of a measured curve (materials/README.md)",
                  cloth.name, cfm(law))};
}

/// Coefficients of porous cells are valid on the cells of their calibration: their resistance is one per volume, and the
/// cells that the cloth cuts have a volume in proportion to their size.
std::vector<std::string> porous_cell_warnings(const Settings& resolved) {
  constexpr double nfm_darcy = 65.98, nfm_forchheimer = 37.45;  // [NFM] Table 3
  const Fabric& cloth = resolved.materials().canopy;
  const PorousCellLaw law = as_cells(cloth.resistance);
  if (!(law.darcy > 0) && !(law.forchheimer > 0)) return {};  // impermeable, or without resistance
  const Vec3 cell = flow_grid(resolved.flow()).spacing({0, 0, resolved.flow().canopy_position_m});
  if (law.darcy != nfm_darcy || law.forchheimer != nfm_forchheimer)
    return {
        fmt::format("materials.{}: coefficients of porous cells (porosity_model = \"paper\") give the right "
                    "drag only on the cells of their calibration, which a material does not contain; the "
                    "cells at this canopy are {:.3g} x {:.3g} x {:.3g} m",
                    cloth.name, cell.x, cell.y, cell.z)};
  std::vector<std::string> all = outside_range(
      porous_cells_model,
      {{"cell width across the stream", std::max(cell.x, cell.y)}, {"cell length along the stream", cell.z}});
  for (std::string& text : all)
    text += "; use these cells (flow.cells, flow.box_m), or a cloth for porosity_model = \"sheet\"";
  return all;
}

}  // namespace

std::vector<std::string> porosity_warnings(const Settings& resolved) {
  const Fabric& cloth = resolved.materials().canopy;
  const PorosityModel used = resolved.flow().porosity_model;
  if (used == model_of(cloth.resistance))
    return used == PorosityModel::sheet ? linear_law_warnings(cloth) : porous_cell_warnings(resolved);
  const auto word = [](PorosityModel model) { return model == PorosityModel::paper ? "paper" : "sheet"; };
  return {
      fmt::format("flow.porosity_model = \"{}\", but the permeability of materials.{} is for \"{}\" "
                  "(materials/README.md)",
                  word(used), cloth.name, word(model_of(cloth.resistance)))};
}

std::vector<std::string> range_warnings(const Settings& resolved) {
  constexpr double heat_ratio = 1.4, gas_constant = 287.05;  // of air, [J/(kg K)]
  const FlowSettings flow = resolved.flow();
  const double speed = flow.speed_m_s;
  const double sound = std::sqrt(heat_ratio * gas_constant * flow.temperature_k);
  const double reynolds =
      flow.density_kg_m3 * speed * nominal_diameter(resolved.parachute()) / flow.viscosity_pa_s;
  return outside_range(flow_model, {{"Mach number", speed / sound}, {"Reynolds number", reynolds}});
}

std::vector<std::string> shape_warnings(const Settings& resolved) {
  const auto* profile = resolved.parachute().canopy.as<ProfileCanopy>();
  if (!profile) return {};
  double highest = -std::numeric_limits<double>::infinity();
  for (const ProfilePiece& piece : profile->pieces)
    for (const double height : piece.height_m) highest = std::max(highest, height);
  const double below = highest - profile->pieces.back().height_m.back();
  if (below <= 1e-6 * nominal_diameter(resolved.parachute())) return {};
  return {
      fmt::format("parachute.pieces: the vent is {:.3g} m below the highest point of the meridian; such an "
                  "apex requires centre lines, which Ripstop does not support: the cloth is cut to this "
                  "shape, but the apex rises in the flow",
                  below)};
}

std::vector<std::string> strain_warnings(const Settings& resolved, double largest_cloth_strain) {
  std::vector<std::string> all;
  for (const auto& [name, material] : resolved.written().materials) {
    const double strain = name == resolved.parachute().canopy_material ? largest_cloth_strain : 0.0;
    for (const std::string& text : material_warnings(material, strain)) all.push_back(text);
  }
  return all;
}

std::vector<std::string> hardware_warnings(const Settings& resolved) {
  std::vector<std::string> all;
  for (const auto& [name, part] : resolved.hardware())
    if (part.rated_load_n && part.kind == Hardware::Kind::textile)
      all.push_back(fmt::format(
          "hardware.{}: the rated load of a textile part has no factors of [margins] for joints, abrasion, "
          "moisture and fatigue; give breaking_load_n if the rating is for a new part without joints",
          name));
    else if (part.breaking_load_n && !part.kind)
      all.push_back(fmt::format(
          "hardware.{}: without kind it is metal, and only the safety factor applies; give kind = "
          "\"textile\" for a cord or webbing, or \"metal\"",
          name));
  return all;
}

namespace {

using Warnings = std::vector<std::string>;

Warnings joined(const std::vector<Warnings>& parts) {
  Warnings all;
  for (const Warnings& more : parts) all.insert(all.end(), more.begin(), more.end());
  return all;
}

Warnings flow_warnings(const Settings& resolved) {
  return joined({grid_warnings(resolved),
                 body_warnings(resolved, flow_grid(resolved.flow()), resolved.flow().unsteady,
                               "increase flow.cells, or narrow flow.core.size_m"),
                 air_warnings(resolved)});
}

}  // namespace

Warnings air_warnings(const Settings& resolved) {
  return joined({porosity_warnings(resolved), range_warnings(resolved), pressure_warnings(resolved)});
}

Warnings case_warnings(const Settings& resolved) {
  return warnings_of(resolved, 0);
}

Warnings warnings_of(const Settings& resolved, double largest_cloth_strain, bool own_mesh) {
  const Warnings none;
  return joined({own_mesh ? none : mesh_warnings(resolved), flow_warnings(resolved),
                 own_mesh ? none : shape_warnings(resolved), strain_warnings(resolved, largest_cloth_strain),
                 hardware_warnings(resolved)});
}

}  // namespace ripstop::inline run
