// Values read from a load history.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/fsi/opening_record.h"

namespace ripstop::inline fsi {

struct InflationSummary {
  double last_load = 0;     // mean over the last fifth of the run; a steady load only where settled() [N]
  double unsteadiness = 0;  // standard deviation of the rows there, over last_load
  std::optional<double> inflation_time;  // absent: still outside the band at the end [s]
  /// Of the low-passed load, absent without one; they hardly depend on single swings, as inflation_time does.
  std::optional<double> filling_time;  // first at last_load [s]
  std::optional<double>
      settling_time;            // from then on within 10 % in the mean square over two cutoff periods [s]
  double smooth_peak = 0;       // of the low-passed history; 0: none asked for [N]
  double smooth_peak_time = 0;  // [s]
};

/// Until the row's mean stays within 10 % of the last load: [NFM]. With a low-pass, of
/// the low-passed history. Peaks and filling are sought after `start_up` [s].
InflationSummary summarise(const std::vector<HistoryRow>& rows, double low_pass_hz, double start_up = 0);

/// Projected area of a canopy, or that of its mouth.
struct AreaAt {
  double time = 0, area = 0;  // [s], [m2]
};
/// First full inflation.
struct Filling {
  double time = 0;      // when the area first reaches its mean when full [s]
  double exponent = 0;  // j of the least squares fit ln(area / that mean) = j ln(t / time)
};
/// The canopy is full in the last fifth of the opening, or where its area is largest in it and then decreases by more
/// than 5 %, after that maximum. Nothing for an opening that does not reach the mean area before: it has not filled.
/// The areas are in the order of time.
std::optional<Filling> filling_of(const std::vector<AreaAt>& areas);
/// By the projected area.
std::optional<Filling> filling_of(const std::vector<InflationFrame>& frames);

/// The largest load over every step of the rows that begin after `start_up` [s], of all rows where none does.
struct HighestLoad {
  double load = 0, time = 0;  // [N], [s]
};
HighestLoad highest_load(const std::vector<HistoryRow>& rows, double start_up);

/// One stage of a reefed opening, from cut to cut, or after the last cut. Times within a row.
struct StageSummary {
  std::optional<double> line;            // length of its reefing line [m]; absent: the open canopy
  double begin = 0, end = 0;             // [s]
  double peak_load = 0;                  // over every step [N]
  double peak_time = 0;                  // [s]
  std::optional<double> smooth_peak;     // of the low-passed history [N]
  double last_load = 0;                  // mean over the last fifth of the stage [N]
  std::optional<double> drag_area;       // likewise C_D S in coupled inflation [m2]
  std::optional<double> line_peak;       // tension of the reefing line over every step [N]
  std::optional<double> line_peak_time;  // [s]
};

template <Of<StageSummary> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("line_m", s.line);
  visit("begin_s", s.begin);
  visit("end_s", s.end);
  visit("peak_load_n", s.peak_load);
  visit("peak_time_s", s.peak_time);
  visit("low_pass_peak_load_n", s.smooth_peak);
  visit("load_at_end_n", s.last_load);
  visit("drag_area_at_end_m2", s.drag_area);
  visit("line_peak_n", s.line_peak);
  visit("line_peak_time_s", s.line_peak_time);
}

/// Of an opening whose `lines` [m] were cut at `cuts` [s], as far as it has come. `air` may be empty. Peaks are
/// sought after `start_up` [s].
std::vector<StageSummary> summarise_stages(const std::vector<HistoryRow>& rows,
                                           const std::vector<AirRow>& air, const std::vector<double>& lines,
                                           const std::vector<double>& cuts, double low_pass_hz,
                                           double start_up = 0);

/// Whether the last load is a steady one: the load remained within 10 % of it for at least the last tenth of the
/// `duration` [s] of the opening, half of its averaging interval.
bool settled(const InflationSummary& summary, double duration);

/// Two passes, forth and back, of a second-order Butterworth filter: no delay, half the power twice
/// (-6 dB) at `cutoff_hz`. `interval` [s] between equally spaced values. Throws Error(usage) at or
/// above half their rate.
std::vector<double> low_pass(const std::vector<double>& values, double interval, double cutoff_hz);

}  // namespace ripstop::inline fsi
