// Rate of change of the momentum of a cell: fluxes through its faces by convection and stress. Each face is computed
// once for both of its cells, so that momentum is conserved to rounding.
//
// The value that a face carries is three quarters the linear one and one quarter that of a line through the two cells
// upstream ("LUST", Weller 2012): second order, with enough dissipation to suppress oscillations of the shortest
// waves. Next to the ends of the box the upstream quarter is the value of the upstream cell.
#include <cmath>

#include "ripstop/flow/cartesian/row_parts.h"
#include "ripstop/flow/cartesian/time_rows.h"

namespace ripstop::cartesian {
namespace {

constexpr double from_upstream = 0.25, linear = 1 - from_upstream;

// flux times the value that it carries.
[[gnu::always_inline]] inline double carried(double flux, double far_low, double low, double high,
                                             double far_high, double weight, double ratio_low,
                                             double ratio_high) {
  const bool up = flux > 0;
  const double b = high - low;
  const double rise = (1 - weight) * (linear * b + from_upstream * ratio_low * (low - far_low));
  const double fall = weight * (linear * b + from_upstream * ratio_high * (far_high - high));
  return flux * (up ? low + rise : high - fall);
}

// `of(i)` gives the weights of face i.
template <class Weights>
[[gnu::always_inline]] inline void passing(const PassingRow& results, const Weights& of) {
  const PassingRow row = results;  // a copy, so that the compiler sees that the loop does not change it
  const std::ptrdiff_t step = row.step, low2 = row.far_low, high2 = row.far_high;
  const std::ptrdiff_t second = row.component, third = 2 * row.component;
#pragma omp simd
  for (int i = 0; i < row.count; ++i) {
    FaceWeights f = of(i);
    const double flux = row.flux[i], other = 1 - f.low;
    const double stiff = (f.low * row.mu_low[i] + other * row.mu[i]) * f.inverse_distance;
    const double tu = f.low * row.t_low[i] + other * row.t[i];
    const double tv = f.low * row.t_low[i + second] + other * row.t[i + second];
    const double tw = f.low * row.t_low[i + third] + other * row.t[i + third];
    const double *u = row.u + i, *v = row.v + i, *w = row.w + i;
    row.pu[i] = carried(flux, u[low2], u[-step], u[0], u[high2], f.low, f.ratio_low, f.ratio_high) -
                stiff * (u[0] - u[-step]) - tu;
    row.pv[i] = carried(flux, v[low2], v[-step], v[0], v[high2], f.low, f.ratio_low, f.ratio_high) -
                stiff * (v[0] - v[-step]) - tv;
    row.pw[i] = carried(flux, w[low2], w[-step], w[0], w[high2], f.low, f.ratio_low, f.ratio_high) -
                stiff * (w[0] - w[-step]) - tw;
  }
}

RIPSTOP_ROW_KERNEL void across_row(const PassingRow& row) {
  const FaceWeights weights = row.across;
  passing(row, [weights](int) { return weights; });
}

// Of the faces between the first and the last cell of a row.
RIPSTOP_ROW_KERNEL void along_row(const PassingRow& row) {
  const double *low = row.along->weight_low.data() + 1, *ratio_low = row.along->ratio_low.data() + 1,
               *ratio_high = row.along->ratio_high.data() + 1, *near = row.along->inverse_distance.data() + 1;
  const int last = row.count - 1;
  passing(row, [=](int i) {
    return FaceWeights{low[i], i > 0 ? ratio_low[i] : 0.0, i < last ? ratio_high[i] : 0.0, near[i]};
  });
}

PassingRow from_face(PassingRow row, int face, int count) {
  row.count = count;
  for (const double** p : {&row.flux, &row.u, &row.v, &row.w, &row.mu, &row.mu_low, &row.t, &row.t_low})
    *p += face;
  for (double** p : {&row.pu, &row.pv, &row.pw}) *p += face;
  return row;
}

}  // namespace

RIPSTOP_ROW_KERNEL void boundary_passing_row(const PassingRow& results) {
  const PassingRow row = results;
  const std::ptrdiff_t step = row.step;
#pragma omp simd
  for (int i = 0; i < row.count; ++i) {
    const double flux = row.flux[i];
    row.pu[i] = flux * (flux > 0 ? row.u[i - step] : row.u[i]);
    row.pv[i] = flux * (flux > 0 ? row.v[i - step] : row.v[i]);
    row.pw[i] = flux * (flux > 0 ? row.w[i - step] : row.w[i]);
  }
}

void side_stress_row(const PassingRow& row, const double* velocity, const double* mu, double inverse_width,
                     double* passing) {
  for (int i = 0; i < row.count; ++i)
    passing[i] -= 2 * mu[i] * inverse_width * (velocity[i] - velocity[i - row.step]);
}

void passing_row(PassingRow& row) {
  if (row.along == nullptr) return across_row(row);
  const PassingRow first = from_face(row, 0, 1), last = from_face(row, row.count - 1, 1);
  boundary_passing_row(first), boundary_passing_row(last);
  side_stress_row(first, first.u, first.mu, row.along->inverse_width.front(), first.pu);
  side_stress_row(last, last.u, last.mu_low, row.along->inverse_width.back(), last.pu);
  along_row(from_face(row, 1, row.count - 2));
}

namespace {

template <bool uniform>
[[gnu::always_inline]] inline void rates(RateRow& results) {
  const RateRow row = results;  // a copy, so that the compiler sees that the loop does not change it
  const RowMetrics& m = row.m;
  const double y = m.y.inverse_width, z = m.z.inverse_width, now = row.now, before = row.before;
#pragma omp simd
  for (int i = 0; i < m.n; ++i) {
    const double x = m.x_inverse_width[i];
    const double u = row.u[i], v = row.v[i], w = row.w[i];
    const double inertia = row.rho[uniform ? 0 : i] * row.inverse_step;
    const double ru = row.body_u[i] - (x * (row.xu[i + 1] - row.xu[i]) + y * (row.yu_high[i] - row.yu[i]) +
                                       z * (row.zu_high[i] - row.zu[i]));
    const double rv = row.body_v[i] - (x * (row.xv[i + 1] - row.xv[i]) + y * (row.yv_high[i] - row.yv[i]) +
                                       z * (row.zv_high[i] - row.zv[i]));
    const double rw = row.body_w[i] - (x * (row.xw[i + 1] - row.xw[i]) + y * (row.yw_high[i] - row.yw[i]) +
                                       z * (row.zw_high[i] - row.zw[i]));
    double r = row.ra[0];
    if constexpr (!uniform) {
      const double speed = std::sqrt(u * u + v * v + w * w);
      r = 1 / (inertia + row.linear[i] + row.rho[i] * row.quadratic[i] * speed);
      row.ra[i] = row.rc[i] = r;
    }
    row.hu[i] = r * (inertia * u + now * ru - before * row.rate_u[i]);
    row.hv[i] = r * (inertia * v + now * rv - before * row.rate_v[i]);
    row.hw[i] = r * (inertia * w + now * rw - before * row.rate_w[i]);
    row.rate_u[i] = ru, row.rate_v[i] = rv, row.rate_w[i] = rw;
  }
}

RIPSTOP_ROW_KERNEL void uniform_row(RateRow& row) {
  rates<true>(row);
}
RIPSTOP_ROW_KERNEL void porous_row(RateRow& row) {
  rates<false>(row);
}

}  // namespace

void rate_row(RateRow& row) {
  row.uniform ? uniform_row(row) : porous_row(row);
}

RIPSTOP_ROW_KERNEL void courant_row(CourantRow& results) {
  const CourantRow row = results;
  const RowMetrics& m = row.m;
  const double y = m.y.inverse_width, z = m.z.inverse_width;
  double largest = 0, defect = 0;
#pragma omp simd reduction(max : largest) reduction(+ : defect)
  for (int i = 0; i < m.n; ++i) {
    const double x = m.x_inverse_width[i];
    const double west = row.fx[i], east = row.fx[i + 1], south = row.fy[i], north = row.fy[i + m.sy],
                 below = row.fz[i], above = row.fz[i + m.sz];
    const double rate = x * larger(std::fabs(west), std::fabs(east)) +
                        y * larger(std::fabs(south), std::fabs(north)) +
                        z * larger(std::fabs(below), std::fabs(above));
    largest = larger(largest, rate);
    defect += m.x_width[i] * std::fabs(x * (east - west) + y * (north - south) + z * (above - below));
  }
  results.largest = largest, results.defect = defect;
}

}  // namespace ripstop::cartesian
