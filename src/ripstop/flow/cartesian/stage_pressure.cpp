// Second half of an iteration: the pressure equation and the corrections that follow. The planes are shared
// among the threads; between the stages all threads synchronise.
#include <algorithm>
#include <cmath>

#include "ripstop/flow/cartesian/solver.h"

namespace ripstop::inline flow::cartesian {

void Solver::matrix_ghosts(int k) {
  const double mirror = b_.sides->mirror();
  side_ghosts(d_, t_.hu, k, 0, mirror), side_ghosts(d_, t_.hv, k, 1, mirror);
  if (!uniform()) side_ghosts(d_, t_.ra, k), side_ghosts(d_, t_.rc, k);
  if (!b_.open() || k > 0) return;
  for (Array<double>* q : {&t_.hw, &t_.ra, &t_.rc}) {  // of the low end; the high one has rows of its own
    for (int j = 0; j < d_.grid.ny; ++j) {
      double* row = &(*q)[d_.layout.at(0, j, 0)];
      std::copy_n(row, d_.grid.nx, row - d_.layout.stride_z);
    }
  }
}

void Solver::pressure(int j, int k) {
  MultigridLevel& top = multigrid_.finest();
  const bool last = k == d_.grid.nz - 1, inlet = k == 0 && !b_.open();
  const std::ptrdiff_t at = d_.layout.at(0, j, k);
  PressureRow r;
  r.m = d_.pressure_metrics(j, k);
  r.y_width = d_.y.width[j];
  r.z_width = d_.z.width[k];
  r.matrix = t_.matrix(at);
  r.rho = &s_.f.rho[at], r.p = &s_.f.p[at];
  r.uniform = uniform();
  r.p_above = last ? &s_.outlet_p[d_.layout.in_plane(0, j)] : r.p + d_.layout.stride_z;
  r.inlet = inlet;
  r.inlet_speed = inlet ? b_.inlet.speed(j) : &t_.zeros[Layout::lead];
  r.outlet = last;
  r.mean_p = s_.mean.p;
  r.flux = s_.f.flux(at);
  r.sheet = sheet(j, k);
  r.conductance = {&top.cx[at], &top.cy[at], &top.cz[at]};
  r.rhs = &top.rhs[at];
  const ResidualSum sum = pressure_row(r);
  b_.sides->conductances(d_, s_.f, t_.rc, j, k, top);
  double* sums = t_.sums.row(j, k);
  sums[Sums::p_residual] = sum.residual, sums[Sums::p_scale] = sum.scale;
}

// Fills the multigrid's correction.
void Solver::correct(int rank) {
  // No flow around the sheet, so that coarse levels are halved; or a stream that has just met a sheet, before its
  // pressure has developed: the residual of a rough solution would disturb the flow.
  if (in_the_way_.sheets.shut() || s_.eased > 0) {
    multigrid_.solve_conjugate(team_, rank, 0.05, 20);
  } else if (!d_.grid.uniform()) {  // long thin cells, which a cycle alone does not smooth
    multigrid_.solve_conjugate(team_, rank, 0.2, 2 * d_.settings.pressure_cycles);
  } else {
    multigrid_.solve(team_, rank, d_.settings.pressure_cycles);
  }
}

/// Where the changes of the jumps on the low faces of a row go; null where there are none.
VectorView<double> Solver::changes(int j, int k) {
  const auto along = [&](int axis) {
    const std::size_t at = in_the_way_.sheets.offset(axis, j, k);
    return at == 0 ? nullptr : s_.change.data() + at;
  };
  return {along(0), along(1), along(2)};
}

// Face fluxes with the whole correction, before the pressure is relaxed.
void Solver::flux(int j, int k) {
  const std::ptrdiff_t at = d_.layout.at(0, j, k), sy = d_.layout.stride_y;
  FluxRow r;
  r.m = d_.pressure_metrics(j, k);
  r.matrix = t_.matrix(at);
  r.rho = &s_.f.rho[at], r.p = &s_.f.p[at], r.dp = &multigrid_.finest().e[at];
  r.uniform = uniform();
  r.inlet_speed = k == 0 && !b_.open() ? b_.inlet.speed(j) : nullptr;
  r.flux = s_.f.flux(at);
  r.sheet = sheet(j, k);
  r.change = changes(j, k);
  flux_row(r);
  if (j == d_.grid.ny - 1) {  // the far side
    // Ghosts that mirror the velocity across the side leave none in it.
    const double passes = 0.5 * (1 + b_.sides->mirror());
    const double rd = d_.yp.inverse_distance[d_.grid.ny];
    for (int i = 0; i < d_.grid.nx; ++i) {
      const double more = static_cast<double>(r.dp[i + sy]) - static_cast<double>(r.dp[i]);
      const double drop = rd * (r.matrix.ra[i] * (r.p[i + sy] - r.p[i]) + r.matrix.rc[i] * more);
      r.flux.y[i + sy] = passes * r.rho[i] * (r.matrix.h.y[i] - drop);
    }
  }
  if (k == d_.grid.nz - 1)
    outlet_flux_row(r, d_.zp.inverse_distance[d_.grid.nz], &s_.outlet_p[d_.layout.in_plane(0, j)]);
}

void Solver::relax_pressure(int k) {
  const MultigridLevel& top = multigrid_.finest();
  const double share = pressure_share();
  for (int j = 0; j < d_.grid.ny; ++j) {
    const std::ptrdiff_t at = d_.layout.at(0, j, k);
    double* p = &s_.f.p[at];
    const float* dp = &top.e[at];
    for (int i = 0; i < d_.grid.nx; ++i) p[i] += share * static_cast<double>(dp[i]);
  }
  pressure_ghosts(d_, b_, s_, k);
}

void Solver::velocity(int j, int k) {
  const std::ptrdiff_t at = d_.layout.at(0, j, k);
  VelocityRow r;
  r.m = d_.metrics(j, k);
  r.gas = {gas_constant_of_air, d_.air.density * gas_constant_of_air * d_.air.temperature, d_.air.temperature,
           d_.air.speed() * d_.air.speed(), 0.5 / heat_capacity};
  r.matrix = t_.matrix(at);
  r.p = &s_.f.p[at], r.dp = &multigrid_.finest().e[at];
  r.held = on_faces(j, k, s_.held);
  r.change = on_faces(j, k, s_.change);
  r.relaxation = pressure_share();
  r.velocity = s_.f.velocity(at);
  if (d_.settings.compressible && !t_.in_time) r.rho = &s_.f.rho[at];
  const VelocitySums sum = velocity_row(r);
  double* sums = t_.sums.row(j, k);
  const double area = d_.y.width[j] * d_.z.width[k];
  sums[Sums::u_mean] = sum.u * area;
  sums[Sums::v_mean] = sum.v * area;
  sums[Sums::w_mean] = sum.w * area;
  sums[Sums::p_mean] = sum.p * area;
  const Vec3 force = porous_force_of_row(j, k);
  sums[Sums::drag_x] = force.x, sums[Sums::drag_y] = force.y, sums[Sums::drag_z] = force.z;
}

Vec3 Solver::porous_force_of_row(int j, int k) const {
  Vec3 force;
  if (in_the_way_.porous.empty(j, k)) return force;
  const std::ptrdiff_t at = d_.layout.at(0, j, k);
  const ResistanceView of = in_the_way_.porous.at(j, k);
  for (int i = 0; i < d_.grid.nx; ++i) {
    const Vec3 velocity{s_.f.u[at + i], s_.f.v[at + i], s_.f.w[at + i]};
    force +=
        (d_.x.width[i] * (of.linear[i] + s_.f.rho[at + i] * norm(velocity) * of.quadratic[i])) * velocity;
  }
  return (d_.y.width[j] * d_.z.width[k]) * force;
}

}  // namespace ripstop::inline flow::cartesian
