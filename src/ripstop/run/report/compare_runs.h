// Numbers of finished runs side by side: `ripstop compare RUN RUN ...`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/members.h"

namespace ripstop::inline run {

struct ComparedNumber {
  std::string key;                   // of result.json
  std::vector<double> values;        // one a run; NaN, in JSON null: the run has no such number
  std::optional<double> difference;  // of the last run's to the first one's, relative; absent: not known
};
template <Of<ComparedNumber> T, class Visit>
void each_member(T& n, Visit&& visit) {
  visit("key", n.key);
  visit("values", n.values);
  visit("relative_difference", n.difference);
}

struct RunComparison {
  std::vector<std::string> runs, titles;
  std::vector<ComparedNumber> numbers;  // in the order of result.json
  std::vector<std::string> warnings;    // of the runs
};
template <Of<RunComparison> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("runs", c.runs);
  visit("titles", c.titles);
  visit("numbers", c.numbers);
  visit("warnings", c.warnings);
}
std::string to_json(const RunComparison& comparison);

/// All numbers of their result.json that two runs at least have, without those that describe the computation. Throws
/// Error(usage) for fewer than two folders or one without a finished run, Error(bad_data) for a damaged one.
RunComparison compare_runs(const std::vector<std::filesystem::path>& folders);

}  // namespace ripstop::inline run
