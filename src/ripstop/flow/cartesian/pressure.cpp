// The pressure equation: the mass fluxes through the faces,
//
//   F = (rho H/A)_f - (rho/A)_f dp/dn - (rho C)_f d(dp)/dn,
//
// with linear interpolation to the faces, must add up to zero in each cell. The first two terms are those of SIMPLE
// in OpenFOAM, A including the resistance R and relaxed with 0.7; the correction dp acts through C = 1 / (A - sum
// a_nb) instead, which takes the neighbours' corrections as equal (SIMPLEC, Van Doormaal and Raithby 1984) and needs
// no relaxation. At the solution dp = 0, so C has no influence on it.
//
// A face covered by a sheet has a jump J in addition to the pressure difference: the one that balances the present
// pressure, and a correction J' = (J0 - J) + S (F - F0) / rho_f to the law, linear about the last iteration, that
// belongs to dp. Solved for F, all terms are divided by 1 + C S / rho_f.
#include <cmath>

#include "ripstop/flow/cartesian/row_parts.h"

namespace ripstop::cartesian {
namespace {

// rho q on a face between two cells, interpolated linearly. `own` is rho q of the cell that looks.
[[gnu::always_inline]] inline double on_low_face(double weight, double rho, double q, double own) {
  return weight * rho * q + (1 - weight) * own;
}
[[gnu::always_inline]] inline double on_high_face(double weight, double own, double rho, double q) {
  return weight * own + (1 - weight) * rho * q;
}

// rho q on the six faces of a cell.
template <bool uniform>
[[gnu::always_inline]] inline Faces times_density(const PressureRow& row, const double* of_cells,
                                                  const double* above, std::ptrdiff_t i) {
  if constexpr (uniform) {
    const double all = row.rho[0] * of_cells[0];
    return {all, all, all, all, all, all};
  }
  const RowMetrics& m = row.m;
  const double *rho = row.rho + i, *q = of_cells + i, *wx = m.x_weight_low + i, own = rho[0] * q[0];
  return {on_low_face(wx[0], rho[-1], q[-1], own),
          on_high_face(wx[1], own, rho[1], q[1]),
          on_low_face(m.y.weight_low, rho[-m.sy], q[-m.sy], own),
          on_high_face(m.y.weight_high, own, rho[m.sy], q[m.sy]),
          on_low_face(m.z.weight_low, rho[-m.sz], q[-m.sz], own),
          on_high_face(m.z.weight_high, own, row.rho_above[i], above[i])};
}

// (rho H/A)_f; `inner` is 0 where the face below is the inlet's, else 1.
template <bool uniform>
[[gnu::always_inline]] inline Faces free_fluxes(const PressureRow& row, double inner, std::ptrdiff_t i) {
  const RowMetrics& m = row.m;
  const auto rho = [&](std::ptrdiff_t step) { return row.rho[uniform ? 0 : i + step]; };
  const double *u = row.hu + i, *v = row.hv + i, *w = row.hw + i, *wx = m.x_weight_low + i;
  const double here = rho(0), fu = here * u[0], fv = here * v[0], fw = here * w[0];
  return {on_low_face(wx[0], rho(-1), u[-1], fu),
          on_high_face(wx[1], fu, rho(1), u[1]),
          on_low_face(m.y.weight_low, rho(-m.sy), v[-m.sy], fv),
          on_high_face(m.y.weight_high, fv, rho(m.sy), v[m.sy]),
          row.inlet_speed[i] * here + inner * on_low_face(m.z.weight_low, rho(-m.sz), w[-m.sz], fw),
          on_high_face(m.z.weight_high, fw, uniform ? here : row.rho_above[i], row.hw_above[i])};
}

// Of the pressure over the faces of a cell [Pa].
[[gnu::always_inline]] inline Faces differences(const PressureRow& row, std::ptrdiff_t i) {
  const double* p = row.p + i;
  const std::ptrdiff_t sy = row.m.sy, sz = row.m.sz;
  return {p[0] - p[-1], p[1] - p[0], p[0] - p[-sy], p[sy] - p[0], p[0] - p[-sz], row.p_above[i] - p[0]};
}

// Factor of the flux of one face with a sheet, and its share of the conductances, see the header.
struct Held {
  double flux, share;
};
[[gnu::always_inline]] inline Held hold(double conductance, double stiffness, double excess, double density,
                                        double old, double flux) {
  const double t = conductance * stiffness / density, share = 1 / (1 + t);
  return {share * (flux - conductance * excess + t * old), share};
}

// The fluxes f of the faces and their conductances g and c next to a sheet.
template <bool uniform>
[[gnu::always_inline]] inline void hold_faces(const PressureRow& row, std::ptrdiff_t i, Faces& f, Faces& g,
                                              Faces& c) {
  const RowMetrics& m = row.m;
  const SheetJumps &excess = row.excess, &stiff = row.stiffness;
  const auto rho = [&](std::ptrdiff_t step) { return row.rho[uniform ? 0 : i + step]; };
  const double *fx = row.fx + i, *fy = row.fy + i, *fz = row.fz + i, r = rho(0);
  const double ww = m.x_weight_low[i], we = m.x_weight_low[i + 1], ws = m.y.weight_low, wn = m.y.weight_high,
               wb = m.z.weight_low, wa = m.z.weight_high;
  Held w =
      hold(c.w * m.x_inverse_distance[i], stiff.x[i], excess.x[i], ww * rho(-1) + (1 - ww) * r, fx[0], f.w);
  f.w = w.flux, g.w *= w.share, c.w *= w.share;
  Held e = hold(c.e * m.x_inverse_distance[i + 1], stiff.x[i + 1], excess.x[i + 1],
                we * r + (1 - we) * rho(1), fx[1], f.e);
  f.e = e.flux, g.e *= e.share, c.e *= e.share;
  Held s = hold(c.s * m.y.distance_low, stiff.y[i], excess.y[i], ws * rho(-m.sy) + (1 - ws) * r, fy[0], f.s);
  f.s = s.flux, g.s *= s.share, c.s *= s.share;
  Held n = hold(c.n * m.y.distance_high, stiff.y_high[i], excess.y_high[i], wn * r + (1 - wn) * rho(m.sy),
                fy[m.sy], f.n);
  f.n = n.flux, g.n *= n.share, c.n *= n.share;
  Held b = hold(c.b * m.z.distance_low, stiff.z[i], excess.z[i], wb * rho(-m.sz) + (1 - wb) * r, fz[0], f.b);
  f.b = b.flux, g.b *= b.share, c.b *= b.share;
  Held a = hold(c.a * m.z.distance_high, stiff.z_high[i], excess.z_high[i],
                wa * r + (1 - wa) * (uniform ? r : row.rho_above[i]), fz[m.sz], f.a);
  f.a = a.flux, g.a *= a.share, c.a *= a.share;
}

[[gnu::always_inline]] inline void add_held(const SheetJumps& held, std::ptrdiff_t i, Faces& difference) {
  difference.w += held.x[i], difference.e += held.x[i + 1];
  difference.s += held.y[i], difference.n += held.y_high[i];
  difference.b += held.z[i], difference.a += held.z_high[i];
}

template <bool with_sheet, bool uniform>
[[gnu::always_inline]] inline void pressure(PressureRow& results) {
  PressureRow row = results;  // a copy, so that the compiler sees that the loop does not change it
  RowMetrics& m = row.m;
  if (row.outlet) m.z.weight_high = 1;  // its faces take the cell's values
  const double area_x = row.y_width * row.z_width, held_at = row.outlet ? row.mean_p : 0;
  const double inner = row.inlet ? 0 : 1;
  double res = 0, scale = 0;
#pragma omp simd reduction(+ : res, scale)
  for (int i = 0; i < m.n; ++i) {
    Faces g = times_density<uniform>(row, row.ra, row.ra_above, i);
    Faces c = times_density<uniform>(row, row.rc, row.rc_above, i);
    Faces f = free_fluxes<uniform>(row, inner, i), d = differences(row, i);
    if constexpr (with_sheet) {
      add_held(row.held, i, d);
      hold_faces<uniform>(row, i, f, g, c);
    }
    const double area_y = m.x_width[i] * row.z_width, area_z = m.x_width[i] * row.y_width;
    const double source = (f.e - f.w) * area_x + (f.n - f.s) * area_y + (f.a - f.b) * area_z;
    const double at_outlet = g.a * m.z.distance_high * area_z;
    const double flow =
        (g.e * m.x_inverse_distance[i + 1] * d.e - g.w * m.x_inverse_distance[i] * d.w) * area_x +
        (g.n * m.y.distance_high * d.n - g.s * m.y.distance_low * d.s) * area_y + at_outlet * d.a -
        g.b * m.z.distance_low * area_z * d.b;
    row.cx[i] = static_cast<float>(c.w * (m.x_inverse_distance[i] * area_x));
    row.cy[i] = static_cast<float>(c.s * (m.y.distance_low * area_y));
    row.cz[i] = static_cast<float>(c.b * (m.z.distance_low * area_z));
    row.rhs[i] = static_cast<float>(flow - source);

    // Row sum of the matrix: only the outlet's faces hold on to a value from outside.
    const double mean = -at_outlet * held_at;
    res += std::fabs(flow - source);
    scale += std::fabs(flow - mean) + std::fabs(source - mean);
  }
  for (int i = 0; row.outlet && i < m.n; ++i) {
    row.cz_above[i] =
        static_cast<float>(row.rho[i] * row.rc[i] * m.z.distance_high * (m.x_width[i] * row.y_width));
  }
  results.sum = {res, scale};
}

// F from its two parts without a sheet, and its value with one.
[[gnu::always_inline]] inline double held_flux(double free, double conductance, double stiffness,
                                               double excess, double density, double old) {
  const double t = conductance * stiffness / density;
  return (free - conductance * excess + t * old) / (1 + t);
}

// Fluxes through `count` low faces along one axis; `step` leads from the cell above a face to the one below.
struct FaceRow {
  int count;
  std::ptrdiff_t step;
  const double *h, *held, *excess, *stiffness;
  double *change, *flux;
};

// `weight` and `inverse_distance` give those of face i.
template <bool with_sheet, bool uniform, class Weight, class Distance>
[[gnu::always_inline]] inline void flux_along(const FluxRow& row, const FaceRow& face, const Weight& weight,
                                              const Distance& inverse_distance) {
  const std::ptrdiff_t step = face.step;
  const double *h = face.h, *ra = row.ra, *rc = row.rc, *rho = row.rho, *p = row.p;
  const double *held = face.held, *excess = face.excess, *stiffness = face.stiffness;
  const float* dp = row.dp;
  double *flux = face.flux, *change = face.change;
#pragma omp simd
  for (int i = 0; i < face.count; ++i) {
    const double w = weight(i), rd = inverse_distance(i);
    const std::ptrdiff_t below = uniform ? 0 : i - step, above = uniform ? 0 : i;
    const double low = w * rho[below], high = (1 - w) * rho[above];
    const double more = static_cast<double>(dp[i]) - static_cast<double>(dp[i - step]);
    const double c = low * rc[below] + high * rc[above];
    double jump = p[i] - p[i - step];
    if constexpr (with_sheet) jump += held[i];
    double f =
        low * h[i - step] + high * h[i] - rd * ((low * ra[below] + high * ra[above]) * jump + c * more);
    if constexpr (with_sheet) {
      f = held_flux(f, rd * c, stiffness[i], excess[i], low + high, flux[i]);
      if (change) change[i] = excess[i] + stiffness[i] * (f - flux[i]) / (low + high);
    }
    flux[i] = f;
  }
}

template <bool with_sheet, bool uniform>
[[gnu::always_inline]] inline void flux(const FluxRow& row) {
  const RowMetrics& m = row.m;
  const SheetJumps &held = row.held, &excess = row.excess, &stiff = row.stiffness;
  const auto constant = [](double value) { return [value](int) { return value; }; };
  const auto of = [](const double* values) { return [values](int i) { return values[i]; }; };
  flux_along<with_sheet, uniform>(row, {m.n + 1, 1, row.hu, held.x, excess.x, stiff.x, row.change_x, row.fx},
                                  of(m.x_weight_low), of(m.x_inverse_distance));
  flux_along<with_sheet, uniform>(row, {m.n, m.sy, row.hv, held.y, excess.y, stiff.y, row.change_y, row.fy},
                                  constant(m.y.weight_low), constant(m.y.distance_low));
  if (row.inlet_speed) {
    for (int i = 0; i < m.n; ++i) row.fz[i] = row.rho[i] * row.inlet_speed[i];
    return;
  }
  flux_along<with_sheet, uniform>(row, {m.n, m.sz, row.hw, held.z, excess.z, stiff.z, row.change_z, row.fz},
                                  constant(m.z.weight_low), constant(m.z.distance_low));
}

// Of a perfect gas at constant total enthalpy: T = T0 + (U0^2 - |U|^2) / (2 c_p).
[[gnu::always_inline]] inline void density(const VelocityRow& row) {
  const double *u = row.u, *v = row.v, *w = row.w, *p = row.p;
  const float* dp = row.dp;
  double* rho = row.rho;
#pragma omp simd
  for (int i = 0; i < row.m.n; ++i) {
    const double temperature =
        row.temperature + row.half_cp * (row.speed2 - (u[i] * u[i] + v[i] * v[i] + w[i] * w[i]));
    rho[i] = (row.pressure0 + p[i] + row.relaxation * static_cast<double>(dp[i])) /
             (row.gas_constant * temperature);
  }
}

template <bool with_sheet>
[[gnu::always_inline]] inline void velocity(VelocityRow& results) {
  const VelocityRow row = results;  // a copy, so that the compiler sees that the loop does not change it
  const RowMetrics& m = row.m;
  double total_u = 0, total_v = 0, total_w = 0, total_p = 0;
#pragma omp simd reduction(+ : total_u, total_v, total_w, total_p)
  for (int i = 0; i < m.n; ++i) {
    Gradient p = gradient(m, row.p, i), more = gradient(m, row.dp, i);
    if constexpr (with_sheet) {
      add_jumps(m, row.held, i, p);
      add_jumps(m, row.change, i, more);
    }
    const double a = row.ra[i], c = row.rc[i], h = m.x_width[i];
    const double u = row.hu[i] - a * p.x - c * more.x, v = row.hv[i] - a * p.y - c * more.y,
                 w = row.hw[i] - a * p.z - c * more.z;
    const double p1 = row.p[i] + row.relaxation * static_cast<double>(row.dp[i]);
    row.u[i] = u;
    row.v[i] = v;
    row.w[i] = w;
    total_u += u * h;
    total_v += v * h;
    total_w += w * h;
    total_p += p1 * h;
  }
  results.total_u = total_u;
  results.total_v = total_v;
  results.total_w = total_w;
  results.total_p = total_p;
  if (row.rho) density(row);
}

RIPSTOP_ROW_KERNEL void plain_row(PressureRow& row) {
  pressure<false, false>(row);
}
RIPSTOP_ROW_KERNEL void sheet_row(PressureRow& row) {
  pressure<true, false>(row);
}
RIPSTOP_ROW_KERNEL void uniform_plain_row(PressureRow& row) {
  pressure<false, true>(row);
}
RIPSTOP_ROW_KERNEL void uniform_sheet_row(PressureRow& row) {
  pressure<true, true>(row);
}

RIPSTOP_ROW_KERNEL void plain_row(FluxRow& row) {
  flux<false, false>(row);
}
RIPSTOP_ROW_KERNEL void sheet_row(FluxRow& row) {
  flux<true, false>(row);
}
RIPSTOP_ROW_KERNEL void uniform_plain_row(FluxRow& row) {
  flux<false, true>(row);
}
RIPSTOP_ROW_KERNEL void uniform_sheet_row(FluxRow& row) {
  flux<true, true>(row);
}

RIPSTOP_ROW_KERNEL void plain_row(VelocityRow& row) {
  velocity<false>(row);
}
RIPSTOP_ROW_KERNEL void sheet_row(VelocityRow& row) {
  velocity<true>(row);
}

}  // namespace

void pressure_row(PressureRow& row) {
  if (row.uniform) return row.held ? uniform_sheet_row(row) : uniform_plain_row(row);
  row.held ? sheet_row(row) : plain_row(row);
}
void flux_row(FluxRow& row) {
  if (row.uniform) return row.held ? uniform_sheet_row(row) : uniform_plain_row(row);
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
