#include "ripstop/fsi/uniform_pressure_opening.h"

#include <algorithm>
#include <utility>

namespace ripstop::inline fsi {

UniformPressureOpening::UniformPressureOpening(InflationProblem problem)
    : Opening(std::move(problem), 0.1, 0, AdaptiveStepper::Step::kept) {}

double UniformPressureOpening::pressure_in(long long row) const {
  const double middle = static_cast<double>(row) * row_duration() + 0.5 * row_duration();
  const double ramp = problem().settings.ramp_s;
  return (ramp > middle ? middle / ramp : 1.0) * problem().pressure;
}

std::vector<HistoryRow> UniformPressureOpening::advance(InflationState& state, std::vector<AirRow>*) {
  const long long first = state.blocks * rows_per_block();
  // Under a constant pressure all rows of a block are stepped together, while it rises one by one.
  const bool rising = problem().settings.ramp_s > static_cast<double>(first) * row_duration();
  Loads loads;
  const auto load_of = [&](long long row) -> const Loads& {
    loads.cell_pressure.assign(mesh().cell_count(), pressure_in(row));
    return loads;
  };
  AdaptiveStepper::Span span = stepper().advance(
      state, cloth_of(state), {first, rows_per_block(), rising ? 1 : rows_per_block()}, load_of);
  if (end_block(state)) span.stable_step = stepper().stable_step(state, cloth_of(state));
  stepper().follow(span.stable_step, state);
  return std::move(span.rows);
}

}  // namespace ripstop::inline fsi
