// First march of an iteration: turbulence, momentum, right-hand side of the pressure, plane by plane from the
// inlet to the outlet, so that each plane sees the new values of the plane before it. Every stage runs a fixed
// number of planes behind the one it needs, and one barrier a plane keeps the threads, which share the rows of
// every plane, together. Inside a plane neighbours are old values: the answer does not depend on the threads.
#include <algorithm>

#include "ripstop/flow/cartesian/solver.h"

namespace ripstop::cartesian {
namespace {

constexpr int mod(int k, int n) {
  return (k + n) % n;
}

}  // namespace

RowMetrics Solver::metrics(int j, int k) const {
  RowMetrics m;
  m.n = grid_.nx;
  m.sy = layout_.stride_y;
  m.sz = layout_.stride_z;
  m.x_inverse_width = x_.inverse_width.data();
  m.x_weight_low = x_.weight_low.data();
  m.x_inverse_distance = x_.inverse_distance.data();
  m.x_slope_low = x_.slope_low.data();
  m.x_slope_high = x_.slope_high.data();
  m.y = cross_metrics(y_, j);
  m.z = cross_metrics(z_, k);
  return m;
}

void Solver::march(int rank) {
  const Range rows = part_of(grid_.ny, rank, team_.size());
  const int nz = grid_.nz;
  eddy_viscosity(0, rows);
  team_.barrier();
  for (int s = 0; s < nz + 3; ++s) {
    if (s >= 1 && s - 1 < nz) commit_turbulence(s - 1, rows);
    if (s + 1 < nz) eddy_viscosity(s + 1, rows);
    if (s < nz) turbulence(s, rows);
    if (s >= 1 && s - 1 < nz) momentum(s - 1, rows);
    if (s >= 2 && s - 2 < nz) commit_momentum(s - 2, rows);
    if (s >= 3) pressure(s - 3, rows);
    team_.barrier();
  }
}

void Solver::eddy_viscosity(int k, Range rows) {
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k);
    const double *kk = &f_.k[at], *om = &f_.omega[at], *rho = &f_.rho[at];
    double* out = &ring_.mut[mod(k, 3)][layout_.in_plane(0, j)];
    for (int i = 0; i < grid_.nx; ++i) out[i] = rho[i] * kk[i] / om[i];
  }
}

void Solver::turbulence(int k, Range rows) {
  const bool first = k == 0, last = k == grid_.nz - 1;
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k), in = layout_.in_plane(0, j), sz = layout_.stride_z;
    TurbulenceRow r;
    r.m = metrics(j, k);
    r.viscosity = air_.viscosity;
    r.relaxation = settings_.relax_turbulence;
    r.mean_k = total_.value[Sums::k_mean];
    r.mean_omega = total_.value[Sums::omega_mean];
    r.u = &f_.u[at], r.v = &f_.v[at], r.w = &f_.w[at];
    r.k = &f_.k[at], r.omega = &f_.omega[at], r.rho = &f_.rho[at];
    r.k_below = first ? &ring_.inlet_k[in] : r.k - sz;
    r.k_above = last ? &ring_.inlet_k[in] : r.k + sz;
    r.omega_below = first ? &ring_.inlet_omega[in] : r.omega - sz;
    r.omega_above = last ? &ring_.inlet_omega[in] : r.omega + sz;
    r.fx = &f_.fx[at], r.fy = &f_.fy[at], r.fz = &f_.fz[at];
    r.mut = &ring_.mut[mod(k, 3)][in];
    r.mut_above = &ring_.mut[mod(last ? k : k + 1, 3)][in];
    // At the inlet the face takes the inlet's eddy viscosity; the ratio of the boundary values is exact there.
    double* below = &ring_.mut[mod(k - 1, 3)][in];
    if (first) {
      for (int i = 0; i < grid_.nx; ++i) below[i] = 2 * r.rho[i] * inlet_k_ / inlet_omega_ - r.mut[i];
    }
    r.mut_below = below;
    r.k_new = &ring_.k[mod(k, 2)][in];
    r.omega_new = &ring_.omega[mod(k, 2)][in];
    r.mu_new = &ring_.mu[mod(k, 4)][in];
    r.tx = &ring_.tx[mod(k, 2)][in];
    r.ty = &ring_.ty[mod(k, 2)][in];
    r.tz = &ring_.tz[mod(k, 3)][in];
    r.component = static_cast<std::ptrdiff_t>(plane_);
    turbulence_row(r);
    // Beyond the sides the explicit stress is that of the last cell.
    for (int c = 0; c < 3; ++c) {
      double *tx = r.tx + c * r.component, *ty = r.ty + c * r.component;
      tx[-1] = tx[0];
      tx[grid_.nx] = tx[grid_.nx - 1];
      if (j == 0) std::copy_n(ty, grid_.nx, ty - layout_.stride_y);
      if (j == grid_.ny - 1) std::copy_n(ty, grid_.nx, ty + layout_.stride_y);
    }
    double* sums = row_sums(j, k).value;
    sums[Sums::k_residual] = r.k_sum.residual, sums[Sums::k_scale] = r.k_sum.scale;
    sums[Sums::omega_residual] = r.omega_sum.residual, sums[Sums::omega_scale] = r.omega_sum.scale;
    sums[Sums::k_mean] = r.total_k * y_.width[j] * z_.width[k];
    sums[Sums::omega_mean] = r.total_omega * y_.width[j] * z_.width[k];
  }
}

namespace {

// Copies a row into a field and its side ghosts; `side` and `cross` are the factors of the ghosts in x and y.
void place_row(const double* from, double* to, int n, std::ptrdiff_t stride_y, bool low, bool high, double side,
               double cross) {
  std::copy_n(from, n, to);
  to[-1] = side * to[0];
  to[n] = side * to[n - 1];
  if (low) {
    for (int i = -1; i <= n; ++i) to[i - stride_y] = cross * to[i];
  }
  if (high) {
    for (int i = -1; i <= n; ++i) to[i + stride_y] = cross * to[i];
  }
}

}  // namespace

void Solver::commit_turbulence(int k, Range rows) {
  const bool first = k == 0, last = k == grid_.nz - 1;
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k), in = layout_.in_plane(0, j), sz = layout_.stride_z;
    const bool low = j == 0, high = j == grid_.ny - 1;
    double *kk = &f_.k[at], *om = &f_.omega[at];
    const double* fz_out = &f_.fz[at + sz];
    place_row(&ring_.k[mod(k, 2)][in], kk, grid_.nx, layout_.stride_y, low, high, 1, 1);
    place_row(&ring_.omega[mod(k, 2)][in], om, grid_.nx, layout_.stride_y, low, high, 1, 1);
    for (int i = 0; first && i < grid_.nx; ++i) {
      kk[i - sz] = 2 * inlet_k_ - kk[i];
      om[i - sz] = 2 * inlet_omega_ - om[i];
    }
    for (int i = 0; last && i < grid_.nx; ++i) {
      kk[i + sz] = fz_out[i] >= 0 ? kk[i] : 2 * inlet_k_ - kk[i];
      om[i + sz] = fz_out[i] >= 0 ? om[i] : 2 * inlet_omega_ - om[i];
    }
  }
}

void Solver::momentum(int k, Range rows) {
  const bool first = k == 0, last = k == grid_.nz - 1;
  const std::ptrdiff_t component = static_cast<std::ptrdiff_t>(plane_);
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k), in = layout_.in_plane(0, j), sz = layout_.stride_z;
    MomentumRow r;
    r.m = metrics(j, k);
    r.relaxation = settings_.relax_velocity;
    r.mean_u = total_.value[Sums::u_mean];
    r.mean_v = total_.value[Sums::v_mean];
    r.mean_w = total_.value[Sums::w_mean];
    r.u = &f_.u[at], r.v = &f_.v[at], r.w = &f_.w[at];
    r.p = &f_.p[at], r.rho = &f_.rho[at];
    const double* predicted = &ring_.predicted[mod(k - 1, 2)][in];
    r.u_below = first ? &ring_.zeros[in] : predicted;
    r.v_below = first ? &ring_.zeros[in] : predicted + component;
    r.w_below = first ? &ring_.inlet_w[in] : predicted + 2 * component;
    r.u_above = last ? &ring_.zeros[in] : r.u + sz;
    r.v_above = last ? &ring_.zeros[in] : r.v + sz;
    r.w_above = last ? &ring_.zeros[in] : r.w + sz;
    r.fx = &f_.fx[at], r.fy = &f_.fy[at], r.fz = &f_.fz[at];
    r.mu = &ring_.mu[mod(k, 4)][in];
    r.mu_above = &ring_.mu[mod(last ? k : k + 1, 4)][in];
    double* below = &ring_.mu[mod(k - 1, 4)][in];
    if (first) {
      const double* rho = &f_.rho[at];
      for (int i = 0; i < grid_.nx; ++i) {
        below[i] = 2 * (air_.viscosity + rho[i] * inlet_k_ / inlet_omega_) - r.mu[i];
      }
    }
    r.mu_below = below;
    r.tx = &ring_.tx[mod(k, 2)][in];
    r.ty = &ring_.ty[mod(k, 2)][in];
    r.tz = &ring_.tz[mod(k, 3)][in];
    r.tz_below = first ? r.tz : &ring_.tz[mod(k - 1, 3)][in];
    r.tz_above = last ? r.tz : &ring_.tz[mod(k + 1, 3)][in];
    r.component = component;
    r.linear = porous_.linear(j, k);
    r.quadratic = porous_.quadratic(j, k);
    double* h = &ring_.h[mod(k, 2)][in];
    r.hu = h, r.hv = h + component, r.hw = h + 2 * component;
    r.ra = &f_.ra[at];
    double* next = &ring_.predicted[mod(k, 2)][in];
    r.u_new = next, r.v_new = next + component, r.w_new = next + 2 * component;
    momentum_row(r);
    double* sums = row_sums(j, k).value;
    sums[Sums::u_residual] = r.u_sum.residual, sums[Sums::u_scale] = r.u_sum.scale;
    sums[Sums::v_residual] = r.v_sum.residual, sums[Sums::v_scale] = r.v_sum.scale;
    sums[Sums::w_residual] = r.w_sum.residual, sums[Sums::w_scale] = r.w_sum.scale;
  }
}

void Solver::commit_momentum(int k, Range rows) {
  const std::ptrdiff_t component = static_cast<std::ptrdiff_t>(plane_), sy = layout_.stride_y;
  const double wall = duct_ ? -1 : 1;  // the normal component mirrors at a slip wall
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k);
    const double* h = &ring_.h[mod(k, 2)][layout_.in_plane(0, j)];
    const bool low = j == 0, high = j == grid_.ny - 1;
    place_row(h, &f_.u[at], grid_.nx, sy, low, high, wall, 1);
    place_row(h + component, &f_.v[at], grid_.nx, sy, low, high, 1, wall);
    place_row(h + 2 * component, &f_.w[at], grid_.nx, sy, low, high, 1, 1);
  }
}

void Solver::pressure(int k, Range rows) {
  MultigridLevel& top = multigrid_.finest();
  const bool last = k == grid_.nz - 1;
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k), sz = layout_.stride_z;
    PressureRow r;
    r.m = metrics(j, k);
    r.m.z = cross_metrics(zp_, k);
    r.x_width = x_.width.data();
    r.y_width = y_.width[j];
    r.z_width = z_.width[k];
    r.hu = &f_.u[at], r.hv = &f_.v[at], r.hw = &f_.w[at];
    r.ra = &f_.ra[at], r.rho = &f_.rho[at], r.p = &f_.p[at];
    r.hw_above = r.hw + sz, r.ra_above = r.ra + sz, r.rho_above = r.rho + sz;
    r.p_above = last ? &ring_.zeros[layout_.in_plane(0, j)] : r.p + sz;
    r.inlet = k == 0;
    r.inlet_speed = air_.speed;
    r.outlet = last;
    r.mean_p = total_.value[Sums::p_mean];
    r.cx = &top.cx[at], r.cy = &top.cy[at], r.cz = &top.cz[at], r.cz_above = &top.cz[at + sz];
    r.rhs = &top.rhs[at];
    pressure_row(r);
    double* sums = row_sums(j, k).value;
    sums[Sums::p_residual] = r.sum.residual, sums[Sums::p_scale] = r.sum.scale;
    sums[Sums::imbalance] = r.imbalance;
  }
}

}  // namespace ripstop::cartesian
