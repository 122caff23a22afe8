#include "ripstop/flow/jet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ripstop::inline flow {

double nozzle_height(const Nozzle& nozzle) {
  return nozzle.shape == NozzleShape::rectangle ? nozzle.height : nozzle.width;
}

double nozzle_area(const Nozzle& nozzle) {
  const double w = nozzle.width;
  switch (nozzle.shape) {
    case NozzleShape::circle:
      return std::numbers::pi / 4 * w * w;
    case NozzleShape::octagon:  // 8 triangles of height w / 2 on sides of w tan(pi / 8)
      return 2 * (std::numbers::sqrt2 - 1) * w * w;
    case NozzleShape::rectangle:
      return w * nozzle.height;
  }
  return 0;
}

double equivalent_diameter(const Nozzle& nozzle) {
  return std::sqrt(4 / std::numbers::pi * nozzle_area(nozzle));
}

double depth_inside(const Nozzle& nozzle, double x, double y) {
  const double a = std::abs(x), b = std::abs(y), half = nozzle.width / 2;
  switch (nozzle.shape) {
    case NozzleShape::circle:
      return half - std::hypot(x, y);
    case NozzleShape::octagon:
      return half - std::max({a, b, (a + b) / std::numbers::sqrt2});
    case NozzleShape::rectangle:
      return std::min(half - a, nozzle.height / 2 - b);
  }
  return 0;
}

double speed_share(const Jet& jet, double x, double y) {
  const double step = 0.5 * (1 + std::tanh(2 * depth_inside(jet.nozzle, x, y) / jet.shear_layer));
  return jet.outside + (1 - jet.outside) * step;
}

double mean_speed_share(const Jet& jet, double low_x, double high_x, double low_y, double high_y) {
  constexpr int points = 8;  // along each side
  double sum = 0;
  for (int j = 0; j < points; ++j)
    for (int i = 0; i < points; ++i)
      sum += speed_share(jet, low_x + (i + 0.5) / points * (high_x - low_x),
                         low_y + (j + 0.5) / points * (high_y - low_y));
  return sum / (points * points);
}

}  // namespace ripstop::inline flow
