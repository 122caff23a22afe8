// Rate of change of the momentum of a cell: fluxes through its faces by convection and stress. Each face is computed
// once for both of its cells, so that momentum is conserved to rounding.
//
// The value that a face carries is three quarters the linear one and one quarter that of a line through the two cells
// upstream ("LUST", Weller 2012): second order, with enough dissipation to suppress oscillations of the shortest
// waves. Next to the ends of the box the upstream quarter is the value of the upstream cell.
#include <cmath>

#include "ripstop/flow/cartesian/row_parts.h"
#include "ripstop/flow/cartesian/time_rows.h"

namespace ripstop::inline flow::cartesian {
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
[[gnu::always_inline]] inline void passing(PassingRow row, const Weights& of) {
  const std::ptrdiff_t step = row.step, low2 = row.far_low, high2 = row.far_high;
  const std::ptrdiff_t second = row.component, third = 2 * row.component;
  for_cells(row.count, [&](int i) RIPSTOP_CELL {
    FaceWeights f = of(i);
    const double flux = row.flux[i], other = 1 - f.low;
    const double stiff = (f.low * row.mu_low[i] + other * row.mu[i]) * f.inverse_distance;
    const double tu = f.low * row.stress_low[i] + other * row.stress[i];
    const double tv = f.low * row.stress_low[i + second] + other * row.stress[i + second];
    const double tw = f.low * row.stress_low[i + third] + other * row.stress[i + third];
    const double *u = row.velocity.x + i, *v = row.velocity.y + i, *w = row.velocity.z + i;
    row.passing.x[i] = carried(flux, u[low2], u[-step], u[0], u[high2], f.low, f.ratio_low, f.ratio_high) -
                       stiff * (u[0] - u[-step]) - tu;
    row.passing.y[i] = carried(flux, v[low2], v[-step], v[0], v[high2], f.low, f.ratio_low, f.ratio_high) -
                       stiff * (v[0] - v[-step]) - tv;
    row.passing.z[i] = carried(flux, w[low2], w[-step], w[0], w[high2], f.low, f.ratio_low, f.ratio_high) -
                       stiff * (w[0] - w[-step]) - tw;
  });
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
  auto& velocity = row.velocity;
  for (const double** p :
       {&row.flux, &velocity.x, &velocity.y, &velocity.z, &row.mu, &row.mu_low, &row.stress, &row.stress_low})
    *p += face;
  for (double** p : {&row.passing.x, &row.passing.y, &row.passing.z}) *p += face;
  return row;
}

}  // namespace

RIPSTOP_ROW_KERNEL void boundary_passing_row(const PassingRow& given) {
  const PassingRow row = given;
  const std::ptrdiff_t step = row.step;
  const VectorView<const double>& of = row.velocity;
  for_cells(row.count, [&](int i) RIPSTOP_CELL {
    const double flux = row.flux[i];
    row.passing.x[i] = flux * (flux > 0 ? of.x[i - step] : of.x[i]);
    row.passing.y[i] = flux * (flux > 0 ? of.y[i - step] : of.y[i]);
    row.passing.z[i] = flux * (flux > 0 ? of.z[i - step] : of.z[i]);
  });
}

void side_stress_row(const PassingRow& row, const double* velocity, const double* mu, double inverse_width,
                     double* passing) {
  for (int i = 0; i < row.count; ++i)
    passing[i] -= 2 * mu[i] * inverse_width * (velocity[i] - velocity[i - row.step]);
}

void passing_row(const PassingRow& row) {
  if (row.along == nullptr) return across_row(row);
  const PassingRow first = from_face(row, 0, 1), last = from_face(row, row.count - 1, 1);
  boundary_passing_row(first), boundary_passing_row(last);
  side_stress_row(first, first.velocity.x, first.mu, row.along->inverse_width.front(), first.passing.x);
  side_stress_row(last, last.velocity.x, last.mu_low, row.along->inverse_width.back(), last.passing.x);
  along_row(from_face(row, 1, row.count - 2));
}

namespace {

// Momentum that leaves cell i through its faces [N/m3].
[[gnu::always_inline]] inline double lost(const RowMetrics& m, const FaceView& f, std::ptrdiff_t i) {
  return m.x_inverse_width[i] * (f.x[i + 1] - f.x[i]) + m.y.inverse_width * (f.y_high[i] - f.y[i]) +
         m.z.inverse_width * (f.z_high[i] - f.z[i]);
}

template <bool uniform>
[[gnu::always_inline]] inline void rates(RateRow row) {
  const RowMetrics& m = row.m;
  const MatrixView<double>& matrix = row.matrix;
  const VectorView<double>& rate = row.rate;
  const double now = row.now, before = row.before;
  for_cells(m.n, [&](int i) RIPSTOP_CELL {
    const double u = row.velocity.x[i], v = row.velocity.y[i], w = row.velocity.z[i];
    const double inertia = row.rho[uniform ? 0 : i] * row.inverse_step;
    const double ru = row.force.x[i] - lost(m, row.u, i);
    const double rv = row.force.y[i] - lost(m, row.v, i);
    const double rw = row.force.z[i] - lost(m, row.w, i);
    double r = matrix.ra[0];
    if constexpr (!uniform) {
      const double speed = std::sqrt(u * u + v * v + w * w);
      r = 1 / (inertia + row.resistance.linear[i] + row.rho[i] * row.resistance.quadratic[i] * speed);
      matrix.ra[i] = matrix.rc[i] = r;
    }
    matrix.h.x[i] = r * (inertia * u + now * ru - before * rate.x[i]);
    matrix.h.y[i] = r * (inertia * v + now * rv - before * rate.y[i]);
    matrix.h.z[i] = r * (inertia * w + now * rw - before * rate.z[i]);
    rate.x[i] = ru, rate.y[i] = rv, rate.z[i] = rw;
  });
}

RIPSTOP_ROW_KERNEL void uniform_row(const RateRow& row) {
  rates<true>(row);
}
RIPSTOP_ROW_KERNEL void porous_row(const RateRow& row) {
  rates<false>(row);
}

}  // namespace

void rate_row(const RateRow& row) {
  row.uniform ? uniform_row(row) : porous_row(row);
}

RIPSTOP_ROW_KERNEL CourantSums courant_row(const RowMetrics& metrics, VectorView<const double> flux) {
  const RowMetrics m = metrics;
  const double y = m.y.inverse_width, z = m.z.inverse_width;
  const CellSums sums = sum_cells(m.n, [&](int i) RIPSTOP_CELL {
    const double x = m.x_inverse_width[i];
    const double west = flux.x[i], east = flux.x[i + 1], south = flux.y[i], north = flux.y[i + m.sy],
                 below = flux.z[i], above = flux.z[i + m.sz];
    CellSums of;
    of.largest = x * larger(std::fabs(west), std::fabs(east)) +
                 y * larger(std::fabs(south), std::fabs(north)) +
                 z * larger(std::fabs(below), std::fabs(above));
    of.a = m.x_width[i] * std::fabs(x * (east - west) + y * (north - south) + z * (above - below));
    return of;
  });
  return {sums.largest, sums.a};
}

}  // namespace ripstop::inline flow::cartesian
