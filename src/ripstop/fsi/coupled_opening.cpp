#include "ripstop/fsi/coupled_opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ripstop/core/quantity_error.h"
#include "ripstop/core/words.h"
#include "ripstop/flow/apart.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/sheet_sides.h"
#include "ripstop/fsi/coupled_step.h"
#include "ripstop/fsi/lines_apart.h"
#include "ripstop/fsi/load_model.h"

namespace ripstop::inline fsi {
namespace {

constexpr int added_masses = 25;  // in an opening

/// A canopy narrower than so many cells would not part the air of any two.
constexpr double least_cells_across = 2;

/// Of a cluster the smallest canopy counts.
double smallest_ratio(const std::vector<SizedCanopy>& sizes) {
  double smallest = 1;
  for (const SizedCanopy& canopy : sizes) smallest = std::min(smallest, canopy.ratio);
  return smallest;
}

/// `smallest`: size of the smallest canopy over that of `folded`.
void check_width(const FoldedStart& folded, double smallest, const FlowGrid& grid) {
  const double width = smallest * (folded.inner_radius + folded.outer_radius);
  const Vec3 cell = grid.spacing({0, 0, 0.5 * grid.size.z + grid.origin.z});
  const double across = std::max(cell.x, cell.y);
  if (width >= least_cells_across * across) return;
  const double finer = least_cells_across * across / width;
  const auto cells = [&](int n) { return static_cast<long long>(std::ceil(finer * n)); };
  throw QuantityError(
      ExitCode::usage,
      fmt::format(
          "the skirt of the folded canopy is {:.3g} m wide, {} cells of the flow grid ({:.3g} m). At "
          "least {:g} cells are needed: use cells of at most {:.3g} m, or a radius of the folded skirt of at "
          "least {:.3g} m. Such cells are about {} x {} x {}, with {:.2g} times the memory and {:.2g} times "
          "the time of this grid",
          width, rounded_apart(width / across, least_cells_across, 2).first, across, least_cells_across,
          width / least_cells_across, 0.5 * least_cells_across * across / smallest, cells(grid.nx),
          cells(grid.ny), cells(grid.nz), std::pow(finer, 3), std::pow(finer, 4)),
      {"flow grid", "radius of the folded skirt"});
}

/// Least share_on_different_sides() of a folded canopy. Where both layers of its folds are between the same two cell
/// centres, the air has no way into it: without any the flow has no effect on the cloth. Starts that open have 0.4 to 0.6.
constexpr double least_share = 0.1;

void check_folds(const FoldedStart& folded, const std::vector<Cell>& cells, const FlowGrid& grid) {
  const CanopySurface canopy(cells, folded.positions, grid);
  const double share = share_on_different_sides(grid, canopy.triangles);
  if (share >= least_share) return;
  throw QuantityError(
      ExitCode::usage,
      fmt::format(
          "the cells of the flow grid do not resolve the {} folds of the canopy, whose skirt folds at {:.3g} "
          "and {:.3g} m from the axis. Both layers of the cloth are between the same cell centres, so the "
          "air could not open the canopy. A share of {:.2g} of the neighbouring centres with cloth between "
          "them is on different sides of it; at least {:g} is needed. Use a finer flow grid, more folds "
          "(gores), or a larger radius of the folded skirt",
          folded.folds, folded.inner_radius, folded.outer_radius, share, least_share),
      {"flow grid", "radius of the folded skirt"});
}

double mean_load(const std::vector<HistoryRow>& history, int rows) {
  double mean = 0;
  for (int n = 1; n <= rows; ++n) mean += history[history.size() - n].mean / rows;
  return mean;
}

}  // namespace

CoupledOpening::CoupledOpening(InflationProblem problem)
    : Opening(problem, problem.settings.duration_s, least_rows_in(problem.air->flow),
              AdaptiveStepper::Step::renewed),
      air_(std::make_unique<CoupledFlow>(*problem.air, mesh(), &team())) {
  check_width(folded(), smallest_ratio(problem.sizes), problem.air->flow.grid);
  check_folds(folded(), cells_of(mesh()), problem.air->flow.grid);
  require_apart(surface_of(cells_of(mesh()), folded().positions), problem.air->flow.bodies);
  require_lines_apart(mesh(), folded().positions, problem.air->flow.bodies);
  if (problem.air->container) contained_.emplace(mesh(), folded().positions);
  for (std::size_t k = 0; k < problem.delays.size(); ++k)
    delayed_.push_back(problem.delays[k] > 0 ? cloths().guided_canopy(static_cast<int>(k))
                                             : std::vector<GuidedNode>{});
}

InflationState CoupledOpening::start() const {
  InflationState state = Opening::start();
  compute_added_mass(state);
  return state;
}

void CoupledOpening::compute_added_mass(InflationState& state) const {
  const auto& payload = problem().air->payload;
  air_->compute_added_mass(positions(state.cloth, cloth()),
                           payload ? density_ratio(*payload, state.air.flight.fallen) : 1, state.air);
}

std::vector<HistoryRow> CoupledOpening::advance(InflationState& state, std::vector<AirRow>* air_rows) {
  std::vector<HistoryRow> history;
  while (static_cast<int>(history.size()) < rows_per_block()) {
    const int rows = rows_of_next_step(state, rows_per_block() - static_cast<int>(history.size()));
    const AirRow row = step(state, rows, history);
    if (air_rows) air_rows->push_back(row);
  }
  end_block(state);
  return history;
}

// A step of the flow is a whole number of rows, as many as it allows, all steps of a block alike as far as possible.
int CoupledOpening::rows_of_next_step(const InflationState& state, int left) {
  const double longest = sound_step(*air_, row_duration(), state.cloth.time);
  return std::max(1, left / steps_in(left * row_duration(), longest, state.cloth.time));
}

void CoupledOpening::deploy_at_start(AirMemory& air) const {
  const AirProblem& given = *problem().air;
  PayloadMotion& flight = air.flight;
  flight.speed = given.flow.air.speed();
  if (given.payload)
    deploy(flight, *given.payload, flight.speed,
           given.flow.air.density * density_ratio(*given.payload, flight.fallen));
  if (given.container) air.container = ContainerMotion{flight.speed - given.container->relative_speed};
}

/// The nodes in the container.
std::vector<int> CoupledOpening::contained(const AirMemory& air) const {
  if (!contained_ || air.container->left) return {};
  return contained_->beyond(air.container->farthest / problem().air->container->canopy_length);
}

/// The cloth of the canopies whose delay has not passed.
std::vector<GuidedNode> CoupledOpening::held(double time) const {
  std::vector<GuidedNode> nodes;
  for (std::size_t k = 0; k < delayed_.size(); ++k)
    if (time * (1 + 1e-12) < problem().delays[k])
      nodes.insert(nodes.end(), delayed_[k].begin(), delayed_[k].end());
  return nodes;
}

/// Over a step of `length` [s], at whose beginning the nodes lay at `before`: the force between container and cloth [N].
double CoupledOpening::advance_container(const std::vector<int>& inside, const std::vector<Vec3>& before,
                                         double length, InflationState& state) const {
  const auto& payload = problem().air->payload;
  const Container& container = *problem().air->container;
  const PayloadMotion& flight = state.air.flight;
  const std::vector<Vec3> after = positions(state.cloth, cloth());
  double moved = 0, mass = 0;
  for (const int node : inside)
    moved += mesh().mass[node] * (after[node].z - before[node].z), mass += mesh().mass[node];
  const double cloth_speed = flight.speed + 0.5 * length * flight.acceleration - moved / mass / length;
  const double gravity = payload ? gravity_along_path(*payload, flight) : 0;
  ContainerMotion& motion = *state.air.container;
  const double force = move_container(motion, container, cloth_speed, length, air_->density(), gravity);
  if (motion.farthest >= container.canopy_length) motion.left = state.cloth.time;
  return force;
}

AirRow CoupledOpening::step(InflationState& state, int rows, std::vector<HistoryRow>& history) {
  const double length = rows * row_duration();
  const long long first = state.blocks * rows_per_block() + static_cast<long long>(history.size());
  const FlowProblem& flow = problem().air->flow;
  const auto& payload = problem().air->payload;
  PayloadMotion& flight = state.air.flight;
  if (state.air.steps == 0) deploy_at_start(state.air);
  Surroundings surroundings = payload ? in_flight(flight, *payload, length) : Surroundings{};
  const std::vector<int> inside = contained(state.air);
  surroundings.guided = inside.empty() ? held(state.cloth.time) : guided_along({0, 0, 1}, inside);
  const std::vector<Vec3> before = inside.empty() ? std::vector<Vec3>{} : positions(state.cloth, cloth());
  const double speed = flight.speed + length * flight.acceleration;

  const CoupledStep taken =
      take_coupled_step(*air_, stepper(), cloth_of(state), {first, rows, rows}, surroundings, team(), state);
  history.insert(history.end(), taken.history.begin(), taken.history.end());

  AirRow row;
  row.time = state.cloth.time, row.length = length, row.courant = taken.flow.courant;
  row.speed = speed;
  const Vec3 on_canopy = taken.flow.force - force_on_others(taken.flow.bodies);
  row.drag = on_canopy.z, row.side_x = on_canopy.x, row.side_y = on_canopy.y;
  for (std::size_t n = 1; n < taken.flow.bodies.size(); ++n)
    row.bodies.push_back(
        without_displaced_air(taken.flow.bodies[n], flow.bodies[n], air_->density() * surroundings.gained));
  row.dynamic_pressure = 0.5 * air_->density() * speed * speed;
  row.drag_area = row.drag / row.dynamic_pressure;
  row.momentum_gap = taken.flow.momentum_gap.z, row.mass_defect = taken.flow.mass_defect;
  row.residual_traction = taken.residual_traction, row.added_mass = state.air.added_mass;

  // Move the payload under the pull of the riser and of the container, which the cloth in it does not transmit.
  double pull = mean_load(history, rows);
  if (!inside.empty()) pull += advance_container(inside, before, length, state);
  if (payload) move_payload(flight, *payload, pull, length, flow.air.density);
  row.path = flight.path, row.fallen = flight.fallen;
  row.angle = flight.angle * 180 / std::numbers::pi;
  return row;
}

InflationFrame CoupledOpening::frame(InflationState& state) const {
  const long long every = std::max(1, problem().settings.frames / added_masses);
  if (state.blocks / blocks_per_frame() % every == 0 || state.blocks == blocks()) compute_added_mass(state);
  return Opening::frame(state);
}

}  // namespace ripstop::inline fsi
