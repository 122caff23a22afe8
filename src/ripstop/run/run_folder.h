// The folder of a run, whatever runs in it: which inputs it is of, and whether it has ended.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "ripstop/case/settings.h"
#include "ripstop/core/claimed_folder.h"

namespace ripstop {

struct RunSettings {
  std::filesystem::path folder;
  bool fresh = false;  // throw away what Ripstop wrote there in an earlier run
  bool fields = true;  // write flow and shapes for ParaView after every iteration; else the last shape only
  bool report = true;  // write report.html at the end
};

/// runs/<name of the case>: that of its file, or of the file's folder where the file is just "case.toml".
std::filesystem::path default_run_folder(const std::filesystem::path& case_file,
                                         const std::string& what = "");

/// Whether the folder holds a run of these inputs to go on with. `solver` says what computes, and with what
/// beside the case. Throws Error(usage) for a folder that holds a run of other inputs which has got anywhere,
/// unless `fresh`, and for one with files that are not Ripstop's and no run.
bool holds_run(const RunSettings& settings, const Settings& resolved, const std::string& solver);

/// Opens or makes the folder of a run, claims it and writes run.json and case.toml, unless the run has ended. What is
/// there of another run is removed as far as Ripstop wrote it; what holds_run() refuses is left as it is. Throws as
/// ClaimedFolder does.
std::unique_ptr<ClaimedFolder> open_run_folder(const RunSettings& settings, const Settings& resolved,
                                               const std::string& solver, int threads);

/// Hash of everything that a result is of: this version, the case, and what else was asked for.
std::string inputs_hash(const Settings& resolved, const std::string& what);

/// Hash of what the run of this folder is of (`inputs_hash` of run.json and result.json).
std::optional<std::string> inputs_of_run(const std::filesystem::path& folder);

/// Throws Error(bad_data) naming what was lost or changed of a sealed folder, but for `except`.
void require_whole(const std::filesystem::path& folder, const std::string& except = "");

/// Throws Error(bad_data) naming what was lost or changed since the checkpoint that a run goes on from.
void refuse_lost(const ClaimedFolder& folder);

/// result.json of a run that had ended. Throws Error(bad_data) when it or any other file of the run was
/// lost or changed since, or is of other inputs than the folder.
std::optional<std::string> finished_result(const std::filesystem::path& folder);

}  // namespace ripstop
