// Second-order convection as a correction of the upwind one: the addition of a limited linear profile to the value on
// each face,
//
//   q_f = q_U + w 2 a b / (a + b) where a b > 0, else q_U;   a = q_U - q_UU (scaled to the distance of b), b
//   = q_D - q_U,
//
// with U, UU the first and second cell upstream of the face, D the one downstream and w the share of the distance
// from U to D upstream of the face: the limiter of van Leer (1974). Computed from the fields at the start of an
// iteration, so that the matrix remains the upwind one. Faces at the ends of the box keep the upwind value.
#include "ripstop/flow/cartesian/loops.h"
#include "ripstop/flow/cartesian/rows.h"
#include "ripstop/flow/cartesian/simd.h"
#include "ripstop/flow/cartesian/solver.h"

namespace ripstop::inline flow::cartesian {
namespace {

// Difference of the face value from the upwind one, times the flux. `ratio` is 0 without a second cell.
[[gnu::always_inline]] inline double beyond(double flux, double far_low, double low, double high,
                                            double far_high, double weight_low, double ratio_low,
                                            double ratio_high) {
  const bool up = flux > 0;
  const double a = up ? (low - far_low) * ratio_low : (high - far_high) * ratio_high;
  const double b = up ? high - low : low - high;
  const double product = a * b;
  const double share = up ? 1 - weight_low : weight_low;
  return product > 0 ? flux * share * (2 * product / (a + b)) : 0;
}

}  // namespace

FaceMetrics face_metrics(const Axis& axis, int c) {
  FaceMetrics m;
  m.inverse_width = axis.inverse_width[c];
  m.weight_low = axis.weight_low[c], m.weight_high = axis.weight_low[c + 1];
  if (c > 0) m.low_low = axis.ratio_low[c], m.low_high = axis.ratio_high[c];
  if (c + 1 < axis.n) m.high_low = axis.ratio_low[c + 1], m.high_high = axis.ratio_high[c + 1];
  return m;
}

RIPSTOP_ROW_KERNEL void convection_row(const ConvectionRow& row) {
  const int n = row.n;
  const std::ptrdiff_t sy = row.sy, sz = row.sz;
  const std::ptrdiff_t south2 = row.south2, north2 = row.north2, below2 = row.below2, above2 = row.above2;
  const double *q = row.q, *fx = row.flux.x, *fy = row.flux.y, *fz = row.flux.z;
  const double *wx = row.x->weight_low.data(), *rhx = row.x->inverse_width.data(),
               *low = row.x->ratio_low.data(), *high = row.x->ratio_high.data();
  const FaceMetrics y = row.y, z = row.z;
  double* source = row.source;
  for_cells(n, [&](int i) RIPSTOP_CELL {
    const double west = i > 0 ? 1 : 0, east = i + 1 < n ? 1 : 0;
    const double w = beyond(fx[i], q[i - 2], q[i - 1], q[i], q[i + 1], wx[i], west * low[i], west * high[i]);
    const double e = beyond(fx[i + 1], q[i - 1], q[i], q[i + 1], q[i + 2], wx[i + 1], east * low[i + 1],
                            east * high[i + 1]);
    const double s =
        beyond(fy[i], q[i + south2], q[i - sy], q[i], q[i + sy], y.weight_low, y.low_low, y.low_high);
    const double o =
        beyond(fy[i + sy], q[i - sy], q[i], q[i + sy], q[i + north2], y.weight_high, y.high_low, y.high_high);
    const double b =
        beyond(fz[i], q[i + below2], q[i - sz], q[i], q[i + sz], z.weight_low, z.low_low, z.low_high);
    const double a =
        beyond(fz[i + sz], q[i - sz], q[i], q[i + sz], q[i + above2], z.weight_high, z.high_low, z.high_high);
    source[i] = (w - e) * rhx[i] + (s - o) * y.inverse_width + (b - a) * z.inverse_width;
  });
}

void Solver::convection(int j, int k) {
  const std::ptrdiff_t at = d_.layout.at(0, j, k), sy = d_.layout.stride_y, sz = d_.layout.stride_z;
  ConvectionRow r;
  r.n = d_.grid.nx;
  r.x = &d_.x;
  r.y = face_metrics(d_.y, j), r.z = face_metrics(d_.z, k);
  r.sy = sy, r.sz = sz;
  r.south2 = j > 0 ? -2 * sy : 0, r.north2 = j + 1 < d_.grid.ny ? 2 * sy : 0;
  r.below2 = k > 0 ? -2 * sz : 0, r.above2 = k + 1 < d_.grid.nz ? 2 * sz : 0;
  r.flux = s_.f.flux(at);
  const auto add = [&](const Array<double>& q, const Array<double>& body, Array<double>& extra) {
    r.q = &q[at], r.source = &extra[at];
    convection_row(r);
    for (int i = 0; !body.empty() && i < d_.grid.nx; ++i) extra[at + i] += body[at + i];
  };
  add(s_.f.u, in_the_way_.body_u, t_.extra_u), add(s_.f.v, in_the_way_.body_v, t_.extra_v),
      add(s_.f.w, in_the_way_.body_w, t_.extra_w);
}

}  // namespace ripstop::inline flow::cartesian
