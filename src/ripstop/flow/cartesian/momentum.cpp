// Momentum equation, first-order upwind in bounded form, and the porous resistance:
//
//   sum F (U_nb - U_P) = div(mu_eff grad U) + div(mu_eff dev2((grad U)^T)) - grad p - R U,
//   R = mu d + rho |U| f / 2                                             [NFM] `paper` porosity
//
// The equation is under-relaxed first and the resistance is added after that, so that R enters the diagonal
// and the face flux (through 1/A) unrelaxed.
//
// A cell enclosed by tight cloth has hardly any flux, so that A nearly vanishes and any error of the pressure would
// cause large velocities. Next to a sheet A is therefore no less than rho U / h of the free stream.
#include <cmath>

#include "ripstop/flow/cartesian/row_parts.h"

namespace ripstop::inline flow::cartesian {
namespace {

// a_nb of upwind convection and diffusion through the faces of a cell [kg/(m3 s)].
[[gnu::always_inline]] inline Faces coefficients(const MomentumRow& row, std::ptrdiff_t i) {
  const RowMetrics& m = row.m;
  Faces mu = on_faces(m, row.mu, i);
  Faces in = inflow(m, row.flux, i);
  const double *distance = m.x_inverse_distance + i, h = m.x_inverse_width[i];
  return {(in.w + mu.w * distance[0]) * h,
          (in.e + mu.e * distance[1]) * h,
          (in.s + mu.s * m.y.distance_low) * m.y.inverse_width,
          (in.n + mu.n * m.y.distance_high) * m.y.inverse_width,
          (in.b + mu.b * m.z.distance_low) * m.z.inverse_width,
          (in.a + mu.a * m.z.distance_high) * m.z.inverse_width};
}

// Lower limit of A: rho U / h in a cell next to a sheet, else 0.
[[gnu::always_inline]] inline double least_diagonal(const MomentumRow& row, std::ptrdiff_t i) {
  const FaceView& s = row.sheet.stiffness;
  const double faces = s.x[i] + s.x[i + 1] + s.y[i] + s.y_high[i] + s.z[i] + s.z_high[i];
  const double least_width =
      larger(row.m.x_inverse_width[i], larger(row.m.y.inverse_width, row.m.z.inverse_width));
  return faces > 0 ? row.inertia * least_width : 0;
}

// Force of the explicit stress of component `c` on cell i [N/m3].
[[gnu::always_inline]] inline double stress_divergence(const MomentumRow& row, std::ptrdiff_t c,
                                                       std::ptrdiff_t i) {
  const RowMetrics& m = row.m;
  const double *tx = row.stress.x + i + c, *ty = row.stress.y + i + c, *tz = row.stress.z + i + c;
  return m.x_slope_high[i] * (tx[1] - tx[0]) + m.x_slope_low[i] * (tx[0] - tx[-1]) +
         m.y.slope_high * (ty[m.sy] - ty[0]) + m.y.slope_low * (ty[0] - ty[-m.sy]) +
         m.z.slope_high * (row.stress_above[i + c] - tz[0]) +
         m.z.slope_low * (tz[0] - row.stress_below[i + c]);
}

// Relaxed matrix for the face flux: diagonal `a`, its part `off` of the neighbours, and its unrelaxed value `whole`.
[[gnu::always_inline]] inline ResidualSum residual(double a, double off, double whole, double neighbours,
                                                   double b, double old, double mean_of_box) {
  const double mean = a - off, back = a - whole;
  return {std::fabs(neighbours + b - whole * old), std::fabs(a * old - neighbours - mean * mean_of_box) +
                                                       std::fabs(b + back * old - mean * mean_of_box)};
}

template <bool with_sheet>
[[gnu::always_inline]] inline MomentumSums momentum(MomentumRow row) {
  const RowMetrics& m = row.m;
  const double inverse_alpha = 1 / row.relaxation, inverse_march = 1 / row.march_relaxation;
  const VectorStencil& of = row.velocity;
  const std::ptrdiff_t component = row.stress.component;
  const CellSums sums = sum_cells(m.n, [&](int i) RIPSTOP_CELL {
    Faces nb = coefficients(row, i);
    const double off = sum(nb);
    const double u0 = of.x.here[i], v0 = of.y.here[i], w0 = of.z.here[i];
    const double speed = std::sqrt(u0 * u0 + v0 * v0 + w0 * w0);
    const double resistance = row.resistance.linear[i] + row.rho[i] * row.resistance.quadratic[i] * speed;
    double held_back = off;
    if constexpr (with_sheet) held_back = larger(off, least_diagonal(row, i));
    const double a = held_back * inverse_alpha + resistance;  // of the face flux
    const double r = 1 / a;
    const double lag = held_back * inverse_march - off;
    const double step = 1 / (held_back * inverse_march + resistance);

    Gradient p = gradient(m, row.p, i);
    if constexpr (with_sheet) add_jumps(m, row.sheet.held, i, p);
    const double nu = from_neighbours(nb, of.x, i);
    const double nv = from_neighbours(nb, of.y, i);
    const double nw = from_neighbours(nb, of.z, i);
    const double bu = stress_divergence(row, 0, i) - p.x + row.force.x[i];
    const double bv = stress_divergence(row, component, i) - p.y + row.force.y[i];
    const double bw = stress_divergence(row, 2 * component, i) - p.z + row.force.z[i];

    const double u1 = step * (nu + lag * u0 + bu);
    const double v1 = step * (nv + lag * v0 + bv);
    const double w1 = step * (nw + lag * w0 + bw);
    row.predicted.x[i] = u1, row.predicted.y[i] = v1, row.predicted.z[i] = w1;
    row.matrix.h.x[i] = u1 + r * p.x, row.matrix.h.y[i] = v1 + r * p.y, row.matrix.h.z[i] = w1 + r * p.z;
    row.matrix.ra[i] = r;
    row.matrix.rc[i] = 1 / (held_back * inverse_march - off + resistance);

    const double whole = off + resistance;
    ResidualSum u = residual(a, off, whole, nu, bu, u0, row.mean.x);
    ResidualSum v = residual(a, off, whole, nv, bv, v0, row.mean.y);
    ResidualSum w = residual(a, off, whole, nw, bw, w0, row.mean.z);
    return CellSums{u.residual, v.residual, w.residual, u.scale, v.scale, w.scale};
  });
  return {{sums.a, sums.d}, {sums.b, sums.e}, {sums.c, sums.f}};
}

RIPSTOP_ROW_KERNEL MomentumSums plain_row(const MomentumRow& row) {
  return momentum<false>(row);
}
RIPSTOP_ROW_KERNEL MomentumSums sheet_row(const MomentumRow& row) {
  return momentum<true>(row);
}

}  // namespace

MomentumSums momentum_row(const MomentumRow& row) {
  return row.sheet.held ? sheet_row(row) : plain_row(row);
}

}  // namespace ripstop::inline flow::cartesian
