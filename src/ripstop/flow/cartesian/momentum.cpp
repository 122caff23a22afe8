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

namespace ripstop::cartesian {
namespace {

// a_nb of upwind convection and diffusion through the faces of a cell [kg/(m3 s)].
[[gnu::always_inline]] inline Faces coefficients(const MomentumRow& row, std::ptrdiff_t i) {
  const RowMetrics& m = row.m;
  Faces mu = on_faces(m, row.mu, row.mu_below, row.mu_above, i);
  Faces in = inflow(m, row.fx, row.fy, row.fz, i);
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
  const SheetJumps& s = row.stiffness;
  const double faces = s.x[i] + s.x[i + 1] + s.y[i] + s.y_high[i] + s.z[i] + s.z_high[i];
  const double least_width =
      larger(row.m.x_inverse_width[i], larger(row.m.y.inverse_width, row.m.z.inverse_width));
  return faces > 0 ? row.inertia * least_width : 0;
}

// Force of the explicit stress of component `c` on cell i [N/m3].
[[gnu::always_inline]] inline double stress_divergence(const MomentumRow& row, std::ptrdiff_t c,
                                                       std::ptrdiff_t i) {
  const RowMetrics& m = row.m;
  const double *tx = row.tx + i + c, *ty = row.ty + i + c, *tz = row.tz + i + c;
  return m.x_slope_high[i] * (tx[1] - tx[0]) + m.x_slope_low[i] * (tx[0] - tx[-1]) +
         m.y.slope_high * (ty[m.sy] - ty[0]) + m.y.slope_low * (ty[0] - ty[-m.sy]) +
         m.z.slope_high * (row.tz_above[i + c] - tz[0]) + m.z.slope_low * (tz[0] - row.tz_below[i + c]);
}

// Relaxed matrix for the face flux: diagonal `a`, its part `off` of the neighbours, and its unrelaxed value `whole`.
[[gnu::always_inline]] inline ResidualSum residual(double a, double off, double whole, double neighbours,
                                                   double b, double old, double mean_of_box) {
  const double mean = a - off, back = a - whole;
  return {std::fabs(neighbours + b - whole * old), std::fabs(a * old - neighbours - mean * mean_of_box) +
                                                       std::fabs(b + back * old - mean * mean_of_box)};
}

template <bool with_sheet>
[[gnu::always_inline]] inline void momentum(MomentumRow& results) {
  const MomentumRow row = results;  // a copy, so that the compiler sees that the loop does not change it
  const RowMetrics& m = row.m;
  const double inverse_alpha = 1 / row.relaxation, inverse_march = 1 / row.march_relaxation;
  double res_u = 0, res_v = 0, res_w = 0, scale_u = 0, scale_v = 0, scale_w = 0;
#pragma omp simd reduction(+ : res_u, res_v, res_w, scale_u, scale_v, scale_w)
  for (int i = 0; i < m.n; ++i) {
    Faces nb = coefficients(row, i);
    const double off = sum(nb);
    const double u0 = row.u[i], v0 = row.v[i], w0 = row.w[i];
    const double speed = std::sqrt(u0 * u0 + v0 * v0 + w0 * w0);
    const double resistance = row.linear[i] + row.rho[i] * row.quadratic[i] * speed;
    double held_back = off;
    if constexpr (with_sheet) held_back = larger(off, least_diagonal(row, i));
    const double a = held_back * inverse_alpha + resistance;  // of the face flux
    const double r = 1 / a;
    const double lag = held_back * inverse_march - off;
    const double step = 1 / (held_back * inverse_march + resistance);

    Gradient p = gradient(m, row.p, i);
    if constexpr (with_sheet) add_jumps(m, row.sheet, i, p);
    const double nu = from_neighbours(nb, row.u, row.u_south, row.u_north, row.u_below, row.u_above, i);
    const double nv = from_neighbours(nb, row.v, row.v_south, row.v_north, row.v_below, row.v_above, i);
    const double nw = from_neighbours(nb, row.w, row.w_south, row.w_north, row.w_below, row.w_above, i);
    const double bu = stress_divergence(row, 0, i) - p.x + row.extra_u[i];
    const double bv = stress_divergence(row, row.component, i) - p.y + row.extra_v[i];
    const double bw = stress_divergence(row, 2 * row.component, i) - p.z + row.extra_w[i];

    const double u1 = step * (nu + lag * u0 + bu);
    const double v1 = step * (nv + lag * v0 + bv);
    const double w1 = step * (nw + lag * w0 + bw);
    row.u_new[i] = u1, row.v_new[i] = v1, row.w_new[i] = w1;
    row.hu[i] = u1 + r * p.x, row.hv[i] = v1 + r * p.y, row.hw[i] = w1 + r * p.z;
    row.ra[i] = r;
    row.rc[i] = 1 / (held_back * inverse_march - off + resistance);

    const double whole = off + resistance;
    ResidualSum u = residual(a, off, whole, nu, bu, u0, row.mean_u);
    ResidualSum v = residual(a, off, whole, nv, bv, v0, row.mean_v);
    ResidualSum w = residual(a, off, whole, nw, bw, w0, row.mean_w);
    res_u += u.residual, res_v += v.residual, res_w += w.residual;
    scale_u += u.scale, scale_v += v.scale, scale_w += w.scale;
  }
  results.u_sum = {res_u, scale_u};
  results.v_sum = {res_v, scale_v};
  results.w_sum = {res_w, scale_w};
}

RIPSTOP_ROW_KERNEL void plain_row(MomentumRow& row) {
  momentum<false>(row);
}
RIPSTOP_ROW_KERNEL void sheet_row(MomentumRow& row) {
  momentum<true>(row);
}

}  // namespace

void momentum_row(MomentumRow& row) {
  row.sheet ? sheet_row(row) : plain_row(row);
}

}  // namespace ripstop::cartesian
