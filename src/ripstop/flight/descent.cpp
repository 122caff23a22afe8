#include "ripstop/flight/descent.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"

namespace ripstop::inline flight {

double terminal_speed(double mass, double drag_area, double density) {
  return std::sqrt(2 * mass * standard_gravity / (density * drag_area));
}

double drag_area_for(double mass, double speed, double density) {
  return 2 * mass * standard_gravity / (density * speed * speed);
}

// Simpson's rule on pieces of at most 50 m: the density changes by 0.6 % over one, so that a piece errs by about
// 1e-11 of itself; at the kinks between two layers, where only the slope jumps, by less than 1e-6.
double descent_time(double mass, double drag_area, double from, double to) {
  if (!(from > to))
    throw Error(ExitCode::usage,
                fmt::format("a descent from {:g} m to {:g} m: must begin above its end", from, to));
  constexpr double piece = 50;  // [m]
  const auto slowness = [&](double height) {
    return 1 / terminal_speed(mass, drag_area, standard_air(height).density);
  };
  const int pieces = std::max(1, static_cast<int>(std::ceil((from - to) / piece)));
  const double length = (from - to) / pieces;
  double time = 0;
  for (int i = 0; i < pieces; ++i) {
    const double low = to + i * length;
    time += length / 6 * (slowness(low) + 4 * slowness(low + length / 2) + slowness(low + length));
  }
  return time;
}

}  // namespace ripstop::inline flight
