// Second march of an iteration, after the pressure correction is known: face fluxes with the full correction,
// then the relaxed pressure, then velocity and density from it.
#include <cmath>

#include "ripstop/flow/cartesian/solver.h"

namespace ripstop::cartesian {

void Solver::correct(int rank) {
  const Range rows = part_of(grid_.ny, rank, team_.size());
  const int nz = grid_.nz;
  for (int s = 0; s < nz + 3; ++s) {
    if (s < nz) flux(s, rows);
    if (s >= 2 && s - 2 < nz) relax_pressure(s - 2, rows);
    if (s >= 3) velocity(s - 3, rows);
    team_.barrier();
  }
}

void Solver::flux(int k, Range rows) {
  const MultigridLevel& top = multigrid_.finest();
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k), sy = layout_.stride_y, sz = layout_.stride_z;
    FluxRow r;
    r.m = metrics(j, k);
    r.m.z = cross_metrics(zp_, k);
    r.hu = &f_.u[at], r.hv = &f_.v[at], r.hw = &f_.w[at];
    r.ra = &f_.ra[at], r.rho = &f_.rho[at], r.p = &f_.p[at], r.dp = &top.e[at];
    r.inlet = k == 0;
    r.inlet_speed = air_.speed;
    r.fx = &f_.fx[at], r.fy = &f_.fy[at], r.fz = &f_.fz[at];
    flux_row(r);
    if (j == grid_.ny - 1) {  // the far side: zero gradient, closed in a duct
      for (int i = 0; i < grid_.nx; ++i) r.fy[i + sy] = duct_ ? 0 : r.rho[i] * r.hv[i];
    }
    if (k == grid_.nz - 1) {
      OutletRow out{grid_.nx, zp_.inverse_distance[grid_.nz], r.hw, r.ra, r.rho, r.p, r.dp, r.fz + sz};
      outlet_flux_row(out);
    }
  }
}

void Solver::relax_pressure(int k, Range rows) {
  const MultigridLevel& top = multigrid_.finest();
  const std::ptrdiff_t sy = layout_.stride_y, sz = layout_.stride_z;
  const int nx = grid_.nx;
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k);
    double* p = &f_.p[at];
    const float* dp = &top.e[at];
    for (int i = 0; i < nx; ++i) p[i] += settings_.relax_pressure * static_cast<double>(dp[i]);
    p[-1] = p[0];
    p[nx] = p[nx - 1];
    if (j == 0) std::copy_n(p, nx, p - sy);
    if (j == grid_.ny - 1) std::copy_n(p, nx, p + sy);
    if (k == 0) std::copy_n(p, nx, p - sz);
    if (k == grid_.nz - 1) {
      for (int i = 0; i < nx; ++i) p[i + sz] = -p[i];
    }
  }
}

void Solver::velocity(int k, Range rows) {
  const std::ptrdiff_t sy = layout_.stride_y, sz = layout_.stride_z;
  const int nx = grid_.nx;
  const double wall = duct_ ? -1 : 1;
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k);
    VelocityRow r;
    r.m = metrics(j, k);
    r.gas_constant = settings_.compressible ? gas_constant_ : 0;
    r.pressure0 = pressure0_;
    r.temperature = air_.temperature;
    r.speed2 = air_.speed * air_.speed;
    r.half_cp = 0.5 / heat_capacity;
    r.ra = &f_.ra[at], r.p = &f_.p[at];
    r.u = &f_.u[at], r.v = &f_.v[at], r.w = &f_.w[at], r.rho = &f_.rho[at];
    r.x_width = x_.width.data();
    velocity_row(r);

    const auto ghosts = [&](double* q, double side, double cross) {
      q[-1] = side * q[0];
      q[nx] = side * q[nx - 1];
      for (int i = -1; j == 0 && i <= nx; ++i) q[i - sy] = cross * q[i];
      for (int i = -1; j == grid_.ny - 1 && i <= nx; ++i) q[i + sy] = cross * q[i];
    };
    ghosts(r.u, wall, 1);
    ghosts(r.v, 1, wall);
    ghosts(r.w, 1, 1);
    ghosts(r.rho, 1, 1);
    if (k == 0) {
      for (int i = 0; i < nx; ++i) {
        r.u[i - sz] = -r.u[i], r.v[i - sz] = -r.v[i], r.w[i - sz] = 2 * air_.speed - r.w[i];
        r.rho[i - sz] = r.rho[i];
      }
    }
    if (k == grid_.nz - 1) {  // zero gradient where air leaves, zero velocity where it would come back
      const double* fz = &f_.fz[at + sz];
      for (int i = 0; i < nx; ++i) {
        const double sign = fz[i] >= 0 ? 1 : -1;
        r.u[i + sz] = sign * r.u[i], r.v[i + sz] = sign * r.v[i], r.w[i + sz] = sign * r.w[i];
        r.rho[i + sz] = r.rho[i];
      }
    }
    double* sums = row_sums(j, k).value;
    const double area = y_.width[j] * z_.width[k];
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
  if (porous_.empty(j, k)) return force;
  const std::ptrdiff_t at = layout_.at(0, j, k);
  const double *a = porous_.linear(j, k), *b = porous_.quadratic(j, k);
  for (int i = 0; i < grid_.nx; ++i) {
    const Vec3 velocity{f_.u[at + i], f_.v[at + i], f_.w[at + i]};
    force += (x_.width[i] * (a[i] + f_.rho[at + i] * norm(velocity) * b[i])) * velocity;
  }
  return (y_.width[j] * z_.width[k]) * force;
}

}  // namespace ripstop::cartesian
