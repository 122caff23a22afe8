#include "ripstop/fsi/steady.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "ripstop/canopy/section_balance.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/steady.h"
#include "ripstop/fsi/approach.h"

namespace ripstop {
namespace {

// The drag has settled when it moved by less than this within one piece of the flow's solution: half the
// default tolerance on the drag's change from one coupling iteration to the next.
constexpr double settled = 5e-4;
// Largest relative gap between fluid force, nodal load and line tension at convergence; and, where the flow
// is a mean over iterations that did not converge, to the momentum that the box loses: a wake that still
// grows keeps some of it.
constexpr double ledger_tolerance = 0.01;
// Largest RelaxResult::regularisation_share at convergence: half of what the staircase of the flow's cells leaves over in the load.
constexpr double held_tolerance = 0.02;

// A flow that does not come to rest, jets through slots, answers the same shape now so, now so. When after so many
// iterations the drag still changes by more than the time before, answers are no longer extrapolated but averaged.
constexpr int accelerated = 5;

// Slack cloth under the pressures of a shape that it has left may find no equilibrium: a loose edge turns over and over.
// The air would give way to it. After so many steps the cloth is held to the last shape instead, by as much per metre as
// is asked for here, in mean pressures over the root of the cloth's area; as the loop comes to rest that force vanishes.
constexpr int steps_unheld = 40000;
constexpr double first_hold = 3, strongest_hold = 48, stronger = 4;
// In time a watch costs more than the cloth: where that is held too much, it is held to where it came, and so on, so often
// at most, before the next one.
constexpr int steps_in_hold = 4;

// The cloth goes after the mean load in watches of a third of the length and certainty that are asked for. Once it
// stands, one of the whole follows.
constexpr double short_watch = 1.0 / 3;

double largest_coefficient(const Mesh& mesh) {
  double largest = 0;
  for (const Patch& patch : mesh.patches) {
    for (const SpringLaw& law : patch.law) {
      for (const double k : law.coefficients) largest = std::max(largest, std::abs(k));
    }
  }
  return largest;
}

/// Mean magnitude over the root of the cloth's area [Pa/m].
double pressure_per_width(const std::vector<double>& pressure, const std::vector<double>& area) {
  double sum = 0, whole = 0;
  for (std::size_t c = 0; c < area.size(); ++c) sum += std::abs(pressure[c]) * area[c], whole += area[c];
  return sum / std::pow(whole, 1.5);
}

bool within(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance * std::abs(b);
}

// Standard deviation of the means of all watches but the first, whose wake still had to form; 0 for fewer than three. A
// flow that drifts more slowly than a watch is long has each of them look surer than it is.
double scatter_of_means(const std::vector<SteadyIteration>& iterations, double now) {
  std::vector<double> means;
  for (const SteadyIteration& i : iterations)
    if (i.in_time) means.push_back(i.fluid_force);
  if (means.size() < 3) return 0;
  means.front() = now;
  double mean = 0, squares = 0;
  for (const double drag : means) mean += drag / double(means.size());
  for (const double drag : means) squares += (drag - mean) * (drag - mean);
  return std::sqrt(squares / double(means.size() - 1));
}

std::vector<double> joined(const ClothLoad& load) {
  const auto& [a, b] = load.remainder;
  std::vector<double> values = load.pressure;
  values.insert(values.end(), {a.x, a.y, a.z, b.x, b.y, b.z});
  return values;
}

}  // namespace

SteadySolver::SteadySolver(SteadyProblem problem, FlowEngine& engine)
    : problem_(std::move(problem)), flow_(engine.start(problem_.flow)), team_(problem_.settings.threads) {
  ClothOptions options;
  options.linear = problem_.settings.linear;
  cloth_ = make_cloth(problem_.mesh, options);
  cells_ = cells_of(problem_.mesh);
  for (const Patch& patch : problem_.mesh.patches) {
    area_.insert(area_.end(), patch.cell_area.begin(),
                 patch.cell_area.begin() + (patch.rows - 1) * patch.columns);
  }
  const FlowGrid& grid = problem_.flow.grid;
  const Vec3 far = grid.origin + grid.size;
  for (const Cell& cell : cells_) {
    for (const int node : cell.corner) {
      if (node < 0) continue;
      const Vec3 p = problem_.mesh.start[node];
      if (p.x < grid.origin.x || p.y < grid.origin.y || p.z < grid.origin.z || p.x > far.x || p.y > far.y ||
          p.z > far.z) {
        throw Error(
            ExitCode::usage,
            fmt::format("the canopy does not fit into the flow's box: cloth at ({:.3g}, {:.3g}, "
                        "{:.3g}) m, box from ({:.3g}, {:.3g}, {:.3g}) to ({:.3g}, {:.3g}, {:.3g}) m",
                        p.x, p.y, p.z, grid.origin.x, grid.origin.y, grid.origin.z, far.x, far.y, far.z));
      }
    }
  }
}

SteadyState SteadySolver::start() const {
  SteadyState state;
  state.shape = problem_.mesh.start;
  const Freestream& air = problem_.flow.air;
  state.pressure.assign(cells_.size(), 0.5 * air.density * air.speed * air.speed);
  state.accelerator.update = problem_.settings.acceleration;
  state.accelerator.relaxation = problem_.settings.relaxation;
  return state;
}

ClothState SteadySolver::cloth_state(const SteadyState& state) const {
  ClothState cloth = start_state(*cloth_);
  set_positions(cloth, *cloth_, state.shape);
  return cloth;
}

bool SteadySolver::finished(const SteadyState& state) const {
  return state.converged || static_cast<int>(state.iterations.size()) >= problem_.settings.max_iterations;
}

FlowField SteadySolver::solve_flow(const std::vector<Triangle>& surface, bool to_the_end, int iteration,
                                   const SteadyReport& report) {
  Stopping stopping = problem_.flow.stopping;
  if (!to_the_end) stopping.settled_drag = settled;
  flow_->place(surface);
  return solve_to_rest(*flow_, stopping, [&](const FlowProgress& progress) {
    if (report) report({.stage = SteadyStage::flow, .iteration = iteration, .flow = progress});
    return true;
  });
}

FlowField SteadySolver::watch_flow(const std::vector<Triangle>& surface, bool to_the_end, SteadyState& state,
                                   SteadyIteration& now, const SteadyReport& report) {
  Watch how = *problem_.watch;
  if (!to_the_end) how.standard_error /= short_watch, how.shortest *= short_watch, how.longest *= short_watch;
  flow_->place(surface);
  FlowField field = watch(*flow_, problem_.flow, how, record_, [&](const WatchProgress& progress) {
    if (report) report({.stage = SteadyStage::time, .iteration = now.iteration, .time = progress});
    return true;
  });
  const auto& [steps, start_up, drag, side_x, side_y, swing, enough, slices] = record_;
  const double error = std::max(drag.standard_error, scatter_of_means(state.iterations, drag.mean));
  state.watched = {.steps = static_cast<int>(steps.size()),
                   .time = record_.watched(),
                   .start_up = start_up,
                   .drag = drag.mean,
                   .error = error,
                   .deviation = drag.deviation,
                   .side_force = {side_x.mean, side_y.mean, 0},
                   .side_error = {side_x.standard_error, side_y.standard_error, 0},
                   .side_deviation = std::hypot(side_x.deviation, side_y.deviation),
                   .swing = swing.frequency,
                   .swing_share = swing.share,
                   .enough = enough && error <= how.standard_error * std::abs(drag.mean)};
  now.in_time = true;
  now.drag_error = error;
  field.last.iteration = state.watched.steps;
  field.average.drag_deviation = drag.deviation;
  return field;
}

// The flow's answer as a load on the cloth. A sheet leaves the pressure on either side clean up to the cloth.
ClothLoad SteadySolver::answer_of(const FlowField& field, const std::vector<Triangle>& surface,
                                  const std::vector<int>& cut, const std::vector<Vec3>& shape,
                                  SteadyState& state, SteadyIteration& now) const {
  const bool sheet = !problem_.flow.sheets.empty();
  state.sides = sample_sides(field, sheet ? std::vector<int>{} : cut, cells_, shape);
  ClothLoad answer{state.sides.difference(), {}};
  if (problem_.settings.load == CanopyLoad::of_flow)
    answer = load_of_flow(field.sheet_loads, field.grid, surface, cells_, shape);
  now.transfer_factor = now.fluid_force / pressure_force(cells_, shape, answer.pressure).z;
  now.load_remainder = remainder_share(answer, cells_, shape);
  if (problem_.settings.load == CanopyLoad::uniform) {
    const std::vector<double> one(cells_.size(), 1.0);
    answer.pressure.assign(cells_.size(), now.fluid_force / pressure_force(cells_, shape, one).z);
  }
  if (problem_.settings.load != CanopyLoad::sampled) return answer;
  // The flow's force on the cut cells also holds what the resistance takes along the cloth, and the staircase
  // of cut cells is not the cloth: sampled differences do not add up to
  // it. The factor between them is reported.
  if (!(now.transfer_factor > 0) || !std::isfinite(now.transfer_factor)) {
    throw Error(
        ExitCode::diverged,
        fmt::format("coupling iteration {}: the pressures beside the cloth add up to {:.3g} N against the "
                    "flow, whose force is {:.3g} N; the grid is too coarse for this canopy or the flow is "
                    "wrong",
                    now.iteration, now.fluid_force / now.transfer_factor, now.fluid_force));
  }
  for (double& dp : answer.pressure) dp *= now.transfer_factor;
  return answer;
}

// Cloth in equilibrium under the present load: a new shape, and what it says of itself.
std::vector<Vec3> SteadySolver::next_shape(const SteadyState& state, SteadyIteration& now,
                                           const SteadyReport& report) {
  ClothState cloth;
  const std::vector<double> no_pressure(cells_.size(), 0.0);
  Loads loads{state.pressure, node_forces({no_pressure, state.remainder}, cells_, state.shape)};
  RelaxOptions options;
  options.tolerance = problem_.settings.cloth_tolerance;
  // A run that starts from its neighbour has a shape to be held to, the canopy as it is sewn is none.
  const bool has_shape = !(state.shape == problem_.mesh.start);
  if (has_shape) options.max_steps = steps_unheld;
  const auto relax_on = [&] {
    const RelaxResult result =
        relax(cloth, *cloth_, loads, options, team_, [&](const RelaxProgress& progress) {
          if (report) report({.stage = SteadyStage::cloth, .iteration = now.iteration, .cloth = progress});
        });
    now.cloth_steps += result.steps;
    return result;
  };
  const auto relax_cloth = [&] {
    cloth = cloth_state(state);
    return relax_on();
  };
  if (!state.iterations.empty()) options.regularisation = state.iterations.back().cloth_hold;
  RelaxResult relaxed = relax_cloth();
  const double unit = pressure_per_width(state.pressure, area_);
  while (has_shape && !relaxed.converged && options.regularisation < strongest_hold * unit) {
    options.regularisation = std::max(first_hold * unit, stronger * options.regularisation);
    relaxed = relax_cloth();
  }
  for (int n = 1; n < steps_in_hold && state.in_time && relaxed.converged &&
                  relaxed.regularisation_share > held_tolerance / 4;
       ++n) {
    const ClothState reached = cloth;
    if (const RelaxResult further = relax_on(); further.converged)
      relaxed = further;
    else
      cloth = reached;
  }
  if (!relaxed.converged) {
    throw Error(
        ExitCode::not_converged,
        fmt::format("coupling iteration {}: the cloth found no equilibrium, residual {:.2e} after {} steps "
                    "(wanted {:.1e}); a looser coupling.cloth_tolerance or a finer parachute.mesh may help",
                    now.iteration, relaxed.residual, now.cloth_steps, options.tolerance));
  }
  now.cloth_hold = options.regularisation;
  now.cloth_held = relaxed.regularisation_share;
  now.cloth_residual = relaxed.residual;
  const std::vector<Vec3> shape = positions(cloth, *cloth_);
  double moved = 0, size = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    now.shape_change += norm(shape[i] - state.shape[i]) / double(shape.size());
    moved += dot(shape[i] - state.shape[i], shape[i] - state.shape[i]);
    size += dot(state.shape[i], state.shape[i]);
  }
  now.omega = std::sqrt(moved / size);
  const Wrench load = wrench_of({state.pressure, state.remainder}, cells_, shape);
  now.nodal_load = load.force.z;
  now.axial_moment = load.moment.z;
  now.line_tension = force_on_fixed(*cloth_, cloth).z;
  const std::vector<Vec3> pressures = node_forces({state.pressure, {}}, cells_, shape);
  for (std::size_t node = 0; node < shape.size(); ++node) loads.node_force[node] += pressures[node];
  now.section_gap = largest_section_gap(problem_.mesh, *cloth_, cloth, loads.node_force);
  return shape;
}

// How far chance in two means over time, each as sure as the last one, has the cloth lean to the side: twice the standard
// error of the direction of the load, times the mean distance from the end that is held [m].
double SteadySolver::lean_by_chance(const SteadyState& state) const {
  if (state.iterations.empty() || !state.iterations.back().in_time) return 0;
  const Vec3& held = state.shape[problem_.mesh.fixed.front()];
  double distance = 0;
  for (const Vec3& x : state.shape) distance += norm(x - held) / double(state.shape.size());
  const Vec3& error = state.watched.side_error;
  const double lean =
      2 * std::sqrt(2.) * std::hypot(error.x, error.y) / std::abs(state.watched.drag) * distance;
  return std::isfinite(lean) ? lean : 0;
}

// Whether drag and flow stand still and the ledger closes. Before a watch they need not do so better than the mean over
// time will be sure. In time the ledger says all: the nodal load is the mean of the means before, which chance has differ
// from this one by twice the standard error of the difference.
bool SteadySolver::converged(const SteadyState& state, const SteadyIteration& now) const {
  const CouplingSettings& settings = problem_.settings;
  double chance = problem_.watch ? problem_.watch->standard_error : 0;
  if (state.in_time)
    chance = 2 * std::hypot(now.drag_error, state.iterations.back().drag_error) / std::abs(now.fluid_force);
  const double ledger = ledger_tolerance + chance;
  return (state.in_time || now.drag_change < settings.drag_tolerance + chance) &&
         now.cloth_held < held_tolerance &&
         (now.flow_converged ||
          (now.flow_averaged > 0 && within(now.momentum_deficit, now.fluid_force, ledger))) &&
         within(now.nodal_load, now.fluid_force, ledger) && within(now.line_tension, now.fluid_force, ledger);
}

// The next load, from the answers so far. The remainder follows the pressures' steps:
// it has no weight of its own.
void SteadySolver::step(SteadyState& state, const ClothLoad& answer, double drag_change) const {
  const CouplingSettings& settings = problem_.settings;
  Accelerator& accelerator = state.accelerator;
  if (settings.acceleration == Acceleration::anderson && !state.in_time) {
    const bool jitters = static_cast<int>(state.iterations.size()) >= accelerated &&
                         drag_change > state.iterations.back().drag_change;
    if (jitters || accelerator.update == Acceleration::none) accelerator.average(settings.relaxation);
  }
  // What means over time have in common is the load, what they differ in is chance. The first ones are of a wake that
  // still had to form: that of the first watch of all gives way to the second, and then each weighs as its number.
  if (const auto& all = state.iterations; state.in_time && all.back().in_time && all[all.size() - 2].in_time)
    accelerator.average(2 * settings.relaxation);
  std::vector<double> weight = area_;
  weight.resize(area_.size() + 6, 0.0);
  const std::vector<double> next =
      accelerator.next(joined({state.pressure, state.remainder}), joined(answer), weight);
  state.pressure.assign(next.begin(), next.end() - 6);
  const double* r = next.data() + state.pressure.size();
  state.remainder = {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}};
}

FlowField SteadySolver::iterate(SteadyState& state, const SteadyReport& report) {
  const auto begin = std::chrono::steady_clock::now();
  const CouplingSettings& settings = problem_.settings;
  SteadyIteration now;
  now.iteration = static_cast<int>(state.iterations.size()) + 1;
  const std::vector<Vec3> shape = next_shape(state, now, report);

  const std::vector<Triangle> surface = surface_of(cells_, shape);
  const std::vector<int> cut = cut_cells(problem_.flow.grid, surface);
  // Under its own load a flow that was left early says little of how the drag settles.
  const bool of_flow = settings.load == CanopyLoad::of_flow;
  const bool stands = now.shape_change < settings.shape_tolerance_m + lean_by_chance(state);
  const bool nearly_there = !state.iterations.empty() && stands &&
                            (of_flow || state.iterations.back().drag_change < settings.drag_tolerance);
  // Cloth that is still held to its last shape is not the one to watch for long.
  const bool whole_watch =
      state.in_time && stands && now.cloth_held < held_tolerance && state.iterations.back().in_time;
  FlowField field = state.in_time ? watch_flow(surface, whole_watch, state, now, report)
                                  : solve_flow(surface, nearly_there, now.iteration, report);
  now.cut_cells = static_cast<int>(cut.size());
  now.flow_iterations = field.last.iteration;
  now.flow_residual = state.in_time ? 0 : largest_residual(field.last);
  now.flow_converged = field.converged;
  now.flow_averaged = field.average.iterations;
  now.drag_deviation = field.average.drag_deviation;
  now.fluid_force = field.porous_force.z;
  now.momentum_deficit = field.momentum_deficit;
  now.approach_speed = approach_speed(field, problem_.mesh, shape);
  now.drag_change = state.iterations.empty()
                        ? std::numeric_limits<double>::infinity()
                        : std::abs(now.fluid_force / state.iterations.back().fluid_force - 1);
  const Vec3 h = problem_.flow.grid.spacing();
  const double dx = std::cbrt(h.x * h.y * h.z);
  now.printed_tolerance =
      now.flow_residual * dx * dx / (problem_.reference_area * largest_coefficient(problem_.mesh));

  const ClothLoad answer = answer_of(field, surface, cut, shape, state, now);
  state.converged = stands && (whole_watch || !state.in_time) && converged(state, now);
  state.shape = shape;
  state.applied = state.pressure;
  step(state, answer, now.drag_change);
  now.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  state.iterations.push_back(now);
  if (state.converged && problem_.watch && !state.in_time) {
    state.in_time = true;
    state.converged = false;
    state.accelerator.update = Acceleration::none;  // differences of means over time are mostly noise
    state.accelerator.relaxation = settings.relaxation;
  }
  return field;
}

}  // namespace ripstop
