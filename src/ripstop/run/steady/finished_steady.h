// A steady run that has ended and converged, read from its folder for further use of its results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop::inline run {

/// Numerical uncertainty of the drag of a run, relative: the largest of its last change, the deviation of an averaged
/// flow or the standard error of an unsteady one, and the force imbalance. The error of the model is not included.
double drag_uncertainty(const SteadyIteration& last);

struct FinishedSteady {
  std::filesystem::path folder;
  Settings resolved;
  SteadyResult result;
  double parachute_mass = 0;               // [kg]
  double drag_uncertainty = 0;             // drag_uncertainty() of its last iteration
  std::vector<std::string> warnings = {};  // of the run, after its name
};

/// Throws Error(usage) for a folder without a finished run of `ripstop steady`, Error(bad_data) for one that is
/// damaged, has not converged or must not be used.
FinishedSteady finished_steady(const std::filesystem::path& folder);
/// Of a run in memory: its `folder` stays empty. Throws Error(bad_data) for one that has not converged.
FinishedSteady finished_steady(const Settings& resolved, const SteadyResult& result);

}  // namespace ripstop::inline run
