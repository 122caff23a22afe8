#include "ripstop/flight/opening_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/core/positive.h"
#include "ripstop/flight/atmosphere.h"

namespace ripstop::inline flight {

void check_conditions(const OpeningConditions& c) {
  const std::pair<const char*, double> all[] = {{"mass (kg)", c.mass},
                                                {"speed (m/s)", c.speed},
                                                {"density (kg/m3)", c.density},
                                                {"drag area (m2)", c.drag_area},
                                                {"filling time (s)", c.filling_time},
                                                {"exponent of the drag area", c.exponent},
                                                {"opening coefficient C_x", c.opening_coefficient}};
  for (const auto& [name, value] : all) require_positive(name, value);
  if (!(std::abs(c.path_angle) <= 90))
    throw Error(
        ExitCode::usage,
        fmt::format("an opening on a flight path {:g} degrees below the horizon: must be from -90 to 90",
                    c.path_angle));
}

double steady_force(const OpeningConditions& c) {
  return 0.5 * c.density * c.speed * c.speed * c.drag_area;
}

double ballistic_parameter(const OpeningConditions& c) {
  return 2 * c.mass / (c.drag_area * c.density * c.speed * c.filling_time);
}

double mass_ratio(const OpeningConditions& c) {
  return c.density * std::pow(c.drag_area, 1.5) / c.mass;
}

// m dv/dt = -(C_D S)_0 tau^j rho v^2 / 2 has v / v_s = 1 / (1 + tau^(j+1) / ((j+1) A)), and tau^j (v / v_s)^2 is
// highest at tau^(j+1) = j (j+1) A / (j+2), unless the drag area ends to grow before.
ForceFactor force_factor(double a, double j, double largest) {
  const double end = std::pow(largest, 1 / j);
  const double inner = std::pow(j * (j + 1) * a / (j + 2), 1 / (j + 1));
  const double tau = std::min(inner, end);
  const double slowed = 1 + std::pow(tau, j + 1) / ((j + 1) * a);
  return {std::pow(tau, j) / (slowed * slowed), tau};
}

OpeningLoad infinite_mass_load(const OpeningConditions& c) {
  check_conditions(c);
  return {steady_force(c) * c.opening_coefficient, 0};
}

OpeningLoad pflanz_load(const OpeningConditions& c) {
  check_conditions(c);
  const ForceFactor x = force_factor(ballistic_parameter(c), c.exponent);
  return {steady_force(c) * c.opening_coefficient * x.factor, x.time * c.filling_time};
}

OpeningLoad ludtke_load(const OpeningConditions& c) {
  check_conditions(c);
  const ForceFactor x = force_factor(ballistic_parameter(c), c.exponent, c.opening_coefficient);
  return {steady_force(c) * x.factor, x.time * c.filling_time};
}

// With F = C_x (C_D S) q Gamma^2 and G = g t_f sin(angle) / v: C_x I_F Gamma^2 = A (1 - Gamma + G), a quadratic
// in Gamma with one root above 0, at most 1 + G.
MomentumImpulse momentum_impulse_load(const OpeningConditions& c, double integral) {
  check_conditions(c);
  if (!(integral > 0 && integral <= 1))
    throw Error(ExitCode::usage,
                fmt::format("a mean over the peak force of {:g}: must be above 0 and at most 1", integral));
  const double a = ballistic_parameter(c);
  const double gravity =
      standard_gravity * std::sin(c.path_angle * std::numbers::pi / 180) * c.filling_time / c.speed;
  const double square = 2 * c.opening_coefficient * integral, constant = std::max(a * (1 + gravity), 0.0);
  MomentumImpulse result;
  // (-a + sqrt(a^2 + 2 square constant)) / square, without the difference of two large numbers at a large mass
  result.speed_ratio = 2 * constant / (a + std::sqrt(a * a + 2 * square * constant));
  result.load.load = c.opening_coefficient * steady_force(c) * result.speed_ratio * result.speed_ratio;
  return result;
}

}  // namespace ripstop::inline flight
