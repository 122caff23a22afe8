// k-omega SST (Menter, Kuntz, Langtry 2003; [NFM] Table 6) far from any wall.
//
// The box has no walls, so the wall distance is unbounded and both blending functions vanish: F1 = F2 = 0.
// What is left is the outer set of constants with the cross-diffusion term, and nu_t = k / omega:
//
//   div(F k)     = div((mu + s_k mu_t) grad k)     + rho min(nu_t S, c1 b* k omega)    - rho b* omega k
//   div(F omega) = div((mu + s_w mu_t) grad omega) + rho g min(S, c1 b* omega^2)       - rho b omega^2
//                                                  + 2 rho s_w grad k . grad omega / omega
//   S = grad U : (grad U + grad U^T) - 2/3 (div U)^2
//
// Cloth taken as a sheet counts as a wall for the limiter of the shear stress, nu_t = k / max(omega, S F2 /
// a1), with F2 from the distance to the cloth; F1 stays 0. Without it the wake is too short and its pressure
// too low.
//
// Convection is first-order upwind in the bounded form sum F (q_nb - q_P); the sinks are implicit.
#include <cmath>

#include "ripstop/flow/cartesian/rows.h"
#include "ripstop/flow/cartesian/simd.h"

namespace ripstop::cartesian {
namespace {

constexpr double sigma_k = 1.0;
constexpr double sigma_omega = 0.856;
constexpr double gamma2 = 0.44;
constexpr double beta2 = 0.0828;
constexpr double beta_star = 0.09;
constexpr double c1 = 10;        // production limiter
constexpr double a1 = 0.31;      // shear-stress limiter
constexpr double floor = 1e-15;  // of k and omega, as OpenFOAM's kMin and omegaMin

}  // namespace

CrossMetrics cross_metrics(const Axis& axis, int c) {
  return {axis.inverse_width[c],        axis.weight_low[c], axis.weight_low[c + 1], axis.inverse_distance[c],
          axis.inverse_distance[c + 1], axis.slope_low[c],  axis.slope_high[c]};
}

RIPSTOP_ROW_KERNEL void eddy_viscosity_row(int n, const double* rho, const double* k, const double* omega,
                                           double* mut) {
#pragma omp simd
  for (int i = 0; i < n; ++i) mut[i] = rho[i] * k[i] / omega[i];
}

RIPSTOP_ROW_KERNEL void limit_row(int n, const double* limit, double* mut) {
#pragma omp simd
  for (int i = 0; i < n; ++i) mut[i] *= limit[i];
}

namespace {

template <bool with_wall>
[[gnu::always_inline]] inline void turbulence(TurbulenceRow& row) {
  const int n = row.m.n;
  const std::ptrdiff_t sy = row.m.sy, sz = row.m.sz, comp = row.component;
  const double *rhx = row.m.x_inverse_width, *wx = row.m.x_weight_low, *rdx = row.m.x_inverse_distance,
               *hx = row.m.x_width, *xl = row.m.x_slope_low, *xh = row.m.x_slope_high;
  const CrossMetrics y = row.m.y, z = row.m.z;
  const double *u = row.u, *v = row.v, *w = row.w, *k = row.k, *om = row.omega, *rho = row.rho;
  const double *kb = row.k_below, *ka = row.k_above, *ob = row.omega_below, *oa = row.omega_above;
  const double *ks = row.k_south, *kn = row.k_north, *os = row.omega_south, *on = row.omega_north;
  const double *fx = row.fx, *fy = row.fy, *fz = row.fz;
  const double *mut = row.mut, *mutb = row.mut_below, *muta = row.mut_above;
  double *k_new = row.k_new, *om_new = row.omega_new, *mu_new = row.mu_new;
  double *tx = row.tx, *ty = row.ty, *tz = row.tz;
  const double* wall = row.wall;
  double* limit_new = row.limit_new;
  const double mu = row.viscosity, inverse_alpha = 1 / row.relaxation, mean_k = row.mean_k,
               mean_om = row.mean_omega;

  double res_k = 0, scale_k = 0, res_om = 0, scale_om = 0, total_k = 0, total_om = 0;
#pragma omp simd reduction(+ : res_k, scale_k, res_om, scale_om, total_k, total_om)
  for (int i = 0; i < n; ++i) {
    const auto slope_x = [&](const double* q) {
      return xh[i] * (q[i + 1] - q[i]) + xl[i] * (q[i] - q[i - 1]);
    };
    const auto slope_y = [&](const double* q) {
      return y.slope_high * (q[i + sy] - q[i]) + y.slope_low * (q[i] - q[i - sy]);
    };
    const auto slope_z = [&](const double* q) {
      return z.slope_high * (q[i + sz] - q[i]) + z.slope_low * (q[i] - q[i - sz]);
    };
    const double ux = slope_x(u), uy = slope_y(u), uz = slope_z(u);
    const double vx = slope_x(v), vy = slope_y(v), vz = slope_z(v);
    const double wx_ = slope_x(w), wy = slope_y(w), wz = slope_z(w);
    const double divergence = ux + vy + wz;
    const double strain = 2 * (ux * ux + vy * vy + wz * wz) + (uy + vx) * (uy + vx) +
                          (uz + wx_) * (uz + wx_) + (vz + wy) * (vz + wy) -
                          (2.0 / 3) * divergence * divergence;
    const double k0 = k[i], om0 = om[i], r = rho[i], inverse_om = 1 / om0;
    const double cross = (2 * sigma_omega) * r *
                         (slope_x(k) * slope_x(om) + slope_y(k) * slope_y(om) + slope_z(k) * slope_z(om)) *
                         inverse_om;

    // Eddy viscosity and convection on the six faces.
    const double mw = wx[i] * mut[i - 1] + (1 - wx[i]) * mut[i];
    const double me = wx[i + 1] * mut[i] + (1 - wx[i + 1]) * mut[i + 1];
    const double ms = y.weight_low * mut[i - sy] + (1 - y.weight_low) * mut[i];
    const double mn = y.weight_high * mut[i] + (1 - y.weight_high) * mut[i + sy];
    const double mb = z.weight_low * mutb[i] + (1 - z.weight_low) * mut[i];
    const double ma = z.weight_high * mut[i] + (1 - z.weight_high) * muta[i];
    const double cw = positive(fx[i]) * rhx[i], ce = positive(-fx[i + 1]) * rhx[i];
    const double cs = positive(fy[i]) * y.inverse_width, cn = positive(-fy[i + sy]) * y.inverse_width;
    const double cb = positive(fz[i]) * z.inverse_width, ca = positive(-fz[i + sz]) * z.inverse_width;
    const double dw = rdx[i] * rhx[i], de = rdx[i + 1] * rhx[i];
    const double ds = y.distance_low * y.inverse_width, dn = y.distance_high * y.inverse_width;
    const double db = z.distance_low * z.inverse_width, da = z.distance_high * z.inverse_width;

    // omega
    double om1;
    {
      const double aw = cw + (sigma_omega * mw + mu) * dw, ae = ce + (sigma_omega * me + mu) * de;
      const double as = cs + (sigma_omega * ms + mu) * ds, an = cn + (sigma_omega * mn + mu) * dn;
      const double ab = cb + (sigma_omega * mb + mu) * db, aa = ca + (sigma_omega * ma + mu) * da;
      const double off = aw + ae + as + an + ab + aa;
      const double neighbours =
          aw * om[i - 1] + ae * om[i + 1] + as * os[i] + an * on[i] + ab * ob[i] + aa * oa[i];
      const double source = r * gamma2 * smaller(strain, (c1 * beta_star) * om0 * om0) + positive(cross);
      const double diagonal = off + r * beta2 * om0 + positive(-cross) * inverse_om;
      const double relaxed = diagonal * inverse_alpha;
      const double b = source + (relaxed - diagonal) * om0;
      const double mean = (relaxed - off) * mean_om;
      om1 = larger((neighbours + b) / relaxed, floor);
      res_om += std::fabs(source + neighbours - diagonal * om0);
      scale_om += std::fabs(relaxed * om0 - neighbours - mean) + std::fabs(b - mean);
    }
    // k
    double k1;
    {
      const double aw = cw + (sigma_k * mw + mu) * dw, ae = ce + (sigma_k * me + mu) * de;
      const double as = cs + (sigma_k * ms + mu) * ds, an = cn + (sigma_k * mn + mu) * dn;
      const double ab = cb + (sigma_k * mb + mu) * db, aa = ca + (sigma_k * ma + mu) * da;
      const double off = aw + ae + as + an + ab + aa;
      const double neighbours =
          aw * k[i - 1] + ae * k[i + 1] + as * ks[i] + an * kn[i] + ab * kb[i] + aa * ka[i];
      const double source = smaller(mut[i] * strain, r * (c1 * beta_star) * k0 * om1);
      const double diagonal = off + r * beta_star * om1;
      const double relaxed = diagonal * inverse_alpha;
      const double b = source + (relaxed - diagonal) * k0;
      const double mean = (relaxed - off) * mean_k;
      k1 = larger((neighbours + b) / relaxed, floor);
      res_k += std::fabs(source + neighbours - diagonal * k0);
      scale_k += std::fabs(relaxed * k0 - neighbours - mean) + std::fabs(b - mean);
    }
    k_new[i] = k1;
    om_new[i] = om1;
    total_k += k1 * hx[i];
    total_om += om1 * hx[i];

    // Explicit part of the stress, mu dev2((grad U)^T): through an x face it carries mu grad(u) - 2/3 mu div
    // U, and so on.
    double limited = 1;
    if constexpr (with_wall) {
      const double root = std::sqrt(k1) / (beta_star * om1 * wall[i]);
      const double arg = larger(2 * root, 500 * mu / (r * wall[i] * wall[i] * om1));
      const double x = smaller(arg * arg, 3), f2 = x * (27 + x * x) / (27 + 9 * x * x);  // tanh within 2.4 %
      limited = 1 / larger(1, std::sqrt(positive(strain)) * f2 / (a1 * om1));
      limit_new[i] = limited;
    }
    const double me_ = mu + r * k1 / om1 * limited;
    const double trace = (2.0 / 3) * me_ * divergence;
    mu_new[i] = me_;
    tx[i] = me_ * ux - trace;
    tx[i + comp] = me_ * uy;
    tx[i + 2 * comp] = me_ * uz;
    ty[i] = me_ * vx;
    ty[i + comp] = me_ * vy - trace;
    ty[i + 2 * comp] = me_ * vz;
    tz[i] = me_ * wx_;
    tz[i + comp] = me_ * wy;
    tz[i + 2 * comp] = me_ * wz - trace;
  }
  row.k_sum = {res_k, scale_k};
  row.omega_sum = {res_om, scale_om};
  row.total_k = total_k;
  row.total_omega = total_om;
}

RIPSTOP_ROW_KERNEL void open_row(TurbulenceRow& row) {
  turbulence<false>(row);
}
RIPSTOP_ROW_KERNEL void wall_row(TurbulenceRow& row) {
  turbulence<true>(row);
}

}  // namespace

void turbulence_row(TurbulenceRow& row) {
  row.wall ? wall_row(row) : open_row(row);
}

}  // namespace ripstop::cartesian
