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
  bool fresh = false;  // remove the files that Ripstop wrote there in an earlier run
  bool fields = true;  // write flow and shapes for ParaView after every iteration; else the last shape only
  bool report = true;  // write report.html at the end
};

/// runs/<name of the case>: that of its file, or of the file's folder where the file is just "case.toml".
std::filesystem::path default_run_folder(const std::filesystem::path& case_file,
                                         const std::string& what = "");

/// Whether the folder contains a run of these inputs that can resume. `solver` describes the solver and its inputs
/// other than the case. Throws Error(usage) for a folder with a run of other inputs that has results, unless `fresh`,
/// and for one with other files and without a run.
bool holds_run(const RunSettings& settings, const Settings& resolved, const std::string& solver);

/// Opens or makes the folder of a run, claims it and writes run.json and case.toml, unless the run has ended. Files
/// that Ripstop wrote for another run are removed; a folder that holds_run() refuses is left unchanged. Throws as
/// ClaimedFolder does.
std::unique_ptr<ClaimedFolder> open_run_folder(const RunSettings& settings, const Settings& resolved,
                                               const std::string& solver, int threads);

/// Hash of all inputs of a result: this version, the case, and the options.
std::string inputs_hash(const Settings& resolved, const std::string& what);

/// Hash of the inputs of the run in this folder (`inputs_hash` of run.json and result.json).
std::optional<std::string> inputs_of_run(const std::filesystem::path& folder);

/// Throws Error(bad_data) that names missing or changed files of a sealed folder, except `except`.
void require_whole(const std::filesystem::path& folder, const std::string& except = "");

/// Throws Error(bad_data) that names files missing or changed after the checkpoint from which a run resumes.
void refuse_lost(const ClaimedFolder& folder);

/// result.json of a run that had ended. Throws Error(bad_data) when it or any other file of the run was
/// lost or changed since, or is of other inputs than the folder.
std::optional<std::string> finished_result(const std::filesystem::path& folder);

}  // namespace ripstop
