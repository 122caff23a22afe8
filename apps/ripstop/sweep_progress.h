// Common parts of sweep, compare and calibrate porosity: the options of many runs and their progress.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/case.h"
#include "ripstop/run/sweep/sweep.h"

namespace CLI {
class App;
}

namespace ripstop::cli {

struct SweepOptions {
  std::filesystem::path case_file;
  Overrides overrides;
  SweepSettings settings;
  bool cold = false, json = false;
};
/// Case, --flow, --ranks, --grid, --set, --jobs, --cold, --fields, --json, --out, --fresh.
void add_sweep_options(CLI::App& command, SweepOptions& options);
/// After parsing: the default folder runs/<name of the case>-<suffix>.
void finish(SweepOptions& options, const std::string& what);

/// Runs the points with one line of progress, a line for every end, and sweep.csv after each of them.
std::vector<SweepRow> run_and_tell(const std::vector<SweepAxis>& axes, const std::vector<SweepPoint>& points,
                                   const SweepSettings& settings);
/// Throws Error of the first failed run's message when one failed, Error(not_converged)
/// when one did not converge.
void require_all(const std::vector<SweepPoint>& points, const std::vector<SweepRow>& rows);

}  // namespace ripstop::cli
