#include "ripstop/run/opening/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/file.h"
#include "ripstop/run/json.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {
namespace {

constexpr double usual_imperfection = 0.01;  // of the radius of the folded skirt (assumed)

std::optional<double> number_of(const nlohmann::json& result, const char* key) {
  const auto found = result.find(key);
  if (found == result.end() || !found->is_number()) return {};
  return found->get<double>();
}

}  // namespace

std::optional<Statistic> statistic_of(const std::vector<std::optional<double>>& values) {
  std::vector<double> there;
  for (const auto& value : values)
    if (value) there.push_back(*value);
  if (there.empty()) return {};
  Statistic s;
  s.openings = static_cast<int>(there.size());
  for (const double value : there) s.mean += value / double(there.size());
  double squares = 0;
  for (const double value : there) squares += (value - s.mean) * (value - s.mean);
  if (there.size() > 1) s.standard_deviation = std::sqrt(squares / double(there.size() - 1));
  const auto [lowest, highest] = std::minmax_element(there.begin(), there.end());
  s.lowest = *lowest, s.highest = *highest;
  return s;
}

void summarise_samples(const std::vector<std::string>& texts, SampleSummary& summary) {
  std::vector<nlohmann::json> results;
  for (const std::string& text : texts) results.push_back(nlohmann::json::parse(text));
  const auto over_all = [&](const char* key) {
    std::vector<std::optional<double>> values;
    for (const nlohmann::json& result : results) values.push_back(number_of(result, key));
    return statistic_of(values);
  };
  summary.peak_load = over_all("peak_load_n"), summary.smooth_peak = over_all("low_pass_peak_load_n");
  summary.filling_time = over_all("filling_time_s");
  summary.filling_distance = over_all("filling_distance_diameters");
  summary.opening_force_coefficient = over_all("opening_force_coefficient");
  summary.finite_mass_factor = over_all("finite_mass_factor");
  const auto warn_of = [&](const char* key, const char* meaning) {
    std::string names;
    int count = 0;
    for (std::size_t n = 0; n < results.size(); ++n) {
      const auto found = results[n].find(key);
      if (found == results[n].end() || !found->is_boolean() || found->get<bool>()) continue;
      names += (count++ ? ", " : "") + summary.folders[n];
    }
    if (count > 0)
      summary.warnings.push_back(
          fmt::format("{} of {} openings {}: {}", count, results.size(), meaning, names));
  };
  warn_of("filled", "ended before the canopy had filled; increase the duration");
  warn_of("usable", "must not be used, see their warnings");
  std::vector<RunEnd> ends;
  for (std::size_t n = 0; n < texts.size(); ++n) {
    ends.push_back(end_of_run(texts[n], summary.folders[n]));
    summary.usable = summary.usable && ends.back().usable;
    ends.back().usable = true;  // listed above
  }
  for (std::string& text : grouped_warnings(ends)) summary.warnings.push_back(std::move(text));
}

std::string to_json(const SampleSummary& summary) {
  return json_text(summary);
}

Settings with_seed(const Settings& resolved, int seed) {
  Case changed = resolved.written();
  InflationSettings& inflation = changed.inflation;
  inflation.imperfection_seed = seed;
  if (inflation.imperfection_m == 0)
    inflation.imperfection_m = usual_imperfection * inflation.initial_radius_m.value_or(0);
  return resolve(changed);
}

SampleSummary run_samples(const InflationFolderSettings& settings, const Settings& resolved, int samples,
                          const std::function<void(const InflationFolderSettings&, const Settings&)>& open) {
  make_results_folder(settings.run.folder, "inflate");
  SampleSummary summary;
  summary.title = resolved.title(), summary.samples = samples;
  std::vector<std::string> results;
  for (int seed = 1; seed <= samples; ++seed) {
    InflationFolderSettings one = settings;
    const std::string name = fmt::format("sample-{:03}", seed);
    one.run.folder = settings.run.folder / name;
    one.keep_end = false;
    open(one, with_seed(resolved, seed));
    summary.folders.push_back(name);
    results.push_back(finished_result(one.run.folder).value());
  }
  summarise_samples(results, summary);
  write_file(settings.run.folder / "result.json", to_json(summary));
  return summary;
}

}  // namespace ripstop::inline run
