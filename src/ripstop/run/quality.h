// Limits of the measures of quality of a result.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ripstop::inline run {

/// One measure. Above `warn` (below it where `at_least`) the result has a warning; beyond `refuse` it must not be used,
/// and the command ends with ExitCode::not_converged.
struct QualityLimit {
  const char* key;  // the member of result.json, or the name of a value that is computed for the check
  const char* name;
  double warn = 0, refuse = 0;
  bool at_least = false;
  double shown_as = 1;  // factor of the number in a message
  const char* unit = "";
  const char* remedy = "";

  /// Whether a value is on the wrong side of `bound`, one of the two above, or not finite. Ten cells across that are
  /// 9.999999999 by rounding are not.
  bool beyond(double value, double bound) const;
};

/// All of them.
const std::vector<QualityLimit>& quality_limits();

/// In the warning of a value beyond `refuse`, and of a result with one. Results are files with warnings as text: these
/// words also identify the reason why a run is not accepted as an input.
inline constexpr const char* refused_text = "must not be used";

/// The part of a warning before these words, with the measure and its value, or the whole warning; empty for a
/// warning without them.
std::string reason_of_refusal(const std::string& warning);

/// A warning without these words: the measure, its value and limit, and the remedy. For a message that states the refusal
/// itself. The whole warning if it has nothing else, or where the words refer to something other than the result.
std::string without_refusal(const std::string& warning);

/// Throws std::logic_error for a key that the list does not have.
const QualityLimit& quality_limit(std::string_view key);

struct QualityValue {
  const char* key;
  double value = 0;
};

struct Judgement {
  std::vector<std::string> warnings;
  bool usable = true;

  void add(const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  }
};

/// Compares `values` with their limits. A value that is not finite is not usable. Throws as quality_limit().
Judgement judge(const std::vector<QualityValue>& values);

}  // namespace ripstop::inline run
