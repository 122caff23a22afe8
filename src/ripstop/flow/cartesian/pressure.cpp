// The pressure equation of SIMPLE, div(rho/A grad p) = div(rho H/A), with both interpolated linearly to the
// faces, and what follows from its solution: face fluxes, velocity, density.
#include <cmath>

#include "ripstop/flow/cartesian/rows.h"
#include "ripstop/flow/cartesian/simd.h"

namespace ripstop::cartesian {

RIPSTOP_ROW_KERNEL void pressure_row(PressureRow& row) {
  const int n = row.m.n;
  const std::ptrdiff_t sy = row.m.sy, sz = row.m.sz;
  const double *wx = row.m.x_weight_low, *rdx = row.m.x_inverse_distance, *hx = row.x_width;
  const CrossMetrics y = row.m.y, z = row.m.z;
  const double *hu = row.hu, *hv = row.hv, *hw = row.hw, *ra = row.ra, *rho = row.rho, *p = row.p;
  const double *hwa = row.hw_above, *rhoa = row.rho_above, *raa = row.ra_above, *pa = row.p_above;
  float *cx = row.cx, *cy = row.cy, *cz = row.cz, *cza = row.cz_above, *rhs = row.rhs;
  const double area_x = row.y_width * row.z_width;
  const bool inlet = row.inlet, outlet = row.outlet;
  const double inlet_speed = row.inlet_speed, mean_p = row.mean_p;

  double res = 0, scale = 0;
#pragma omp simd reduction(+ : res, scale)
  for (int i = 0; i < n; ++i) {
    const double g = rho[i] * ra[i], fu = rho[i] * hu[i], fv = rho[i] * hv[i], fw = rho[i] * hw[i];
    const auto mix = [](double weight, double low, double high) {
      return weight * low + (1 - weight) * high;
    };

    const double gw = mix(wx[i], rho[i - 1] * ra[i - 1], g) * rdx[i];
    const double ge = mix(wx[i + 1], g, rho[i + 1] * ra[i + 1]) * rdx[i + 1];
    const double gs = mix(y.weight_low, rho[i - sy] * ra[i - sy], g) * y.distance_low;
    const double gn = mix(y.weight_high, g, rho[i + sy] * ra[i + sy]) * y.distance_high;
    const double gb = mix(z.weight_low, rho[i - sz] * ra[i - sz], g) * z.distance_low;
    const double ga = (outlet ? g : mix(z.weight_high, g, rhoa[i] * raa[i])) * z.distance_high;

    const double fxw = mix(wx[i], rho[i - 1] * hu[i - 1], fu);
    const double fxe = mix(wx[i + 1], fu, rho[i + 1] * hu[i + 1]);
    const double fys = mix(y.weight_low, rho[i - sy] * hv[i - sy], fv);
    const double fyn = mix(y.weight_high, fv, rho[i + sy] * hv[i + sy]);
    const double fzb = inlet ? rho[i] * inlet_speed : mix(z.weight_low, rho[i - sz] * hw[i - sz], fw);
    const double fza = outlet ? fw : mix(z.weight_high, fw, rhoa[i] * hwa[i]);

    const double area_y = hx[i] * row.z_width, area_z = hx[i] * row.y_width;
    const double source = (fxe - fxw) * area_x + (fyn - fys) * area_y + (fza - fzb) * area_z;
    const double flow = (ge * (p[i + 1] - p[i]) - gw * (p[i] - p[i - 1])) * area_x +
                        (gn * (p[i + sy] - p[i]) - gs * (p[i] - p[i - sy])) * area_y +
                        (ga * (pa[i] - p[i]) - gb * (p[i] - p[i - sz])) * area_z;
    cx[i] = static_cast<float>(gw * area_x);
    cy[i] = static_cast<float>(gs * area_y);
    cz[i] = static_cast<float>(gb * area_z);
    if (outlet) cza[i] = static_cast<float>(ga * area_z);
    rhs[i] = static_cast<float>(flow - source);

    // Row sum of the matrix: only the outlet's faces hold on to a value from outside.
    const double mean = outlet ? -ga * area_z * mean_p : 0;
    res += std::fabs(flow - source);
    scale += std::fabs(flow - mean) + std::fabs(source - mean);
  }
  row.sum = {res, scale};
}

RIPSTOP_ROW_KERNEL void flux_row(FluxRow& row) {
  const int n = row.m.n;
  const std::ptrdiff_t sy = row.m.sy, sz = row.m.sz;
  const double *wx = row.m.x_weight_low, *rdx = row.m.x_inverse_distance;
  const CrossMetrics y = row.m.y, z = row.m.z;
  const double *hu = row.hu, *hv = row.hv, *hw = row.hw, *ra = row.ra, *rho = row.rho, *p = row.p;
  const float* dp = row.dp;
  double *fx = row.fx, *fy = row.fy, *fz = row.fz;
  const bool inlet = row.inlet;
  const double inlet_speed = row.inlet_speed;
#pragma omp simd
  for (int i = 0; i < n + 1; ++i) {
    const double g = wx[i] * rho[i - 1] * ra[i - 1] + (1 - wx[i]) * rho[i] * ra[i];
    const double h = wx[i] * rho[i - 1] * hu[i - 1] + (1 - wx[i]) * rho[i] * hu[i];
    const double jump = (p[i] + static_cast<double>(dp[i])) - (p[i - 1] + static_cast<double>(dp[i - 1]));
    fx[i] = h - g * rdx[i] * jump;
  }
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const double g = y.weight_low * rho[i - sy] * ra[i - sy] + (1 - y.weight_low) * rho[i] * ra[i];
    const double h = y.weight_low * rho[i - sy] * hv[i - sy] + (1 - y.weight_low) * rho[i] * hv[i];
    const double jump = (p[i] + static_cast<double>(dp[i])) - (p[i - sy] + static_cast<double>(dp[i - sy]));
    fy[i] = h - g * y.distance_low * jump;
  }
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const double g = z.weight_low * rho[i - sz] * ra[i - sz] + (1 - z.weight_low) * rho[i] * ra[i];
    const double h = z.weight_low * rho[i - sz] * hw[i - sz] + (1 - z.weight_low) * rho[i] * hw[i];
    const double jump = (p[i] + static_cast<double>(dp[i])) - (p[i - sz] + static_cast<double>(dp[i - sz]));
    fz[i] = inlet ? rho[i] * inlet_speed : h - g * z.distance_low * jump;
  }
}

RIPSTOP_ROW_KERNEL void outlet_flux_row(OutletRow& row) {
  const int n = row.n;
  const double *hw = row.hw, *ra = row.ra, *rho = row.rho, *p = row.p;
  const float* dp = row.dp;
  double* fz = row.fz;
  const double rd = row.inverse_distance;
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    fz[i] = rho[i] * (hw[i] + ra[i] * rd * (p[i] + static_cast<double>(dp[i])));
  }
}

RIPSTOP_ROW_KERNEL void velocity_row(VelocityRow& row) {
  const int n = row.m.n;
  const std::ptrdiff_t sy = row.m.sy, sz = row.m.sz;
  const double *xl = row.m.x_slope_low, *xh = row.m.x_slope_high, *hx = row.x_width;
  const CrossMetrics y = row.m.y, z = row.m.z;
  const double *ra = row.ra, *p = row.p, *hu = row.hu, *hv = row.hv, *hw = row.hw;
  double *u = row.u, *v = row.v, *w = row.w, *rho = row.rho;
  const double gas = row.gas_constant, p0 = row.pressure0, t0 = row.temperature, speed2 = row.speed2,
               half_cp = row.half_cp;
  double total_u = 0, total_v = 0, total_w = 0, total_p = 0;
#pragma omp simd reduction(+ : total_u, total_v, total_w, total_p)
  for (int i = 0; i < n; ++i) {
    const double px = xh[i] * (p[i + 1] - p[i]) + xl[i] * (p[i] - p[i - 1]);
    const double py = y.slope_high * (p[i + sy] - p[i]) + y.slope_low * (p[i] - p[i - sy]);
    const double pz = z.slope_high * (p[i + sz] - p[i]) + z.slope_low * (p[i] - p[i - sz]);
    const double u1 = hu[i] - ra[i] * px, v1 = hv[i] - ra[i] * py, w1 = hw[i] - ra[i] * pz;
    u[i] = u1;
    v[i] = v1;
    w[i] = w1;
    // Perfect gas at constant total enthalpy: T = T0 + (U0^2 - |U|^2) / (2 c_p).
    const double temperature = t0 + half_cp * (speed2 - (u1 * u1 + v1 * v1 + w1 * w1));
    rho[i] = gas > 0 ? (p0 + p[i]) / (gas * temperature) : rho[i];
    total_u += u1 * hx[i];
    total_v += v1 * hx[i];
    total_w += w1 * hx[i];
    total_p += p[i] * hx[i];
  }
  row.total_u = total_u;
  row.total_v = total_v;
  row.total_w = total_w;
  row.total_p = total_p;
}

}  // namespace ripstop::cartesian
