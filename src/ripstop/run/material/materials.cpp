#include "ripstop/run/material/materials.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <variant>

#include "ripstop/core/build_info.h"
#include "ripstop/core/units.h"
#include "ripstop/material/permeability.h"
#include "ripstop/material/spring_law.h"
#include "ripstop/material/strength.h"
#include "ripstop/run/json.h"

namespace ripstop::inline run {
namespace {

constexpr int curve_points = 10;
constexpr double untested_strain = 0.1;  // end of the curve of a material without a tested strain
constexpr std::array flow_pressures = {50.0, 100.0, half_inch_of_water, 250.0, 500.0, 1000.0};  // [Pa]

std::optional<double> known(double value) {
  return value > 0 ? std::optional(value) : std::nullopt;
}

/// Of a cloth; the law of a line or tape has its tension.
void take_curve(const std::vector<double>& warp, const std::vector<double>& weft, MaterialEntry& entry) {
  const bool cloth = !weft.empty();
  const double end = entry.tested_strain.value_or(untested_strain);
  for (int i = 1; i <= curve_points; ++i) {
    MaterialLoad point;
    point.strain = end * i / curve_points;
    const double load = SpringLaw{warp}.tension(point.strain);
    if (cloth)
      point.warp = load, point.weft = SpringLaw{weft}.tension(point.strain);
    else
      point.tension = load;
    entry.curve.push_back(point);
  }
}

void take_own(const Fabric& cloth, MaterialEntry& entry) {
  entry.areal_density = known(cloth.areal_density_kg_m2), entry.thickness = known(cloth.thickness_m);
  entry.strength_per_width = strength_of(cloth).value;
  const std::vector<double>& weft = cloth.weft_coefficients_n_m;
  take_curve(cloth.coefficients_n_m, weft.empty() ? cloth.coefficients_n_m : weft, entry);
  if (model_of(cloth.resistance) != PorosityModel::sheet) return;
  const PressureDrop law = as_sheet(cloth.resistance);
  entry.permeability_cfm = cfm(law);
  for (const double pressure : flow_pressures) entry.air.push_back({pressure, velocity_at(law, pressure)});
  entry.permeability = velocity_at(law, half_inch_of_water);
}

void take_own(const Line& line, MaterialEntry& entry) {
  entry.linear_density = known(line.linear_density_kg_m);
  entry.strength = strength_of(line).value;
  take_curve(line.coefficients_n, {}, entry);
}

void take_own(const Tape& tape, MaterialEntry& entry) {
  entry.linear_density = known(tape.linear_density_kg_m);
  entry.width = known(tape.width_m), entry.thickness = known(tape.thickness_m);
  entry.strength = strength_of(tape).value;
  take_curve(SpringLaw{tape.coefficients_n_m}.scaled(tape.width_m).coefficients, {}, entry);
}

}  // namespace

std::string to_json(const MaterialList& list) {
  return json_text(list);
}

MaterialEntry material_entry(const Material& material, const std::filesystem::path& file) {
  MaterialEntry entry;
  entry.name = name_of(material), entry.kind = kind_of(material), entry.file = file.string();
  std::visit(
      [&](const auto& m) {
        entry.source = m.source, entry.warning = m.warning;
        entry.tested_strain = known(m.tested_strain);
        entry.strength_from = strength_of(m).from;
        take_own(m, entry);
      },
      material);
  return entry;
}

MaterialEntry material_entry(const std::string& name) {
  const std::filesystem::path file(name);
  if (file.has_extension()) return material_entry(read_material(file), file);
  return material_entry(library_material(name), data_directory() / "materials" / (name + ".toml"));
}

MaterialList library_materials() {
  MaterialList list;
  for (const std::string& name : library_names()) list.materials.push_back(material_entry(name));
  std::stable_sort(list.materials.begin(), list.materials.end(),
                   [](const MaterialEntry& a, const MaterialEntry& b) { return a.kind < b.kind; });
  return list;
}

}  // namespace ripstop::inline run
