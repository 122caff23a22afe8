// Many steady runs of one case side by side, each started from its neighbour: in memory, or each in a folder
// of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/error.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop::inline run {

/// Varied values: one value is one or more settings, shown under one name.
struct SweepAxis {
  std::string name;                            // "flow.speed_m_s", "gamma"
  std::vector<std::string> values;             // as shown, "20"
  std::vector<std::vector<Setting>> settings;  // of each value
};
/// Values of one key.
SweepAxis sweep_axis(const std::string& key, const std::vector<std::string>& values,
                     const std::string& option);

struct SweepPoint {
  std::vector<std::string> values;  // one an axis
  Settings resolved;
  std::string folder;  // name inside the sweep's folder
  int start = -1;      // index of the neighbour whose result it starts from; -1: none
};

/// Every combination of the axes' values (a table's rows are one axis). The middle of all axes starts cold,
/// every other point from its neighbour one step nearer to the middle, so that the order of work does not
/// change results. Throws the exceptions of read_case(), Error(usage) for a value twice on one axis and for more than
/// 10,000 combinations, before any case is read.
std::vector<SweepPoint> sweep_points(const std::filesystem::path& case_file, const Overrides& overrides,
                                     const std::vector<SweepAxis>& axes);
/// The same of a case that `read` makes with the settings of each point.
using CaseReader = std::function<Case(const Overrides&)>;
std::vector<SweepPoint> sweep_points(const CaseReader& read, const Overrides& overrides,
                                     const std::vector<SweepAxis>& axes);

struct SweepSettings {
  std::filesystem::path folder;  // empty: in memory
  bool fresh = false;
  bool warm = true;        // false: every run starts cold
  bool fields = false;     // shapes and flow of every iteration for ParaView
  int jobs = 0;            // runs side by side; 0: as many as cores and free memory allow
  bool elsewhere = false;  // other machines run it: this one's memory does not matter
};

/// How one run of a sweep ended.
struct SweepRow {
  bool done = false;               // there is a result
  std::string error;               // why there is none
  ExitCode code = ExitCode::done;  // of that error
  bool waits = false;              // the next call may end otherwise: the disk, another process in its folder
  SteadyResult result;
  SteadyState state;  // the last one of a sweep in memory; else final_state() of the run's folder has it
};

/// Warnings of the runs that have a result: each text once, after the folders of its runs.
std::vector<std::string> sweep_warnings(const std::vector<SweepPoint>& points,
                                        const std::vector<SweepRow>& rows);

/// Called by one run at a time.
struct SweepEvents {
  std::function<void(std::size_t point, const SteadyProgress&, const SteadyState&)> progress;
  std::function<void(std::size_t point, const std::vector<SweepRow>&)> ended;  // with a result or an error
};

/// Throws the exceptions of run_sweep() in this folder before its first run, and changes nothing.
void check_sweep(const std::vector<SweepPoint>& points, const SweepSettings& settings);

/// All tables and plots of the sweep are written: whoever reads its folder notices when one was lost or changed.
void seal_sweep(const std::filesystem::path& folder);

/// How many of these runs fit side by side into this machine's cores and free memory.
int fitting_jobs(const std::vector<SweepPoint>& points);

/// Computes runs without a result; a failed run is recorded in its row and does not stop the others. In memory a
/// neighbour gives its shape and pressure, in folders its flow too. Throws Error(usage) for a folder that
/// contains something else.
std::vector<SweepRow> run_sweep(const std::vector<SweepPoint>& points, const SweepSettings& settings,
                                const SweepEvents& events = {});

/// The runs in waves: each starts from one of an earlier wave, or cold. Runs that run_sweep() computes at the same
/// time can be computed wave by wave on other machines, with the same results.
std::vector<std::vector<std::size_t>> sweep_waves(const std::vector<SweepPoint>& points, bool warm);

/// Makes the folder of a sweep whose runs are done one by one elsewhere. Throws as check_sweep() does.
void prepare_sweep(const std::vector<SweepPoint>& points, const SweepSettings& settings);

/// One run in a folder that prepare_sweep() made. It claims only its own folder, so other runs may be computed at the
/// same time. Throws Error(io) if the run from which it starts is not finished, and as run_steady_in() does.
SteadyResult run_sweep_point(const std::vector<SweepPoint>& points, const SweepSettings& settings,
                             std::size_t point, SteadyObserver& observer);

/// The rows of all runs that have ended, computing nothing; the others are failed ones that wait.
std::vector<SweepRow> gather_sweep(const std::vector<SweepPoint>& points, const SweepSettings& settings);

}  // namespace ripstop::inline run
