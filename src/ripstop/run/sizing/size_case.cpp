#include "ripstop/run/sizing/size_case.h"

#include <fmt/format.h>

#include <sstream>

#include "ripstop/case/payload.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/write.h"

namespace ripstop::inline run {
namespace {

/// Comments of the file on a key.
std::string comment_on(const std::string& key, const SizeResult& r) {
  if (key == "nominal_diameter_m")
    return r.handbook_diameter ? fmt::format("{:.2f} to {:.2f} for the handbook range of C_D",
                                             r.handbook_diameter->at(1), r.handbook_diameter->at(0))
                               : "";
  if (key == "vent_diameter_m")
    return fmt::format("{:.2f} % of the area", 100 * r.vent_area / r.nominal_area);
  if (key == "lines.material")
    return fmt::format("utilisation {:.0f} % under the highest design load", 100 * r.line_used);
  if (key == "tape.material") return r.tape_source;
  return "";
}

/// The parachute's keys as to_toml() writes them, without those that the example leaves to their defaults.
std::string parachute_text(const SizeResult& r) {
  Design design = r.given.parachute;
  Fields fields;
  describe(fields, design);
  std::istringstream all(to_toml(fields));
  std::string text = "[parachute]\n", line, table;
  bool rows = false;
  std::string head;
  while (std::getline(all, line)) {
    if (line.empty()) continue;
    if (line.front() == '[') {
      rows = line.starts_with("[[");
      table = line.substr(rows ? 2 : 1, line.find(']') - (rows ? 2 : 1));
      head = rows ? "\n[[parachute." + table + "]]\n" : "\n[parachute." + table + "]\n";
      continue;
    }
    const std::string key = (table.empty() || rows ? "" : table + ".") + line.substr(0, line.find(' '));
    const bool chosen =
        key == "lines.material" || key == "tape.material" || key == "canopy_material" || key == "type";
    if (!rows && !chosen && !r.given.origins.contains("parachute." + key)) continue;
    const std::string comment = comment_on(key, r);
    text += head + line + (comment.empty() ? "" : "  # " + comment) + "\n";
    head.clear();
  }
  return text;
}

}  // namespace

std::string size_case_text(const SizeRequest& request, const SizeResult& r) {
  std::string text = fmt::format(
      "# A {} parachute for {:g} kg at {:g} m/s in air of {:.4g} kg/m3, by ripstop size, Ripstop {}.\n"
      "# Drag coefficient {:.3f} on S0 = {:.4g} m2: {}.\n",
      r.family, r.payload_mass, r.descent_rate, r.density, version(), r.drag_coefficient, r.nominal_area,
      r.drag_source);
  if (r.handbook_drag_coefficient)
    text += fmt::format("# The handbook has {:.2f} to {:.2f} for the family (Knacke, in descent).\n",
                        r.handbook_drag_coefficient->at(0), r.handbook_drag_coefficient->at(1));
  text += fmt::format(
      "# Parachute {:.3g} kg: cloth {:.3g}, tape {:.3g}, lines {:.3g}; packed {:.3g} litres at {:g} kg/m3.\n"
      "# Design load {:.0f} N for a payload of {:g} kg at {:g} m/s: {} (ripstop load).\n"
      "# Highest design load {:.0f} N, with the uncertainty of {:.0f} %: {}.\n"
      "title = \"{}\"\n\n",
      r.parachute_mass, r.cloth_mass, r.tape_mass, r.line_mass, 1000 * r.packed_volume,
      request.packing_density, r.design_load, r.payload_mass, r.deployment_speed, r.design_load_from,
      r.highest_design_load, 100 * r.load_uncertainty, r.load_uncertainty_from, r.given.title);
  text += parachute_text(r);
  text += fmt::format(
      "\n[payload]  # instead of a speed: ripstop steady computes the speed at which drag equals weight\n"
      "mass_kg = {}\n"
      "deployment_speed_m_s = {}  # airspeed at line stretch, of the design load{}\n\n[flow]\n",
      r.payload_mass, r.deployment_speed,
      r.deployment_speed == usual_deployment_speed(r.descent_rate) ? ": the default of ripstop size" : "");
  text += request.density ? fmt::format("density_kg_m3 = {}\n", r.density)
                          : fmt::format("height_m = {}  # above sea level, standard atmosphere\n", r.height);
  text += fmt::format("speed_m_s = {}  # start value of the iteration\n", r.descent_rate);
  text +=
      fmt::format("\n[inflation]\ndrag_coefficient = {}  # on S0, for ripstop load\n", r.drag_coefficient);
  if (r.drag_basis == "descent") text += "drag_coefficient_basis = \"descent\"\n";
  return text;
}

}  // namespace ripstop::inline run
