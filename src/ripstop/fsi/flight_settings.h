// [flight] of a case file.
#pragma once

#include <optional>

#include "ripstop/core/vec3.h"
#include "ripstop/flight/wind.h"

namespace ripstop::inline fsi {

struct FlightSettings {
  /// Equilibrium on the axis, or the end of a coupled inflation with the payload.
  enum class Start { steady, inflation } start = Start::steady;
  double duration_s = 30;            // after that
  double courant = 0.7;              // of the steps of the flow
  double cells_across = 20;          // cells of the flow across the nominal diameter
  double angle_deg = 5;              // between the vertical and the line from payload to canopy at the start
  double azimuth_deg = 0;            // direction in which the payload is displaced, from x to y
  double swing_deg_s = 0;            // rate at which that angle grows at the start
  std::optional<Vec3> velocity_m_s;  // of the parachute over the ground at the start, z up
  std::optional<double> height_m;    // of the payload above the ground at the start
  std::optional<double> standard_error;  // of the rate of descent, relative, at which the flight ends
  double shapes_per_s = 4;               // shapes that are written
  Wind wind;

  bool operator==(const FlightSettings&) const = default;
};

}  // namespace ripstop::inline fsi
