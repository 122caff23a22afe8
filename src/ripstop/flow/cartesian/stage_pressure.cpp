// Second half of an iteration: the pressure equation and the corrections that follow. The planes are shared
// among the threads; between the stages all threads synchronise.
#include <algorithm>
#include <cmath>

#include "ripstop/flow/cartesian/solver.h"

namespace ripstop::cartesian {

void Solver::matrix_ghosts(int k) {
  const double mirror = b_.sides->mirror();
  side_ghosts(d_, t_.hu, k, mirror, 1), side_ghosts(d_, t_.hv, k, 1, mirror);
  if (!uniform()) side_ghosts(d_, t_.ra, k, 1, 1), side_ghosts(d_, t_.rc, k, 1, 1);
  if (!b_.open() || k > 0) return;
  for (Array<double>* q : {&t_.hw, &t_.ra, &t_.rc}) {  // of the low end; the high one has rows of its own
    for (int j = 0; j < d_.grid.ny; ++j) {
      double* row = &(*q)[d_.layout.at(0, j, 0)];
      std::copy_n(row, d_.grid.nx, row - d_.layout.stride_z);
    }
  }
}

void Solver::pressure(int k, IndexRange rows) {
  MultigridLevel& top = multigrid_.finest();
  const bool last = k == d_.grid.nz - 1, inlet = k == 0 && !b_.open();
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = d_.layout.at(0, j, k), sz = d_.layout.stride_z;
    PressureRow r;
    r.m = d_.pressure_metrics(j, k);
    r.y_width = d_.y.width[j];
    r.z_width = d_.z.width[k];
    r.hu = &t_.hu[at], r.hv = &t_.hv[at], r.hw = &t_.hw[at];
    r.ra = &t_.ra[at], r.rc = &t_.rc[at], r.rho = &s_.f.rho[at], r.p = &s_.f.p[at];
    r.uniform = uniform();
    r.hw_above = r.hw + sz, r.ra_above = r.ra + sz, r.rc_above = r.rc + sz, r.rho_above = r.rho + sz;
    r.p_above = last ? &s_.outlet_p[d_.layout.in_plane(0, j)] : r.p + sz;
    r.inlet = inlet;
    r.inlet_speed = inlet ? b_.inlet.speed(j) : &t_.zeros[Layout::lead];
    r.outlet = last;
    r.mean_p = s_.mean.p;
    r.fx = &s_.f.fx[at], r.fy = &s_.f.fy[at], r.fz = &s_.f.fz[at];
    r.held = jumps(j, k, s_.held);
    r.excess = jumps(j, k, in_the_way_.sheets.excess());
    r.stiffness = jumps(j, k, in_the_way_.sheets.stiffness());
    r.cx = &top.cx[at], r.cy = &top.cy[at], r.cz = &top.cz[at], r.cz_above = &top.cz[at + sz];
    r.rhs = &top.rhs[at];
    pressure_row(r);
    b_.sides->conductances(d_, s_.f, t_.rc, j, k, top);
    double* sums = t_.sums.row(j, k);
    sums[Sums::p_residual] = r.sum.residual, sums[Sums::p_scale] = r.sum.scale;
  }
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

/// Where the changes of the jumps on a row of faces go; null where there are none.
double* Solver::changes(int axis, int j, int k) {
  const std::size_t at = in_the_way_.sheets.offset(axis, j, k);
  return at == 0 ? nullptr : s_.change.data() + at;
}

// Face fluxes with the whole correction, before the pressure is relaxed.
void Solver::flux(int k, IndexRange rows) {
  const MultigridLevel& top = multigrid_.finest();
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = d_.layout.at(0, j, k), sy = d_.layout.stride_y, sz = d_.layout.stride_z;
    FluxRow r;
    r.m = d_.pressure_metrics(j, k);
    r.hu = &t_.hu[at], r.hv = &t_.hv[at], r.hw = &t_.hw[at];
    r.ra = &t_.ra[at], r.rc = &t_.rc[at], r.rho = &s_.f.rho[at], r.p = &s_.f.p[at], r.dp = &top.e[at];
    r.uniform = uniform();
    r.inlet_speed = k == 0 && !b_.open() ? b_.inlet.speed(j) : nullptr;
    r.fx = &s_.f.fx[at], r.fy = &s_.f.fy[at], r.fz = &s_.f.fz[at];
    r.held = jumps(j, k, s_.held);
    r.excess = jumps(j, k, in_the_way_.sheets.excess());
    r.stiffness = jumps(j, k, in_the_way_.sheets.stiffness());
    r.change_x = changes(0, j, k), r.change_y = changes(1, j, k), r.change_z = changes(2, j, k);
    flux_row(r);
    if (j == d_.grid.ny - 1) {  // the far side
      // Ghosts that mirror the velocity across the side leave none in it.
      const double passes = 0.5 * (1 + b_.sides->mirror());
      const double rd = d_.yp.inverse_distance[d_.grid.ny];
      for (int i = 0; i < d_.grid.nx; ++i) {
        const double more = static_cast<double>(r.dp[i + sy]) - static_cast<double>(r.dp[i]);
        const double drop = rd * (r.ra[i] * (r.p[i + sy] - r.p[i]) + r.rc[i] * more);
        r.fy[i + sy] = passes * r.rho[i] * (r.hv[i] - drop);
      }
    }
    if (k == d_.grid.nz - 1) {
      const double* outlet = &s_.outlet_p[d_.layout.in_plane(0, j)];
      OutletRow out{
          d_.grid.nx, d_.zp.inverse_distance[d_.grid.nz], r.hw, r.ra, r.rc, r.rho, r.p, outlet, r.dp,
          r.fz + sz};
      outlet_flux_row(out);
    }
  }
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

void Solver::velocity(int k, IndexRange rows) {
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = d_.layout.at(0, j, k);
    VelocityRow r;
    r.m = d_.metrics(j, k);
    r.gas_constant = gas_constant_of_air;
    r.pressure0 = d_.air.density * gas_constant_of_air * d_.air.temperature;
    r.temperature = d_.air.temperature;
    r.speed2 = d_.air.speed() * d_.air.speed();
    r.half_cp = 0.5 / heat_capacity;
    r.ra = &t_.ra[at], r.rc = &t_.rc[at], r.p = &s_.f.p[at], r.dp = &multigrid_.finest().e[at];
    r.held = jumps(j, k, s_.held);
    r.change = jumps(j, k, s_.change);
    r.relaxation = pressure_share();
    r.hu = &t_.hu[at], r.hv = &t_.hv[at], r.hw = &t_.hw[at];
    r.u = &s_.f.u[at], r.v = &s_.f.v[at], r.w = &s_.f.w[at];
    if (d_.settings.compressible && !t_.in_time) r.rho = &s_.f.rho[at];
    velocity_row(r);
    double* sums = t_.sums.row(j, k);
    const double area = d_.y.width[j] * d_.z.width[k];
    sums[Sums::u_mean] = r.total_u * area;
    sums[Sums::v_mean] = r.total_v * area;
    sums[Sums::w_mean] = r.total_w * area;
    sums[Sums::p_mean] = r.total_p * area;
    const Vec3 force = porous_force_of_row(j, k);
    sums[Sums::drag_x] = force.x, sums[Sums::drag_y] = force.y, sums[Sums::drag_z] = force.z;
  }
}

Vec3 Solver::porous_force_of_row(int j, int k) const {
  Vec3 force;
  if (in_the_way_.porous.empty(j, k)) return force;
  const std::ptrdiff_t at = d_.layout.at(0, j, k);
  const double *a = in_the_way_.porous.linear(j, k), *b = in_the_way_.porous.quadratic(j, k);
  for (int i = 0; i < d_.grid.nx; ++i) {
    const Vec3 velocity{s_.f.u[at + i], s_.f.v[at + i], s_.f.w[at + i]};
    force += (d_.x.width[i] * (a[i] + s_.f.rho[at + i] * norm(velocity) * b[i])) * velocity;
  }
  return (d_.y.width[j] * d_.z.width[k]) * force;
}

}  // namespace ripstop::cartesian
