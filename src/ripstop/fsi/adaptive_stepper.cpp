#include "ripstop/fsi/adaptive_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ripstop/core/checked_int.h"
#include "ripstop/core/error.h"

namespace ripstop::inline fsi {
namespace {

// Rise of the stable step that makes the step longer.
constexpr double clear_rise = 1.1;

// No intact cloth needs a shorter step: the finest meshes have about 1e-7 s.
constexpr double shortest_stable_step = 1e-9;  // [s]
constexpr double most_steps = 1e7;             // in one call: the record of each has room in memory

}  // namespace

int steps_in(double duration, double step, double time, int rows) {
  const double count = step > 0 ? std::max(std::ceil(duration / step), 1.0) : INFINITY;
  return checked_int(count, 1, most_steps / rows, [&] {
    return fmt::format(
        "t = {:.6g} s: {:.3g} s would take {:.3g} steps of {:.3g} s: the motion of the cloth has diverged, "
        "or the time step is a very small fraction of the stability limit",
        time, duration * rows, rows * duration / step, step);
  });
}

double AdaptiveStepper::stable_step(const InflationState& state, const Cloth& cloth) const {
  if (last_.cloth == &cloth && last_.x == state.cloth.x && last_.v == state.cloth.v) return last_.stable_step;
  const StabilityLimit limit = stability_limit(cloth, state.cloth);
  if (limit.stable_step > shortest_stable_step) {
    last_ = {&cloth, state.cloth.x, state.cloth.v, limit.stable_step};
    return limit.stable_step;
  }
  const std::string place = limit.node < 0 ? limit.part : fmt::format("node {} ({})", limit.node, limit.part);
  throw Error(ExitCode::diverged,
              fmt::format("t = {:.6g} s: the stability limit has decreased to {:.3g} s at {}: the motion of "
                          "the cloth has diverged; try a smaller time step, more damping or lower loads",
                          state.cloth.time, limit.stable_step, place));
}

double AdaptiveStepper::allowed_step(const InflationState& state, const Cloth& cloth) const {
  return fraction_ * stable_step(state, cloth);
}

AdaptiveStepper::Span AdaptiveStepper::advance(InflationState& state, const Cloth& cloth, const RowSpan& span,
                                               const std::function<const Loads&(long long)>& load_of) const {
  if (kind_ == Step::renewed) state.step = allowed_step(state, cloth);
  for (int tries = 1;; ++tries) {
    const int steps = steps_in(row_, state.step, state.cloth.time, span.under_one_load);
    const double used = kind_ == Step::kept ? state.step : row_ / steps;
    double stable = 0;
    try {
      InflationState next = state;
      std::vector<HistoryRow> rows = compute(next, cloth, span, steps, load_of);
      stable = stable_step(next, cloth);
      if (used <= stable) {
        state = std::move(next);
        return {std::move(rows), stable};
      }
    } catch (const Error& error) {
      if (error.code() != ExitCode::diverged || tries == most_tries) throw;
      stable = 0.5 * used / fraction_;
    }
    state.step = fraction_ * stable;
    ++state.step_changes;
  }
}

void AdaptiveStepper::follow(double stable_step, InflationState& state) const {
  const double allowed = fraction_ * stable_step;
  if (allowed < state.step || allowed > clear_rise * state.step) state.step = allowed;
}

std::vector<HistoryRow> AdaptiveStepper::compute(
    InflationState& state, const Cloth& cloth, const RowSpan& span, int steps,
    const std::function<const Loads&(long long)>& load_of) const {
  const double dt = row_ / steps;
  std::vector<HistoryRow> rows;
  for (int done = 0; done < span.rows; done += span.under_one_load) {
    const long long index = span.first + done;
    step(state.cloth, cloth, load_of(index), dt, steps * span.under_one_load, team_, &state.record, memory_);
    state.cloth.time = static_cast<double>(index + span.under_one_load) * row_;
    for (int i = 0; i < span.under_one_load; ++i)
      rows.push_back(row_of_history(state, index + i, steps, dt, i * steps));
  }
  return rows;
}

// Steps [from, from + steps) of the last call of step().
HistoryRow AdaptiveStepper::row_of_history(InflationState& state, long long index, int steps, double dt,
                                           int from) const {
  const double begin = static_cast<double>(index) * row_;
  const auto load = [&](int k) { return state.record.fixed_force[from + k].z; };
  HistoryRow row{static_cast<double>(index + 1) * row_, 0, load(0), load(0)};
  const std::vector<double>& reefing = state.record.drawstring;
  for (int k = from; k < from + steps && !reefing.empty(); ++k) {
    row.reefing_mean += reefing[k] / steps;
    row.reefing_largest = std::max(row.reefing_largest, reefing[k]);
  }
  for (int k = 0; k < steps; ++k) {
    row.mean += load(k) / steps;
    row.least = std::min(row.least, load(k));
    row.largest = std::max(row.largest, load(k));
    if (load(k) <= state.peak_load) continue;
    state.peak_load = load(k);
    state.peak_time = begin + k * dt;
  }
  state.impulse += row.mean * row_;
  return row;
}

}  // namespace ripstop::inline fsi
