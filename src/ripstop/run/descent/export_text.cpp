// The texts of an exported recovery: Python for RocketPy, XML for OpenRocket.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/markup.h"
#include "ripstop/run/descent/export.h"
#include "ripstop/run/json.h"
#include "ripstop/run/opening/filling.h"

namespace ripstop::inline run {
namespace {

constexpr int sampling_rate = 100;  // of RocketPy's triggers [1/s]

/// A string literal that Python and JSON read alike.
std::string literal(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true);
}

std::string basis_text(const ExportedParachute& p) {
  return (p.basis == "descent" ? "that in descent (computed free flight, with glide and oscillation)"
                               : "axial (steady flow on the axis, without glide and oscillation)") +
         (p.known_coefficient ? fmt::format("; Knacke, in descent: {:.2f} to {:.2f}",
                                            p.known_coefficient->at(0), p.known_coefficient->at(1))
                              : std::string());
}

/// Nothing for apogee, else the height above the ground [m].
std::optional<double> trigger_height(const std::string& trigger) {
  if (trigger == "apogee") return {};
  double height = 0;
  const auto [end, error] = std::from_chars(trigger.data(), trigger.data() + trigger.size(), height);
  if (error != std::errc() || end != trigger.data() + trigger.size() || !(height > 0) ||
      !std::isfinite(height))
    throw Error(
        ExitCode::usage,
        fmt::format("--trigger {}: must be apogee, or a height above the ground in metres above 0", trigger));
  return height;
}

/// A reefed stage or the full opening.
struct Part {
  double share = 1, added = 1;  // of the drag area, in all and by this part
  double after = 0, lag = 0;    // since the trigger, from then to the drag area [s]
  std::string name;
};

/// A stage fills as the root of the share of the drag area that it adds: docs/theory/opening-load.md, Reefing. The filling
/// time of every stage is at the speed of the deployment.
std::vector<Part> parts_of(const ExportedStage& stage, const std::string& name) {
  std::vector<Part> parts;
  double before = 0, after = 0;
  std::vector<ReefedStage> all = stage.reefing;
  all.push_back({1, 0});
  for (const ReefedStage& reefed : all) {
    Part part{reefed.share, reefed.share - before, after,
              stage.parachute.lag * std::sqrt(reefed.share - before),
              reefed.share < 1 ? fmt::format("{}, reefed to {:.3g} %", name, 100 * reefed.share) : name};
    if (reefed.share < 1 && !(reefed.duration > part.lag))
      throw Error(
          ExitCode::usage,
          fmt::format("--reef {:g}:{:g}: the stage fills within {:.3g} s; its duration must be longer",
                      reefed.share, reefed.duration, part.lag));
    before = reefed.share, after += reefed.duration;
    parts.push_back(std::move(part));
  }
  return parts;
}

std::string stage_name(const ExportedRecovery& recovery, std::size_t i) {
  const std::string& title = recovery.stages[i].parachute.title;
  if (recovery.stages.size() == 1) return title;
  return (i == 0 ? "drogue, " : "main, ") + title;
}

std::string comment_of(const ExportedStage& stage, const std::string& name) {
  const ExportedParachute& p = stage.parachute;
  std::string warnings;
  for (const std::string& text : p.warnings) warnings += "# Warning: " + literal(text) + "\n";
  return fmt::format(
             "# {}: drag area {:.4f} +- {:.4f} m2 (numerical uncertainty of the run). Lag: {}.\n"
             "# Reference area of drag_coefficient: pi radius^2 = {:.4f} m2, as RocketPy defines it. On "
             "the nominal area\n# S0 = {:.4f} m2 the drag coefficient of the open canopy is C_D = {:.4f}.\n"
             "# This coefficient is {}.\n",
             literal(name), p.drag_area, p.drag_area_uncertainty, p.lag_from,
             std::numbers::pi * p.radius * p.radius, p.nominal_area, p.drag_coefficient, basis_text(p)) +
         warnings;
}

// RocketPy passes no time to a trigger, and calls it once or twice per sample (time_overshoot). The time therefore follows
// from the heights lost, dt = 2 dz / (v1 + v2), which is exact at constant acceleration.
constexpr const char* after_class =
    "class After:\n"
    "    \"\"\"A time after a trigger. RocketPy passes none: it is the height lost over the speed, "
    "summed.\"\"\"\n\n"
    "    def __init__(self, trigger, seconds):\n"
    "        self.trigger, self.seconds, self.time, self.last = trigger, seconds, 0, None\n\n"
    "    def __call__(self, pressure, height, state):\n"
    "        z, descent = state[2], -state[5]\n"
    "        if descent <= 0:  # the rocket ascends, also at the start of the next simulation\n"
    "            self.time, self.last = 0, None\n"
    "            return False\n"
    "        if self.last is not None:\n"
    "            self.time += 2 * (self.last[0] - z) / (self.last[1] + descent)\n"
    "        elif self.trigger != \"apogee\" and height >= self.trigger:\n"
    "            return False\n"
    "        self.last = (z, descent)\n"
    "        return self.time >= self.seconds\n\n\n";

/// RocketPy fails on a negative lag, which a normal distribution has in one of 740 draws. A gamma distribution of the
/// same mean and standard deviation has none: shape (mean / deviation)^2, scale deviation^2 / mean.
std::string lag_distribution(double lag, double relative_deviation) {
  if (!(lag > 0 && relative_deviation > 0)) return {};
  const double square = relative_deviation * relative_deviation;
  return fmt::format(", lag=({}, {}, \"gamma\")", 1 / square, lag * square);
}

/// Of a drogue that remains, in the drag area of the main [m2].
struct OtherDrag {
  double area = 0, mean = 0, deviation = 0;
};

/// The two dictionaries of one part: arguments, and distributions of drag area and lag.
struct PartText {
  std::string arguments, deviations;
};
PartText rocketpy_part(const ExportedStage& stage, const Part& part, const OtherDrag& others) {
  const ExportedParachute& p = stage.parachute;
  const std::optional<double> height = trigger_height(stage.trigger);
  const std::string plain = height ? fmt::format("{}", *height) : "\"apogee\"";
  const double area = part.share * p.drag_area + others.area, radius = p.radius * std::sqrt(part.share);
  return {
      fmt::format("    dict(\n        name={},\n        cd_s={},\n        trigger={},\n"
                  "        sampling_rate=SAMPLING_RATE,\n        lag={},\n        noise=(0, 0, 0),\n"
                  "        radius={},\n        height={},\n        porosity={},\n"
                  "        drag_coefficient={},\n    ),\n",
                  literal(part.name), area,
                  part.after > 0 ? fmt::format("After({}, {})", plain, part.after) : plain, part.lag, radius,
                  p.height * std::sqrt(part.share), p.porosity, area / (std::numbers::pi * radius * radius)),
      fmt::format("    dict(cd_s=({}, {}){}),\n", part.share * p.drag_area_mean + others.mean,
                  std::hypot(part.share * p.drag_area_deviation, others.deviation),
                  lag_distribution(part.lag, p.lag > 0 ? p.lag_deviation / p.lag : 0))};
}

std::string material_text(const std::string& name, double density, const char* unit, const char* type) {
  return fmt::format(
      "        <Material UnitsOfMeasure=\"{}\">\n            <Name>{}</Name>\n            <Density>{}"
      "</Density>\n            <Type>{}</Type>\n        </Material>\n",
      unit, escaped_markup(name), density, type);
}

std::string component_text(const ExportedParachute& p, const std::string& name) {
  return fmt::format(
      "        <Parachute>\n            <Manufacturer>Ripstop</Manufacturer>\n"
      "            <PartNumber>{}</PartNumber>\n"
      "            <Description>{}</Description>\n            <Material Type=\"SURFACE\">{}</Material>\n"
      "            <Mass Unit=\"kg\">{}</Mass>\n            <Diameter Unit=\"m\">{}</Diameter>\n"
      "            <Sides>{}</Sides>\n            <PackedDiameter Unit=\"m\">{}</PackedDiameter>\n"
      "            <PackedLength Unit=\"m\">{}</PackedLength>\n            "
      "<DragCoefficient>{}</DragCoefficient>\n"
      "            <LineCount>{}</LineCount>\n            <LineLength Unit=\"m\">{}</LineLength>\n"
      "            <LineMaterial Type=\"LINE\">{}</LineMaterial>\n        </Parachute>\n",
      escaped_markup(name),
      escaped_markup(fmt::format("{}: C_D S {:.4f} m2, C_D on S0 = {:.4f} m2, {}, by Ripstop {}", p.title,
                                 p.drag_area, p.nominal_area, p.basis, version())),
      escaped_markup(p.cloth_material), p.mass, p.nominal_diameter, p.gores, p.packed_diameter,
      p.packed_length, p.drag_coefficient, p.line_count, p.line_length, escaped_markup(p.line_material));
}

/// A device of a design. The mass belongs to the first part of a parachute.
std::string device_text(const ExportedStage& stage, const Part& part) {
  const ExportedParachute& p = stage.parachute;
  const std::optional<double> height = trigger_height(stage.trigger);
  return fmt::format(
      "                <parachute>\n                  <name>{}</name>\n"
      "                  <comment>Delay: {}</comment>\n"
      "                  <overridemass>{}</overridemass>\n"
      "                  <packedlength>{}</packedlength>\n                  <packedradius>{}</packedradius>\n"
      "                  <cd>{}</cd>\n                  <material type=\"surface\" "
      "density=\"{}\">{}</material>\n"
      "                  <deployevent>{}</deployevent>\n{}"
      "                  <deploydelay>{}</deploydelay>\n                  <diameter>{}</diameter>\n"
      "                  <linecount>{}</linecount>\n                  <linelength>{}</linelength>\n"
      "                  <linematerial type=\"line\" density=\"{}\">{}</linematerial>\n"
      "                </parachute>\n",
      escaped_markup(part.name), escaped_markup(p.lag_from), part.after > 0 ? 0 : p.mass, p.packed_length,
      p.packed_diameter / 2, part.added * p.drag_coefficient, p.cloth_density,
      escaped_markup(p.cloth_material), height ? "altitude" : "apogee",
      height ? fmt::format("                  <deployaltitude>{}</deployaltitude>\n", *height) : "",
      part.after + part.lag, p.nominal_diameter, p.line_count, p.line_length, p.line_density,
      escaped_markup(p.line_material));
}

}  // namespace

// RocketPy takes a missing radius from cd_s = drag_coefficient pi radius^2, so all three must agree.
std::string rocketpy_text(const ExportedRecovery& recovery) {
  std::string comments, arguments, deviations;
  bool timed = false;
  OtherDrag others;
  for (std::size_t i = 0; i < recovery.stages.size(); ++i) {
    const ExportedStage& stage = recovery.stages[i];
    comments += comment_of(stage, stage_name(recovery, i));
    for (const Part& part : parts_of(stage, stage_name(recovery, i))) {
      const PartText text = rocketpy_part(stage, part, others);
      arguments += text.arguments, deviations += text.deviations;
      timed = timed || part.after > 0;
    }
    if (!recovery.drogue_released)
      others = {stage.parachute.drag_area, stage.parachute.drag_area_mean,
                stage.parachute.drag_area_deviation};
  }
  return fmt::format(
      "# Parachutes for RocketPy 1.12 and later, by Ripstop {}.\n{}"
      "# RocketPy's added mass follows from radius, height and porosity: those of the computed canopy.\n{}"
      "SAMPLING_RATE = {}\n\n\n{}"
      "parachutes = [\n{}]\n\n"
      "# For StochasticParachute. Drag area: mean and standard deviation, from the middle and a quarter\n"
      "# of the width of its range in descent (as ripstop recovery; assumed). Lag: gamma distribution\n"
      "# (shape, scale) with a standard deviation of {:.0f} % (assumed): RocketPy fails on a lag below 0.\n"
      "deviations = [\n{}]\n\n\n"
      "def add_to(rocket):\n    \"\"\"Add the parachutes to a rocketpy.Rocket and return them.\"\"\"\n"
      "    return [rocket.add_parachute(**arguments) for arguments in parachutes]\n\n\n"
      "def add_stochastic_to(stochastic_rocket, added):\n"
      "    \"\"\"Add the parachutes that add_to() returned to a rocketpy.StochasticRocket.\"\"\"\n"
      "    from rocketpy import StochasticParachute\n\n"
      "    for parachute, deviation in zip(added, deviations):\n"
      "        stochastic_rocket.add_parachute(StochasticParachute(parachute, **deviation))\n",
      version(), comments,
      recovery.stages.size() > 1 && !recovery.drogue_released
          ? "# cd_s of the main includes the drogue, which remains attached: RocketPy uses the last one "
            "only.\n"
          : "",
      sampling_rate, timed ? after_class : "", arguments, 100 * filling_time_scatter, deviations);
}

std::string rocketpy_text(const ExportedParachute& p, const std::string& trigger) {
  return rocketpy_text(ExportedRecovery{{{p, trigger}}});
}

// The elements and their order are those of OpenRocket's own component databases.
std::string openrocket_text(const ExportedRecovery& recovery) {
  std::string materials, components;
  for (std::size_t i = 0; i < recovery.stages.size(); ++i) {
    const ExportedParachute& p = recovery.stages[i].parachute;
    for (const std::string& text : {material_text(p.cloth_material, p.cloth_density, "kg/m2", "SURFACE"),
                                    material_text(p.line_material, p.line_density, "kg/m", "LINE")})
      if (materials.find(text) == std::string::npos) materials += text;
    components += component_text(p, stage_name(recovery, i));
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n<OpenRocketComponent>\n"
      "    <Version>0.1</Version>\n    <Materials>\n{}    </Materials>\n    <Components>\n{}"
      "    </Components>\n</OpenRocketComponent>\n",
      materials, components);
}

std::string openrocket_text(const ExportedParachute& p) {
  return openrocket_text(ExportedRecovery{{{p}}});
}

// Elements of version 1.8 of the format, which all present versions of OpenRocket read.
std::string openrocket_design(const ExportedRecovery& recovery) {
  if (recovery.drogue_released)
    throw Error(ExitCode::usage,
                "OpenRocket adds the drag areas of all open devices and cannot release a drogue: leave out "
                "--drogue-released");
  std::string devices;
  double length = 0, radius = 0;
  for (std::size_t i = 0; i < recovery.stages.size(); ++i) {
    const ExportedStage& stage = recovery.stages[i];
    for (const Part& part : parts_of(stage, stage_name(recovery, i))) devices += device_text(stage, part);
    length += stage.parachute.packed_length;
    radius = std::max(radius, stage.parachute.packed_diameter / 2);
  }
  return fmt::format(
      "<?xml version='1.0' encoding='utf-8'?>\n<openrocket version=\"1.8\" creator=\"Ripstop {}\">\n"
      "  <rocket>\n    <name>Recovery by Ripstop</name>\n    <subcomponents>\n      <stage>\n"
      "        <name>Sustainer</name>\n        <subcomponents>\n          <bodytube>\n"
      "            <name>Parachute bay</name>\n            <length>{}</length>\n"
      "            <thickness>0.002</thickness>\n            <radius>{}</radius>\n"
      "            <subcomponents>\n{}            </subcomponents>\n"
      "          </bodytube>\n        </subcomponents>\n      </stage>\n    </subcomponents>\n  </rocket>\n"
      "</openrocket>\n",
      version(), length, radius + 0.002, devices);
}

}  // namespace ripstop::inline run
