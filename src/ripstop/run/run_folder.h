// The folder of a run, whatever runs in it: the inputs that it belongs to, its artefacts, and whether it has ended.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/output/vtk.h"

namespace ripstop::inline run {

struct RunSettings {
  std::filesystem::path folder;
  bool fresh = false;  // remove the files that Ripstop wrote there in an earlier run
  bool fields = true;  // write flow and shapes for ParaView after every iteration; else the last shape only
  bool report = true;  // write report.html at the end
};

/// Hash of the inputs of the run in this folder (`inputs_hash` of run.json and result.json).
std::optional<std::string> inputs_of_run(const std::filesystem::path& folder);

/// runs/<name of the case>: that of its file, or of the file's folder where the file is just "case.toml".
std::filesystem::path default_run_folder(const std::filesystem::path& case_file,
                                         const std::string& what = "");

/// Whether the folder contains a run of these inputs that can resume. `solver` describes the solver and its inputs
/// other than the case. Throws Error(usage) for a folder with a run of other inputs that has results, unless `fresh`,
/// and for one with other files and without a run.
bool holds_run(const RunSettings& settings, const Settings& resolved, const std::string& solver);

/// Throws Error(usage) for the folder of a run that has no records of its files: one of an early version, or a copy
/// without them.
void refuse_without_records(const std::filesystem::path& folder);

/// Whether the folder contains a finished steady run of these inputs that has not converged within a lower
/// coupling.max_iterations; it continues to the present one. Throws Error(bad_data) for a damaged one.
bool continues_run(const RunSettings& settings, const Settings& resolved, const std::string& solver);

/// The folder of one run while the run uses it.
class RunFolder : public ClaimedFolder {
 public:
  explicit RunFolder(const RunSettings& settings) : ClaimedFolder(settings.folder), settings_(settings) {}

  const RunSettings& settings() const { return settings_; }
  /// result.json of the run, which had ended. Throws as finished_result().
  std::optional<std::string> finished() const;

  /// Artefacts: each kind has one format.
  void write(const std::string& name, const std::string& text) { write_file(own(name), text); }
  void write(const std::string& name, const CsvTable& table) { write_csv(own(name), table); }
  void write(const std::string& name, const Plot& plot) { write_plot(own(name), plot); }
  void write(const std::string& name, const VtkSurface& surface) { write_vtp(own(name), surface); }
  void write(const std::string& name, const std::vector<VtkSeriesFile>& series) {
    write_pvd(own(name), series);
  }

  /// The result, which gets the hash of the run's inputs, the report if it is wanted, and the seal. Returns the
  /// reason why there is no report; empty: none.
  template <class Result>
  [[nodiscard]] std::string end(Result result) {
    result.inputs_hash = inputs_of_run(path());
    return end_with(to_json(result));
  }
  [[nodiscard]] std::string end_with(const std::string& result_json);

 private:
  RunSettings settings_;
};

/// Opens or makes the folder of a run, claims it and writes run.json and case.toml, unless the run has ended. Files
/// that Ripstop wrote for another run are removed; a folder that holds_run() refuses is left unchanged. Throws as
/// ClaimedFolder does.
std::unique_ptr<RunFolder> open_run_folder(const RunSettings& settings, const Settings& resolved,
                                           const std::string& solver, int threads);

/// Of a folder of several runs, which the file `description` lists: throws Error(usage) where another process uses it,
/// and where other files are there; `what` names the runs, as "sweep of Ripstop".
void check_series_folder(const std::filesystem::path& folder, const std::string& description,
                         const std::string& what);

/// Hash of all inputs of a result: this version, the case, and the options.
std::string inputs_hash(const Settings& resolved, const std::string& what);

/// Throws Error(bad_data) that names missing or changed files of a sealed folder, except `except`.
void require_whole(const std::filesystem::path& folder, const std::string& except = "");

/// Throws Error(bad_data) that names files missing or changed after the checkpoint from which a run resumes.
void refuse_lost(const ClaimedFolder& folder);

/// result.json of a run that had ended. Throws Error(bad_data) when it or any other file of the run was
/// lost or changed since, or is of other inputs than the folder.
std::optional<std::string> finished_result(const std::filesystem::path& folder);
/// Throws Error(usage): the folder does not exist, or contains no finished run of `command` ("steady"), with the command
/// that computes one.
[[noreturn]] void refuse_unfinished(const std::filesystem::path& folder, const char* command);

}  // namespace ripstop::inline run
