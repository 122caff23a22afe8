// Second half of an iteration: the pressure equation and what follows from it. The planes are shared among
// the threads; between the stages all of them meet.
#include <algorithm>
#include <cmath>

#include "ripstop/flow/cartesian/solver.h"

namespace ripstop::cartesian {
namespace {

constexpr int none = -1;  // no axis

}  // namespace

// Ghosts of one plane: beyond the sides a factor of the last cell, 1 or, at a slip wall, -1.
void Solver::side_ghosts(Array<double>& field, int k, double across_x, double across_y) const {
  const int nx = grid_.nx, ny = grid_.ny;
  for (int j = 0; j < ny; ++j) {
    double* q = &field[layout_.at(0, j, k)];
    q[-1] = across_x * q[0];
    q[nx] = across_x * q[nx - 1];
  }
  const double *low = &field[layout_.at(-1, 0, k)], *high = &field[layout_.at(-1, ny - 1, k)];
  double *below = &field[layout_.at(-1, -1, k)], *above = &field[layout_.at(-1, ny, k)];
  for (int i = 0; i < nx + 2; ++i) below[i] = across_y * low[i];
  for (int i = 0; i < nx + 2; ++i) above[i] = across_y * high[i];
}

/// Faces of plane k in the sides: the axis across the face, ghost, cell, mass flux into the box.
template <class Visit>
void Solver::each_side_face(int k, Visit&& visit) const {
  const std::ptrdiff_t sy = layout_.stride_y;
  for (int j = 0; j < grid_.ny; ++j) {
    const std::ptrdiff_t low = layout_.at(0, j, k), high = layout_.at(grid_.nx - 1, j, k);
    visit(0, low - 1, low, f_.fx[low]);
    visit(0, high + 1, high, -f_.fx[high + 1]);
  }
  for (int i = 0; i < grid_.nx; ++i) {
    const std::ptrdiff_t low = layout_.at(i, 0, k), high = layout_.at(i, grid_.ny - 1, k);
    visit(1, low - sy, low, f_.fy[low]);
    visit(1, high + sy, high, -f_.fy[high + sy]);
  }
}

// Air that comes in through an entraining side brings the stream's values; none across the faces of axis
// `normal`.
void Solver::entrain(Array<double>& field, int k, int normal, double stream) const {
  if (!entraining()) return;
  each_side_face(k, [&](int axis, std::ptrdiff_t ghost, std::ptrdiff_t, double inflow) {
    if (axis != normal && inflow > 0) field[ghost] = stream;
  });
}

// Ghosts beyond the inlet hold 2 q_inlet - q; those beyond the outlet q where air leaves, 2 q_back - q where
// it would come back. An outlet that draws in air at its total pressure has no gradient there either.
void Solver::end_ghosts(Array<double>& field, int k, double inlet, double back) const {
  const std::ptrdiff_t sz = layout_.stride_z;
  const bool free = !outlet_p_.empty();
  for (int j = 0; j < grid_.ny; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k);
    double* q = &field[at];
    const double* fz = &f_.fz[at + sz];
    for (int i = 0; k == 0 && i < grid_.nx; ++i) q[i - sz] = 2 * inlet - q[i];
    for (int i = 0; k == grid_.nz - 1 && i < grid_.nx; ++i)
      q[i + sz] = fz[i] >= 0 || free ? q[i] : 2 * back - q[i];
  }
}

void Solver::march_ghosts(int k) {
  const double wall = sides_ == Sides::slip ? -1 : 1;
  side_ghosts(hu_, k, wall, 1), side_ghosts(hv_, k, 1, wall);
  side_ghosts(f_.k, k, 1, 1), end_ghosts(f_.k, k, inlet_k_, inlet_k_);
  side_ghosts(f_.omega, k, 1, 1), end_ghosts(f_.omega, k, inlet_omega_, inlet_omega_);
  entrain(f_.k, k, none, inlet_k_), entrain(f_.omega, k, none, inlet_omega_);
  if (entraining()) side_ghosts(ra_, k, 1, 1), side_ghosts(rc_, k, 1, 1);
}

void Solver::pressure(int k, IndexRange rows) {
  MultigridLevel& top = multigrid_.finest();
  const bool last = k == grid_.nz - 1;
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k), sz = layout_.stride_z;
    PressureRow r;
    r.m = pressure_metrics(j, k);
    r.y_width = y_.width[j];
    r.z_width = z_.width[k];
    r.hu = &hu_[at], r.hv = &hv_[at], r.hw = &hw_[at];
    r.ra = &ra_[at], r.rc = &rc_[at], r.rho = &f_.rho[at], r.p = &f_.p[at];
    r.hw_above = r.hw + sz, r.ra_above = r.ra + sz, r.rc_above = r.rc + sz, r.rho_above = r.rho + sz;
    const double* outlet =
        outlet_p_.empty() ? &constant_.zeros[Layout::lead] : &outlet_p_[layout_.in_plane(0, j)];
    r.p_above = last ? outlet : r.p + sz;
    r.inlet = k == 0;
    r.inlet_speed = air_.speed;
    r.outlet = last;
    r.mean_p = total_.value[Sums::p_mean];
    r.fx = &f_.fx[at], r.fy = &f_.fy[at], r.fz = &f_.fz[at];
    r.held = jumps(j, k, &SheetRows::held);
    r.excess = jumps(j, k, &SheetRows::excess);
    r.stiffness = jumps(j, k, &SheetRows::stiffness);
    r.cx = &top.cx[at], r.cy = &top.cy[at], r.cz = &top.cz[at], r.cz_above = &top.cz[at + sz];
    r.rhs = &top.rhs[at];
    pressure_row(r);
    if (entraining()) entraining_conductances(j, k);
    double* sums = row_sums(j, k).value;
    sums[Sums::p_residual] = r.sum.residual, sums[Sums::p_scale] = r.sum.scale;
  }
}

// From the cells of row (j, k) in the sides to the faces there, half a cell.
void Solver::entraining_conductances(int j, int k) {
  MultigridLevel& top = multigrid_.finest();
  const std::ptrdiff_t low = layout_.at(0, j, k), high = layout_.at(grid_.nx - 1, j, k);
  const auto conductance = [&](std::ptrdiff_t cell, double width, double area) {
    return static_cast<float>(f_.rho[cell] * rc_[cell] * 2 / width * area);
  };
  const double area_x = y_.width[j] * z_.width[k];
  top.cx[low] = conductance(low, x_.width.front(), area_x);
  top.cx[high + 1] = conductance(high, x_.width.back(), area_x);
  for (int i = 0; i < grid_.nx; ++i) {
    const double area_y = x_.width[i] * z_.width[k];
    if (j == 0) top.cy[low + i] = conductance(low + i, y_.width.front(), area_y);
    if (j == grid_.ny - 1) top.cy[low + i + layout_.stride_y] = conductance(low + i, y_.width.back(), area_y);
  }
}

// Face fluxes with the whole correction, before the pressure is relaxed.
void Solver::flux(int k, IndexRange rows) {
  const MultigridLevel& top = multigrid_.finest();
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k), sy = layout_.stride_y, sz = layout_.stride_z;
    FluxRow r;
    r.m = pressure_metrics(j, k);
    r.hu = &hu_[at], r.hv = &hv_[at], r.hw = &hw_[at];
    r.ra = &ra_[at], r.rc = &rc_[at], r.rho = &f_.rho[at], r.p = &f_.p[at], r.dp = &top.e[at];
    r.inlet = k == 0;
    r.inlet_speed = air_.speed;
    r.fx = &f_.fx[at], r.fy = &f_.fy[at], r.fz = &f_.fz[at];
    r.held = jumps(j, k, &SheetRows::held);
    r.excess = jumps(j, k, &SheetRows::excess);
    r.stiffness = jumps(j, k, &SheetRows::stiffness);
    r.change_x = sheets_.change_to_write(0, j, k);
    r.change_y = sheets_.change_to_write(1, j, k);
    r.change_z = sheets_.change_to_write(2, j, k);
    flux_row(r);
    if (j == grid_.ny - 1) {  // the far side
      const bool open = sides_ != Sides::slip;
      const double rd = yp_.inverse_distance[grid_.ny];
      for (int i = 0; i < grid_.nx; ++i) {
        const double more = static_cast<double>(r.dp[i + sy]) - static_cast<double>(r.dp[i]);
        const double drop = rd * (r.ra[i] * (r.p[i + sy] - r.p[i]) + r.rc[i] * more);
        r.fy[i + sy] = open ? r.rho[i] * (r.hv[i] - drop) : 0;
      }
    }
    if (k == grid_.nz - 1) {
      const double* outlet =
          outlet_p_.empty() ? &constant_.zeros[Layout::lead] : &outlet_p_[layout_.in_plane(0, j)];
      OutletRow out{grid_.nx, zp_.inverse_distance[grid_.nz], r.hw, r.ra, r.rc, r.rho, r.p, outlet, r.dp,
                    r.fz + sz};
      outlet_flux_row(out);
    }
  }
}

// The correction has the pressure's ghosts while velocities are corrected; the solver wants zeros there.
void Solver::correction_ghosts(int k) {
  Array<float>& e = multigrid_.finest().e;
  const std::ptrdiff_t sy = layout_.stride_y, sz = layout_.stride_z;
  const int nx = grid_.nx, ny = grid_.ny;
  const float across = entraining() ? -1 : 1;
  for (int j = 0; j < ny; ++j) {
    float* q = &e[layout_.at(0, j, k)];
    q[-1] = across * q[0];
    q[nx] = across * q[nx - 1];
    for (int i = 0; j == 0 && i < nx; ++i) q[i - sy] = across * q[i];
    for (int i = 0; j == ny - 1 && i < nx; ++i) q[i + sy] = across * q[i];
    if (k == 0) std::copy_n(q, nx, q - sz);
    for (int i = 0; k == grid_.nz - 1 && i < nx; ++i) q[i + sz] = -q[i];
  }
}

void Solver::pressure_ghosts(int k) {
  const std::ptrdiff_t sz = layout_.stride_z;
  side_ghosts(f_.p, k, 1, 1);
  if (entraining()) {
    each_side_face(k, [&](int, std::ptrdiff_t ghost, std::ptrdiff_t cell, double inflow) {
      const double side = inflow > 0 ? -0.5 * inflow * inflow / f_.rho[cell] : 0;
      f_.p[ghost] = 2 * side - f_.p[cell];
    });
  }
  for (int j = 0; j < grid_.ny; ++j) {
    double* p = &f_.p[layout_.at(0, j, k)];
    if (k == 0) std::copy_n(p, grid_.nx, p - sz);
    if (k < grid_.nz - 1) continue;
    if (outlet_p_.empty()) {
      for (int i = 0; i < grid_.nx; ++i) p[i + sz] = -p[i];
      continue;
    }
    // Where a wake sucks air back in through the outlet, that air has the total pressure of air at rest; with
    // its static pressure held instead, it would come in ever faster.
    const double *fz = &f_.fz[layout_.at(0, j, k) + sz], *rho = &f_.rho[layout_.at(0, j, k)];
    double* outlet = &outlet_p_[layout_.in_plane(0, j)];
    for (int i = 0; i < grid_.nx; ++i) {
      const double total = fz[i] < 0 ? -0.5 * fz[i] * fz[i] / rho[i] : 0;
      outlet[i] = 0.5 * (outlet[i] + total);
      p[i + sz] = 2 * outlet[i] - p[i];
    }
  }
}

void Solver::relax_pressure(int k) {
  const MultigridLevel& top = multigrid_.finest();
  for (int j = 0; j < grid_.ny; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k);
    double* p = &f_.p[at];
    const float* dp = &top.e[at];
    for (int i = 0; i < grid_.nx; ++i) p[i] += settings_.relax_pressure * static_cast<double>(dp[i]);
  }
  pressure_ghosts(k);
}

void Solver::velocity_ghosts(int k) {
  const double wall = sides_ == Sides::slip ? -1 : 1;
  side_ghosts(f_.u, k, wall, 1), end_ghosts(f_.u, k, 0, 0);
  side_ghosts(f_.v, k, 1, wall), end_ghosts(f_.v, k, 0, 0);
  side_ghosts(f_.w, k, 1, 1), end_ghosts(f_.w, k, air_.speed, 0);
  side_ghosts(f_.rho, k, 1, 1);
  entrain(f_.u, k, 0, 0), entrain(f_.v, k, 1, 0), entrain(f_.w, k, none, air_.speed);
  const std::ptrdiff_t sz = layout_.stride_z;
  for (int j = 0; j < grid_.ny; ++j) {
    double* rho = &f_.rho[layout_.at(0, j, k)];
    if (k == 0) std::copy_n(rho, grid_.nx, rho - sz);
    if (k == grid_.nz - 1) std::copy_n(rho, grid_.nx, rho + sz);
  }
}

void Solver::velocity(int k, IndexRange rows) {
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k);
    VelocityRow r;
    r.m = metrics(j, k);
    r.gas_constant = settings_.compressible ? gas_constant_ : 0;
    r.pressure0 = pressure0_;
    r.temperature = air_.temperature;
    r.speed2 = air_.speed * air_.speed;
    r.half_cp = 0.5 / heat_capacity;
    r.ra = &ra_[at], r.rc = &rc_[at], r.p = &f_.p[at], r.dp = &multigrid_.finest().e[at];
    r.held = jumps(j, k, &SheetRows::held);
    r.change = jumps(j, k, &SheetRows::change);
    r.relaxation = settings_.relax_pressure;
    r.hu = &hu_[at], r.hv = &hv_[at], r.hw = &hw_[at];
    r.u = &f_.u[at], r.v = &f_.v[at], r.w = &f_.w[at], r.rho = &f_.rho[at];
    velocity_row(r);
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
