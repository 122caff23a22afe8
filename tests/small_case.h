// A small flat circular canopy as a case made in code, as a caller of the library makes one.
#pragma once

#include <filesystem>

#include "ripstop/case/settings.h"
#include "ripstop/parachute/flat_circular.h"

namespace ripstop {

/// `diameter_m` and lines as long, twelve gores; in air of 1.2 kg/m3.
inline Case flat_circular_case(double diameter_m, int cloth_nodes, double speed_m_s) {
  Case given;
  given.parachute.canopy = FlatCircular{diameter_m, diameter_m / 10};
  given.parachute.gores = 12;
  given.parachute.lines.count = 12;
  given.parachute.lines.length_m = diameter_m;
  given.parachute.tape.material = "nylon-tape";
  given.parachute.mesh.cloth_nodes = cloth_nodes;
  given.flow.speed_m_s = speed_m_s;
  given.flow.density_kg_m3 = 1.2;
  return given;
}

/// A canopy of 1 m with a payload, on a coarse mesh.
inline Case small_payload_case(double speed_m_s) {
  Case given = flat_circular_case(1, 500, speed_m_s);
  given.parachute.mesh.line_segment_m = 0.25;
  given.payload.mass_kg = 0.8, given.payload.drag_area_m2 = 0.01;
  return given;
}

/// The settings of the same case after an edit of it.
template <class Edit>
Settings edited(const Settings& resolved, Edit edit) {
  Case given = resolved.written();
  edit(given);
  return resolve(given);
}

/// Stratos IV on a coarse mesh with six lines: the first 8 ms of its opening.
inline Case small_opening(const Overrides& overrides = {}) {
  Case given =
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml", overrides);
  given.parachute.mesh.cloth_nodes = 1500;
  given.parachute.lines.count = 6;
  given.parachute.mesh.folds = 6;
  given.parachute.mesh.line_segment_m = 0.15;
  given.inflation.initial_radius_m = 0.2;
  given.inflation.duration_s = 8e-3;
  given.inflation.frames = 8;
  return given;
}

/// The same in air that flows, on cells of 8 to 11 cm: the first 4 ms.
inline Case small_opening_in_air() {
  Overrides cloth;
  cloth.set = {{"parachute.canopy_material", "f-111-physical", ""}, {"flow.porosity_model", "sheet", ""}};
  Case given = small_opening(cloth);
  given.flow.cells = {24, 24, 36};
  given.inflation.air = AirModel::coupled;
  given.inflation.duration_s = 4e-3;
  given.inflation.frames = 4;
  return given;
}

}  // namespace ripstop
