#include "ripstop/calibration/damping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/fsi/uniform_pressure_opening.h"

namespace ripstop::inline calibration {

double misfit_of(const DampingTrial& trial, const DampingTarget& target) {
  const double peak = trial.peak / target.peak - 1;
  if (!target.inflation_time) return std::abs(peak);
  const double time = trial.inflation_time ? *trial.inflation_time / *target.inflation_time - 1 : 1.0;
  return std::sqrt(0.5 * (peak * peak + time * time));
}

DampingTrial open_with(double damping, const InflationProblem& problem, const std::function<void()>& alive) {
  InflationProblem own = problem;
  own.settings.damping_n_s_m3 = damping;
  UniformPressureOpening solver(std::move(own));
  InflationState state = solver.start();
  std::vector<HistoryRow> rows;
  while (state.blocks < solver.blocks()) {
    const std::vector<HistoryRow> block = solver.advance(state);
    rows.insert(rows.end(), block.begin(), block.end());
    if (alive) alive();
  }
  const double low_pass_hz = problem.settings.low_pass_hz;
  const InflationSummary summary = summarise(rows, low_pass_hz);
  DampingTrial trial;
  trial.damping = damping;
  trial.every_step_peak = state.peak_load;
  trial.peak = low_pass_hz > 0 ? summary.smooth_peak : state.peak_load;
  trial.peak_time = low_pass_hz > 0 ? summary.smooth_peak_time : state.peak_time;
  trial.steady_load = summary.last_load;
  trial.inflation_time = summary.inflation_time;
  return trial;
}

void check_search(const DampingSearch& search) {
  if (!(search.from > 0 && search.to > search.from && search.points >= 3)) {
    throw Error(
        ExitCode::usage,
        fmt::format("the search for C_a requires 0 < from < to and at least 3 points, not {} to {} with {}",
                    search.from, search.to, search.points));
  }
}

DampingCalibration calibrate_damping(const DampingTarget& target, const DampingSearch& search,
                                     const std::function<DampingTrial(double)>& open,
                                     const std::function<void(const DampingTrial&)>& report) {
  check_search(search);
  DampingCalibration result;
  const auto attempt = [&](double damping) {
    DampingTrial trial = open(damping);
    trial.misfit = misfit_of(trial, target);
    if (report) report(trial);
    result.trials.push_back(trial);
    return trial.misfit;
  };
  const auto at = [&](int i) {
    return search.from * std::pow(search.to / search.from, double(i) / (search.points - 1));
  };
  int best = 0;
  for (int i = 0; i < search.points; ++i) {
    if (attempt(at(i)) < result.trials[best].misfit) best = i;
  }
  result.at_edge = best == 0 || best + 1 == search.points;
  if (!result.at_edge) {
    // Golden section in log C_a between the neighbours of the best point.
    const double share = 1 / std::numbers::phi;
    double low = std::log(at(best - 1)), high = std::log(at(best + 1));
    double a = high - share * (high - low), b = low + share * (high - low);
    double at_a = 0, at_b = 0;
    for (int i = 0; i < search.refinements; ++i) {
      if (i == 0) {
        at_a = attempt(std::exp(a));
        continue;
      }
      if (i == 1) {
        at_b = attempt(std::exp(b));
        continue;
      }
      if (at_a < at_b) {
        high = b, b = a, at_b = at_a;
        a = high - share * (high - low);
        at_a = attempt(std::exp(a));
      } else {
        low = a, a = b, at_a = at_b;
        b = low + share * (high - low);
        at_b = attempt(std::exp(b));
      }
    }
  }
  std::sort(result.trials.begin(), result.trials.end(),
            [](auto& x, auto& y) { return x.damping < y.damping; });
  result.best = *std::min_element(result.trials.begin(), result.trials.end(),
                                  [](auto& x, auto& y) { return x.misfit < y.misfit; });
  return result;
}

}  // namespace ripstop::inline calibration
