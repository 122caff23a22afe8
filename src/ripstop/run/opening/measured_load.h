// A measured load over time compared with that of a computed opening: `ripstop compare RUN --measured FILE`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/core/table/table.h"

namespace ripstop::inline run {

struct MeasuredLoadRequest {
  std::filesystem::path run, file;  // folder of an opening; table of time and force, docs/guide/tables.md
  std::vector<table::ColumnChoice> columns;
  table::Decimal decimal = table::Decimal::automatic;
  std::optional<double> shift;  // of the measured time [s]; absent: where both agree best
};

/// result.json of that comparison.
struct MeasuredLoad {
  std::string title, run, file;
  double shift = 0;                                  // that was added to the measured time [s]
  std::string shift_from;                            // given, or fitted
  double computed_peak = 0, computed_peak_time = 0;  // of the mean over each block of steps [N], [s]
  double measured_peak = 0, measured_peak_time = 0;
  double peak_difference = 0;                                   // computed to measured, relative
  double overlap = 0;                                           // time for which both are known [s]
  double rms_difference = 0;                                    // over that time [N]
  double computed_impulse = 0, measured_impulse = 0;            // over that time [N s]
  std::vector<std::string> warnings;                            // of the run
  std::vector<double> time, measured, computed_time, computed;  // not in result.json: load.svg and load.png
};
template <Of<MeasuredLoad> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("title", m.title);
  visit("run", m.run);
  visit("measured_file", m.file);
  visit("time_shift_s", m.shift);
  visit("time_shift_from", m.shift_from);
  visit("computed_peak_n", m.computed_peak);
  visit("computed_peak_time_s", m.computed_peak_time);
  visit("measured_peak_n", m.measured_peak);
  visit("measured_peak_time_s", m.measured_peak_time);
  visit("peak_difference", m.peak_difference);
  visit("overlap_s", m.overlap);
  visit("rms_difference_n", m.rms_difference);
  visit("computed_impulse_n_s", m.computed_impulse);
  visit("measured_impulse_n_s", m.measured_impulse);
  visit("warnings", m.warnings);
}
std::string to_json(const MeasuredLoad& comparison);

/// Throws Error(usage) for a folder without a finished opening and where both have no time in common, Error(bad_data)
/// for a table that cannot be read.
MeasuredLoad compare_load(const MeasuredLoadRequest& request);

/// load.svg, load.png and result.json.
void write_measured_load(const std::filesystem::path& folder, const MeasuredLoad& comparison);

}  // namespace ripstop::inline run
