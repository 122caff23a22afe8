#include "ripstop/run/report/compare_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ripstop/core/error.h"
#include "ripstop/run/json.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {
namespace {

using Json = nlohmann::ordered_json;

/// Of the computation, not of the parachute.
constexpr std::array<const char*, 5> of_the_computation = {"wall_time_s", "steps", "step_changes",
                                                           "coupling_iterations", "transfer_factor"};

Json compared_result(const std::filesystem::path& folder) {
  const std::optional<std::string> text = finished_result(folder);
  if (!text)
    throw Error(
        ExitCode::usage,
        fmt::format(
            "{} contains no finished run of steady or inflate; name folders of finished runs, or give "
            "--linear to compare the models of a case",
            folder.string()));
  Json result = Json::parse(*text, nullptr, false);
  if (!result.is_object())
    throw Error(ExitCode::bad_data, fmt::format("{}: result.json is not a result", folder.string()));
  return result;
}

ComparedNumber compared_number(const std::string& key, const std::vector<Json>& results) {
  ComparedNumber number{key, {}, {}};
  for (const Json& result : results) {
    const auto found = result.find(key);
    const bool known = found != result.end() && found->is_number();
    number.values.push_back(known ? found->get<double>() : std::numeric_limits<double>::quiet_NaN());
  }
  constexpr double rounding = 1e-9;  // such as a moment about the axis that is 0 but for rounding
  const double first = number.values.front(), last = number.values.back();
  // A quantity that changes its sign has no relative change either.
  if (std::isfinite(first) && std::isfinite(last) && std::abs(first) > rounding && first * last >= 0)
    number.difference = last / first - 1;
  return number;
}

}  // namespace

std::string to_json(const RunComparison& comparison) {
  return json_text(comparison);
}

RunComparison compare_runs(const std::vector<std::filesystem::path>& folders) {
  if (folders.size() < 2)
    throw Error(ExitCode::usage,
                "give two or more folders of finished runs, or one with --measured FILE, or a case file with "
                "--linear");
  RunComparison comparison;
  std::vector<Json> results;
  std::vector<std::string> keys;
  for (const std::filesystem::path& folder : folders) {
    results.push_back(compared_result(folder));
    comparison.runs.push_back(folder.string());
    comparison.titles.push_back(results.back().value("title", std::string()));
    for (const auto& [key, value] : results.back().items())
      if (value.is_number() && std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  }
  for (const std::string& key : keys) {
    if (std::find(of_the_computation.begin(), of_the_computation.end(), key) != of_the_computation.end())
      continue;
    ComparedNumber number = compared_number(key, results);
    const auto known =
        std::count_if(number.values.begin(), number.values.end(), [](double v) { return !std::isnan(v); });
    if (known > 1) comparison.numbers.push_back(std::move(number));
  }
  comparison.warnings = warnings_of_shown(folders);
  return comparison;
}

}  // namespace ripstop::inline run
