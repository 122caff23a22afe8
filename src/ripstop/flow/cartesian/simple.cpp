#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ripstop/flow/average.h"
#include "ripstop/flow/boundaries.h"
#include "ripstop/flow/cartesian/quarter.h"
#include "ripstop/flow/cartesian/solver.h"

namespace ripstop::inline flow::cartesian {
namespace {

/// Half steps after a start with a sheet: the initial pressure does not yet balance the drop of the cloth,
/// and full steps would disturb the flow.
constexpr int eased_iterations = 30;

Boundaries boundaries_of(const FlowProblem& problem, const Discretisation& d) {
  return {make_inlet(d, problem.jet), make_sides(sides_of(problem)), make_outlet(problem.outlet)};
}

void lay_out(const std::vector<Vec3>& force, const Discretisation& d, Obstacles& obstacles) {
  if (force.empty()) return;
  obstacles.body_u = obstacles.body_v = obstacles.body_w = Array<double>(d.layout.values());
  for (int k = 0; k < d.grid.nz; ++k) {
    for (int j = 0; j < d.grid.ny; ++j) {
      for (int i = 0; i < d.grid.nx; ++i) {
        const Vec3 f = force[d.grid.index(i, j, k)];
        const std::ptrdiff_t at = d.layout.at(i, j, k);
        obstacles.body_u[at] = f.x, obstacles.body_v[at] = f.y, obstacles.body_w[at] = f.z;
      }
    }
  }
}

}  // namespace

Scratch::Scratch(const Discretisation& d, int threads) : sums(d.grid.ny, d.grid.nz) {
  for (Array<double>* field : {&hu, &hv, &hw, &ra, &rc, &new_k, &new_omega, &new_limit})
    *field = Array<double>(d.layout.values());
  std::fill(new_limit.begin(), new_limit.end(), 1.0);
  if (d.settings.second_order) extra_u = extra_v = extra_w = Array<double>(d.layout.values());
  const auto row = static_cast<std::size_t>(d.layout.stride_y);
  zeros = Array<double>(row);
  rings.assign(threads, MarchRings(row * (d.grid.ny / block_count(d.grid) + 7)));
}

Solver::Solver(const FlowProblem& problem, const FlowGrid& grid, PorousRows porous,
               const CartesianSettings& settings, ThreadTeam& team)
    : d_(grid, problem.air, settings, make_sides(sides_of(problem))->pressure_end(),
         make_sides(sides_of(problem))->everywhere(), problem.quarter),
      b_(boundaries_of(problem, d_)),
      s_(d_.layout),
      t_(d_, team.size()),
      multigrid_(d_.xp, d_.yp, d_.zp),
      team_(team) {
  lay_out(problem.body_force, d_, in_the_way_);
  start_uniform();
  place(std::move(porous), problem.bodies);
}

void Solver::start_uniform() {
  const auto fill = [](auto& values, double value) { std::fill(values.begin(), values.end(), value); };
  Fields& f = s_.f;
  const Stream& stream = b_.inlet.stream;
  fill(f.u, stream.velocity.x), fill(f.v, stream.velocity.y), fill(f.p, 0), fill(f.rho, d_.air.density);
  fill(f.k, stream.k), fill(f.omega, stream.omega);
  fill(f.fx, d_.air.density * stream.velocity.x), fill(f.fy, d_.air.density * stream.velocity.y);
  const std::size_t plane = b_.inlet.w.size();  // inflow through the whole box
  for (std::size_t at = 0; at < f.w.size(); ++at) {
    f.w[at] = b_.inlet.w[at % plane];
    f.fz[at] = d_.air.density * f.w[at];
  }
  fill(s_.limit, 1), fill(s_.outlet_p, 0);
  s_.face_p.assign(b_.open() ? d_.layout.values() : 0, 0.0);
  s_.mean = {stream.velocity.x, stream.velocity.y, b_.inlet.mean_speed, 0, stream.k, stream.omega};
  s_.force = {};
  s_.iteration = 0;
  s_.untouched = true;
  stop_the_clock(s_);
  s_.eased = in_the_way_.sheets.empty() ? 0 : eased_iterations;
  in_the_way_.sheets.begin(s_, d_.layout);
}

void Solver::continue_from(const Solver& other) {
  const State& from = other.s_;
  const auto take_stream = [&] {
    s_.clock.changing = from.clock.changing, s_.clock.stream = from.clock.stream;
    s_.clock.gaining = from.clock.gaining;
    if (s_.clock.changing) let_stream_in();
  };
  take_stream();
  start_from(other);
  take_stream();
  if (!(other.grid() == grid())) return;
  s_.limit = from.limit, s_.held = from.held, s_.change = from.change, s_.drop = from.drop;
  s_.force = from.force, s_.iteration = from.iteration, s_.eased = from.eased;
  s_.f.rho = from.f.rho;
  s_.rate_u = from.rate_u, s_.rate_v = from.rate_v, s_.rate_w = from.rate_w;
  s_.correction = from.correction, s_.clock = from.clock;
}

void Solver::start_from(const Solver& coarse) {
  start_uniform();
  team_.run([&](int rank) { interpolate(coarse.s_, coarse.d_, s_, d_, rank, team_.size()); });
  s_.mean = coarse.s_.mean;
  s_.untouched = false;
  in_the_way_.sheets.begin(s_, d_.layout);
  for (int k = 0; k < d_.grid.nz; ++k)
    velocity_ghosts(d_, b_, s_, k), pressure_ghosts(d_, b_, s_, k), turbulence_ghosts(d_, b_, s_, k);
}

void Solver::place(PorousRows porous, const std::vector<FlowBody>& bodies) {
  in_the_way_.porous = std::move(porous);
  const SheetRows before =
      std::exchange(in_the_way_.sheets, SheetRows(d_.x, d_.y, d_.z, bodies, d_.quarter, &team_));
  in_the_way_.sheets.begin(s_, d_.layout, before);
  if (s_.untouched) s_.eased = in_the_way_.sheets.empty() ? 0 : eased_iterations;
  in_the_way_.wall = {};
}

/// One quantity of the sheets on the faces of row (j, k); empty where no sheet passes.
FaceView Solver::on_faces(int j, int k, const std::vector<double>& values) const {
  const SheetRows& sheets = in_the_way_.sheets;
  if (!sheets.touches(j, k)) return {};
  const auto row = [&](int axis, int jj, int kk) { return values.data() + sheets.offset(axis, jj, kk); };
  return {row(0, j, k), row(1, j, k), row(1, j + 1, k), row(2, j, k), row(2, j, k + 1)};
}

SheetView Solver::sheet(int j, int k) const {
  const SheetRows& sheets = in_the_way_.sheets;
  return {on_faces(j, k, s_.held), on_faces(j, k, sheets.excess()), on_faces(j, k, sheets.stiffness())};
}

FlowProgress Solver::iterate() {
  t_.in_time = false;
  t_.all_inverse = 0;
  if (!s_.rate_u.empty()) stop_the_clock(s_);
  SheetRows& sheets = in_the_way_.sheets;
  if (!sheets.empty()) {
    if (in_the_way_.wall.empty()) in_the_way_.wall = sheets.distance(d_.x, d_.y, d_.z, d_.layout, &team_);
    sheets.update(s_, d_.layout, d_.air.density * d_.air.speed());
  }
  team_.run([this](int rank) {
    if (d_.settings.second_order) each_row(rank, [&](int j, int k) { convection(j, k); });
    each_block(rank, [&](IndexRange rows) { march(rank, rows); });
    if (rank == 0) take_new_turbulence();
    team_.barrier();
    each_plane(rank, [&](int k) { turbulence_ghosts(d_, b_, s_, k), matrix_ghosts(k); });
    each_row(rank, [&](int j, int k) { pressure(j, k); });
    correct(rank);
    each_plane(rank, [&](int k) { correction_ghosts(d_, b_, multigrid_.finest().e, k); });
    each_row(rank, [&](int j, int k) { flux(j, k); });
    each_row(rank, [&](int j, int k) { velocity(j, k); });
    each_plane(rank, [&](int k) { relax_pressure(k), velocity_ghosts(d_, b_, s_, k); });
    t_.sums.add_up(team_, rank);
  });
  return close_iteration();
}

void Solver::take_new_turbulence() {
  std::swap(s_.f.k, t_.new_k), std::swap(s_.f.omega, t_.new_omega), std::swap(s_.limit, t_.new_limit);
}

// Evaluates the sums, and prepares the next iteration.
FlowProgress Solver::close_iteration() {
  const Sums& sum = t_.sums.total();
  const double per_volume = 1 / (d_.grid.size.x * d_.grid.size.y * d_.grid.size.z);
  const auto mean = [&](Sums::Name name) { return sum.value[name] * per_volume; };
  s_.mean = {mean(Sums::u_mean), mean(Sums::v_mean), mean(Sums::w_mean),
             mean(Sums::p_mean), mean(Sums::k_mean), mean(Sums::omega_mean)};
  if (d_.quarter) s_.mean.u = s_.mean.v = 0;
  s_.force = of_whole_box({sum.value[Sums::drag_x], sum.value[Sums::drag_y], sum.value[Sums::drag_z]});
  in_the_way_.sheets.settle(s_);
  for (const SheetLoad& load : in_the_way_.sheets.loads(s_, d_.layout)) s_.force += load.force;
  ++s_.iteration;
  s_.eased = std::max(0, s_.eased - 1);
  s_.untouched = false;
  FlowProgress progress;
  progress.iteration = s_.iteration;
  progress.residual_u =
      std::max({sum.ratio(Sums::u_residual), sum.ratio(Sums::v_residual), sum.ratio(Sums::w_residual)});
  progress.residual_p = sum.ratio(Sums::p_residual);
  progress.residual_k = sum.ratio(Sums::k_residual);
  progress.residual_omega = sum.ratio(Sums::omega_residual);
  progress.drag = dot(s_.force, d_.air.direction());
  return progress;
}

Vec3 Solver::of_whole_box(Vec3 sum) const {
  return d_.quarter ? cartesian::of_whole_box(sum) : sum;
}

std::array<Solver::Bounded, 6> Solver::bounded() const {
  const double speed = d_.air.speed();
  return {{{"velocity x", &s_.f.u, 1e3 * speed},
           {"velocity y", &s_.f.v, 1e3 * speed},
           {"velocity z", &s_.f.w, 1e3 * speed},
           {"pressure", &s_.f.p, 1e4 * d_.air.density * speed * speed},
           {"k", &s_.f.k, 1e6 * speed * speed},
           {"omega", &s_.f.omega, 1e300}}};
}

bool Solver::within_reason() {
  std::vector<char> sound(static_cast<std::size_t>(team_.size()), 1);
  team_.run([&](int rank) {
    const IndexRange planes = part_of(d_.grid.nz, rank, team_.size());
    for (const Bounded& field : bounded()) {
      for (int k = planes.begin; k < planes.end; ++k) {
        for (int j = 0; j < d_.grid.ny; ++j) {
          const double* row = &(*field.values)[d_.layout.at(0, j, k)];
          bool within = true;
          for (int i = 0; i < d_.grid.nx; ++i) within &= std::fabs(row[i]) <= field.bound;  // not of a NaN
          if (!within) sound[rank] = 0;
        }
      }
    }
  });
  return std::find(sound.begin(), sound.end(), 0) == sound.end();
}

std::string Solver::first_bad_value() const {
  for (const Bounded& check : bounded()) {
    for (int k = 0; k < d_.grid.nz; ++k) {
      for (int j = 0; j < d_.grid.ny; ++j) {
        for (int i = 0; i < d_.grid.nx; ++i) {
          const double value = (*check.values)[d_.layout.at(i, j, k)];
          if (std::isfinite(value) && std::fabs(value) <= check.bound) continue;
          const Vec3 place = d_.grid.centre(i, j, k);
          return fmt::format("{} is {} at ({:.3f}, {:.3f}, {:.3f}) m", check.name, value, place.x, place.y,
                             place.z);
        }
      }
    }
  }
  return {};
}

FlowField Solver::field() const {
  FlowField field = field_without_cells();
  field.pressure.resize(d_.grid.cells());
  field.velocity.resize(d_.grid.cells());
  draw_cells(field, 1);
  return field;
}

BodyLoad Solver::load_on(const PorousCells& porous, Vec3 about) const {
  BodyLoad load;
  for (const int cell : porous.cells) {
    const int i = cell % d_.grid.nx, j = cell / d_.grid.nx % d_.grid.ny, k = cell / d_.grid.nx / d_.grid.ny;
    const std::ptrdiff_t at = d_.layout.at(i, j, k);
    const Vec3 velocity{s_.f.u[at], s_.f.v[at], s_.f.w[at]};
    const double resistance =
        d_.air.viscosity * porous.darcy + s_.f.rho[at] * norm(velocity) * porous.forchheimer / 2;
    const Vec3 force = (d_.grid.cell_volume(cell) * resistance) * velocity;
    load.force += force, load.moment += cross(d_.grid.centre(i, j, k) - about, force);
  }
  return d_.quarter ? cartesian::of_whole_box(load, about) : load;
}

void Solver::add_to(FieldMean& mean, std::vector<BodyLoad> loads) const {
  FlowField last = field_without_cells();
  last.bodies = std::move(loads);
  mean.add(last, [this](FlowField& field, double share) { draw_cells(field, share); });
}

FlowField Solver::field_without_cells() const {
  FlowField field;
  field.grid = d_.grid;
  field.porous_force = s_.force;
  field.sheet_loads = in_the_way_.sheets.loads(s_, d_.layout);
  field.momentum_deficit = of_whole_box(momentum_deficit(d_, b_, s_));
  return field;
}

// Pressures and velocities towards the state's.
void Solver::draw_cells(FlowField& field, double share) const {
  team_.run([&](int rank) {
    const IndexRange planes = part_of(d_.grid.nz, rank, team_.size());
    for (int k = planes.begin; k < planes.end; ++k) {
      for (int j = 0; j < d_.grid.ny; ++j) {
        const std::ptrdiff_t at = d_.layout.at(0, j, k);
        const double *p = &s_.f.p[at], *u = &s_.f.u[at], *v = &s_.f.v[at], *w = &s_.f.w[at];
        double* pressure = &field.pressure[d_.grid.index(0, j, k)];
        Vec3* velocity = &field.velocity[d_.grid.index(0, j, k)];
        for (int i = 0; i < d_.grid.nx; ++i) {
          pressure[i] += share * (p[i] - pressure[i]);
          velocity[i] += share * (Vec3{u[i], v[i], w[i]} - velocity[i]);
        }
      }
    }
  });
}

}  // namespace ripstop::inline flow::cartesian
