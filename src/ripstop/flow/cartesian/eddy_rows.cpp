// The eddies that the cells do not resolve: WALE (Nicoud and Ducros 1999),
//
//   nu_t = (C_w width)^2 (Sd : Sd)^(3/2) / ((S : S)^(5/2) + (Sd : Sd)^(5/4)),
//
// with S the strain rate and Sd the traceless symmetric part of the square of the velocity's gradient g. It is
// nothing in plain shear, so that the layer that leaves a sharp edge is free to roll up, and nothing at a wall.
#include <cmath>

#include "ripstop/flow/cartesian/row_parts.h"
#include "ripstop/flow/cartesian/time_rows.h"

namespace ripstop::inline flow::cartesian {
namespace {

constexpr double least = 1e-30;  // [1/s5], keeps 0/0 out of air at rest

// nu_t / (C_w width)^2 [1/s]
[[gnu::always_inline]] inline double eddy_rate(const Gradient& u, const Gradient& v, const Gradient& w) {
  const double xx = u.x, yy = v.y, zz = w.z;
  const double xy = 0.5 * (u.y + v.x), xz = 0.5 * (u.z + w.x), yz = 0.5 * (v.z + w.y);
  const double strain = xx * xx + yy * yy + zz * zz + 2 * (xy * xy + xz * xz + yz * yz);
  // The square of g, its diagonal and the symmetric part of the rest.
  const double a = u.x * u.x + u.y * v.x + u.z * w.x, b = v.x * u.y + v.y * v.y + v.z * w.y,
               c = w.x * u.z + w.y * v.z + w.z * w.z;
  const double d = 0.5 * (u.x * u.y + u.y * v.y + u.z * w.y + v.x * u.x + v.y * v.x + v.z * w.x);
  const double e = 0.5 * (u.x * u.z + u.y * v.z + u.z * w.z + w.x * u.x + w.y * v.x + w.z * w.x);
  const double f = 0.5 * (v.x * u.z + v.y * v.z + v.z * w.z + w.x * u.y + w.y * v.y + w.z * w.y);
  const double third = (a + b + c) / 3;
  const double square = (a - third) * (a - third) + (b - third) * (b - third) + (c - third) * (c - third) +
                        2 * (d * d + e * e + f * f);
  const double root = std::sqrt(square);
  return square * root / (strain * strain * std::sqrt(strain) + square * std::sqrt(root) + least);
}

}  // namespace

RIPSTOP_ROW_KERNEL void eddy_row(const EddyRow& given) {
  const EddyRow row = given;
  const RowMetrics& m = row.m;
  const StressView<double>& t = row.stress;
  const std::ptrdiff_t second = t.component, third = 2 * t.component;
  for_cells(m.n, [&](int i) RIPSTOP_CELL {
    Gradient u = gradient(m, row.velocity.x, i), v = gradient(m, row.velocity.y, i),
             w = gradient(m, row.velocity.z, i);
    const double mu = row.viscosity + row.density * row.across * row.along[i] * eddy_rate(u, v, w);
    row.mu[i] = mu;
    t.x[i] = mu * u.x, t.x[i + second] = mu * u.y, t.x[i + third] = mu * u.z;
    t.y[i] = mu * v.x, t.y[i + second] = mu * v.y, t.y[i + third] = mu * v.z;
    t.z[i] = mu * w.x, t.z[i + second] = mu * w.y, t.z[i + third] = mu * w.z;
  });
}

}  // namespace ripstop::inline flow::cartesian
