#include "ripstop/run/descent/export.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/markup.h"
#include "ripstop/core/positive.h"
#include "ripstop/run/descent/descent.h"
#include "ripstop/run/json.h"
#include "ripstop/run/opening/filling.h"
#include "ripstop/run/sizing/pattern.h"
#include "ripstop/run/steady/steady_folder.h"

namespace ripstop {
namespace {

/// A string literal that Python and JSON read alike.
std::string literal(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true);
}

std::string basis_text(const ExportedParachute& p) {
  return (p.basis == "descent" ? "that in descent (flown, with glide and oscillation)"
                               : "axial (steady flow on the axis, without glide and oscillation)") +
         (p.known_coefficient ? fmt::format("; Knacke, in descent: {:.2f} to {:.2f}",
                                            p.known_coefficient->at(0), p.known_coefficient->at(1))
                              : std::string());
}

std::string trigger_literal(const std::string& trigger) {
  if (trigger == "apogee") return "\"apogee\"";
  double height = 0;
  const auto [end, error] = std::from_chars(trigger.data(), trigger.data() + trigger.size(), height);
  if (error != std::errc() || end != trigger.data() + trigger.size() || !(height > 0) ||
      !std::isfinite(height))
    throw Error(
        ExitCode::usage,
        fmt::format("--trigger {}: must be apogee, or a height above the ground in metres above 0", trigger));
  return fmt::format("{}", height);
}

}  // namespace

std::string to_json(const ExportedParachute& parachute) {
  return json_text(parachute);
}

ExportedParachute exported(const FinishedSteady& run, std::optional<double> deployment_speed,
                           const std::optional<FinishedFlight>& flight) {
  const Design& design = run.resolved.parachute();
  const double speed = deployment_speed.value_or(run.result.speed);
  require_positive("deployment speed (m/s)", speed);
  ExportedParachute p;
  p.title = run.result.title, p.run = run.folder.string();
  if (flight) require_same_parachute(flight->resolved, flight->folder.string(), run.resolved);
  const CarryingRun carries = flight ? carrying_run(*flight) : carrying_run(run);
  p.basis = carries.basis;
  p.drag_area = carries.drag_area, p.drag_area_uncertainty = carries.uncertainty * p.drag_area;
  p.known_coefficient = experience(design).drag_coefficient.if_known();
  p.nominal_area = run.result.reference_area;
  p.nominal_diameter = nominal_diameter(design);
  p.drag_coefficient = flight ? *flight->result.coefficient : run.result.drag_coefficient;
  p.drag_coefficient_on = "nominal_area_m2";
  p.radius = run.result.size.projected_diameter / 2, p.height = run.result.size.length;
  p.porosity = facts(design).geometric_porosity();
  const KnownFilling filling = known_filling(design.canopy.family().type);
  const double constant = filling_constant_at(filling.constant, speed);
  p.lag = constant * p.nominal_diameter / speed;
  p.lag_from = fmt::format("filling distance {:.3g} D0 at {:.3g} m/s: {}", constant, speed, filling.source);
  p.mass = run.parachute_mass;
  p.gores = design.gores, p.line_count = design.lines.count, p.line_length = design.lines.length_m;
  p.line_material = design.lines.material, p.line_density = run.resolved.materials().line.linear_density_kg_m;
  p.cloth_material = design.canopy_material,
  p.cloth_density = run.resolved.materials().canopy.areal_density_kg_m2;
  p.packed_volume = run_pattern(run.resolved, {}, packed_by_hand).bill.packed_volume;
  p.packed_diameter = std::cbrt(2 * p.packed_volume / std::numbers::pi);
  p.packed_length = 2 * p.packed_diameter;
  return p;
}

// RocketPy takes a missing radius from cd_s = drag_coefficient pi radius^2, so all three must agree.
std::string rocketpy_text(const ExportedParachute& p, const std::string& trigger) {
  const double mouth = std::numbers::pi * p.radius * p.radius;  // [m2]
  return fmt::format(
      "# {}: a parachute for RocketPy 1.12, by Ripstop {}.\n"
      "# Drag area {:.4f} +- {:.4f} m2 (numerical uncertainty of the run). Lag: {}.\n"
      "# Reference area of drag_coefficient: pi radius^2 = {:.4f} m2, as RocketPy defines it. On the nominal "
      "area\n"
      "# S0 = {:.4f} m2 the same drag area is C_D = {:.4f}.\n"
      "# This coefficient is {}.\n"
      "# RocketPy's added mass follows from radius, height and porosity: those of the computed canopy.\n"
      "parachute = dict(\n"
      "    name={},\n    cd_s={},\n    trigger={},\n    sampling_rate=100,\n    lag={},\n    noise=(0, 0, "
      "0),\n"
      "    radius={},\n    height={},\n    porosity={},\n    drag_coefficient={},\n)\n\n\n"
      "def add_to(rocket):\n    \"\"\"Adds the parachute to a rocketpy.Rocket.\"\"\"\n"
      "    return rocket.add_parachute(**parachute)\n",
      literal(p.title), version(), p.drag_area, p.drag_area_uncertainty, p.lag_from, mouth, p.nominal_area,
      p.drag_coefficient, basis_text(p), literal(p.title), p.drag_area, trigger_literal(trigger), p.lag,
      p.radius, p.height, p.porosity, p.drag_area / mouth);
}

// The elements and their order are those of OpenRocket's own component databases.
std::string openrocket_text(const ExportedParachute& p) {
  const auto material = [](const std::string& name, double density, const char* unit, const char* type) {
    return fmt::format(
        "        <Material UnitsOfMeasure=\"{}\">\n            <Name>{}</Name>\n            <Density>{}"
        "</Density>\n            <Type>{}</Type>\n        </Material>\n",
        unit, escaped_markup(name), density, type);
  };
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n<OpenRocketComponent>\n"
      "    <Version>0.1</Version>\n    <Materials>\n{}{}    </Materials>\n    <Components>\n        "
      "<Parachute>\n"
      "            <Manufacturer>Ripstop</Manufacturer>\n            <PartNumber>{}</PartNumber>\n"
      "            <Description>{}</Description>\n            <Material Type=\"SURFACE\">{}</Material>\n"
      "            <Mass Unit=\"kg\">{}</Mass>\n            <Diameter Unit=\"m\">{}</Diameter>\n"
      "            <Sides>{}</Sides>\n            <PackedDiameter Unit=\"m\">{}</PackedDiameter>\n"
      "            <PackedLength Unit=\"m\">{}</PackedLength>\n            "
      "<DragCoefficient>{}</DragCoefficient>\n"
      "            <LineCount>{}</LineCount>\n            <LineLength Unit=\"m\">{}</LineLength>\n"
      "            <LineMaterial Type=\"LINE\">{}</LineMaterial>\n        </Parachute>\n    </Components>\n"
      "</OpenRocketComponent>\n",
      material(p.cloth_material, p.cloth_density, "kg/m2", "SURFACE"),
      material(p.line_material, p.line_density, "kg/m", "LINE"), escaped_markup(p.title),
      escaped_markup(fmt::format("{}: C_D S {:.4f} m2, C_D on S0 = {:.4f} m2, {}, by Ripstop {}", p.title,
                                 p.drag_area, p.nominal_area, p.basis, version())),
      escaped_markup(p.cloth_material), p.mass, p.nominal_diameter, p.gores, p.packed_diameter,
      p.packed_length, p.drag_coefficient, p.line_count, p.line_length, escaped_markup(p.line_material));
}

}  // namespace ripstop
