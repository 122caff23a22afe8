// The eddies that the cells do not resolve: WALE (Nicoud and Ducros 1999),
//
//   nu_t = (C_w width)^2 (Sd : Sd)^(3/2) / ((S : S)^(5/2) + (Sd : Sd)^(5/4)),
//
// with S the strain rate and Sd the traceless symmetric part of the square of the velocity's gradient g. It is
// nothing in plain shear, so that the layer that leaves a sharp edge is free to roll up, and nothing at a wall.
#include <cmath>

#include "ripstop/flow/cartesian/row_parts.h"
#include "ripstop/flow/cartesian/time_rows.h"

namespace ripstop::cartesian {
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

RIPSTOP_ROW_KERNEL void eddy_row(EddyRow& results) {
  const EddyRow row = results;  // a copy, so that the compiler sees that the loop does not change it
  const RowMetrics& m = row.m;
  const std::ptrdiff_t second = row.component, third = 2 * row.component;
#pragma omp simd
  for (int i = 0; i < m.n; ++i) {
    Gradient u = gradient(m, row.u, i), v = gradient(m, row.v, i), w = gradient(m, row.w, i);
    const double mu = row.viscosity + row.density * row.across * row.along[i] * eddy_rate(u, v, w);
    row.mu[i] = mu;
    row.tx[i] = mu * u.x, row.tx[i + second] = mu * u.y, row.tx[i + third] = mu * u.z;
    row.ty[i] = mu * v.x, row.ty[i + second] = mu * v.y, row.ty[i + third] = mu * v.z;
    row.tz[i] = mu * w.x, row.tz[i + second] = mu * w.y, row.tz[i + third] = mu * w.z;
  }
}

}  // namespace ripstop::cartesian
