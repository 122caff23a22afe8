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

namespace ripstop::inline flow::cartesian {
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
                                                  std::ptrdiff_t i) {
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
          on_high_face(m.z.weight_high, own, rho[m.sz], q[m.sz])};
}

// (rho H/A)_f; `inner` is 0 where the face below is the inlet's, else 1.
template <bool uniform>
[[gnu::always_inline]] inline Faces free_fluxes(const PressureRow& row, double inner, std::ptrdiff_t i) {
  const RowMetrics& m = row.m;
  const auto rho = [&](std::ptrdiff_t step) { return row.rho[uniform ? 0 : i + step]; };
  const VectorView<const double>& h = row.matrix.h;
  const double *u = h.x + i, *v = h.y + i, *w = h.z + i, *wx = m.x_weight_low + i;
  const double here = rho(0), fu = here * u[0], fv = here * v[0], fw = here * w[0];
  return {on_low_face(wx[0], rho(-1), u[-1], fu),
          on_high_face(wx[1], fu, rho(1), u[1]),
          on_low_face(m.y.weight_low, rho(-m.sy), v[-m.sy], fv),
          on_high_face(m.y.weight_high, fv, rho(m.sy), v[m.sy]),
          row.inlet_speed[i] * here + inner * on_low_face(m.z.weight_low, rho(-m.sz), w[-m.sz], fw),
          on_high_face(m.z.weight_high, fw, rho(m.sz), w[m.sz])};
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
  const FaceView &excess = row.sheet.excess, &stiff = row.sheet.stiffness;
  const auto rho = [&](std::ptrdiff_t step) { return row.rho[uniform ? 0 : i + step]; };
  const double *fx = row.flux.x + i, *fy = row.flux.y + i, *fz = row.flux.z + i, r = rho(0);
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
  Held a = hold(c.a * m.z.distance_high, stiff.z_high[i], excess.z_high[i], wa * r + (1 - wa) * rho(m.sz),
                fz[m.sz], f.a);
  f.a = a.flux, g.a *= a.share, c.a *= a.share;
}

[[gnu::always_inline]] inline void add_held(const FaceView& held, std::ptrdiff_t i, Faces& difference) {
  difference.w += held.x[i], difference.e += held.x[i + 1];
  difference.s += held.y[i], difference.n += held.y_high[i];
  difference.b += held.z[i], difference.a += held.z_high[i];
}

template <bool with_sheet, bool uniform>
[[gnu::always_inline]] inline ResidualSum pressure(PressureRow row) {
  RowMetrics& m = row.m;
  if (row.outlet) m.z.weight_high = 1;  // its faces take the cell's values
  const double area_x = row.y_width * row.z_width, held_at = row.outlet ? row.mean_p : 0;
  const double inner = row.inlet ? 0 : 1;
  const CellSums sums = sum_cells(m.n, [&](int i) RIPSTOP_CELL {
    Faces g = times_density<uniform>(row, row.matrix.ra, i);
    Faces c = times_density<uniform>(row, row.matrix.rc, i);
    Faces f = free_fluxes<uniform>(row, inner, i), d = differences(row, i);
    if constexpr (with_sheet) {
      add_held(row.sheet.held, i, d);
      hold_faces<uniform>(row, i, f, g, c);
    }
    const double area_y = m.x_width[i] * row.z_width, area_z = m.x_width[i] * row.y_width;
    const double source = (f.e - f.w) * area_x + (f.n - f.s) * area_y + (f.a - f.b) * area_z;
    const double at_outlet = g.a * m.z.distance_high * area_z;
    const double flow =
        (g.e * m.x_inverse_distance[i + 1] * d.e - g.w * m.x_inverse_distance[i] * d.w) * area_x +
        (g.n * m.y.distance_high * d.n - g.s * m.y.distance_low * d.s) * area_y + at_outlet * d.a -
        g.b * m.z.distance_low * area_z * d.b;
    row.conductance.x[i] = static_cast<float>(c.w * (m.x_inverse_distance[i] * area_x));
    row.conductance.y[i] = static_cast<float>(c.s * (m.y.distance_low * area_y));
    row.conductance.z[i] = static_cast<float>(c.b * (m.z.distance_low * area_z));
    row.rhs[i] = static_cast<float>(flow - source);

    // Row sum of the matrix: only the outlet's faces hold on to a value from outside.
    const double mean = -at_outlet * held_at;
    return CellSums{std::fabs(flow - source), std::fabs(flow - mean) + std::fabs(source - mean)};
  });
  for (int i = 0; row.outlet && i < m.n; ++i) {
    row.conductance.z[i + m.sz] =
        static_cast<float>(row.rho[i] * row.matrix.rc[i] * m.z.distance_high * (m.x_width[i] * row.y_width));
  }
  return {sums.a, sums.b};
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
  const double *h = face.h, *ra = row.matrix.ra, *rc = row.matrix.rc, *rho = row.rho, *p = row.p;
  const double *held = face.held, *excess = face.excess, *stiffness = face.stiffness;
  const float* dp = row.dp;
  double *flux = face.flux, *change = face.change;
  for_cells(face.count, [&](int i) RIPSTOP_CELL {
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
  });
}

template <bool with_sheet, bool uniform>
[[gnu::always_inline]] inline void flux(const FluxRow& row) {
  const RowMetrics& m = row.m;
  const FaceView &held = row.sheet.held, &excess = row.sheet.excess, &stiff = row.sheet.stiffness;
  const VectorView<const double>& h = row.matrix.h;
  const VectorView<double>&change = row.change, &flux = row.flux;
  const auto constant = [](double value) { return [value](int) { return value; }; };
  const auto of = [](const double* values) { return [values](int i) { return values[i]; }; };
  flux_along<with_sheet, uniform>(row, {m.n + 1, 1, h.x, held.x, excess.x, stiff.x, change.x, flux.x},
                                  of(m.x_weight_low), of(m.x_inverse_distance));
  flux_along<with_sheet, uniform>(row, {m.n, m.sy, h.y, held.y, excess.y, stiff.y, change.y, flux.y},
                                  constant(m.y.weight_low), constant(m.y.distance_low));
  if (row.inlet_speed) {
    for (int i = 0; i < m.n; ++i) flux.z[i] = row.rho[i] * row.inlet_speed[i];
    return;
  }
  flux_along<with_sheet, uniform>(row, {m.n, m.sz, h.z, held.z, excess.z, stiff.z, change.z, flux.z},
                                  constant(m.z.weight_low), constant(m.z.distance_low));
}

// T = T0 + (U0^2 - |U|^2) / (2 c_p).
[[gnu::always_inline]] inline void density(const VelocityRow& row) {
  const double *u = row.velocity.x, *v = row.velocity.y, *w = row.velocity.z, *p = row.p;
  const float* dp = row.dp;
  double* rho = row.rho;
  const Gas& gas = row.gas;
  for_cells(row.m.n, [&](int i) RIPSTOP_CELL {
    const double temperature =
        gas.temperature + gas.half_cp * (gas.speed2 - (u[i] * u[i] + v[i] * v[i] + w[i] * w[i]));
    rho[i] =
        (gas.pressure + p[i] + row.relaxation * static_cast<double>(dp[i])) / (gas.constant * temperature);
  });
}

template <bool with_sheet>
[[gnu::always_inline]] inline VelocitySums velocity(VelocityRow row) {
  const RowMetrics& m = row.m;
  const VectorView<const double>& free = row.matrix.h;
  const CellSums sums = sum_cells(m.n, [&](int i) RIPSTOP_CELL {
    Gradient p = gradient(m, row.p, i), more = gradient(m, row.dp, i);
    if constexpr (with_sheet) {
      add_jumps(m, row.held, i, p);
      add_jumps(m, row.change, i, more);
    }
    const double a = row.matrix.ra[i], c = row.matrix.rc[i], h = m.x_width[i];
    const double u = free.x[i] - a * p.x - c * more.x, v = free.y[i] - a * p.y - c * more.y,
                 w = free.z[i] - a * p.z - c * more.z;
    const double p1 = row.p[i] + row.relaxation * static_cast<double>(row.dp[i]);
    row.velocity.x[i] = u;
    row.velocity.y[i] = v;
    row.velocity.z[i] = w;
    return CellSums{u * h, v * h, w * h, p1 * h};
  });
  if (row.rho) density(row);
  return {sums.a, sums.b, sums.c, sums.d};
}

RIPSTOP_ROW_KERNEL ResidualSum plain_row(const PressureRow& row) {
  return pressure<false, false>(row);
}
RIPSTOP_ROW_KERNEL ResidualSum sheet_row(const PressureRow& row) {
  return pressure<true, false>(row);
}
RIPSTOP_ROW_KERNEL ResidualSum uniform_plain_row(const PressureRow& row) {
  return pressure<false, true>(row);
}
RIPSTOP_ROW_KERNEL ResidualSum uniform_sheet_row(const PressureRow& row) {
  return pressure<true, true>(row);
}

RIPSTOP_ROW_KERNEL void plain_row(const FluxRow& row) {
  flux<false, false>(row);
}
RIPSTOP_ROW_KERNEL void sheet_row(const FluxRow& row) {
  flux<true, false>(row);
}
RIPSTOP_ROW_KERNEL void uniform_plain_row(const FluxRow& row) {
  flux<false, true>(row);
}
RIPSTOP_ROW_KERNEL void uniform_sheet_row(const FluxRow& row) {
  flux<true, true>(row);
}

RIPSTOP_ROW_KERNEL VelocitySums plain_row(const VelocityRow& row) {
  return velocity<false>(row);
}
RIPSTOP_ROW_KERNEL VelocitySums sheet_row(const VelocityRow& row) {
  return velocity<true>(row);
}

}  // namespace

ResidualSum pressure_row(const PressureRow& row) {
  if (row.uniform) return row.sheet.held ? uniform_sheet_row(row) : uniform_plain_row(row);
  return row.sheet.held ? sheet_row(row) : plain_row(row);
}
void flux_row(const FluxRow& row) {
  if (row.uniform) return row.sheet.held ? uniform_sheet_row(row) : uniform_plain_row(row);
  row.sheet.held ? sheet_row(row) : plain_row(row);
}
VelocitySums velocity_row(const VelocityRow& row) {
  return row.held ? sheet_row(row) : plain_row(row);
}

RIPSTOP_ROW_KERNEL void outlet_flux_row(const FluxRow& row, double inverse_distance, const double* pressure) {
  const double *hw = row.matrix.h.z, *ra = row.matrix.ra, *rc = row.matrix.rc, *rho = row.rho, *p = row.p;
  const float* dp = row.dp;
  double* fz = row.flux.z + row.m.sz;
  for_cells(row.m.n, [=](int i) RIPSTOP_CELL {
    const double more = static_cast<double>(dp[i]);
    fz[i] = rho[i] * (hw[i] + inverse_distance * (ra[i] * (p[i] - pressure[i]) + rc[i] * more));
  });
}

}  // namespace ripstop::inline flow::cartesian
