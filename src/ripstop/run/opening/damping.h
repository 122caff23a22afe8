// C_a from a measured opening, from a case to its files.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/calibration/damping.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"
#include "ripstop/run/opening/inflation.h"

namespace ripstop::inline run {

template <Of<DampingTrial> T, class Visit>
void each_member(T& trial, Visit&& visit) {
  visit("damping_n_s_m3", trial.damping);
  visit("peak_n", trial.peak);
  visit("peak_time_s", trial.peak_time);
  visit("every_step_peak_n", trial.every_step_peak);
  visit("inflation_time_s", trial.inflation_time);
  visit("misfit", trial.misfit);
}

/// result.json of `ripstop calibrate damping`.
struct DampingResult {
  std::string title;
  std::optional<std::string> inputs_hash;  // of version, case, load and range searched
  DampingCalibration found;
  DampingTarget target;
  double low_pass_hz = 0;
  double pressure = 0;  // [Pa]
  std::string pressure_from;
  int nodes = 0;
  std::vector<std::string> warnings;  // of the steady run that gives the pressure
};
template <Of<DampingResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("inputs_hash", r.inputs_hash);
  visit("damping_n_s_m3", r.found.best.damping);
  visit("misfit", r.found.best.misfit);
  visit("peak_load_n", r.found.best.peak);
  visit("measured_peak_n", r.target.peak);
  visit("every_step_peak_n", r.found.best.every_step_peak);
  visit("low_pass_hz", r.low_pass_hz);
  visit("measured_inflation_time_s", r.target.inflation_time);
  visit("inflation_time_s", r.found.best.inflation_time);
  visit("pressure_pa", r.pressure);
  visit("pressure_from", r.pressure_from);
  visit("nodes", r.nodes);
  visit("best_is_at_the_edge", r.found.at_edge);
  visit("trials", r.found.trials);
  visit("warnings", r.warnings);
}
std::string to_json(const DampingResult& result);

/// Measurements of the case. Throws Error(usage) without any.
DampingTarget damping_target(const Settings& resolved);

/// calibrate_damping() on the case's measured opening, under the pressure of `problem`; `alive` as of open_with().
DampingResult run_damping(const Settings& resolved, const LoadSource& source, const InflationProblem& problem,
                          const DampingSearch& search,
                          const std::function<void(const DampingTrial&)>& report = {},
                          const std::function<void()>& alive = {});

/// damping.csv, misfit.png and result.json.
void write_damping(const std::filesystem::path& folder, const DampingResult& result);

}  // namespace ripstop::inline run
