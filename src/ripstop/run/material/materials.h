// The material library as a table, and one material with its load curve and its permeability.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/material/library.h"

namespace ripstop::inline run {

/// The load of a cloth is per width along warp and weft, that of a line or a tape is its tension.
struct MaterialLoad {
  double strain = 0;
  std::optional<double> warp, weft;  // [N/m]
  std::optional<double> tension;     // [N]
};
template <Of<MaterialLoad> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("strain", p.strain);
  visit("warp_load_n_m", p.warp);
  visit("weft_load_n_m", p.weft);
  visit("tension_n", p.tension);
}

/// Air through a cloth.
struct MaterialFlow {
  double pressure = 0, velocity = 0;  // [Pa], [m/s]
};
template <Of<MaterialFlow> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("pressure_pa", p.pressure);
  visit("velocity_m_s", p.velocity);
}

struct MaterialEntry {
  std::string name, kind;                               // kind: "fabric", "line", "tape"
  std::optional<double> areal_density, linear_density;  // [kg/m2] of cloth, else [kg/m]
  std::optional<double> width, thickness;               // [m]
  std::optional<double> strength_per_width, strength;   // as sold: [N/m] of cloth, else [N]
  std::string strength_from;
  std::optional<double> tested_strain;
  std::optional<double> permeability,
      permeability_cfm;  // at 124.5 Pa [m/s], [CFM/ft2]; absent for the paper model
  std::string source, warning;
  std::string file;
  std::vector<MaterialLoad> curve;  // to the tested strain, else to 10 %
  std::vector<MaterialFlow> air;    // of a permeability
};
template <Of<MaterialEntry> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("name", m.name);
  visit("kind", m.kind);
  visit("areal_density_kg_m2", m.areal_density);
  visit("linear_density_kg_m", m.linear_density);
  visit("width_m", m.width);
  visit("thickness_m", m.thickness);
  visit("strength_n_m", m.strength_per_width);
  visit("strength_n", m.strength);
  visit("strength_from", m.strength_from);
  visit("tested_strain", m.tested_strain);
  visit("permeability_m_s", m.permeability);
  visit("permeability_cfm", m.permeability_cfm);
  visit("source", m.source);
  visit("warning", m.warning);
  visit("file", m.file);
  visit("curve", m.curve);
  visit("air", m.air);
}

struct MaterialList {
  std::vector<MaterialEntry> materials;
};
template <Of<MaterialList> T, class Visit>
void each_member(T& list, Visit&& visit) {
  visit("materials", list.materials);
}
std::string to_json(const MaterialList& list);

MaterialEntry material_entry(const Material& material, const std::filesystem::path& file);
/// A material of the library, or of a file (.toml). Throws as library_material() and read_material().
MaterialEntry material_entry(const std::string& name);
/// All of the library: cloth, lines and tapes, each by name.
MaterialList library_materials();

}  // namespace ripstop::inline run
