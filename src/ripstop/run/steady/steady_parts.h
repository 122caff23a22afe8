// Parts of a steady run for its two forms: at a given speed, and at the speed at which drag equals weight.
#pragma once

#include <memory>

#include "ripstop/core/file.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop {

struct SteadyParts {
  std::unique_ptr<TemporaryFolder> temporary;  // of an engine that needs one and was given none
  std::unique_ptr<FlowEngine> engine;
  std::unique_ptr<SteadySolver> solver;
};
SteadyParts steady_parts(const Settings& resolved, const SteadySettings& settings);

/// Of the state in which the run ended.
SteadyResult steady_result(const SteadySolver& solver, const SteadyState& state, const Settings& resolved);

/// run_steady() of a case with payload.mass_kg.
SteadySolution run_with_payload(const Settings& resolved, SteadyObserver& observer,
                                const SteadySettings& settings);

}  // namespace ripstop
