// Momentum equation, first-order upwind in bounded form, and the porous resistance:
//
//   sum F (U_nb - U_P) = div(mu_eff grad U) + div(mu_eff dev2((grad U)^T)) - grad p - R U,
//   R = mu d + rho |U| f / 2                                             [NFM] `paper` porosity
//
// The equation is under-relaxed first and the resistance is added after that, so that R enters the diagonal
// and the face flux (through 1/A) unrelaxed.
//
// A cell that tight cloth shuts in has hardly any flux, so that A all but vanishes and any error of the
// pressure would send its air off at once. Beside a sheet A is therefore no less than rho U / h of the free
// stream.
#include <cmath>

#include "ripstop/flow/cartesian/rows.h"
#include "ripstop/flow/cartesian/simd.h"

namespace ripstop::cartesian {
namespace {

template <bool with_sheet>
[[gnu::always_inline]] inline void momentum(MomentumRow& row) {
  const int n = row.m.n;
  const std::ptrdiff_t sy = row.m.sy, sz = row.m.sz, comp = row.component;
  const double *rhx = row.m.x_inverse_width, *wx = row.m.x_weight_low, *rdx = row.m.x_inverse_distance,
               *xl = row.m.x_slope_low, *xh = row.m.x_slope_high;
  const CrossMetrics y = row.m.y, z = row.m.z;
  const double *u = row.u, *v = row.v, *w = row.w, *p = row.p, *rho = row.rho;
  const double *ub = row.u_below, *vb = row.v_below, *wb = row.w_below;
  const double *ua = row.u_above, *va = row.v_above, *wa = row.w_above;
  const double *us = row.u_south, *vs = row.v_south, *ws = row.w_south;
  const double *un = row.u_north, *vn = row.v_north, *wn = row.w_north;
  const double *fx = row.fx, *fy = row.fy, *fz = row.fz;
  const double *mu = row.mu, *mub = row.mu_below, *mua = row.mu_above;
  const double *tx = row.tx, *ty = row.ty, *tz = row.tz, *tzb = row.tz_below, *tza = row.tz_above;
  const double *linear = row.linear, *quadratic = row.quadratic;
  const SheetJumps jump = row.sheet, stiff = row.stiffness;
  const double inertia = row.inertia;
  const double *extra_u = row.extra_u, *extra_v = row.extra_v, *extra_w = row.extra_w;
  double *hu = row.hu, *hv = row.hv, *hw = row.hw, *ra = row.ra, *rc = row.rc;
  double *u_new = row.u_new, *v_new = row.v_new, *w_new = row.w_new;
  const double inverse_alpha = 1 / row.relaxation, inverse_march = 1 / row.march_relaxation;
  const double mean_u = row.mean_u, mean_v = row.mean_v, mean_w = row.mean_w;

  double res_u = 0, res_v = 0, res_w = 0, scale_u = 0, scale_v = 0, scale_w = 0;
#pragma omp simd reduction(+ : res_u, res_v, res_w, scale_u, scale_v, scale_w)
  for (int i = 0; i < n; ++i) {
    const double mw = wx[i] * mu[i - 1] + (1 - wx[i]) * mu[i];
    const double me = wx[i + 1] * mu[i] + (1 - wx[i + 1]) * mu[i + 1];
    const double ms = y.weight_low * mu[i - sy] + (1 - y.weight_low) * mu[i];
    const double mn = y.weight_high * mu[i] + (1 - y.weight_high) * mu[i + sy];
    const double mb = z.weight_low * mub[i] + (1 - z.weight_low) * mu[i];
    const double ma = z.weight_high * mu[i] + (1 - z.weight_high) * mua[i];
    const double aw = (positive(fx[i]) + mw * rdx[i]) * rhx[i];
    const double ae = (positive(-fx[i + 1]) + me * rdx[i + 1]) * rhx[i];
    const double as = (positive(fy[i]) + ms * y.distance_low) * y.inverse_width;
    const double an = (positive(-fy[i + sy]) + mn * y.distance_high) * y.inverse_width;
    const double ab = (positive(fz[i]) + mb * z.distance_low) * z.inverse_width;
    const double aa = (positive(-fz[i + sz]) + ma * z.distance_high) * z.inverse_width;
    const double off = aw + ae + as + an + ab + aa;

    const double u0 = u[i], v0 = v[i], w0 = w[i];
    const double speed = std::sqrt(u0 * u0 + v0 * v0 + w0 * w0);
    const double resistance = linear[i] + rho[i] * quadratic[i] * speed;
    double held_back = off;
    if constexpr (with_sheet) {
      const double faces =
          stiff.x[i] + stiff.x[i + 1] + stiff.y[i] + stiff.y_high[i] + stiff.z[i] + stiff.z_high[i];
      held_back =
          larger(off, faces > 0 ? inertia * larger(rhx[i], larger(y.inverse_width, z.inverse_width)) : 0);
    }
    const double a = held_back * inverse_alpha + resistance;  // of the face flux
    const double r = 1 / a;
    const double lag = held_back * inverse_march - off;
    const double step = 1 / (held_back * inverse_march + resistance);

    const auto divergence = [&](std::ptrdiff_t c) {
      return xh[i] * (tx[i + 1 + c] - tx[i + c]) + xl[i] * (tx[i + c] - tx[i - 1 + c]) +
             y.slope_high * (ty[i + sy + c] - ty[i + c]) + y.slope_low * (ty[i + c] - ty[i - sy + c]) +
             z.slope_high * (tza[i + c] - tz[i + c]) + z.slope_low * (tz[i + c] - tzb[i + c]);
    };
    double px = xh[i] * (p[i + 1] - p[i]) + xl[i] * (p[i] - p[i - 1]);
    double py = y.slope_high * (p[i + sy] - p[i]) + y.slope_low * (p[i] - p[i - sy]);
    double pz = z.slope_high * (p[i + sz] - p[i]) + z.slope_low * (p[i] - p[i - sz]);
    if constexpr (with_sheet) {
      px += xh[i] * jump.x[i + 1] + xl[i] * jump.x[i];
      py += y.slope_high * jump.y_high[i] + y.slope_low * jump.y[i];
      pz += z.slope_high * jump.z_high[i] + z.slope_low * jump.z[i];
    }

    const double nu = aw * u[i - 1] + ae * u[i + 1] + as * us[i] + an * un[i] + ab * ub[i] + aa * ua[i];
    const double nv = aw * v[i - 1] + ae * v[i + 1] + as * vs[i] + an * vn[i] + ab * vb[i] + aa * va[i];
    const double nw = aw * w[i - 1] + ae * w[i + 1] + as * ws[i] + an * wn[i] + ab * wb[i] + aa * wa[i];
    const double bu = divergence(0) - px + extra_u[i], bv = divergence(comp) - py + extra_v[i],
                 bw = divergence(2 * comp) - pz + extra_w[i];

    const double u1 = step * (nu + lag * u0 + bu);
    const double v1 = step * (nv + lag * v0 + bv);
    const double w1 = step * (nw + lag * w0 + bw);
    u_new[i] = u1;
    v_new[i] = v1;
    w_new[i] = w1;
    hu[i] = u1 + r * px;
    hv[i] = v1 + r * py;
    hw[i] = w1 + r * pz;
    ra[i] = r;
    rc[i] = 1 / (held_back * inverse_march - off + resistance);

    // Residual and scale of the matrix as it is relaxed for the face flux.
    const double whole = off + resistance, mean = a - off, back = a - whole;
    res_u += std::fabs(nu + bu - whole * u0);
    res_v += std::fabs(nv + bv - whole * v0);
    res_w += std::fabs(nw + bw - whole * w0);
    scale_u += std::fabs(a * u0 - nu - mean * mean_u) + std::fabs(bu + back * u0 - mean * mean_u);
    scale_v += std::fabs(a * v0 - nv - mean * mean_v) + std::fabs(bv + back * v0 - mean * mean_v);
    scale_w += std::fabs(a * w0 - nw - mean * mean_w) + std::fabs(bw + back * w0 - mean * mean_w);
  }
  row.u_sum = {res_u, scale_u};
  row.v_sum = {res_v, scale_v};
  row.w_sum = {res_w, scale_w};
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
