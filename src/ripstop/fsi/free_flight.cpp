#include "ripstop/fsi/free_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "ripstop/core/angle.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flight/point_mass.h"
#include "ripstop/fsi/lines_apart.h"
#include "ripstop/fsi/opening_cloth.h"

namespace ripstop::inline fsi {
namespace {

// The box follows the canopy as a critically damped spring would, at this rate times speed over size of the canopy. A
// swing takes some ten of these times, and the canopy stays within a tenth of its displacement.
constexpr double follow_rate = 3;
// Longest step of the flow: of the time in which the stream passes a canopy's diameter.
constexpr double longest_share = 0.02;
// Below this share of the mouth's area at the start, for so long [s], a canopy counts as collapsed.
constexpr double collapsed_share = 0.25, collapsed_for = 0.5;
constexpr double turned_over = 90;  // [deg]
constexpr double deployment_swing =
    30;  // beyond the direction of the deployment, and below `turned_over` [deg]

std::vector<int> nodes_of_patches(const Mesh& mesh) {
  std::vector<char> used(mesh.mass.size(), 0);
  for (const Cell& cell : cells_of(mesh))
    if (cell.corner[0] >= 0)
      for (const int node : cell.corner) used[node] = 1;
  std::vector<int> nodes;
  for (std::size_t n = 0; n < used.size(); ++n)
    if (used[n]) nodes.push_back(static_cast<int>(n));
  return nodes;
}

Vec3 centroid(const std::vector<int>& nodes, const std::vector<Vec3>& x) {
  Vec3 sum;
  for (const int n : nodes) sum += x[n];
  return sum / double(nodes.size());
}

/// Of all canopies, each the magnitude of its area vector.
double mouth_area(const std::vector<double>& mouths) {
  return std::accumulate(mouths.begin(), mouths.end(), 0.0);
}

/// v turned by `angle` [rad] about the unit vector `axis` (Rodrigues).
Vec3 turned(Vec3 v, Vec3 axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + (1 - std::cos(angle)) * dot(axis, v) * axis;
}

// Dampers of a Kelvin-Voigt solid take this share of critical from a vibration at the highest frequency of the mesh,
// 2 / (stable step). Without it symplectic Euler feeds energy into springs that alternate between slack and taut. A
// swing or a breathing canopy, a thousand times slower, loses nothing.
constexpr double grid_damping = 0.25;

/// Damping time of springs at the start shape [s].
double damping_time(const Mesh& mesh, const FlightProblem& problem) {
  const ClothPtr undamped = make_cloth(mesh, {problem.linear, 0, 0});
  ClothState state = start_state(*undamped);
  set_positions(state, *undamped, problem.shape);
  return grid_damping * stability_limit(*undamped, state).stable_step;
}

/// Of an opening its z axis points against the path of the payload, which lies in the plane of x and z.
BoxAxes axes_of(const FlightProblem& problem) {
  if (!problem.from) return {};
  const double level = std::cos(problem.from->angle), down = std::sin(problem.from->angle);
  return {{down, 0, level}, {0, 1, 0}, {-level, 0, down}};
}

FlightProblem with_shape(FlightProblem problem) {
  if (problem.from) problem.shape = problem.from->shape, problem.pressure = problem.from->pressure;
  return problem;
}

CanopyMesh flying_mesh(const FlightProblem& problem) {
  CanopyMesh mesh = problem.mesh;
  if (!(problem.payload_mass > 0))
    throw QuantityError(ExitCode::usage, "a flight needs a payload: its mass is not given",
                        {"mass of the payload"});
  if (mesh.fixed.size() != 1)
    throw Error(ExitCode::usage,
                fmt::format("a flight needs one confluence or one end of the riser, which is "
                            "the payload; this parachute has {} fixed nodes",
                            mesh.fixed.size()));
  mesh.mass[mesh.fixed[0]] += problem.payload_mass;
  mesh.fixed.clear();
  const double time = damping_time(mesh, problem);
  damp_springs(mesh, std::max(time, problem.cloth.line_damping_s),
               std::max(time, problem.cloth.cloth_damping_s.value_or(0)));
  return mesh;
}

ClothPtr flying_cloth(CanopyMesh& mesh, const FlightProblem& problem) {
  ClothOptions options{problem.linear, 0, 0};
  const InflationSettings& s = problem.cloth;
  if (s.contact_pa > 0)
    options.contact =
        ContactOptions{s.contact_pa, s.contact_friction, problem.from ? problem.from->folded : problem.shape};
  limit_viscosity(mesh, options, problem.shape, s.cloth_damping_step_share);
  return make_cloth(mesh, options);
}

/// Cells of equal width.
Extent fine_cells(const FlowGrid& grid) {
  Extent fine;
  for (int axis = 0; axis < 3; ++axis) {
    const Grading& g = grid.grading[axis];
    const bool graded = g.before > 0 || g.after > 0;
    fine.low[axis] = graded ? g.core_low : grid.edge(axis, 0);
    fine.high[axis] = graded ? g.core_high : grid.edge(axis, grid.count(axis));
  }
  return fine;
}

/// Between the speed of the opening's end and that of the descent [m/s].
double slowest(const FlightProblem& problem) {
  return problem.descent_speed > 0 ? problem.descent_speed : problem.air.flow.air.speed();
}
double fastest(const FlightProblem& problem) {
  return std::max(slowest(problem), problem.from ? problem.from->speed : 0);
}

}  // namespace

FreeFlight::FreeFlight(FlightProblem problem)
    : problem_(with_shape(std::move(problem))),
      axes_(axes_of(problem_)),
      gravity_(axes_.in_box({0, 0, -problem_.gravity})),
      team_(problem_.threads),
      mesh_(flying_mesh(problem_)),
      payload_(problem_.mesh.fixed[0]),
      canopy_(nodes_of_patches(mesh_)),
      home_(centroid(canopy_, problem_.shape)),
      fine_(fine_cells(problem_.air.flow.grid)),
      row_(problem_.air.flow.air.speed() / fastest(problem_) / least_rows_in(problem_.air.flow)),
      cloth_(flying_cloth(mesh_, problem_)),
      stepper_(AdaptiveStepper::Step::renewed, problem_.cloth.step_fraction, row_, team_),
      air_(std::make_unique<CoupledFlow>(problem_.air, mesh_, &team_)) {
  for (const double m : mesh_.mass) mass_ += m;
  const std::vector<FlowBody>& bodies = problem_.air.flow.bodies;
  if (bodies.size() > 1) {
    if (!problem_.from) require_lines_apart(mesh_, problem_.shape, bodies);
    bodies_ = CarriedBodies(bodies, pose(problem_.shape));
  }
  mouth_share_ = mouths(mesh_.start);
  const double as_cut = mouth_area(mouth_share_);
  for (double& share : mouth_share_) share /= as_cut;
  const double of_one = mouth_area(mouths(problem_.shape)) / canopies();
  const double diameter = std::sqrt(of_one * 4 / std::numbers::pi);
  follow_ = follow_rate * fastest(problem_) / diameter;
  longest_step_ = longest_share * diameter / slowest(problem_);
}

/// At a place in the box and a time since the start of the flight.
Vec3 FreeFlight::wind_in_box(Vec3 place, double time) const {
  return axes_.in_box(wind_velocity(problem_.settings.wind, axes_.over_ground(place).z, began() + time));
}

double FreeFlight::start_height() const {
  return problem_.settings.height_m.value_or(0) - (problem_.from ? problem_.from->fallen : 0);
}

void FreeFlight::release(FreeFlightState& state) const {
  const FlightSettings& s = problem_.settings;
  const double azimuth = s.azimuth_deg * degree;
  // The payload is displaced towards the azimuth: the parachute turns about the canopy.
  const Vec3 axis{std::sin(azimuth), -std::cos(azimuth), 0};
  std::vector<Vec3> x = problem_.shape, v(x.size());
  Vec3 middle;  // of all mass
  for (Vec3& p : x) p = home_ + turned(p - home_, axis, s.angle_deg * degree);
  for (std::size_t n = 0; n < x.size(); ++n) middle += (mesh_.mass[n] / mass_) * x[n];
  for (std::size_t n = 0; n < x.size(); ++n) v[n] = cross(s.swing_deg_s * degree * axis, x[n] - middle);
  set_positions(state.coupled.cloth, *cloth_, x);
  set_velocities(state.coupled.cloth, *cloth_, v);
  state.box = Vec3{0, 0, start_height()} - x[payload_];
  const Vec3 wind = wind_in_box(state.box + home_, 0);
  state.box_velocity = s.velocity_m_s.value_or(wind - problem_.air.flow.air.velocity);
  if (!problem_.pressure.empty()) {
    state.coupled.air.pressure = problem_.pressure;
    state.coupled.air.force.assign(x.size(), {});
  }
}

// Positions, velocities, loads of the air and the velocity of the payload through the air continue.
void FreeFlight::continue_opening(FreeFlightState& state) const {
  const OpeningEnd& end = *problem_.from;
  set_positions(state.coupled.cloth, *cloth_, end.shape);
  set_velocities(state.coupled.cloth, *cloth_, end.velocity);
  state.box = axes_.in_box({end.distance, 0, start_height()}) - end.shape[payload_];
  state.box_velocity = wind_in_box(state.box + home_, 0) - Vec3{0, 0, end.speed};
  state.coupled.record.peak_tension = end.peak_tension, state.coupled.highest_stress = end.highest_stress;
  state.coupled.air.pressure = end.pressure, state.coupled.air.force = end.force;
}

FreeFlightState FreeFlight::start() {
  FreeFlightState state;
  ClothState& cloth = state.coupled.cloth;
  cloth = start_state(*cloth_);
  if (problem_.from)
    continue_opening(state);
  else
    release(state);
  state.coupled.step = stepper_.allowed_step(state.coupled, *cloth_);
  state.stream = wind_in_box(state.box + home_, 0) - state.box_velocity;
  state.kinetic_at_start = kinetic_energy(*cloth_, cloth);
  state.elastic_at_start = elastic_energy(*cloth_, cloth);
  state.momentum_at_start = momentum(*cloth_, cloth) + mass_ * state.box_velocity;
  state.mouth_at_start = mouth_area(mouths(positions(cloth, *cloth_)));
  // The predictor of the first step has the inertia of this box, not that of the opening's.
  if (problem_.from) {
    const Vec3 on_mass = gravity_ - box_acceleration(state);
    for (const double m : mesh_.mass) state.coupled.air.other.push_back(m * on_mass);
  }
  return state;
}

// a_b = f^2 (x_c - home) + 2 f v_c: in the box the canopy moves as on a critically damped spring.
Vec3 FreeFlight::box_acceleration(const FreeFlightState& state) const {
  const Vec3 away = centroid(canopy_, positions(state.coupled.cloth, *cloth_)) - home_,
             rate = centroid(canopy_, velocities(state.coupled.cloth, *cloth_));
  return follow_ * follow_ * away + 2 * follow_ * rate;
}

Surroundings FreeFlight::surroundings(const FreeFlightState& state, double length) const {
  const Vec3 accelerates = box_acceleration(state);
  const double time = state.coupled.cloth.time;
  Surroundings s;
  s.moves = true;
  s.stream = wind_in_box(state.box + home_ + length * state.box_velocity, time + length) -
             (state.box_velocity + length * accelerates);
  s.gained = (s.stream - state.stream) / length;
  s.on_mass = gravity_ - accelerates;
  s.rigid = place_bodies(state, length);
  const double fallen =
      problem_.settings.height_m.value_or(0) - axes_.over_ground(state.box + problem_.shape[payload_]).z;
  if (problem_.density_ratio) s.density_ratio = problem_.density_ratio(fallen);
  if (problem_.payload_drag_area > 0) {
    const Vec3 place = positions(state.coupled.cloth, *cloth_)[payload_],
               moves = velocities(state.coupled.cloth, *cloth_)[payload_];
    s.node = payload_;
    s.force = drag_force(state.box_velocity + moves - wind_in_box(state.box + place, time),
                         problem_.air.flow.air.density * s.density_ratio, problem_.payload_drag_area);
  }
  return s;
}

void FreeFlight::check_cells(const std::vector<Vec3>& x, double time) const {
  const auto outside = [&](int axis, double at) { return at < fine_.low[axis] || at > fine_.high[axis]; };
  for (const int n : canopy_) {
    const Vec3 p = x[n];
    if (!outside(0, p.x) && !outside(1, p.y) && !outside(2, p.z)) continue;
    throw QuantityError(
        ExitCode::not_converged,
        fmt::format(
            "t = {:.4g} s: the canopy has left the fine cells of the flow, which follow it: a point of "
            "it is at ({:.3g}, {:.3g}, {:.3g}) m from its mean position. It has turned over or collapsed, "
            "or the region of fine cells is too small{}",
            time, p.x - home_.x, p.y - home_.y, p.z - home_.z,
            canopies() > 1 ? "; increase the widest spread angle" : ""),
        {"region of fine cells", "the widest spread angle"});
  }
}

CarriedBodies::Pose FreeFlight::pose(const std::vector<Vec3>& x) const {
  const Vec3 line = centroid(mesh_.rigging.skirt_nodes, x) - x[payload_];
  return {x[payload_], line / norm(line)};
}

std::vector<Placement> FreeFlight::place_bodies(const FreeFlightState& state, double length) const {
  if (bodies_.empty()) return {};
  const std::vector<Vec3> x = positions(state.coupled.cloth, *cloth_),
                          v = velocities(state.coupled.cloth, *cloth_);
  std::vector<Vec3> next = x;
  for (std::size_t n = 0; n < x.size(); ++n) next[n] += length * v[n];
  std::vector<Placement> placed = bodies_.placed(pose(x), pose(next), length);
  const FlowGrid& grid = air_->grid();
  for (const Placement& body : placed) {
    const Extent e = extent_of(body.surface);
    for (int axis = 0; axis < 3; ++axis) {
      const double low = grid.edge(axis, 0), high = grid.edge(axis, grid.count(axis));
      if (e.low[axis] >= low && e.high[axis] <= high) continue;
      throw QuantityError(
          ExitCode::not_converged,
          fmt::format(
              "t = {:.4g} s: the body \"{}\" has left the flow domain, which follows the canopy: it "
              "extends from {} = {:.3g} to {:.3g} m, the domain from {:.3g} to {:.3g} m; increase the "
              "size of the domain",
              began() + state.coupled.cloth.time, problem_.air.flow.bodies[body.body].name, "xyz"[axis],
              e.low[axis], e.high[axis], low, high),
          {"the size of the domain"});
    }
  }
  return placed;
}

std::vector<Placement> FreeFlight::bodies(const FreeFlightState& state) const {
  const CarriedBodies::Pose now = pose(positions(state.coupled.cloth, *cloth_));
  return bodies_.placed(now, now, 1);
}

/// From places and vectors in the box at `box`.
std::vector<FlightBodyRow> FreeFlight::over_ground(std::vector<FlightBodyRow> rows, Vec3 box,
                                                   double time) const {
  for (FlightBodyRow& row : rows) {
    row.time = time;
    row.force = axes_.over_ground(row.force), row.moment = axes_.over_ground(row.moment);
    row.aft = axes_.over_ground(box + row.aft);
  }
  return rows;
}

FreeFlightRow FreeFlight::row_of(const FreeFlightState& state, const std::vector<Vec3>& x,
                                 const std::vector<Vec3>& v) const {
  FreeFlightRow row;
  row.time = began() + state.coupled.cloth.time;
  row.payload = axes_.over_ground(state.box + x[payload_]);
  row.velocity = axes_.over_ground(state.box_velocity + v[payload_]);
  row.canopy = axes_.over_ground(state.box + centroid(canopy_, x));
  const Vec3 line = axes_.over_ground(centroid(mesh_.rigging.skirt_nodes, x) - x[payload_]);
  row.angle = std::atan2(std::hypot(line.x, line.y), line.z) / degree;
  row.tilt_x = std::atan2(line.x, line.z) / degree, row.tilt_y = std::atan2(line.y, line.z) / degree;
  row.stream = axes_.over_ground(state.stream);
  row.wind = axes_.over_ground(state.stream + state.box_velocity);
  const Vec3 relative = axes_.over_ground(state.stream - centroid(canopy_, v));
  row.attack = std::atan2(norm(cross(line, relative)), dot(line, relative)) / degree;
  row.mouth_area = mouth_area(mouths(x));
  return row;
}

FreeFlightRow FreeFlight::advance(FreeFlightState& state) {
  InflationState& coupled = state.coupled;
  const double time = coupled.cloth.time;
  const double longest = std::min(sound_step(*air_, row_, time), longest_step_);
  const int rows = std::max(1, static_cast<int>(longest / row_));
  const double length = rows * row_;
  const std::vector<Vec3> v_before = velocities(coupled.cloth, *cloth_);
  const CarriedBodies::Pose pose_before = pose(positions(coupled.cloth, *cloth_));
  const Vec3 box_before = state.box;
  const Surroundings around = surroundings(state, length);

  const CoupledStep taken =
      take_coupled_step(*air_, stepper_, *cloth_, {state.rows, rows, rows}, around, team_, coupled);
  state.rows += rows;

  // The box moves on with the acceleration of this step.
  const Vec3 accelerates = gravity_ - around.on_mass;
  state.box += length * state.box_velocity + (0.5 * length * length) * accelerates;
  state.box_velocity += length * accelerates;
  state.stream = around.stream;
  const Vec3 on_canopy = taken.flow.force - force_on_others(taken.flow.bodies);
  state.impulse += length * (on_canopy + around.force + mass_ * gravity_);

  const std::vector<Vec3> x = positions(coupled.cloth, *cloth_), v = velocities(coupled.cloth, *cloth_);
  check_cells(x, began() + coupled.cloth.time);
  FreeFlightRow row = row_of(state, x, v);
  row.air_force = on_canopy;
  row.payload_drag = norm(around.force);
  // The force of lines and riser is the remaining change of the payload's momentum, averaged over the step.
  const double m = mesh_.mass[payload_];
  row.line_force = (m / length) * (v[payload_] - v_before[payload_]) - m * around.on_mass - around.force;
  row.step = length, row.courant = taken.flow.courant;
  if (!bodies_.empty()) {
    const Vec3 gains = (v[payload_] - v_before[payload_]) / length;
    const BodiesInStep step{
        taken.flow.bodies, around.stream - v[payload_], air_->density(), around.gained, gains, fine_};
    row.bodies = over_ground(bodies_.rows(pose_before, around.rigid, step), box_before, row.time);
  }
  row.residual_traction = taken.residual_traction;
  row.momentum_gap = norm(taken.flow.momentum_gap), row.mass_defect = taken.flow.mass_defect;
  // A canopy that has just opened may still grow.
  if (problem_.from) state.mouth_at_start = std::max(state.mouth_at_start, row.mouth_area);
  if (const std::vector<double> open = open_shares(x);
      *std::min_element(open.begin(), open.end()) >= collapsed_share * state.mouth_at_start)
    state.collapsed_since = -1;
  else if (state.collapsed_since < 0)
    state.collapsed_since = row.time;
  if (row.angle < turned_over - deployment_swing) state.upright = true;
  return row;
}

std::string FreeFlight::failure(const FreeFlightState& state, const FreeFlightRow& row) const {
  // The canopy of a payload that is deployed along the horizon begins next to it, and then swings up.
  double limit = turned_over;
  if (problem_.from && !state.upright)
    limit = std::max(limit, turned_over - problem_.from->angle / degree + deployment_swing);
  if (row.angle > limit) return fmt::format("the parachute turned over at {:.4g} s", row.time);
  if (state.collapsed_since >= 0 && row.time - state.collapsed_since > collapsed_for) {
    if (canopies() == 1) return fmt::format("the canopy collapsed at {:.4g} s", state.collapsed_since);
    const std::vector<double> open = open_shares(positions(state.coupled.cloth, *cloth_));
    const auto number = std::min_element(open.begin(), open.end()) - open.begin() + 1;
    return fmt::format("canopy {} of the cluster collapsed at {:.4g} s", number, state.collapsed_since);
  }
  return "";
}

/// Mouth of each canopy over its share in all mouths [m2].
std::vector<double> FreeFlight::open_shares(const std::vector<Vec3>& x) const {
  std::vector<double> open = mouths(x);
  for (std::size_t k = 0; k < open.size(); ++k) open[k] /= mouth_share_[k];
  return open;
}

std::vector<CanopyRow> FreeFlight::canopy_rows(const FreeFlightState& state) const {
  std::vector<CanopyRow> rows = ripstop::canopy_rows(mesh_, *cloth_, state.coupled.cloth, payload_);
  for (CanopyRow& row : rows) row.time += began();
  return rows;
}

FreeFlight::Balance FreeFlight::balance(const FreeFlightState& state, const FreeFlightRow& row) const {
  const ClothState& cloth = state.coupled.cloth;
  const double work = state.coupled.record.pressure_work + state.coupled.air.work;
  const double left = work + state.kinetic_at_start + state.elastic_at_start -
                      kinetic_energy(*cloth_, cloth) - elastic_energy(*cloth_, cloth) -
                      state.coupled.record.damped;
  const Vec3 now = momentum(*cloth_, cloth) + mass_ * state.box_velocity;
  const double weight = mass_ * problem_.gravity, fallen = start_height() - row.payload.z;
  return {left / (weight * std::max(fallen, 1e-3)),
          norm(now - state.momentum_at_start - state.impulse) / (weight * cloth.time)};
}

}  // namespace ripstop::inline fsi
