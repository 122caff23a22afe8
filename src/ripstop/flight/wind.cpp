#include "ripstop/flight/wind.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ripstop::inline flight {

Vec3 wind_velocity(const Wind& wind, double height, double time) {
  double speed = wind.speed_m_s;
  if (wind.exponent > 0) speed *= std::pow(std::max(height, 0.0) / wind.reference_height_m, wind.exponent);
  const double since = time - wind.gust_start_s;
  if (wind.gust_m_s != 0 && since > 0 && since < wind.gust_duration_s)
    speed += 0.5 * wind.gust_m_s * (1 - std::cos(2 * std::numbers::pi * since / wind.gust_duration_s));
  const double direction = wind.direction_deg * std::numbers::pi / 180;
  return {speed * std::cos(direction), speed * std::sin(direction), 0};
}

}  // namespace ripstop::inline flight
