// Parts of a steady run for its two forms: at a given speed, and at the speed at which drag equals weight.
#pragma once

#include <chrono>
#include <memory>

#include "ripstop/core/file.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop::inline run {

struct SteadyParts {
  std::unique_ptr<TemporaryFolder> temporary;  // of an engine that needs one and was given none
  std::unique_ptr<FlowEngine> engine;
  std::unique_ptr<SteadySolver> solver;
};
SteadyParts steady_parts(const Settings& resolved, const SteadySettings& settings);

/// The same run with other settings, the flow of `old` where `continues`: else it starts anew.
SteadyParts parts_with(SteadyParts old, const Settings& now, const SteadySettings& settings, bool continues);

/// Of the state in which the run ended.
SteadyResult steady_result(const SteadySolver& solver, const SteadyState& state, const Settings& resolved);

/// Wall time of a run, with that of the iterations before it was resumed.
class RunClock {
 public:
  void count_earlier(const SteadyState& resumed) {
    for (const SteadyIteration& i : resumed.iterations) earlier_ += i.wall_time;
  }
  double elapsed() const {
    return earlier_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double earlier_ = 0;
};

/// run_steady() of a case with payload.mass_kg; `clock` was started with the run.
SteadySolution run_with_payload(const Settings& resolved, SteadyObserver& observer,
                                const SteadySettings& settings, RunClock clock);
/// run_steady() of a cluster with cluster.equilibrium.
SteadySolution run_to_equilibrium(const Settings& resolved, SteadyObserver& observer,
                                  const SteadySettings& settings, RunClock clock);

}  // namespace ripstop::inline run
