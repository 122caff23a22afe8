#include "ripstop/case/openrocket_import.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/core/units.h"
#include "ripstop/core/visible.h"

namespace ripstop::inline cases {
namespace {

using std::numbers::pi;

// Projected over nominal diameter of an open flat circular canopy: Knacke has 0.67 to 0.70, the example 0.709.
constexpr double projected_ratio = 0.70;
// On its nominal area no canopy of the handbook has more than 0.95; a larger coefficient is on another area.
constexpr double largest_on_nominal = 1.2;
constexpr double assumed_speed = 20;     // [m/s]
constexpr double assumed_density = 1.2;  // [kg/m3]

std::string list_of(const OpenRocketFile& file) {
  std::string list;
  for (std::size_t i = 0; i < file.devices.size(); ++i) {
    const RecoveryDevice& d = file.devices[i];
    list += fmt::format("\n  {}  {}", i + 1, visible_line(d.name));
    if (d.diameter) list += fmt::format(", {:.4g} m", *d.diameter);
    if (d.streamer) list += ", streamer";
    if (!d.event.empty()) list += ", " + visible_line(d.event);
    if (!d.stage.empty()) list += ", stage " + visible_line(d.stage);
  }
  return list;
}

/// As the file gives it, or by OpenRocket's formula from the flat area, the lines and their densities [kg].
std::optional<double> mass_of(const RecoveryDevice& d) {
  if (d.mass) return d.mass;
  const double lines = d.line_count.value_or(0) * d.line_length.value_or(0);
  if (!d.diameter || !d.cloth_density || (lines > 0 && !d.line_density)) return {};
  return pi / 4 * *d.diameter * *d.diameter * *d.cloth_density + lines * d.line_density.value_or(0);
}

class OpenRocketImporter {
 public:
  OpenRocketImporter(const OpenRocketFile& file, const RecoveryDevice& device,
                     const OpenRocketImportOptions& options, const std::string& source)
      : file_(file), d_(device), options_(options), source_(source) {}

  ImportedCase run() {
    if (d_.streamer) refuse("is a streamer; Ripstop computes parachutes only");
    if (!d_.diameter) refuse("has no diameter");
    result_.type = "flat-circular";
    result_.case_text = head();
    for (const auto part :
         {&OpenRocketImporter::canopy, &OpenRocketImporter::lines, &OpenRocketImporter::materials,
          &OpenRocketImporter::flight})  // in this order: the canopy decides the area
      result_.case_text += (this->*part)();
    for (const std::string& note : file_.notes) result_.not_mapped.push_back(note);
    if (d_.mass)
      result_.not_mapped.push_back(fmt::format(
          "mass of the parachute, {:.4g} kg: Ripstop computes it from cloth, lines and seams", *d_.mass));
    result_.not_mapped.push_back("packed size, position in the rocket, and all other components");
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw Error(ExitCode::bad_data,
                fmt::format("{}:{}: \"{}\" {}", source_, d_.line, visible_line(d_.name), reason));
  }
  template <class... Args>
  void mapped(fmt::format_string<Args...> text, Args&&... args) {
    result_.mapped.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
  template <class... Args>
  void assumed(fmt::format_string<Args...> text, Args&&... args) {
    result_.assumed.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  std::string head() {
    std::string text = fmt::format("# From {} of {} by `ripstop import`.\n",
                                   toml_quoted(visible_line(d_.name), 100), toml_quoted(source_, 500));
    if (!d_.event.empty()) {
      std::string event = d_.event;
      if (event == "altitude" && d_.altitude) event += fmt::format(" {:g} m above ground", *d_.altitude);
      if (d_.delay && *d_.delay > 0) event += fmt::format(", delay {:g} s", *d_.delay);
      text += "# Deployment: " + visible_line(event) + "\n";
      mapped("deployment at {}: written as a comment, because a case has no trigger", visible_line(event));
    }
    return text + fmt::format("title = {}\n\n[parachute]\ntype = \"flat-circular\"\n",
                              toml_quoted(d_.name.empty() ? "imported" : d_.name, 100));
  }

  std::string canopy() {
    nominal_ = *d_.diameter;
    if (options_.diameter == GivenDiameter::projected) {
      nominal_ /= projected_ratio;
      result_.changed.push_back(fmt::format(
          "projected diameter {:.4g} m: nominal diameter {:.4g} m, with the ratio {:.2f} of an open "
          "flat circular canopy",
          *d_.diameter, nominal_, projected_ratio));
    } else {
      mapped("diameter {:.4g} m: that of the cloth laid flat", nominal_);
    }
    result_.changed.push_back(
        "shape: a flat circular canopy, because the file has none; change parachute.type for another one");
    const int lines = line_count();
    const int gores = d_.sides.value_or(0) >= 3 ? *d_.sides : std::max(lines, 6);
    if (d_.sides.value_or(0) >= 3)
      mapped("{} sides: gores", gores);
    else
      assumed("{} gores", gores);
    std::string text = fmt::format("nominal_diameter_m = {:.9g}\ngores = {}\n", nominal_, gores) + vent();
    if (lines % 2 != 0) text += "vent_lines = false  # an odd number of lines has no opposite ones\n";
    if (d_.cloth_density) text += "canopy_material = \"imported-cloth\"\n";
    return text;
  }

  std::string vent() {
    const double given = options_.vent_diameter.value_or(d_.spill_hole.value_or(0));
    if (given >= nominal_)
      refuse(fmt::format("has a spill hole of {:.4g} m, not smaller than its canopy", given));
    if (given > 0) {
      if (!options_.vent_diameter) mapped("spill hole {:.4g} m", given);
      return fmt::format("vent_diameter_m = {:.9g}\n", given);
    }
    assumed("a vent of {:g} % of the diameter (--vent-diameter)", 100 * openrocket_vent_share);
    return fmt::format("vent_diameter_m = {:.9g}  # assumed\n", openrocket_vent_share * nominal_);
  }

  int line_count() {
    if (options_.line_count) return *options_.line_count;
    if (d_.line_count.value_or(0) >= 3) return *d_.line_count;
    return openrocket_line_count;
  }

  std::string lines() {
    const int count = line_count();
    if (!options_.line_count && d_.line_count.value_or(0) >= 3)
      mapped("{} lines", count);
    else if (!options_.line_count)
      assumed("{} lines: the file has {} (--lines)", count, d_.line_count.value_or(0));
    const bool given = d_.line_length.value_or(0) > 0;
    const double length =
        options_.line_length.value_or(given ? *d_.line_length : openrocket_line_share * nominal_);
    if (length <= 0.5 * nominal_)
      refuse(fmt::format(
          "has lines of {:.4g} m, too short to meet under a canopy of {:.4g} m; use --line-length", length,
          nominal_));
    if (!options_.line_length && given) mapped("lines of {:.4g} m", length);
    if (!options_.line_length && !given)
      assumed("lines of {:g} nominal diameters (--line-length)", openrocket_line_share);
    std::string text = fmt::format("\n[parachute.lines]\ncount = {}\nlength_m = {:.9g}\n", count, length);
    if (d_.line_density) text += "material = \"imported-line\"\n";
    // Cells a tenth of the diameter suffice for a small vent; the number is that of the examples of openchute.
    return text + "\n[parachute.mesh]\ncloth_nodes = 11200\n";
  }

  std::string materials() {
    std::string text;
    const auto add = [&](const char* name, const char* base, const char* kind, const std::string& given,
                         double density, const char* key, const char* unit) {
      text += fmt::format(
          "\n[materials.{}]\nbase = \"{}\"  # assumed: the file has name and mass only\nsource = {}\n{} = "
          "{:.9g}\n",
          name, base,
          toml_quoted(
              fmt::format("mass of \"{}\" in the file of OpenRocket; all other properties assumed as {}",
                          given, base),
              400),
          key, density);
      mapped("{} \"{}\", {:.4g} {}", kind, visible_line(given), density, unit);
      assumed("stiffness and strength of the {}: those of {}", kind, base);
    };
    if (d_.cloth_density)
      add("imported-cloth", "pia-c-44378-type-iv", "cloth", d_.cloth, *d_.cloth_density,
          "areal_density_kg_m2", "kg/m2");
    else
      assumed("cloth: the default material, because the file has no density of a cloth");
    if (d_.line_density)
      add("imported-line", "nylon-line-type-ii", "line", d_.line_material, *d_.line_density,
          "linear_density_kg_m", "kg/m");
    else
      assumed("lines: the default material, because the file has no density of a line");
    return text;
  }

  /// Payload of the stored simulation: Ripstop adds the mass of its own parachutes [kg].
  double simulated_payload() {
    double payload = *d_.descent_mass;
    std::string subtracted, unknown;
    for (const RecoveryDevice& other : file_.devices) {
      if (other.streamer || other.stage != d_.stage) continue;
      const std::optional<double> mass = mass_of(other);
      payload -= mass.value_or(0);
      const std::string name = fmt::format("\"{}\"", visible_line(other.name));
      if (mass)
        subtracted += fmt::format("{}{} {:.3g} kg", subtracted.empty() ? "" : ", ", name, *mass);
      else
        unknown += (unknown.empty() ? "" : ", ") + name;
    }
    if (!(payload > 0))
      refuse(
          fmt::format("is in a stage of {:.4g} kg at the end of the simulation \"{}\", not more than its "
                      "parachutes; give the payload with --mass",
                      *d_.descent_mass, visible_line(d_.simulation)));
    if (!subtracted.empty())
      mapped(
          "payload {:.4g} kg: mass at the end of the simulation \"{}\", {:.4g} kg, without the parachutes "
          "({})",
          payload, visible_line(d_.simulation), *d_.descent_mass, subtracted);
    else
      mapped("payload {:.4g} kg: mass at the end of the simulation \"{}\"", payload,
             visible_line(d_.simulation));
    if (!unknown.empty())
      result_.changed.push_back(
          fmt::format("the payload includes the parachute {}, because the file has no mass of it: correct "
                      "payload.mass_kg",
                      unknown));
    return payload;
  }

  std::string flight() {
    std::string text;
    const std::optional<double> mass = options_.payload_mass ? options_.payload_mass
                                       : d_.descent_mass     ? std::optional(simulated_payload())
                                                             : std::nullopt;
    const double nominal_area = pi / 4 * nominal_ * nominal_;
    double speed = assumed_speed, coefficient = 0;
    if (d_.drag_coefficient) {
      const double drag_area = *d_.drag_coefficient * pi / 4 * *d_.diameter * *d_.diameter;
      coefficient = drag_area / nominal_area;
      mapped("C_D {:.4g} on {:.4g} m2: drag area {:.4g} m2, C_D {:.4g} on S0 = {:.4g} m2 for ripstop load",
             *d_.drag_coefficient, drag_area / *d_.drag_coefficient, drag_area, coefficient, nominal_area);
      if (coefficient > largest_on_nominal)
        result_.changed.push_back(fmt::format(
            "C_D {:.4g} on the area of the cloth is larger than that of any parachute of the handbook "
            "(0.95): it is probably on the projected area; import with --diameter-is projected, or correct "
            "the case",
            coefficient));
      const std::optional<double> carried = options_.payload_mass ? mass : d_.descent_mass;
      if (carried) speed = std::sqrt(2 * *carried * standard_gravity / (assumed_density * drag_area));
    } else {
      result_.not_mapped.push_back(
          d_.automatic ? "C_D \"auto\": OpenRocket's own value is used there; compute it with ripstop "
                         "steady"
                       : "no C_D in the file; compute it with ripstop steady");
    }
    if (mass)
      text += fmt::format("\n[payload]\nmass_kg = {:.9g}\n", *mass);
    else
      assumed("no payload: the file has no stored simulation with a mass (--mass)");
    text += fmt::format("\n[flow]  # assumed\nspeed_m_s = {:.4g}\ndensity_kg_m3 = {:g}\n", speed,
                        assumed_density);
    if (mass && d_.drag_coefficient)
      assumed("flow: the rate of descent with this C_D, {:.3g} m/s, at {:g} kg/m3", speed, assumed_density);
    else
      assumed("flow: {:g} m/s at {:g} kg/m3", speed, assumed_density);
    if (coefficient > 0)
      text += fmt::format(
          "\n[inflation]\ndrag_coefficient = {:.9g}  # on S0, for ripstop load\n"
          "drag_coefficient_basis = \"descent\"\n",
          coefficient);
    return text;
  }

  const OpenRocketFile& file_;
  const RecoveryDevice& d_;
  const OpenRocketImportOptions& options_;
  const std::string& source_;
  ImportedCase result_;
  double nominal_ = 0;  // diameter [m]
};

}  // namespace

const RecoveryDevice& choose_device(const OpenRocketFile& file, std::string_view wanted) {
  if (file.devices.empty()) throw Error(ExitCode::bad_data, "the file has no parachute and no streamer");
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (error == std::errc() && end == wanted.data() + wanted.size() && number >= 1 &&
      number <= file.devices.size())
    return file.devices[number - 1];
  const RecoveryDevice* found = nullptr;
  int fitting = 0;
  for (const RecoveryDevice& d : file.devices)
    if (wanted.empty() ? !d.streamer : d.name == wanted) found = &d, ++fitting;
  if (fitting == 1) return *found;
  if (fitting == 0 && wanted.empty()) return file.devices.front();  // streamers only
  throw Error(
      ExitCode::usage,
      fmt::format("{}; choose one by its number with --device:{}",
                  wanted.empty() ? fmt::format("the file has {} recovery devices", file.devices.size())
                  : fitting == 0 ? fmt::format("--device {}: no such recovery device", wanted)
                                 : fmt::format("--device {}: {} devices have this name", wanted, fitting),
                  list_of(file)));
}

ImportedCase import_openrocket(const OpenRocketFile& file, const RecoveryDevice& device,
                               const OpenRocketImportOptions& options, const std::string& source) {
  return OpenRocketImporter(file, device, options, source).run();
}

}  // namespace ripstop::inline cases
