// One steady run in its folder, from the first iteration or from where it was killed.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "ripstop/case/case.h"
#include "ripstop/coupling/steady.h"
#include "ripstop/flow/flow.h"
#include "ripstop/run/run_folder.h"

namespace ripstop {

struct SteadyRunSettings {
  RunSettings folder;
  int threads = 0;                  // of this run; 0: coupling.threads
  std::filesystem::path hostfile;   // for MPI; empty: none
  std::filesystem::path warm_from;  // folder of a finished run to start from; empty: cold
};

/// How a run is followed; any of them may be empty.
struct SteadyRunEvents {
  /// Before the first iteration, which may be one after a checkpoint.
  std::function<void(const SteadyState&, const std::string& engine, int nodes)> begun;
  std::function<void(const SteadyProgress&, const SteadyState&)> progress;
  std::function<void(const SteadyState&)> iterated;
};

struct SteadyRunOutcome {
  bool already_finished = false;
  std::string json;     // result.json
  SteadyResult result;  // of this process; empty when already finished
};

/// The flow engine of a case by name and version. Throws Error(external) where OpenFOAM is asked for and
/// missing.
std::string name_of_engine(const Case& value);

/// Runs to the end of the coupling; a converged result is not promised. Throws as RunFolder, SteadySolver and
/// the flow engine do.
SteadyRunOutcome run_steady(const Case& value, const SteadyRunSettings& settings,
                            const SteadyRunEvents& events = {});

/// The final state in the folder of a steady run. Throws Error(usage) when there is none.
SteadyState final_state(const std::filesystem::path& folder);
/// The case that was run there. Throws Error(usage) when there is none.
Case case_of_run(const std::filesystem::path& folder);
/// Gives back the disk space of the flow field in the checkpoint of a finished run; final_state() stays.
void drop_flow_checkpoint(const std::filesystem::path& folder);

}  // namespace ripstop
