// Wind over the ground: uniform or a power-law profile over height, with one gust.
#pragma once

#include "ripstop/core/vec3.h"

namespace ripstop::inline flight {

/// Horizontal; z is up.
struct Wind {
  double speed_m_s = 0;            // at the reference height
  double direction_deg = 0;        // towards which it blows, from x to y
  double exponent = 0;             // of the profile over height; 0: the same at all heights
  double reference_height_m = 10;  // above the ground
  double gust_m_s = 0;             // largest addition, in the same direction
  double gust_start_s = 0;
  double gust_duration_s = 2;

  bool operator==(const Wind&) const = default;
};

/// W = speed (h / h_ref)^exponent + gust/2 (1 - cos(2 pi (t - t_0) / T)),  t_0 <= t <= t_0 + T,  at `height` above the
/// ground [m] and `time` [s] -> [m/s]. Below the ground as at it.
Vec3 wind_velocity(const Wind& wind, double height, double time);

}  // namespace ripstop::inline flight
