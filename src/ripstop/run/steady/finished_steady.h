// A steady run that has ended and converged, read back from its folder for what is made of its numbers.
#pragma once

#include <filesystem>

#include "ripstop/case/settings.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop {

/// How well a run knows its own drag, relative: the largest of its last change, the deviation of a flow that was
/// averaged or the standard error of one that was watched in time, and what the ledger does not close. What the
/// model does not have is not in it.
double drag_uncertainty(const SteadyIteration& last);

struct FinishedSteady {
  std::filesystem::path folder;
  Settings resolved;
  SteadyResult result;
  double parachute_mass = 0;    // [kg]
  double drag_uncertainty = 0;  // drag_uncertainty() of its last iteration
};

/// Throws Error(usage) for a folder without a finished run of `ripstop steady`, Error(bad_data) for one that is
/// damaged or has not converged.
FinishedSteady finished_steady(const std::filesystem::path& folder);
/// Of a run in memory: its `folder` stays empty. Throws Error(bad_data) for one that has not converged.
FinishedSteady finished_steady(const Settings& resolved, const SteadyResult& result);

}  // namespace ripstop
