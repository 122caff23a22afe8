#include "ripstop/fsi/coupled_step.h"

#include <fmt/format.h>

#include <algorithm>

#include "ripstop/core/quantity_error.h"

namespace ripstop::inline fsi {
namespace {

// Of the time in which the stream passes a cell: no row is longer, as steps of the flow are whole numbers of rows and
// as long as its fastest cell allows.
constexpr double longest_row = 0.03;
// Of a row: no flow of the stream's air needs a shorter step.
constexpr double shortest_step = 0.05;

/// work(), whose divergence is reported with the time at which its step began [s] and with how much heavier than the
/// cloth the air of a cell is, which decides whether the two can be stepped together.
template <class Work>
auto or_diverged(double time, const CoupledFlow& air, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.code() != ExitCode::diverged) throw;
    throw restated(
        error,
        fmt::format("coupled step from t = {:.6g} s: {}. The air of a cell has {:.3g} times the mass of the "
                    "cloth next to it; a finer flow grid reduces this ratio",
                    time, error.what(), air.heaviness()),
        {"flow grid"});
  }
}

/// Of the cloth under the last load, with smaller steps where it diverges.
ClothMotion predicted_motion(const AdaptiveStepper& stepper, const Cloth& cloth, const Loads& last_load,
                             double length, ThreadTeam& team, const InflationState& state) {
  double step = stepper.allowed_step(state, cloth);
  for (int tries = 1;; ++tries, step /= 2) {
    const int steps = steps_in(length, step, state.cloth.time);
    try {
      return predict_motion(state.cloth, cloth, last_load, length, steps, team, stepper.memory());
    } catch (const Error& error) {
      if (error.code() != ExitCode::diverged || tries == AdaptiveStepper::most_tries) throw;
    }
  }
}

CoupledStep unguarded_step(CoupledFlow& air, const AdaptiveStepper& stepper, const Cloth& cloth,
                           const RowSpan& span, const Surroundings& surroundings, ThreadTeam& team,
                           InflationState& state) {
  const double length = span.rows * stepper.row();
  const std::vector<Vec3> before = positions(state.cloth, cloth);
  CoupledStep taken;

  const ClothMotion predicted =
      predicted_motion(stepper, cloth, air.last_load(surroundings, state.air), length, team, state);

  // Step the flow about it, transfer its load.
  taken.flow = air.step(before, predicted, length, surroundings, state.air);
  const Loads loads = air.transfer(before, surroundings, state.air, taken.residual_traction);

  // Correct: step the cloth under that load.
  const auto load_of = [&](long long) -> const Loads& { return loads; };
  taken.history = stepper.advance(state, cloth, span, load_of).rows;

  // The work of the load that is not pressure.
  const std::vector<Vec3> after = positions(state.cloth, cloth);
  for (std::size_t n = 0; n < before.size(); ++n)
    state.air.work += dot(loads.node_force[n], after[n] - before[n]);
  return taken;
}

}  // namespace

double least_rows_in(const FlowProblem& flow) {
  double least = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = axis == 0 ? flow.grid.nx : axis == 1 ? flow.grid.ny : flow.grid.nz;
    for (int c = 0; c < n; ++c) least = std::min(least, flow.grid.width(axis, c));
  }
  return flow.air.speed() / (longest_row * least);
}

double sound_step(CoupledFlow& air, double row, double time) {
  const double longest = air.longest_step();
  if (longest > shortest_step * row) return longest;
  throw QuantityError(
      ExitCode::diverged,
      fmt::format("at {:.6g} s the flow would need time steps of {:.3g} s: it has diverged; try a smaller "
                  "Courant number of the flow or a finer flow grid",
                  time, longest),
      {"Courant number of the flow", "flow grid"});
}

Surroundings in_flight(const PayloadMotion& flight, const Payload& payload, double length) {
  Surroundings box;
  box.moves = true;
  box.stream = {0, 0, flight.speed + length * flight.acceleration};
  box.gained = {0, 0, flight.acceleration};
  box.on_mass = {0, 0, flight.acceleration - gravity_along_path(payload, flight)};
  box.density_ratio = density_ratio(payload, flight.fallen);
  return box;
}

CoupledStep take_coupled_step(CoupledFlow& air, const AdaptiveStepper& stepper, const Cloth& cloth,
                              const RowSpan& span, const Surroundings& surroundings, ThreadTeam& team,
                              InflationState& state) {
  return or_diverged(state.cloth.time, air,
                     [&] { return unguarded_step(air, stepper, cloth, span, surroundings, team, state); });
}

}  // namespace ripstop::inline fsi
