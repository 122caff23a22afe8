#include "ripstop/material/permeability.h"

#include <fmt/format.h>

#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/core/least_squares.h"
#include "ripstop/core/units.h"

namespace ripstop::inline material {
namespace {

constexpr double slowest = 1e-5, fastest = 50;  // [m/s]

}  // namespace

// With u = v and dp/v = a + b v, relative errors of dp weigh each row by v / dp:
//   a v/dp + b v^2/dp = 1
PermeabilityFit fit_permeability(const std::vector<FlowPoint>& points) {
  if (points.empty()) throw Error(ExitCode::bad_data, "air permeability: no flow-pressure points");
  for (const FlowPoint& p : points) {
    if (!(p.pressure > 0) || !(p.velocity > 0))
      throw Error(ExitCode::bad_data,
                  fmt::format("air permeability: pressure {} Pa and velocity {} m/s must be above 0",
                              p.pressure, p.velocity));
    if (p.velocity < slowest || p.velocity > fastest)
      throw Error(ExitCode::bad_data,
                  fmt::format("air permeability: {:.4g} m/s through cloth is outside {} to {} m/s; write CFM "
                              "per square foot as cfm (1 CFM/ft2 = 5.08e-3 m/s)",
                              p.velocity, slowest, fastest));
  }
  PermeabilityFit fit;
  double aa = 0, ab = 0, bb = 0, a1 = 0, b1 = 0;
  for (const FlowPoint& p : points) {
    const double u = p.velocity / p.pressure, w = p.velocity * u;
    aa += u * u, ab += u * w, bb += w * w, a1 += u, b1 += w;
  }
  const double determinant = aa * bb - ab * ab;
  fit.one_point = !(determinant > 1e-9 * aa * bb);
  fit.law = {a1 / aa, 0};
  if (!fit.one_point) {
    const PressureDrop free{(a1 * bb - b1 * ab) / determinant, (b1 * aa - a1 * ab) / determinant};
    fit.on_bound = free.linear < 0 || free.quadratic < 0;
    if (!fit.on_bound)
      fit.law = free;
    else if (free.linear < 0)
      fit.law = {0, b1 / bb};
  }
  std::vector<double> measured, fitted;
  for (const FlowPoint& p : points) {
    measured.push_back(p.pressure);
    fitted.push_back(pressure_drop(fit.law, p.velocity));
  }
  if (!fit.one_point) fit.r2 = r_squared(measured, fitted);
  return fit;
}

double pressure_drop(const PressureDrop& law, double velocity) {
  return law.linear * velocity + law.quadratic * velocity * std::abs(velocity);
}

double velocity_at(const PressureDrop& law, double pressure) {
  // The root of b v^2 + a v - dp that does not cancel.
  return 2 * pressure / (law.linear + std::sqrt(law.linear * law.linear + 4 * law.quadratic * pressure));
}

double cfm(const PressureDrop& law) {
  return velocity_at(law, half_inch_of_water) / cfm_per_square_foot;
}

PressureDrop law_of_cfm(double flow) {
  if (!(flow > 0) || !(flow < 1e4))
    throw Error(ExitCode::bad_data,
                fmt::format("{} CFM/ft2 is outside the range of cloth, above 0 and below 10000", flow));
  return {half_inch_of_water / (flow * cfm_per_square_foot), 0};
}

// [NFM] Eq. 16: a = 150 mu (1-g)^2 t / (D^2 g^3), b = 1.75 rho (1-g) t / (D g^3), D = 6 (1-g) V/S, V/S = t
PressureDrop ergun(const ErgunCloth& cloth, const ErgunAir& air) {
  const double g = cloth.porosity, t = cloth.thickness;
  if (!(g > 0) || !(g < 1) || !(t > 0))
    throw Error(
        ExitCode::bad_data,
        fmt::format("Ergun's law needs a porosity between 0 and 1 and a thickness above 0, not {} and {} m",
                    g, t));
  const double d = 6 * (1 - g) * t, g3 = g * g * g;
  return {150 * air.viscosity * (1 - g) * (1 - g) * t / (d * d * g3),
          1.75 * air.density * (1 - g) * t / (d * g3)};
}

ErgunCloth ergun_cloth(const PressureDrop& law, const ErgunAir& air) {
  if (!(law.linear > 0) || !(law.quadratic > 0))
    throw Error(ExitCode::bad_data,
                fmt::format("a porosity follows from a = {} and b = {} only when both are above 0",
                            law.linear, law.quadratic));
  const double g3 = 1.75 * air.density / (6 * law.quadratic);
  if (!(g3 < 1))
    throw Error(ExitCode::bad_data,
                fmt::format("b = {} is smaller than that of open air: no porosity below 1 corresponds to it",
                            law.quadratic));
  return {std::cbrt(g3), 150 * air.viscosity / (36 * law.linear * g3)};
}

}  // namespace ripstop::inline material
