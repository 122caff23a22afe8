#include "ripstop/run/sizing/size_case.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "ripstop/core/build_info.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/write.h"

namespace ripstop {
namespace {

double scaled(double length, double factor) {
  return std::round(length * factor * 1e4) / 1e4;
}

void scale_fields(const Fields& fields, double factor) {
  for (const Field& field : fields.list()) {
    if (const auto* kind = std::get_if<Kind>(&field.value)) scale_fields(kind->select(kind->get()), factor);
    if (const auto* sub = std::get_if<Subtable>(&field.value); sub && field.key != "mesh")
      scale_fields(sub->fields(), factor);
    if (const auto* rows = std::get_if<Rows>(&field.value))
      for (std::size_t i = 0; i < rows->count(); ++i) scale_fields(rows->row(i), factor);
    if (!field.key.ends_with("_m")) continue;
    if (const auto* value = std::get_if<double*>(&field.value)) **value = scaled(**value, factor);
    if (const auto* value = std::get_if<std::optional<double>*>(&field.value); value && **value)
      **value = scaled(***value, factor);
    if (const auto* list = std::get_if<NumberList>(&field.value))
      for (double& value : *list->value) value *= factor;
  }
}

/// What a reader of the file may want to know of a key.
std::string comment_on(const std::string& key, const SizeResult& r) {
  if (key == "nominal_diameter_m")
    return r.handbook_diameter ? fmt::format("{:.2f} to {:.2f} by the handbook's range of C_D",
                                             r.handbook_diameter->at(1), r.handbook_diameter->at(0))
                               : "";
  if (key == "vent_diameter_m")
    return fmt::format("{:.2f} % of the area", 100 * r.vent_area / r.nominal_area);
  if (key == "lines.material")
    return fmt::format("{:.0f} % of its strength after losses and safety at the opening", 100 * r.line_used);
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

void scale_lengths(Design& design, double factor) {
  Fields fields;
  describe(fields, design);
  scale_fields(fields, factor);
}

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
      "# Opening load {:.0f} to {:.0f} N behind {:g} kg at {:g} m/s, by the methods that apply (ripstop "
      "load).\n"
      "title = \"{}\"\n\n",
      r.parachute_mass, r.cloth_mass, r.tape_mass, r.line_mass, 1000 * r.packed_volume,
      request.packing_density, r.opening_load_low, r.opening_load, r.payload_mass, r.deployment_speed,
      r.given.title);
  text += parachute_text(r);
  text += fmt::format(
      "\n[payload]  # in place of a speed: ripstop steady finds the one at which drag is weight\n"
      "mass_kg = {}\n\n[flow]\n",
      r.payload_mass);
  text += request.density ? fmt::format("density_kg_m3 = {}\n", r.density)
                          : fmt::format("height_m = {}  # above sea level, standard atmosphere\n", r.height);
  text += fmt::format("speed_m_s = {}  # where the search begins\n", r.descent_rate);
  return text;
}

}  // namespace ripstop
