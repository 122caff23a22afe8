// A step in time. The flux through the faces of the cells by convection and stress is extrapolated from this step and
// the last one (Adams and Bashforth, second order, for steps of unequal length); the pressure and the drop across
// sheets are those at its end:
//
//   rho (u* - u) / dt = (1 + r/2) R(u) - r/2 R(u before) - grad p,     r = dt / dt before,
//   u = u* - dt/rho grad dp,   p += dp,   such that the fluxes through the faces add up to zero
//
// (van Kan 1986), with the stages of an iteration's pressure (stage_pressure.cpp), whose matrix is rho / dt
// here. A sheet's law is linear about the drop and flux at the beginning of the step. The density is constant:
// below Mach 0.3 an isenthalpic one changes the drag by parts of a thousand.
#include <algorithm>
#include <cmath>
#include <utility>

#include "ripstop/flow/cartesian/solver.h"

namespace ripstop::inline flow::cartesian {
namespace {

constexpr double mixing_constant = 0.325;  // C_w, WALE with the linear schemes of a finite-volume code
/// The pressure correction of a step is solved to this share of its start. The rest is a mass imbalance that
/// the next step removes.
constexpr double reduction = 0.05;
constexpr int most_cycles = 12;
/// A step is kept while the Courant number is within this share of the given one, so that nearly all steps
/// are equal; a new one lies between.
constexpr double least_share = 0.75, new_share = 0.9;
constexpr double most_growth = 1.2;  // of a step over the last one

// Momentum that passes a row of faces across the stream: across x, y and the next y, three components each.
VectorView<double> across_stream(MarchRings& rings, const Layout& layout, int which) {
  double* p = &rings.scratch[Layout::lead + std::ptrdiff_t{3} * which * layout.stride_y];
  return {p, p + layout.stride_y, p + 2 * layout.stride_y};
}
// `which` of the low faces across y of row j.
int low_faces(int j) {
  return 1 + j % 2;
}

FaceWeights weights_of(const Axis& axis, int face) {
  FaceWeights weights;
  weights.low = axis.weight_low[face];
  if (face > 1) weights.ratio_low = axis.ratio_low[face];
  if (face < axis.n - 1) weights.ratio_high = axis.ratio_high[face];
  weights.inverse_distance = axis.inverse_distance[face];
  return weights;
}

/// Beyond it the extrapolated stress of the air's own viscosity is unstable [s]; no limit but on tiny cells.
double longest_viscous_step(const Discretisation& d) {
  const auto steepest = [](const Axis& axis) {
    const double inverse = *std::max_element(axis.inverse_width.begin(), axis.inverse_width.end());
    return inverse * inverse;
  };
  return 0.2 * d.air.density / d.air.viscosity / (steepest(d.x) + steepest(d.y) + steepest(d.z));
}

}  // namespace

void Solver::begin_time() {
  for (Array<double>* rate : {&s_.rate_u, &s_.rate_v, &s_.rate_w}) *rate = Array<double>(d_.layout.values());
  s_.correction = Array<float>(d_.layout.values());
  std::fill(s_.f.rho.begin(), s_.f.rho.end(), d_.air.density);
  if (modelled()) {
    for (int k = 0; k < d_.grid.nz; ++k) {
      for (int j = 0; j < d_.grid.ny; ++j) {
        const std::ptrdiff_t at = d_.layout.at(0, j, k);
        unresolved_row(d_.grid.nx, d_.x.width.data(), std::max(d_.y.width[j], d_.z.width[k]), &s_.f.omega[at],
                       &s_.f.k[at]);
      }
      turbulence_ghosts(d_, b_, s_, k);
    }
  }
  const Clock before = std::exchange(s_.clock, {});
  s_.clock.changing = before.changing, s_.clock.stream = before.stream, s_.clock.gaining = before.gaining;
}

// The box moves with a decelerating body: the acceleration of the stream acts on all air in it.
void Solver::stream(Vec3 velocity, Vec3 acceleration) {
  s_.clock.changing = true;
  s_.clock.stream = velocity, s_.clock.gaining = acceleration;
}

void Solver::let_stream_in() {
  Inlet& inlet = b_.inlet;
  std::fill(inlet.w.begin(), inlet.w.end(), s_.clock.stream.z);
  inlet.stream.velocity = s_.clock.stream, inlet.mean_speed = s_.clock.stream.z;
}

double Solver::longest_step(double courant_number) {
  t_.in_time = true;
  t_.fastest.resize(d_.grid.nz);
  if (s_.rate_u.empty()) begin_time();
  if (s_.clock.steps == 0) {
    for (int k = 0; k < d_.grid.nz; ++k) courant(k);
    s_.clock.courant_rate = *std::max_element(t_.fastest.begin(), t_.fastest.end()) / d_.air.density;
  }
  return std::min(courant_number / s_.clock.courant_rate, longest_viscous_step(d_));
}

double Solver::next_step(double courant_number) {
  const double longest = longest_step(courant_number), before = s_.clock.step;
  if (before <= longest && before >= least_share * longest) return before;
  const double wanted = new_share * longest;
  return s_.clock.steps > 0 ? std::min(wanted, most_growth * before) : wanted;
}

FlowStep Solver::step(double length) {
  longest_step(1);  // begins, where nothing has
  if (t_.mixing.empty()) {
    for (const double width : d_.x.width) t_.mixing.push_back(std::cbrt(width * width));
  }
  if (t_.density.empty()) t_.density.assign(t_.zeros.size(), d_.air.density);
  const double inverse = uniform() ? length / d_.air.density : 0;
  if (inverse > 0 && t_.all_inverse != inverse) {
    for (Array<double>* all : {&t_.ra, &t_.rc}) std::fill(all->begin(), all->end(), inverse);
  }
  t_.all_inverse = inverse;
  const double ratio = s_.clock.steps > 0 ? length / s_.clock.step : 0;
  s_.clock.step = length;
  t_.now = 1 + 0.5 * ratio, t_.before = 0.5 * ratio;
  if (s_.clock.changing) {  // such that the extrapolated rate is the acceleration of the stream in this step
    const auto of_now = [&](double gaining, double pulled) {
      return (gaining + t_.before * pulled) / t_.now;
    };
    Vec3& pulled = s_.clock.pulled;
    const Vec3 gaining = s_.clock.gaining;
    pulled = {of_now(gaining.x, pulled.x), of_now(gaining.y, pulled.y), of_now(gaining.z, pulled.z)};
    t_.pull_u.assign(t_.zeros.size(), d_.air.density * pulled.x);
    t_.pull_v.assign(t_.zeros.size(), d_.air.density * pulled.y);
    t_.pull_w.assign(t_.zeros.size(), d_.air.density * pulled.z);
  }
  SheetRows& sheets = in_the_way_.sheets;
  if (!sheets.empty()) sheets.update(s_, d_.layout, d_.air.density * d_.air.speed(), length);
  if (modelled() && !sheets.empty() && in_the_way_.wall.empty())
    in_the_way_.wall = sheets.distance(d_.x, d_.y, d_.z, d_.layout, &team_);
  const Vec3 velocity_before{s_.mean.u, s_.mean.v, s_.mean.w};
  const Vec3 brought_before = std::exchange(s_.clock.brought, momentum_carried_in(d_, b_, s_));
  const Vec3 held_in = pressed_in(d_, b_, s_, true);  // by pressures as the step has them
  team_.run([this](int rank) {
    each_block(rank, [&](IndexRange rows) { rates(rank, rows); });
    if (modelled()) {
      if (rank == 0) take_new_turbulence();
      team_.barrier();
      each_plane(rank, [&](int k) { turbulence_ghosts(d_, b_, s_, k); });
    }
    if (s_.clock.changing) {  // rates are those of the beginning of the step
      if (rank == 0) let_stream_in();
      team_.barrier();
    }
    each_plane(rank, [&](int k) { matrix_ghosts(k); });
    each_row(rank, [&](int j, int k) { pressure(j, k); });
    // A wake changes little in a step: most of the last one's correction comes again.
    multigrid_.solve_conjugate(team_, rank, reduction, most_cycles, &s_.correction);
    each_plane(rank, [&](int k) { correction_ghosts(d_, b_, multigrid_.finest().e, k); });
    each_row(rank, [&](int j, int k) { flux(j, k); });
    each_row(rank, [&](int j, int k) { velocity(j, k); });
    each_plane(rank, [&](int k) { relax_pressure(k), velocity_ghosts(d_, b_, s_, k), courant(k); });
    t_.sums.add_up(team_, rank);
  });
  const Vec3 brought_now = t_.now * s_.clock.brought - t_.before * brought_before;
  return close_step(velocity_before, -held_in - brought_now);
}

// A block from the inlet to the outlet. Each face along the stream is taken once, a plane ahead of the cells.
void Solver::rates(int rank, IndexRange rows) {
  MarchRings& rings = t_.rings[rank];
  eddies(rings, 0, rows);
  pass_along_stream(rings, 0, rows);
  for (int k = 0; k < d_.grid.nz; ++k) {
    if (k + 1 < d_.grid.nz) eddies(rings, k + 1, rows);
    pass_along_stream(rings, k + 1, rows);
    pass_in_plane(rings, k, rows);
  }
}

// The block's rows and one more on each side, as far as the grid goes.
void Solver::eddies(MarchRings& rings, int k, IndexRange rows) {
  if (modelled()) return model_eddies(rings, k, rows);
  for (int j = std::max(rows.begin - 1, 0); j < std::min(rows.end + 1, d_.grid.ny); ++j) {
    const std::ptrdiff_t at = d_.layout.at(0, j, k), in = rings.at(d_.layout, j, rows.begin);
    EddyRow r;
    r.m = d_.metrics(j, k);
    r.viscosity = d_.air.viscosity, r.density = d_.air.density;
    const double across = d_.y.width[j] * d_.z.width[k];
    r.along = t_.mixing.data();
    const bool none = d_.settings.small_eddies == SmallEddies::none;
    r.across = none ? 0 : mixing_constant * mixing_constant * std::cbrt(across * across);
    r.velocity = s_.f.velocity(at);
    r.mu = rings.mu.row(k, in);
    r.stress = rings.stress(k, in);
    eddy_row(r);
  }
}

/// Data of row j for faces of all axes.
PassingRow Solver::passing_of(MarchRings& rings, int j, int k, IndexRange rows) const {
  PassingRow r;
  r.count = d_.grid.nx;
  r.velocity = s_.f.velocity(d_.layout.at(0, j, k));
  r.mu = r.mu_low = rings.mu.row(k, rings.at(d_.layout, j, rows.begin));
  r.component = rings.component;
  return r;
}

// Through the low faces of plane k; plane nz has the outlet's.
void Solver::pass_along_stream(MarchRings& rings, int k, IndexRange rows) const {
  const std::ptrdiff_t sz = d_.layout.stride_z;
  for (int j = rows.begin; j < rows.end; ++j) {
    const std::ptrdiff_t at = d_.layout.at(0, j, k), in = rings.at(d_.layout, j, rows.begin);
    const VectorView<double> passing = rings.predicted(k, in);
    const double* flux = &s_.f.fz[at];
    if (k == 0 && !b_.open()) {
      std::fill_n(passing.x, d_.grid.nx, 0.0), std::fill_n(passing.y, d_.grid.nx, 0.0);
      for (int i = 0; i < d_.grid.nx; ++i) passing.z[i] = flux[i] * b_.inlet.speed(j)[i];
      continue;
    }
    PassingRow r = passing_of(rings, j, k, rows);
    r.flux = flux, r.step = sz, r.far_low = -2 * sz, r.far_high = sz;
    r.passing = passing;
    if (k == 0 || k == d_.grid.nz) {
      boundary_passing_row(r);
      continue;
    }
    r.across = weights_of(d_.z, k);
    r.mu_low = rings.mu.row(k - 1, in);
    r.stress = rings.tz.row(k, in), r.stress_low = rings.tz.row(k - 1, in);
    passing_row(r);
  }
}

// Fluxes through the faces along x and y of plane k, and the sum in its cells.
void Solver::pass_in_plane(MarchRings& rings, int k, IndexRange rows) {
  const std::ptrdiff_t sy = d_.layout.stride_y;
  const auto across = [&](int j) {  // the low faces of row j
    PassingRow r = passing_of(rings, j, k, rows);
    const std::ptrdiff_t in = rings.at(d_.layout, j, rows.begin);
    r.passing = across_stream(rings, d_.layout, low_faces(j));
    r.flux = &s_.f.fy[d_.layout.at(0, j, k)], r.step = sy, r.far_low = -2 * sy, r.far_high = sy;
    if (j == 0 || j == d_.grid.ny) {
      boundary_passing_row(r);
      return side_stress_row(r, r.velocity.y, j == 0 ? r.mu : r.mu - sy,
                             d_.y.inverse_width[j == 0 ? 0 : j - 1], r.passing.y);
    }
    r.across = weights_of(d_.y, j);
    r.mu_low = r.mu - sy;
    r.stress = rings.ty.row(k, in), r.stress_low = r.stress - sy;
    passing_row(r);
  };
  across(rows.begin);
  for (int j = rows.begin; j < rows.end; ++j) {
    across(j + 1);
    PassingRow r = passing_of(rings, j, k, rows);
    const std::ptrdiff_t in = rings.at(d_.layout, j, rows.begin);
    r.count = d_.grid.nx + 1;
    r.along = &d_.x;
    r.flux = &s_.f.fx[d_.layout.at(0, j, k)], r.step = 1, r.far_low = -2, r.far_high = 1;
    r.mu_low = r.mu - 1;
    r.stress = rings.tx.row(k, in), r.stress_low = r.stress - 1;
    r.passing = across_stream(rings, d_.layout, 0);
    passing_row(r);
    rate(rings, j, k, rows);
  }
}

void Solver::rate(MarchRings& rings, int j, int k, IndexRange rows) {
  const std::ptrdiff_t at = d_.layout.at(0, j, k), in = rings.at(d_.layout, j, rows.begin);
  const double* zeros = &t_.zeros[Layout::lead];
  const VectorView<double> x = across_stream(rings, d_.layout, 0),
                           y = across_stream(rings, d_.layout, low_faces(j)),
                           north = across_stream(rings, d_.layout, low_faces(j + 1)),
                           z = rings.predicted(k, in), above = rings.predicted(k + 1, in);
  RateRow r;
  r.m = d_.metrics(j, k);
  r.u = {x.x, y.x, north.x, z.x, above.x};
  r.v = {x.y, y.y, north.y, z.y, above.y};
  r.w = {x.z, y.z, north.z, z.z, above.z};
  const auto force = [&](const Array<double>& pull, const Array<double>& body) {
    return !pull.empty() ? &pull[Layout::lead] : body.empty() ? zeros : &body[at];
  };
  r.force = {force(t_.pull_u, in_the_way_.body_u), force(t_.pull_v, in_the_way_.body_v),
             force(t_.pull_w, in_the_way_.body_w)};
  r.velocity = s_.f.velocity(at), r.rho = density_of_row(j, k);
  r.resistance = in_the_way_.porous.at(j, k);
  r.inverse_step = 1 / s_.clock.step;
  r.now = t_.now, r.before = t_.before;
  r.rate = row_of(s_.rate_u, s_.rate_v, s_.rate_w, at);
  r.matrix = t_.matrix(at);
  r.uniform = uniform();
  rate_row(r);
}

// The fastest cell of plane k, and the mass that its cells do not pass on.
void Solver::courant(int k) {
  t_.fastest[k] = 0;
  for (int j = 0; j < d_.grid.ny; ++j) {
    const CourantSums sum = courant_row(d_.metrics(j, k), s_.f.flux(d_.layout.at(0, j, k)));
    t_.fastest[k] = std::max(t_.fastest[k], sum.largest);
    t_.sums.row(j, k)[Sums::mass_defect] = sum.defect * d_.y.width[j] * d_.z.width[k];
  }
}

// `held_back`: momentum that the air and the faces with fixed pressure take from the box in this step.
FlowStep Solver::close_step(Vec3 velocity_before, Vec3 held_back) {
  const Sums& sum = t_.sums.total();
  const double volume = d_.grid.size.x * d_.grid.size.y * d_.grid.size.z;
  const auto mean = [&](Sums::Name name) { return sum.value[name] / volume; };
  s_.mean.u = mean(Sums::u_mean), s_.mean.v = mean(Sums::v_mean), s_.mean.w = mean(Sums::w_mean);
  s_.mean.p = mean(Sums::p_mean);
  s_.force = {sum.value[Sums::drag_x], sum.value[Sums::drag_y], sum.value[Sums::drag_z]};
  in_the_way_.sheets.settle(s_);
  for (const SheetLoad& load : in_the_way_.sheets.loads(s_, d_.layout)) s_.force += load.force;
  s_.untouched = false;
  Clock& clock = s_.clock;
  FlowStep step;
  step.courant = clock.courant_rate * clock.step;
  ++clock.steps;
  clock.time += clock.step;
  clock.courant_rate = *std::max_element(t_.fastest.begin(), t_.fastest.end()) / d_.air.density;
  step.step = static_cast<int>(clock.steps);
  step.time = clock.time, step.length = clock.step;
  step.force = s_.force;
  const Vec3 size = d_.grid.size, stream = d_.air.velocity;
  step.mass_defect = sum.value[Sums::mass_defect] / (d_.air.density * std::abs(stream.z) * size.x * size.y +
                                                     d_.air.density * std::abs(stream.x) * size.y * size.z +
                                                     d_.air.density * std::abs(stream.y) * size.x * size.z);
  const double mass = d_.air.density * volume;
  const Vec3 velocity{s_.mean.u, s_.mean.v, s_.mean.w}, pressed = pressed_in(d_, b_, s_, false);
  const auto gap = [&](double Vec3::*a) {
    const double gained = mass * (velocity.*a - velocity_before.*a) / clock.step,
                 pulled = mass * clock.gaining.*a;
    return s_.force.*a + gained + held_back.*a - pressed.*a - pulled;
  };
  step.momentum_gap = {gap(&Vec3::x), gap(&Vec3::y), gap(&Vec3::z)};
  return step;
}

}  // namespace ripstop::inline flow::cartesian
