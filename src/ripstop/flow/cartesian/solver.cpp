#include "ripstop/flow/cartesian/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ripstop::cartesian {
namespace {

/// Weights of two values of an axis (ghosts included) around a point of another one.
struct Pair {
  int low;
  double high_weight;
};

/// Where the centres or faces of `to` lie among those of `from`; ghost centres are as far beyond the ends as
/// the outermost centres lie inside.
std::vector<Pair> pairs(const Axis& to, const Axis& from, bool faces) {
  const auto place = [faces](const Axis& axis, int c) {
    if (faces) return axis.edge[c];
    if (c < 0) return axis.edge[0] - 0.5 * axis.width[0];
    if (c >= axis.n) return axis.edge[axis.n] + 0.5 * axis.width[axis.n - 1];
    return 0.5 * (axis.edge[c] + axis.edge[c + 1]);
  };
  std::vector<Pair> result(to.n + 1);
  const int least = faces ? 0 : -1;
  int low = least;
  for (int c = 0; c < to.n + (faces ? 1 : 0); ++c) {
    const double x = place(to, c);
    while (low + 1 < from.n && place(from, low + 1) <= x) ++low;
    const double a = place(from, low), b = place(from, low + 1);
    result[c] = {low, std::clamp((x - a) / (b - a), 0.0, 1.0)};
  }
  return result;
}

End side_end(const FlowProblem& problem) {
  return problem.sides == Sides::entraining ? End::fixed_value : End::zero_gradient;
}

}  // namespace

Solver::Solver(const FlowProblem& problem, const FlowGrid& grid, PorousRows porous,
               const CartesianSettings& settings, ThreadTeam& team)
    : grid_(grid),
      air_(problem.air),
      sides_(problem.sides),
      settings_(settings),
      team_(team),
      porous_(std::move(porous)),
      x_(make_axis(grid.edges(0), End::zero_gradient, End::zero_gradient)),
      y_(make_axis(grid.edges(1), End::zero_gradient, End::zero_gradient)),
      z_(make_axis(grid.edges(2), End::fixed_value, End::zero_gradient)),
      xp_(make_axis(grid.edges(0), side_end(problem), side_end(problem))),
      yp_(make_axis(grid.edges(1), side_end(problem), side_end(problem))),
      zp_(make_axis(grid.edges(2), End::zero_gradient, End::fixed_value)),
      sheets_(x_, y_, z_, problem.sheets),
      layout_(grid.nx, grid.ny, grid.nz),
      multigrid_(xp_, yp_, zp_) {
  // Beyond an entraining side the pressure has a ghost, a whole cell away; the correction, which the
  // multigrid holds at zero in the face, has its own conductances there.
  for (Axis* axis : {&xp_, &yp_}) axis->inverse_distance.front() *= 0.5, axis->inverse_distance.back() *= 0.5;
  const std::size_t values = layout_.values();
  for (Array<double>* field : {&f_.u, &f_.v, &f_.w, &f_.p, &f_.rho, &f_.k, &f_.omega, &f_.fx, &f_.fy, &f_.fz,
                               &hu_, &hv_, &hw_, &ra_, &rc_, &new_k_, &new_omega_}) {
    *field = Array<double>(values);
  }
  const std::size_t row = static_cast<std::size_t>(layout_.stride_y);
  rings_.assign(team_.size(), MarchRings(row * (grid.ny / block_count(grid) + 7)));

  // Inlet: k = 3/2 (I U)^2, omega = k / nu_t.
  const double fluctuation = air_.turbulence_intensity * air_.speed;
  inlet_k_ = 1.5 * fluctuation * fluctuation;
  inlet_omega_ = inlet_k_ / (air_.viscosity_ratio * air_.viscosity / air_.density);
  gas_constant_ = gas_constant_of_air;
  pressure0_ = air_.density * gas_constant_ * air_.temperature;

  constant_.zeros = Array<double>(row);
  constant_.inlet_w = Array<double>(row, air_.speed);
  constant_.inlet_k = Array<double>(row, inlet_k_);
  constant_.inlet_omega = Array<double>(row, inlet_omega_);
  if (settings_.second_order) extra_u_ = extra_v_ = extra_w_ = Array<double>(values);
  if (!problem.body_force.empty()) {
    body_u_ = body_v_ = body_w_ = Array<double>(values);
    for (int k = 0; k < grid.nz; ++k) {
      for (int j = 0; j < grid.ny; ++j) {
        for (int i = 0; i < grid.nx; ++i) {
          const Vec3 force = problem.body_force[grid.index(i, j, k)];
          const std::ptrdiff_t at = layout_.at(i, j, k);
          body_u_[at] = force.x, body_v_[at] = force.y, body_w_[at] = force.z;
        }
      }
    }
  }
  if (!sheets_.empty()) {
    outlet_p_ = Array<double>(static_cast<std::size_t>(layout_.stride_z));
    wall_ = sheets_.distance(x_, y_, z_, layout_);
    limit_ = new_limit_ = Array<double>(values, 1.0);
  }
  rows_.resize(static_cast<std::size_t>(grid.ny) * grid.nz);
  planes_.resize(grid.nz);
}

RowMetrics Solver::metrics(int j, int k, const Axis& x, const Axis& y, const Axis& z) const {
  RowMetrics m;
  m.n = grid_.nx;
  m.sy = layout_.stride_y;
  m.sz = layout_.stride_z;
  m.x_width = x.width.data();
  m.x_inverse_width = x.inverse_width.data();
  m.x_weight_low = x.weight_low.data();
  m.x_inverse_distance = x.inverse_distance.data();
  m.x_slope_low = x.slope_low.data();
  m.x_slope_high = x.slope_high.data();
  m.y = cross_metrics(y, j);
  m.z = cross_metrics(z, k);
  return m;
}

/// The rows of one quantity that the faces of row (j, k) have; null where no sheet passes.
SheetJumps Solver::jumps(int j, int k, const double* (SheetRows::*row)(int, int, int) const) const {
  if (!sheets_.touches(j, k)) return {};
  return {(sheets_.*row)(0, j, k), (sheets_.*row)(1, j, k), (sheets_.*row)(1, j + 1, k),
          (sheets_.*row)(2, j, k), (sheets_.*row)(2, j, k + 1)};
}

void Solver::start_uniform() {
  const auto fill = [](Array<double>& field, double value) { std::fill(field.begin(), field.end(), value); };
  fill(f_.u, 0), fill(f_.v, 0), fill(f_.w, air_.speed), fill(f_.p, 0), fill(f_.rho, air_.density);
  fill(f_.k, inlet_k_), fill(f_.omega, inlet_omega_);
  fill(f_.fx, 0), fill(f_.fy, 0), fill(f_.fz, air_.density * air_.speed);
  total_.value[Sums::w_mean] = air_.speed;
  total_.value[Sums::k_mean] = inlet_k_;
  total_.value[Sums::omega_mean] = inlet_omega_;
}

void Solver::start_from(const Solver& other) {
  const auto cx = pairs(x_, other.x_, false), cy = pairs(y_, other.y_, false),
             cz = pairs(z_, other.z_, false);
  const auto ex = pairs(x_, other.x_, true), ey = pairs(y_, other.y_, true), ez = pairs(z_, other.z_, true);
  const auto interpolate = [&](const Array<double>& from, Array<double>& to, const std::vector<Pair>& px,
                               const std::vector<Pair>& py, const std::vector<Pair>& pz, double factor,
                               bool fx, bool fy, bool fz) {
    const auto work = [&](int rank) {
      const IndexRange planes = part_of(grid_.nz + (fz ? 1 : 0), rank, team_.size());
      for (int k = planes.begin; k < planes.end; ++k) {
        for (int j = 0; j < grid_.ny + (fy ? 1 : 0); ++j) {
          for (int i = 0; i < grid_.nx + (fx ? 1 : 0); ++i) {
            double value = 0;
            for (int corner = 0; corner < 8; ++corner) {
              const int a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
              // Fluxes are piecewise constant along their own faces' other axes only through these weights.
              const double weight = (a ? px[i].high_weight : 1 - px[i].high_weight) *
                                    (b ? py[j].high_weight : 1 - py[j].high_weight) *
                                    (c ? pz[k].high_weight : 1 - pz[k].high_weight);
              if (weight != 0)
                value += weight * from[other.layout_.at(px[i].low + a, py[j].low + b, pz[k].low + c)];
            }
            to[layout_.at(i, j, k)] = factor * value;
          }
        }
      }
    };
    team_.run(work);
  };
  // Other air: the same flow at another speed, but for what Reynolds and Mach number change.
  const double speed = air_.speed / other.air_.speed, density = air_.density / other.air_.density;
  const double pressure = density * speed * speed;
  interpolate(other.f_.u, f_.u, cx, cy, cz, speed, false, false, false);
  interpolate(other.f_.v, f_.v, cx, cy, cz, speed, false, false, false);
  interpolate(other.f_.w, f_.w, cx, cy, cz, speed, false, false, false);
  interpolate(other.f_.p, f_.p, cx, cy, cz, pressure, false, false, false);
  if (settings_.compressible) {
    interpolate(other.f_.rho, f_.rho, cx, cy, cz, density, false, false, false);
  } else {  // no iteration would mend what the interpolation gets wrong where two sides of the box meet
    std::fill(f_.rho.begin(), f_.rho.end(), air_.density);
  }
  interpolate(other.f_.k, f_.k, cx, cy, cz, speed * speed, false, false, false);
  interpolate(other.f_.omega, f_.omega, cx, cy, cz, speed, false, false, false);
  interpolate(other.f_.fx, f_.fx, ex, cy, cz, density * speed, true, false, false);
  interpolate(other.f_.fy, f_.fy, cx, ey, cz, density * speed, false, true, false);
  interpolate(other.f_.fz, f_.fz, cx, cy, ez, density * speed, false, false, true);
  const double factor[] = {speed, speed, speed, pressure, speed * speed, speed};  // of the means, u to omega
  for (int name = Sums::u_mean; name <= Sums::omega_mean; ++name)
    total_.value[name] = factor[name - Sums::u_mean] * other.total_.value[name];
  fill_ghosts();
}

void Solver::fill_ghosts() {
  for (int k = 0; k < grid_.nz; ++k) velocity_ghosts(k), pressure_ghosts(k), march_ghosts(k);
}

// Rows to planes in parallel, planes to totals on rank 0; always in the same order.
void Solver::add_up(int rank, int from, int to) {
  const IndexRange planes = part_of(grid_.nz, rank, team_.size());
  for (int k = planes.begin; k < planes.end; ++k) {
    for (int name = from; name <= to; ++name) planes_[k].value[name] = 0;
    for (int j = 0; j < grid_.ny; ++j) {
      const Sums& row = row_sums(j, k);
      for (int name = from; name <= to; ++name) planes_[k].value[name] += row.value[name];
    }
  }
  team_.barrier();
  if (rank == 0) {
    for (int name = from; name <= to; ++name) {
      total_.value[name] = 0;
      for (const Sums& plane : planes_) total_.value[name] += plane.value[name];
    }
  }
}

FlowProgress Solver::iterate() {
  team_.run([this](int rank) {
    const IndexRange planes = part_of(grid_.nz, rank, team_.size());
    const auto each_plane = [&](auto stage) {
      for (int k = planes.begin; k < planes.end; ++k) stage(k);
      team_.barrier();
    };
    const int count = block_count(grid_);
    const IndexRange blocks = part_of(count, rank, team_.size());
    const auto each_block = [&](auto stage) {
      for (int b = blocks.begin; b < blocks.end; ++b) stage(part_of(grid_.ny, b, count));
      team_.barrier();
    };
    const auto each_plane_of_a_block = [&](auto stage) {
      each_block([&](IndexRange rows) {
        for (int k = 0; k < grid_.nz; ++k) stage(k, rows);
      });
    };
    if (!sheets_.empty()) {
      if (rank == 0) sheets_.update(f_, layout_, air_.density * air_.speed);
      team_.barrier();
    }
    if (settings_.second_order) each_plane_of_a_block([&](int k, IndexRange rows) { convection(k, rows); });
    each_block([&](IndexRange rows) { march(rank, rows); });
    if (rank == 0) std::swap(f_.k, new_k_), std::swap(f_.omega, new_omega_), std::swap(limit_, new_limit_);
    team_.barrier();
    each_plane([&](int k) { march_ghosts(k); });
    each_plane_of_a_block([&](int k, IndexRange rows) { pressure(k, rows); });
    if (sheets_.shut()) {  // nothing passes round the sheet: coarse levels are cut in two
      multigrid_.solve_conjugate(team_, rank, 0.05, 20);
    } else if (!grid_.uniform()) {  // long thin cells, which a cycle alone does not smooth
      multigrid_.solve_conjugate(team_, rank, 0.2, 2 * settings_.pressure_cycles);
    } else {
      multigrid_.solve(team_, rank, settings_.pressure_cycles);
    }
    each_plane([&](int k) { correction_ghosts(k); });
    each_plane_of_a_block([&](int k, IndexRange rows) { flux(k, rows); });
    each_plane_of_a_block([&](int k, IndexRange rows) { velocity(k, rows); });
    each_plane([&](int k) { relax_pressure(k), velocity_ghosts(k); });
    add_up(rank, 0, Sums::count - 1);
  });
  const Vec3 on_sheets = sheets_.force();
  total_.value[Sums::drag_x] += on_sheets.x;
  total_.value[Sums::drag_y] += on_sheets.y;
  total_.value[Sums::drag_z] += on_sheets.z;
  const double volume = grid_.size.x * grid_.size.y * grid_.size.z;
  for (int name = Sums::u_mean; name <= Sums::omega_mean; ++name) total_.value[name] /= volume;
  ++iteration_;
  const auto ratio = [this](int residual) {
    const int scale = residual + (Sums::u_scale - Sums::u_residual);
    return total_.value[residual] / (total_.value[scale] + 1e-300);
  };
  FlowProgress progress;
  progress.iteration = iteration_;
  progress.residual_u = std::max({ratio(Sums::u_residual), ratio(Sums::v_residual), ratio(Sums::w_residual)});
  progress.residual_p = ratio(Sums::p_residual);
  progress.residual_k = ratio(Sums::k_residual);
  progress.residual_omega = ratio(Sums::omega_residual);
  progress.drag = total_.value[Sums::drag_z];
  return progress;
}

std::string Solver::first_bad_value() const {
  const struct {
    const char* name;
    const Array<double>* values;
    double bound;
  } checks[] = {{"velocity x", &f_.u, 1e3 * air_.speed},
                {"velocity y", &f_.v, 1e3 * air_.speed},
                {"velocity z", &f_.w, 1e3 * air_.speed},
                {"pressure", &f_.p, 1e4 * air_.density * air_.speed * air_.speed},
                {"k", &f_.k, 1e6 * air_.speed * air_.speed},
                {"omega", &f_.omega, 1e300}};
  for (const auto& check : checks) {
    for (int k = 0; k < grid_.nz; ++k) {
      for (int j = 0; j < grid_.ny; ++j) {
        for (int i = 0; i < grid_.nx; ++i) {
          const double value = (*check.values)[layout_.at(i, j, k)];
          if (std::isfinite(value) && std::fabs(value) <= check.bound) continue;
          const Vec3 place = grid_.centre(i, j, k);
          return fmt::format("{} is {} at ({:.3f}, {:.3f}, {:.3f}) m", check.name, value, place.x, place.y,
                             place.z);
        }
      }
    }
  }
  return {};
}

// Momentum that the air brings through the faces of the box, pressure and diffusion included: the force on
// whatever is inside [N].
double Solver::momentum_deficit() const {
  double force = 0;
  const std::ptrdiff_t sz = layout_.stride_z;
  const auto mu = [&](std::ptrdiff_t at) {
    const double limit = limit_.empty() ? 1 : limit_[at];
    return air_.viscosity + f_.rho[at] * f_.k[at] / f_.omega[at] * limit;
  };
  for (int j = 0; j < grid_.ny; ++j) {
    for (int i = 0; i < grid_.nx; ++i) {
      const double area = x_.width[i] * y_.width[j];
      const std::ptrdiff_t in = layout_.at(i, j, 0), out = layout_.at(i, j, grid_.nz - 1);
      const double mu_in = air_.viscosity + f_.rho[in] * inlet_k_ / inlet_omega_;
      force += area *
               (f_.fz[in] * air_.speed + f_.p[in] - mu_in * z_.inverse_distance[0] * (f_.w[in] - air_.speed));
      // The explicit stress at the outlet is that of the last cell.
      if (!outlet_p_.empty()) force -= area * outlet_p_[layout_.in_plane(i, j)];
      const double leaving = f_.fz[out + sz] >= 0 || !outlet_p_.empty() ? f_.w[out] : 0;
      force -= area * f_.fz[out + sz] * leaving;
      const double slope = (f_.w[out] - f_.w[out - sz]) * z_.inverse_distance[grid_.nz - 1];
      force += area * mu(out) * slope / 2;
    }
  }
  // Ghosts hold what air brings in.
  const std::ptrdiff_t sy = layout_.stride_y;
  const auto carried = [&](double flux, std::ptrdiff_t before, std::ptrdiff_t after) {
    return flux * f_.w[flux > 0 ? before : after];
  };
  for (int k = 0; k < grid_.nz; ++k) {
    for (int j = 0; j < grid_.ny; ++j) {
      const double area = y_.width[j] * z_.width[k];
      const std::ptrdiff_t low = layout_.at(0, j, k), high = layout_.at(grid_.nx - 1, j, k);
      force += area * (carried(f_.fx[low], low - 1, low) - carried(f_.fx[high + 1], high, high + 1));
    }
    for (int i = 0; i < grid_.nx; ++i) {
      const double area = x_.width[i] * z_.width[k];
      const std::ptrdiff_t low = layout_.at(i, 0, k), high = layout_.at(i, grid_.ny - 1, k);
      force += area * (carried(f_.fy[low], low - sy, low) - carried(f_.fy[high + sy], high, high + sy));
    }
  }
  return force;
}

FlowField Solver::field() const {
  FlowField field;
  field.grid = grid_;
  field.pressure.resize(grid_.cells());
  field.velocity.resize(grid_.cells());
  for (int k = 0; k < grid_.nz; ++k) {
    for (int j = 0; j < grid_.ny; ++j) {
      for (int i = 0; i < grid_.nx; ++i) {
        const std::ptrdiff_t at = layout_.at(i, j, k);
        const int cell = grid_.index(i, j, k);
        field.pressure[cell] = f_.p[at];
        field.velocity[cell] = {f_.u[at], f_.v[at], f_.w[at]};
      }
    }
  }
  field.porous_force = {total_.value[Sums::drag_x], total_.value[Sums::drag_y], total_.value[Sums::drag_z]};
  field.sheet_loads = sheets_.loads();
  field.momentum_deficit = momentum_deficit();
  return field;
}

}  // namespace ripstop::cartesian
