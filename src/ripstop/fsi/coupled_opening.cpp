#include "ripstop/fsi/coupled_opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ripstop/core/quantity_error.h"

namespace ripstop {
namespace {

// Of the time in which the stream passes a cell: no row is longer, as steps of the flow are whole numbers of rows and as
// long as its fastest cell allows.
constexpr double longest_row = 0.03;
// Of a row: no flow of the stream's air needs a shorter step.
constexpr double shortest_step = 0.05;
constexpr int added_masses = 25;  // in an opening

double least_rows_in(const FlowProblem& flow) {
  double least = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = axis == 0 ? flow.grid.nx : axis == 1 ? flow.grid.ny : flow.grid.nz;
    for (int c = 0; c < n; ++c) least = std::min(least, flow.grid.width(axis, c));
  }
  return flow.air.speed() / (longest_row * least);  // [1/s]
}

/// work(), whose divergence is reported with the time at which its step began [s] and with how much heavier than the
/// cloth the air of a cell is, which decides whether the two can be stepped together.
template <class Work>
auto or_diverged(double time, double heaviness, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.code() != ExitCode::diverged) throw;
    throw QuantityError(
        ExitCode::diverged,
        fmt::format("t = {:.6g} s, coupled flow step: {}. The air of a cell has {:.3g} times the mass "
                    "of the cloth in it; a finer flow grid reduces this ratio",
                    time, error.what(), heaviness),
        {"flow grid"});
  }
}

/// A canopy narrower than so many cells would not part the air of any two.
constexpr double least_cells_across = 2;

void check_width(const FoldedStart& folded, const FlowGrid& grid) {
  const double width = folded.inner_radius + folded.outer_radius;
  const Vec3 cell = grid.spacing({0, 0, 0.5 * grid.size.z + grid.origin.z});
  const double across = std::max(cell.x, cell.y);
  if (width >= least_cells_across * across) return;
  throw QuantityError(
      ExitCode::usage,
      fmt::format(
          "the skirt of the folded canopy is {:.3g} m wide, {:.2g} cells of the flow grid ({:.3g} m); the "
          "air needs at least {:g}: use cells of at most {:.3g} m or a radius of the folded skirt of at "
          "least "
          "{:.3g} m",
          width, width / across, across, least_cells_across, width / least_cells_across,
          0.5 * least_cells_across * across),
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
      air_(std::make_unique<CoupledFlow>(*problem.air, mesh())) {
  check_width(folded(), problem.air->flow.grid);
}

InflationState CoupledOpening::start() const {
  InflationState state = Opening::start();
  air_->compute_added_mass(positions(state.cloth, cloth()), state.air);
  return state;
}

std::vector<HistoryRow> CoupledOpening::advance(InflationState& state, std::vector<AirRow>* air_rows) {
  std::vector<HistoryRow> history;
  while (static_cast<int>(history.size()) < rows_per_block()) {
    const int rows = rows_of_next_step(state, rows_per_block() - static_cast<int>(history.size()));
    const AirRow row =
        or_diverged(state.cloth.time, air_->heaviness(), [&] { return step(state, rows, history); });
    if (air_rows) air_rows->push_back(row);
  }
  end_block(state);
  return history;
}

// A step of the flow is a whole number of rows, as many as it allows, all steps of a block alike as far as possible.
int CoupledOpening::rows_of_next_step(const InflationState& state, int left) {
  const double longest = air_->longest_step();
  if (!(longest > shortest_step * row_duration()))
    throw QuantityError(ExitCode::diverged,
                        fmt::format("at {:.6g} s the flow would need time steps of {:.3g} s: it has "
                                    "diverged; try a smaller Courant number of the flow or a finer flow grid",
                                    state.cloth.time, longest),
                        {"Courant number of the flow", "flow grid"});
  return std::max(1, left / steps_in(left * row_duration(), longest, state.cloth.time));
}

AirRow CoupledOpening::step(InflationState& state, int rows, std::vector<HistoryRow>& history) {
  const double length = rows * row_duration();
  const std::vector<Vec3> before = positions(state.cloth, cloth());
  const long long first = state.blocks * rows_per_block() + static_cast<long long>(history.size());

  // Predict the motion of the cloth under the last load.
  const double step = stepper().allowed_step(state, cloth_of(state));
  const int steps = steps_in(length, step, state.cloth.time);
  const ClothMotion predicted =
      predict_motion(state.cloth, cloth_of(state), air_->last_load(state.air), length, steps, team());

  // Step the flow about it, transfer its load.
  AirRow row = air_->step(before, predicted, length, state.air);
  const Loads loads = air_->transfer(before, state.air, row);

  // Correct: step the cloth under that load.
  const auto load_of = [&](long long) -> const Loads& { return loads; };
  const AdaptiveStepper::Span span = stepper().advance(state, cloth_of(state), {first, rows, rows}, load_of);
  history.insert(history.end(), span.rows.begin(), span.rows.end());
  row.time = state.cloth.time;

  // Move the payload under the pull of the riser.
  air_->move_payload(mean_load(history, rows), state.air, row);

  // The work of the load that is not pressure.
  const std::vector<Vec3> after = positions(state.cloth, cloth());
  for (std::size_t n = 0; n < before.size(); ++n)
    state.air.work += dot(loads.node_force[n], after[n] - before[n]);
  return row;
}

InflationFrame CoupledOpening::frame(InflationState& state) const {
  const long long every = std::max(1, problem().settings.frames / added_masses);
  if (state.blocks / blocks_per_frame() % every == 0 || state.blocks == blocks())
    air_->compute_added_mass(positions(state.cloth, cloth()), state.air);
  return Opening::frame(state);
}

}  // namespace ripstop
