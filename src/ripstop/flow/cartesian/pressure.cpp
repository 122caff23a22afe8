// The pressure equation: the mass fluxes through the faces,
//
//   F = (rho H/A)_f - (rho/A)_f dp/dn - (rho C)_f d(dp)/dn,
//
// with linear interpolation to the faces, must add up to zero in each cell. The first two terms are those of
// SIMPLE as OpenFOAM has it, A including the resistance R and relaxed with 0.7; the correction dp acts
// through C = 1 / (A - sum a_nb) instead, which takes the neighbours' corrections as equal (SIMPLEC, Van
// Doormaal and Raithby 1984) and needs no relaxation. Where dp = 0, the answer, C has no part in it.
//
// A face that a sheet parts has a jump J beside the pressure difference: the one that the pressure already
// stands against, and a correction J' = (J0 - J) + S (F - F0) / rho_f to the law, linear about the last
// iteration, that goes with dp. Solved for F, all terms are divided by 1 + C S / rho_f.
#include <cmath>

#include "ripstop/flow/cartesian/rows.h"
#include "ripstop/flow/cartesian/simd.h"

namespace ripstop::cartesian {
namespace {

template <bool with_sheet>
[[gnu::always_inline]] inline void pressure(PressureRow& row) {
  const int n = row.m.n;
  const std::ptrdiff_t sy = row.m.sy, sz = row.m.sz;
  const double *wx = row.m.x_weight_low, *rdx = row.m.x_inverse_distance, *hx = row.m.x_width;
  const CrossMetrics y = row.m.y, z = row.m.z;
  const double *hu = row.hu, *hv = row.hv, *hw = row.hw, *ra = row.ra, *rc = row.rc, *rho = row.rho,
               *p = row.p;
  const SheetJumps held = row.held, more = row.excess, stiff = row.stiffness;
  const double *old_x = row.fx, *old_y = row.fy, *old_z = row.fz;
  const double *hwa = row.hw_above, *rhoa = row.rho_above, *raa = row.ra_above, *rca = row.rc_above,
               *pa = row.p_above;
  float *cx = row.cx, *cy = row.cy, *cz = row.cz, *cza = row.cz_above, *rhs = row.rhs;
  const double area_x = row.y_width * row.z_width, y_width = row.y_width, z_width = row.z_width;
  // Ends of the box as weights, so that the loop has no branches: the inlet's face carries the given speed,
  // the outlet's takes the cell's values.
  const double* inflow = row.inlet_speed;
  const double inner = row.inlet ? 0 : 1;
  const double wt = row.outlet ? 1 : z.weight_high, held_at = row.outlet ? row.mean_p : 0;

  double res = 0, scale = 0;
#pragma omp simd reduction(+ : res, scale)
  for (int i = 0; i < n; ++i) {
    const double r = rho[i], g = r * ra[i], fu = r * hu[i], fv = r * hv[i], fw = r * hw[i], c = r * rc[i];
    const double rw = rho[i - 1], re = rho[i + 1], rs = rho[i - sy], rn = rho[i + sy], rb = rho[i - sz],
                 rt = rhoa[i];
    const double ww = wx[i], we = wx[i + 1], ws = y.weight_low, wn = y.weight_high, wb = z.weight_low;

    double gw = ww * rw * ra[i - 1] + (1 - ww) * g, ge = we * g + (1 - we) * re * ra[i + 1];
    double gs = ws * rs * ra[i - sy] + (1 - ws) * g, gn = wn * g + (1 - wn) * rn * ra[i + sy];
    double gb = wb * rb * ra[i - sz] + (1 - wb) * g, ga = wt * g + (1 - wt) * rt * raa[i];

    double fxw = ww * rw * hu[i - 1] + (1 - ww) * fu, fxe = we * fu + (1 - we) * re * hu[i + 1];
    double fys = ws * rs * hv[i - sy] + (1 - ws) * fv, fyn = wn * fv + (1 - wn) * rn * hv[i + sy];
    double fzb = inflow[i] * r + inner * (wb * rb * hw[i - sz] + (1 - wb) * fw);
    double fza = wt * fw + (1 - wt) * rt * hwa[i];

    double cw = ww * rw * rc[i - 1] + (1 - ww) * c, cs = ws * rs * rc[i - sy] + (1 - ws) * c,
           cb = wb * rb * rc[i - sz] + (1 - wb) * c;
    double dw = p[i] - p[i - 1], de = p[i + 1] - p[i], ds = p[i] - p[i - sy], dn = p[i + sy] - p[i],
           db = p[i] - p[i - sz], da = pa[i] - p[i];
    if constexpr (with_sheet) {
      dw += held.x[i], de += held.x[i + 1], ds += held.y[i], dn += held.y_high[i], db += held.z[i];
      da += held.z_high[i];
      const double ce = we * c + (1 - we) * re * rc[i + 1], cn = wn * c + (1 - wn) * rn * rc[i + sy],
                   ca = wt * c + (1 - wt) * rt * rca[i];
      const auto hold = [](double conductance, double stiffness, double excess, double density, double old,
                           double& f, double& resist) {
        const double t = conductance * stiffness / density, share = 1 / (1 + t);
        f = share * (f - conductance * excess + t * old);
        resist *= share;
        return share;
      };
      cw *= hold(cw * rdx[i], stiff.x[i], more.x[i], ww * rw + (1 - ww) * r, old_x[i], fxw, gw);
      hold(ce * rdx[i + 1], stiff.x[i + 1], more.x[i + 1], we * r + (1 - we) * re, old_x[i + 1], fxe, ge);
      cs *= hold(cs * y.distance_low, stiff.y[i], more.y[i], ws * rs + (1 - ws) * r, old_y[i], fys, gs);
      hold(cn * y.distance_high, stiff.y_high[i], more.y_high[i], wn * r + (1 - wn) * rn, old_y[i + sy], fyn,
           gn);
      cb *= hold(cb * z.distance_low, stiff.z[i], more.z[i], wb * rb + (1 - wb) * r, old_z[i], fzb, gb);
      hold(ca * z.distance_high, stiff.z_high[i], more.z_high[i], wt * r + (1 - wt) * rt, old_z[i + sz], fza,
           ga);
    }

    const double area_y = hx[i] * z_width, area_z = hx[i] * y_width;
    const double source = (fxe - fxw) * area_x + (fyn - fys) * area_y + (fza - fzb) * area_z;
    const double at_outlet = ga * z.distance_high * area_z;
    const double flow = (ge * rdx[i + 1] * de - gw * rdx[i] * dw) * area_x +
                        (gn * y.distance_high * dn - gs * y.distance_low * ds) * area_y + at_outlet * da -
                        gb * z.distance_low * area_z * db;
    cx[i] = static_cast<float>(cw * (rdx[i] * area_x));
    cy[i] = static_cast<float>(cs * (y.distance_low * area_y));
    cz[i] = static_cast<float>(cb * (z.distance_low * area_z));
    rhs[i] = static_cast<float>(flow - source);

    // Row sum of the matrix: only the outlet's faces hold on to a value from outside.
    const double mean = -at_outlet * held_at;
    res += std::fabs(flow - source);
    scale += std::fabs(flow - mean) + std::fabs(source - mean);
  }
  for (int i = 0; row.outlet && i < n; ++i) {
    cza[i] = static_cast<float>(rho[i] * rc[i] * z.distance_high * (hx[i] * y_width));
  }
  row.sum = {res, scale};
}

// F from its two parts without a sheet, and what it becomes with one.
[[gnu::always_inline]] inline double held_flux(double free, double conductance, double stiffness,
                                               double excess, double density, double old) {
  const double t = conductance * stiffness / density;
  return (free - conductance * excess + t * old) / (1 + t);
}

template <bool with_sheet>
[[gnu::always_inline]] inline void flux(FluxRow& row) {
  const int n = row.m.n;
  const std::ptrdiff_t sy = row.m.sy, sz = row.m.sz;
  const double *wx = row.m.x_weight_low, *rdx = row.m.x_inverse_distance;
  const CrossMetrics y = row.m.y, z = row.m.z;
  const double *hu = row.hu, *hv = row.hv, *hw = row.hw, *ra = row.ra, *rc = row.rc, *rho = row.rho,
               *p = row.p;
  const float* dp = row.dp;
  double *fx = row.fx, *fy = row.fy, *fz = row.fz;
  const SheetJumps held = row.held, excess = row.excess, stiff = row.stiffness;
  double *change_x = row.change_x, *change_y = row.change_y, *change_z = row.change_z;
#pragma omp simd
  for (int i = 0; i < n + 1; ++i) {
    const double low = wx[i] * rho[i - 1], high = (1 - wx[i]) * rho[i];
    const double more = static_cast<double>(dp[i]) - static_cast<double>(dp[i - 1]);
    const double c = low * rc[i - 1] + high * rc[i];
    double jump = p[i] - p[i - 1];
    if constexpr (with_sheet) jump += held.x[i];
    double f = low * hu[i - 1] + high * hu[i] - rdx[i] * ((low * ra[i - 1] + high * ra[i]) * jump + c * more);
    if constexpr (with_sheet) {
      f = held_flux(f, rdx[i] * c, stiff.x[i], excess.x[i], low + high, fx[i]);
      if (change_x) change_x[i] = excess.x[i] + stiff.x[i] * (f - fx[i]) / (low + high);
    }
    fx[i] = f;
  }
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const double low = y.weight_low * rho[i - sy], high = (1 - y.weight_low) * rho[i];
    const double more = static_cast<double>(dp[i]) - static_cast<double>(dp[i - sy]);
    const double c = low * rc[i - sy] + high * rc[i];
    double jump = p[i] - p[i - sy];
    if constexpr (with_sheet) jump += held.y[i];
    double f = low * hv[i - sy] + high * hv[i] -
               y.distance_low * ((low * ra[i - sy] + high * ra[i]) * jump + c * more);
    if constexpr (with_sheet) {
      f = held_flux(f, y.distance_low * c, stiff.y[i], excess.y[i], low + high, fy[i]);
      if (change_y) change_y[i] = excess.y[i] + stiff.y[i] * (f - fy[i]) / (low + high);
    }
    fy[i] = f;
  }
  if (row.inlet_speed) {
    for (int i = 0; i < n; ++i) fz[i] = rho[i] * row.inlet_speed[i];
    return;
  }
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const double low = z.weight_low * rho[i - sz], high = (1 - z.weight_low) * rho[i];
    const double more = static_cast<double>(dp[i]) - static_cast<double>(dp[i - sz]);
    const double c = low * rc[i - sz] + high * rc[i];
    double jump = p[i] - p[i - sz];
    if constexpr (with_sheet) jump += held.z[i];
    double f = low * hw[i - sz] + high * hw[i] -
               z.distance_low * ((low * ra[i - sz] + high * ra[i]) * jump + c * more);
    if constexpr (with_sheet) {
      f = held_flux(f, z.distance_low * c, stiff.z[i], excess.z[i], low + high, fz[i]);
      if (change_z) change_z[i] = excess.z[i] + stiff.z[i] * (f - fz[i]) / (low + high);
    }
    fz[i] = f;
  }
}

template <bool with_sheet>
[[gnu::always_inline]] inline void velocity(VelocityRow& row) {
  const int n = row.m.n;
  const std::ptrdiff_t sy = row.m.sy, sz = row.m.sz;
  const double *xl = row.m.x_slope_low, *xh = row.m.x_slope_high, *hx = row.m.x_width;
  const CrossMetrics y = row.m.y, z = row.m.z;
  const float* dp = row.dp;
  const SheetJumps jump = row.held, change = row.change;
  const double relax = row.relaxation;
  const double *ra = row.ra, *rc = row.rc, *p = row.p, *hu = row.hu, *hv = row.hv, *hw = row.hw;
  double *u = row.u, *v = row.v, *w = row.w, *rho = row.rho;
  const double gas = row.gas_constant, p0 = row.pressure0, t0 = row.temperature, speed2 = row.speed2,
               half_cp = row.half_cp;
  double total_u = 0, total_v = 0, total_w = 0, total_p = 0;
#pragma omp simd reduction(+ : total_u, total_v, total_w, total_p)
  for (int i = 0; i < n; ++i) {
    double px = xh[i] * (p[i + 1] - p[i]) + xl[i] * (p[i] - p[i - 1]);
    double py = y.slope_high * (p[i + sy] - p[i]) + y.slope_low * (p[i] - p[i - sy]);
    double pz = z.slope_high * (p[i + sz] - p[i]) + z.slope_low * (p[i] - p[i - sz]);
    const auto more = [&](std::ptrdiff_t a) { return static_cast<double>(dp[i + a]); };
    const double d0 = more(0);
    double dx = xh[i] * (more(1) - d0) + xl[i] * (d0 - more(-1));
    double dy = y.slope_high * (more(sy) - d0) + y.slope_low * (d0 - more(-sy));
    double dz = z.slope_high * (more(sz) - d0) + z.slope_low * (d0 - more(-sz));
    if constexpr (with_sheet) {
      px += xh[i] * jump.x[i + 1] + xl[i] * jump.x[i];
      py += y.slope_high * jump.y_high[i] + y.slope_low * jump.y[i];
      pz += z.slope_high * jump.z_high[i] + z.slope_low * jump.z[i];
      dx += xh[i] * change.x[i + 1] + xl[i] * change.x[i];
      dy += y.slope_high * change.y_high[i] + y.slope_low * change.y[i];
      dz += z.slope_high * change.z_high[i] + z.slope_low * change.z[i];
    }
    const double u1 = hu[i] - ra[i] * px - rc[i] * dx, v1 = hv[i] - ra[i] * py - rc[i] * dy,
                 w1 = hw[i] - ra[i] * pz - rc[i] * dz;
    const double p1 = p[i] + relax * d0;
    u[i] = u1;
    v[i] = v1;
    w[i] = w1;
    // Perfect gas at constant total enthalpy: T = T0 + (U0^2 - |U|^2) / (2 c_p).
    const double temperature = t0 + half_cp * (speed2 - (u1 * u1 + v1 * v1 + w1 * w1));
    rho[i] = gas > 0 ? (p0 + p1) / (gas * temperature) : rho[i];
    total_u += u1 * hx[i];
    total_v += v1 * hx[i];
    total_w += w1 * hx[i];
    total_p += p1 * hx[i];
  }
  row.total_u = total_u;
  row.total_v = total_v;
  row.total_w = total_w;
  row.total_p = total_p;
}

RIPSTOP_ROW_KERNEL void plain_row(PressureRow& row) {
  pressure<false>(row);
}
RIPSTOP_ROW_KERNEL void sheet_row(PressureRow& row) {
  pressure<true>(row);
}

RIPSTOP_ROW_KERNEL void plain_row(FluxRow& row) {
  flux<false>(row);
}
RIPSTOP_ROW_KERNEL void sheet_row(FluxRow& row) {
  flux<true>(row);
}

RIPSTOP_ROW_KERNEL void plain_row(VelocityRow& row) {
  velocity<false>(row);
}
RIPSTOP_ROW_KERNEL void sheet_row(VelocityRow& row) {
  velocity<true>(row);
}

}  // namespace

void pressure_row(PressureRow& row) {
  row.held ? sheet_row(row) : plain_row(row);
}
void flux_row(FluxRow& row) {
  row.held ? sheet_row(row) : plain_row(row);
}
void velocity_row(VelocityRow& row) {
  row.held ? sheet_row(row) : plain_row(row);
}

RIPSTOP_ROW_KERNEL void outlet_flux_row(OutletRow& row) {
  const int n = row.n;
  const double *hw = row.hw, *ra = row.ra, *rc = row.rc, *rho = row.rho, *p = row.p, *out = row.outlet_p;
  const float* dp = row.dp;
  double* fz = row.fz;
  const double rd = row.inverse_distance;
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    fz[i] = rho[i] * (hw[i] + rd * (ra[i] * (p[i] - out[i]) + rc[i] * static_cast<double>(dp[i])));
  }
}

}  // namespace ripstop::cartesian
