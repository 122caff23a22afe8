#include "ripstop/case/settings.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "ripstop/case/resolve.h"
#include "ripstop/flow/engines.h"

namespace ripstop::inline cases {

namespace {

PartMaterials part_materials(const Case& given, PorosityModel model) {
  PartMaterials materials{canopy_fabric(given), suspension_line(given), riser_line(given), std::nullopt};
  if (const Tape* tape = reinforcement_tape(given)) materials.tape = *tape;
  if (model != PorosityModel::sheet) return materials;
  if (!materials.canopy.buckling_strain) materials.canopy.buckling_strain = wrinkling_strain;
  if (materials.tape && !materials.tape->buckling_strain) materials.tape->buckling_strain = wrinkling_strain;
  return materials;
}

}  // namespace

Settings::Settings(SettingsValues values, PartMaterials materials, std::vector<Line> reefing_lines)
    : values_(std::move(values)),
      materials_(std::move(materials)),
      reefing_lines_(std::move(reefing_lines)) {}

Settings resolve(const Case& given) {
  SettingsValues values = settings_values(given);
  PartMaterials materials = part_materials(values.written, values.flow.porosity_model);
  std::vector<Line> reefing_lines;
  for (const ReefingStage& stage : given.inflation.reefing)
    reefing_lines.push_back(reefing_line(given, stage));
  Settings resolved(std::move(values), std::move(materials), std::move(reefing_lines));
  if (const Measured* row = measured_row(given)) resolved.measured_row_ = *row;
  return resolved;
}

const Source& Settings::source(const std::string& key) const {
  const auto found = std::find_if(values_.sources.begin(), values_.sources.end(),
                                  [&](const Source& source) { return source.key == key; });
  if (found == values_.sources.end()) throw std::out_of_range(key);
  return *found;
}

Settings at_speed(const Settings& resolved, double speed_m_s) {
  Case changed = resolved.written();
  changed.flow.speed_m_s = speed_m_s;
  changed.flow.speed_basis = SpeedBasis::nominal;
  return resolve(changed);
}

Settings in_full_domain(const Settings& resolved) {
  if (resolved.flow().symmetry != FlowSymmetry::automatic) return resolved;
  Case changed = resolved.written();
  changed.flow.symmetry = FlowSymmetry::full;
  return resolve(changed);
}

Settings at_spread_angle(const Settings& resolved, double spread_angle_deg) {
  Case changed = resolved.written();
  changed.cluster->spread_angle_deg = spread_angle_deg;
  return resolve(changed);
}

bool same_flow(const FlowSettings& a, const FlowSettings& b) {
  FlowSettings other = b;
  other.canopy_position_m = a.canopy_position_m;
  other.unsteady = a.unsteady;
  other.watch = a.watch;
  if (engine_of(a.engine).can.other_air) {
    other.speed_m_s = a.speed_m_s;
    other.nominal_speed_m_s = a.nominal_speed_m_s;
    other.speed_basis = a.speed_basis;
    other.height_m = a.height_m;
    other.density_kg_m3 = a.density_kg_m3;
    other.viscosity_pa_s = a.viscosity_pa_s;
    other.temperature_k = a.temperature_k;
    other.turbulence_intensity = a.turbulence_intensity;
    other.viscosity_ratio = a.viscosity_ratio;
  }
  return a == other;
}

}  // namespace ripstop::inline cases
