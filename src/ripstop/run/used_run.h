// Warnings and end of a run whose numbers another command uses or shows: every command that takes the folder of a run
// takes them over.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ripstop::inline run {

/// How a run ended, by its result.json.
struct RunEnd {
  std::string name;                // of the run in messages: its folder
  std::vector<std::string> texts;  // its warnings
  bool usable = true;              // false: not converged, or beyond a limit of quality (exit code 4)

  /// The warnings, each after the name. A run that must not be used has a first one that states it.
  std::vector<std::string> warnings() const;
};

/// Of a run, of a sweep (the runs that have a result) or of a curve of stability.
RunEnd end_of_run(const std::string& result_json, const std::string& name);
/// Of the finished run in a folder; without one, an end without warnings. Throws as finished_result().
RunEnd end_of_run(const std::filesystem::path& folder);

/// For a command that computes from the numbers of a run. Throws Error(bad_data) for a run that must not be used.
std::vector<std::string> warnings_if_usable(const RunEnd& end);
/// The same of runs in folders; empty paths are left out.
std::vector<std::string> warnings_of_used(const std::vector<std::filesystem::path>& folders);
/// For a command that shows numbers of runs, also of those that must not be used.
std::vector<std::string> warnings_of_shown(const std::vector<std::filesystem::path>& folders);

/// Adds the warnings of the run to those of a result, without texts that the result has itself.
void add_warnings_of(const RunEnd& end, std::vector<std::string>& warnings);

/// Warnings of several runs: each text once, after the names of its runs, or after "all N runs".
std::vector<std::string> grouped_warnings(const std::vector<RunEnd>& ends);

}  // namespace ripstop::inline run
