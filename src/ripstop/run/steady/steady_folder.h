// The folder of one steady run: inputs (run.json), history (iterations.csv, canopy.pvd), result
// (result.json), and the state from which a killed run resumes (checkpoint/).
#pragma once

#include <filesystem>
#include <string>

#include "ripstop/case/opening.h"
#include "ripstop/case/settings.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop::inline run {

struct SteadyFolderSettings {
  RunSettings run;
  int threads = 0;                  // of this run; 0: coupling.threads
  std::filesystem::path hostfile;   // for MPI; empty: none
  std::filesystem::path warm_from;  // folder of a finished run to start from; empty: cold
  bool elsewhere = false;           // another machine runs it: this one's memory does not matter
};

struct SteadyFolderRun {
  bool already_finished = false;
  SteadyResult result;
};

/// run_steady() in a folder, from the first iteration or from the state of a killed run. Nothing is computed, and the
/// observer is not called, when the folder contains the finished run. Throws as holds_run() and run_steady() do.
SteadyFolderRun run_steady_in(const SteadyFolderSettings& settings, const Settings& resolved,
                              SteadyObserver& observer);

/// Throws the exceptions of run_steady_in() before it computes, and changes nothing.
void check_steady_in(const SteadyFolderSettings& settings, const Settings& resolved);

/// Drag of the converged run in a folder, for an opening of the same parachute, but for its mesh, in the same
/// air. Throws Error(usage) for another parachute, speed or density, Error(bad_data) for a run that is
/// damaged or has not converged.
double drag_for_opening(const std::filesystem::path& folder, const Settings& opening);
/// The same of a run of `resolved`, which messages call `where`.
double drag_for_opening(const Settings& resolved, const SteadyResult& result, const std::string& where,
                        const Settings& opening);
/// The load of an opening from a steady run: that drag, or of a run with a payload, which found its own speed, its drag
/// area at the speed of the opening. Throws as drag_for_opening().
LoadSource steady_load(const std::filesystem::path& folder, const Settings& opening);
LoadSource steady_load(const Settings& resolved, const SteadyResult& result, const std::string& where,
                       const Settings& opening);
/// Throws Error(usage) unless the run of `resolved`, which messages call `where`, has the parachute of `opening`, but for
/// its mesh.
void require_same_parachute(const Settings& resolved, const std::string& where, const Settings& opening);
/// The final state in the folder of a steady run. Throws Error(usage) when there is none.
SteadyState final_state(const std::filesystem::path& folder);
/// The settings of the run there. Throws Error(usage) when there is none.
Settings settings_of_run(const std::filesystem::path& folder);
/// Gives back the disk space of the flow field in the checkpoint of a finished run; final_state() stays.
/// Throws Error(io).
void drop_flow_checkpoint(const std::filesystem::path& folder);

}  // namespace ripstop::inline run
