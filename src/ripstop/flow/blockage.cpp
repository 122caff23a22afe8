#include "ripstop/flow/blockage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop::inline flow {

// With U = 1, u the speed through the disk, x in the wake, y around it, b the blockage:
//   K u^2 = y^2 - x^2                            (Bernoulli on either side, one pressure behind)
//   y (1 - b u / x) = 1 - b u                    (mass around the disk)
//   b K u^2 = y^2 + 1 - 2 b u x - 2 y (1 - b u)  (momentum of the section)
// Newton from free air; the derivatives are differences.
double porous_disk_drag(double loss, double blockage) {
  if (blockage <= 0) return loss / ((1 + loss / 4) * (1 + loss / 4));
  const double b = blockage;
  const auto through = [&](double x, double y) { return std::sqrt(std::max(0.0, y * y - x * x) / loss); };
  const auto mass = [&](double x, double y) {
    const double u = through(x, y);
    return y * (1 - b * u / x) - (1 - b * u);
  };
  const auto momentum = [&](double x, double y) {
    const double u = through(x, y);
    return y * y + 1 - 2 * b * u * x - 2 * y * (1 - b * u) - b * (y * y - x * x);
  };
  double x = std::max(0.1, 2 / (1 + loss / 4) - 1), y = 1 + 0.3 * b;
  constexpr double step = 1e-7, share = 0.7;
  for (int n = 0; n < 200; ++n) {
    const double f = mass(x, y), g = momentum(x, y);
    const double fx = (mass(x + step, y) - f) / step, fy = (mass(x, y + step) - f) / step;
    const double gx = (momentum(x + step, y) - g) / step, gy = (momentum(x, y + step) - g) / step;
    const double det = fx * gy - fy * gx;
    const double dx = (fy * g - f * gy) / det, dy = (f * gx - fx * g) / det;
    x += share * dx, y += share * dy;
    if (!(x > 0) || !std::isfinite(y)) break;
    const bool found = std::abs(dx) + std::abs(dy) < 1e-10;
    if (found && y - x > 1e-6) return y * y - x * x;
    if (found) break;  // the other root: nothing slows down
  }
  throw Error(ExitCode::not_converged,
              "momentum theory has no solution for this drag and blockage between walls");
}

double maskell_ratio(double drag_coefficient, double base_pressure, double blockage) {
  return 1 / (1 + drag_coefficient * blockage / base_pressure);
}

// The image of a doublet in a cylinder of constant pressure, at its place: -(2 pi^2 R^3)^-1 int t^2 K0 / I0 dt.
double open_jet_speed_change(double effective_volume, double jet_area) {
  return -0.1825 * effective_volume / std::pow(jet_area, 1.5);
}

// Lamb, Hydrodynamics, section 114: k = a0 / (2 - a0), a0 = 2 (1 - e^2) / e^3 (artanh e - e).
double spheroid_effective_volume(double length, double diameter) {
  const double ratio = diameter / length, e = std::sqrt(1 - ratio * ratio);
  const double a0 = e < 0.05 ? 2.0 / 3 : 2 * (1 - e * e) / (e * e * e) * (std::atanh(e) - e);
  return std::numbers::pi / 6 * length * diameter * diameter * (1 + a0 / (2 - a0));
}

}  // namespace ripstop::inline flow
