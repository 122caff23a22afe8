// k-omega SST (Menter, Kuntz, Langtry 2003; [NFM] Table 6) far from any wall.
//
// The box has no walls, so the wall distance is unbounded and both blending functions vanish: F1 = F2 = 0.
// The remaining terms are the outer set of constants with the cross-diffusion term, and nu_t = k / omega:
//
//   div(F k)     = div((mu + s_k mu_t) grad k)     + rho min(nu_t S, c1 b* k omega)    - rho b* omega k
//   div(F omega) = div((mu + s_w mu_t) grad omega) + rho g min(S, c1 b* omega^2)       - rho b omega^2
//                                                  + 2 rho s_w grad k . grad omega / omega
//   S = grad U : (grad U + grad U^T) - 2/3 (div U)^2
//
// A porous sheet is treated as a wall for the limiter of the shear stress, nu_t = k / max(omega,
// S F2 / a1), with F2 from the distance to the cloth; F1 stays 0. Without it the wake is too short
// and its pressure too low.
//
// Convection is first-order upwind in the bounded form sum F (q_nb - q_P); the sinks are implicit.
//
// A step in time is Euler's, with the fluxes at its beginning; the sink of k is that of detached-eddy simulation
// (Strelets 2001), rho b* omega k max(1, L / (C D)) with L = sqrt(k) / (b* omega) and D a cell's largest width. A
// march begins without the resolved eddies: k is limited by L = C D.
#include <cmath>

#include "ripstop/flow/cartesian/row_parts.h"

namespace ripstop::inline flow::cartesian {
namespace {

constexpr double sigma_k = 1.0;
constexpr double sigma_omega = 0.856;
constexpr double gamma2 = 0.44;
constexpr double beta2 = 0.0828;
constexpr double beta_star = 0.09;
constexpr double c1 = 10;        // production limiter
constexpr double a1 = 0.31;      // shear-stress limiter
constexpr double c_des = 0.61;   // of the outer set of constants
constexpr double floor = 1e-15;  // of k and omega, as OpenFOAM's kMin and omegaMin

}  // namespace

CrossMetrics cross_metrics(const Axis& axis, int c) {
  return {axis.inverse_width[c],        axis.weight_low[c], axis.weight_low[c + 1], axis.inverse_distance[c],
          axis.inverse_distance[c + 1], axis.slope_low[c],  axis.slope_high[c]};
}

RIPSTOP_ROW_KERNEL void eddy_viscosity_row(int n, const double* rho, const double* k, const double* omega,
                                           double* mut) {
  for_cells(n, [=](int i) RIPSTOP_CELL { mut[i] = rho[i] * k[i] / omega[i]; });
}

RIPSTOP_ROW_KERNEL void unresolved_row(int n, const double* width, double across, const double* omega,
                                       double* k) {
  for_cells(n, [=](int i) RIPSTOP_CELL {
    const double root = beta_star * c_des * omega[i] * larger(width[i], across);
    k[i] = smaller(k[i], root * root);
  });
}

RIPSTOP_ROW_KERNEL void limit_row(int n, const double* limit, double* mut) {
  for_cells(n, [=](int i) RIPSTOP_CELL { mut[i] *= limit[i]; });
}

namespace {

// S of the header from the gradients of the three components [1/s2].
[[gnu::always_inline]] inline double strain_rate(const Gradient& u, const Gradient& v, const Gradient& w,
                                                 double divergence) {
  return 2 * (u.x * u.x + v.y * v.y + w.z * w.z) + (u.y + v.x) * (u.y + v.x) + (u.z + w.x) * (u.z + w.x) +
         (v.z + w.y) * (v.z + w.y) - (2.0 / 3) * divergence * divergence;
}

// Face data of one of the two equations for a cell: inflow and diffusion per viscosity [1/m2], both
// over the cell's width, and the eddy viscosity.
[[gnu::always_inline]] inline Faces convection(const TurbulenceRow& row, std::ptrdiff_t i) {
  const RowMetrics& m = row.m;
  Faces in = inflow(m, row.flux, i);
  const double h = m.x_inverse_width[i], hy = m.y.inverse_width, hz = m.z.inverse_width;
  return {in.w * h, in.e * h, in.s * hy, in.n * hy, in.b * hz, in.a * hz};
}
[[gnu::always_inline]] inline Faces diffusion(const RowMetrics& m, std::ptrdiff_t i) {
  const double h = m.x_inverse_width[i], hy = m.y.inverse_width, hz = m.z.inverse_width;
  return {m.x_inverse_distance[i] * h, m.x_inverse_distance[i + 1] * h, m.y.distance_low * hy,
          m.y.distance_high * hy,      m.z.distance_low * hz,           m.z.distance_high * hz};
}

// a_nb with the part `sigma` of the eddy viscosity `eddy`, c and d from above.
[[gnu::always_inline]] inline Faces coefficients(const Faces& c, const Faces& d, const Faces& eddy,
                                                 double sigma, double mu) {
  return {c.w + (sigma * eddy.w + mu) * d.w, c.e + (sigma * eddy.e + mu) * d.e,
          c.s + (sigma * eddy.s + mu) * d.s, c.n + (sigma * eddy.n + mu) * d.n,
          c.b + (sigma * eddy.b + mu) * d.b, c.a + (sigma * eddy.a + mu) * d.a};
}

// The new value in a cell of diagonal q = neighbours + source, under-relaxed, and its residual.
struct Update {
  double value, residual, scale;
};
[[gnu::always_inline]] inline Update update(double off, double neighbours, double source, double diagonal,
                                            double old, double mean_of_box, double inverse_alpha) {
  const double relaxed = diagonal * inverse_alpha;
  const double b = source + (relaxed - diagonal) * old;
  const double mean = (relaxed - off) * mean_of_box;
  return {larger((neighbours + b) / relaxed, floor), std::fabs(source + neighbours - diagonal * old),
          std::fabs(relaxed * old - neighbours - mean) + std::fabs(b - mean)};
}
// Or after a step in time, `inertia` the density over it: of the diagonal the sinks alone are implicit.
[[gnu::always_inline]] inline Update stepped(double off, double neighbours, double source, double diagonal,
                                             double old, double inertia) {
  const double gained = neighbours - off * old + source;
  return {larger((inertia * old + gained) / (inertia + diagonal - off), floor), 0, 0};
}

template <bool in_time>
[[gnu::always_inline]] inline Update omega_update(const TurbulenceRow& row, const Faces& a, double strain,
                                                  double cross, double inverse_alpha, std::ptrdiff_t i) {
  const double off = sum(a), old = row.omega.here[i], rho = row.rho[i];
  const double neighbours = from_neighbours(a, row.omega, i);
  const double source = rho * gamma2 * smaller(strain, (c1 * beta_star) * old * old) + positive(cross);
  const double diagonal = off + rho * beta2 * old + positive(-cross) * (1 / old);
  if constexpr (in_time) return stepped(off, neighbours, source, diagonal, old, rho * row.inverse_step);
  return update(off, neighbours, source, diagonal, old, row.mean_omega, inverse_alpha);
}

template <bool in_time>
[[gnu::always_inline]] inline Update k_update(const TurbulenceRow& row, const Faces& a, double strain,
                                              double omega, double inverse_alpha, std::ptrdiff_t i) {
  const double off = sum(a), old = row.k.here[i], rho = row.rho[i];
  const double neighbours = from_neighbours(a, row.k, i);
  const double source = smaller(row.mut.here[i] * strain, rho * (c1 * beta_star) * old * omega);
  if constexpr (in_time) {
    const double inverse_width = smaller(row.m.x_inverse_width[i], row.inverse_across);
    const double sink = larger(omega, 1 / (beta_star * c_des) * std::sqrt(old) * inverse_width);
    return stepped(off, neighbours, source, off + rho * beta_star * sink, old, rho * row.inverse_step);
  }
  const double diagonal = off + rho * beta_star * omega;
  return update(off, neighbours, source, diagonal, old, row.mean_k, inverse_alpha);
}

// Factor of the eddy viscosity at distance `wall` from the cloth [m].
[[gnu::always_inline]] inline double shear_stress_limit(double strain, double k, double omega, double rho,
                                                        double viscosity, double wall) {
  const double mass = rho * wall, once = 1 / (mass * wall * omega);
  const double arg = larger(2 / beta_star * std::sqrt(k) * mass * once, 500 * viscosity * once);
  const double x = smaller(arg * arg, 3);  // F2 = tanh(arg^2) within 2.4 % as a ratio of polynomials
  const double over = x * (27 + x * x), under = (27 + 9 * x * x) * (a1 * omega);
  return under / larger(under, std::sqrt(positive(strain)) * over);
}

// Explicit part of the stress, mu dev2((grad U)^T): through an x face it carries mu grad(u) - 2/3 mu div U,
// and so on.
[[gnu::always_inline]] inline void write_stress(const TurbulenceRow& row, const Gradient& u,
                                                const Gradient& v, const Gradient& w, double mu,
                                                double divergence, std::ptrdiff_t i) {
  const double trace = (2.0 / 3) * mu * divergence;
  const StressView<double>& t = row.stress;
  const std::ptrdiff_t j = i + t.component, k = i + 2 * t.component;
  row.mu_new[i] = mu;
  t.x[i] = mu * u.x - trace;
  t.x[j] = mu * u.y;
  t.x[k] = mu * u.z;
  t.y[i] = mu * v.x;
  t.y[j] = mu * v.y - trace;
  t.y[k] = mu * v.z;
  t.z[i] = mu * w.x;
  t.z[j] = mu * w.y;
  t.z[k] = mu * w.z - trace;
}

template <bool with_wall, bool in_time>
[[gnu::always_inline]] inline TurbulenceSums turbulence(TurbulenceRow row) {
  const RowMetrics& m = row.m;
  const double inverse_alpha = 1 / row.relaxation;
  const CellSums sums = sum_cells<in_time>(m.n, [&](int i) RIPSTOP_CELL {
    Gradient u = gradient(m, row.velocity.x, i), v = gradient(m, row.velocity.y, i),
             w = gradient(m, row.velocity.z, i);
    const double divergence = u.x + v.y + w.z, strain = strain_rate(u, v, w, divergence);
    Gradient of_k = gradient(m, row.k.here, i), of_omega = gradient(m, row.omega.here, i);
    const double cross = (2 * sigma_omega) * row.rho[i] *
                         (of_k.x * of_omega.x + of_k.y * of_omega.y + of_k.z * of_omega.z) *
                         (1 / row.omega.here[i]);

    Faces c = convection(row, i), d = diffusion(m, i);
    Faces eddy = on_faces(m, row.mut, i);
    Faces a_omega = coefficients(c, d, eddy, sigma_omega, row.viscosity);
    Update omega = omega_update<in_time>(row, a_omega, strain, cross, inverse_alpha, i);
    Faces a_k = coefficients(c, d, eddy, sigma_k, row.viscosity);
    Update k = k_update<in_time>(row, a_k, strain, omega.value, inverse_alpha, i);
    row.omega_new[i] = omega.value;
    row.k_new[i] = k.value;

    double limit = 1;
    if constexpr (with_wall) {
      limit = shear_stress_limit(strain, k.value, omega.value, row.rho[i], row.viscosity, row.wall[i]);
      row.limit_new[i] = limit;
    }
    if constexpr (in_time) {  // the stress that acts in this step
      write_stress(row, u, v, w, row.viscosity + row.mut.here[i], 0, i);
      return CellSums{};
    } else {
      const double mu = row.viscosity + row.rho[i] * k.value / omega.value * limit;
      write_stress(row, u, v, w, mu, divergence, i);
      const double h = m.x_width[i];
      return CellSums{k.residual, k.scale, omega.residual, omega.scale, k.value * h, omega.value * h};
    }
  });
  return {{sums.a, sums.b}, {sums.c, sums.d}, sums.e, sums.f};
}

RIPSTOP_ROW_KERNEL TurbulenceSums open_row(const TurbulenceRow& row) {
  return turbulence<false, false>(row);
}
RIPSTOP_ROW_KERNEL TurbulenceSums wall_row(const TurbulenceRow& row) {
  return turbulence<true, false>(row);
}
RIPSTOP_ROW_KERNEL TurbulenceSums open_row_in_time(const TurbulenceRow& row) {
  return turbulence<false, true>(row);
}
RIPSTOP_ROW_KERNEL TurbulenceSums wall_row_in_time(const TurbulenceRow& row) {
  return turbulence<true, true>(row);
}

}  // namespace

TurbulenceSums turbulence_row(const TurbulenceRow& row) {
  if (row.inverse_step > 0) return row.wall ? wall_row_in_time(row) : open_row_in_time(row);
  return row.wall ? wall_row(row) : open_row(row);
}

}  // namespace ripstop::inline flow::cartesian
