#include "ripstop/fsi/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"

namespace ripstop::inline fsi {
namespace {

constexpr double steady_band = 0.1;

// y_n = b0 (x_n + 2 x_{n-1} + x_{n-2}) - a1 y_{n-1} - a2 y_{n-2}: the bilinear transform of 1 / (s^2 + sqrt2
// s + 1) with the cutoff prewarped. Starts as if the first value had always been there.
std::vector<double> butterworth(const std::vector<double>& x, double k) {
  const double scale = 1 / (1 + std::numbers::sqrt2 * k + k * k);
  const double b0 = k * k * scale, a1 = 2 * (k * k - 1) * scale,
               a2 = (1 - std::numbers::sqrt2 * k + k * k) * scale;
  std::vector<double> y(x.size());
  double x1 = x.front(), x2 = x1, y1 = x1, y2 = x1;
  for (std::size_t i = 0; i < x.size(); ++i) {
    y[i] = b0 * (x[i] + 2 * x1 + x2) - a1 * y1 - a2 * y2;
    x2 = x1, x1 = x[i], y2 = y1, y1 = y[i];
  }
  return y;
}

// The beginning of the first window after which no window's root mean square deviation leaves the band.
std::optional<double> settling_time(const std::vector<double>& load, double steady, double interval,
                                    double window_time) {
  const double rows = std::round(window_time / interval);
  if (!(rows >= 1 && rows <= static_cast<double>(load.size()))) return {};
  const auto window = static_cast<std::size_t>(rows);
  std::vector<double> before(load.size() + 1, 0.0);
  for (std::size_t i = 0; i < load.size(); ++i) before[i + 1] = before[i] + std::pow(load[i] / steady - 1, 2);
  std::size_t begin = load.size() - window + 1;
  const double allowed = steady_band * steady_band * static_cast<double>(window);
  while (begin > 0 && before[begin - 1 + window] - before[begin - 1] <= allowed) --begin;
  if (begin > load.size() - window) return {};
  return static_cast<double>(begin) * interval;
}

std::vector<double> means_of(const std::vector<HistoryRow>& rows) {
  std::vector<double> means;
  for (const HistoryRow& row : rows) means.push_back(row.mean);
  return means;
}

/// How many rows have ended by a time.
template <class Row>
std::ptrdiff_t rows_until(const std::vector<Row>& rows, double time) {
  const double with_rounding = time * (1 + 1e-9);
  return std::upper_bound(rows.begin(), rows.end(), with_rounding,
                          [](double t, const Row& row) { return t < row.time; }) -
         rows.begin();
}

/// The first row whose interval begins at `start_up` or later; the first of all for 0.
std::vector<HistoryRow>::const_iterator first_after(const std::vector<HistoryRow>& rows, double start_up) {
  if (start_up <= 0) return rows.begin();
  return rows.begin() + std::min<std::ptrdiff_t>(rows_until(rows, start_up) + 1, std::ssize(rows));
}

/// Over the rows that end in (from, to], the last of them at least.
template <class Row>
double mean_between(const std::vector<Row>& rows, double from, double to, double Row::*member) {
  const std::ptrdiff_t end = rows_until(rows, to), begin = std::min(rows_until(rows, from), end - 1);
  double sum = 0;
  for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(begin, 0); i < end; ++i) sum += rows[i].*member;
  return end > 0 ? sum / static_cast<double>(end - std::max<std::ptrdiff_t>(begin, 0)) : 0;
}

}  // namespace

std::vector<double> low_pass(const std::vector<double>& values, double interval, double cutoff_hz) {
  if (!(cutoff_hz > 0 && cutoff_hz * interval < 0.5)) {
    throw QuantityError(ExitCode::usage,
                        fmt::format("low-pass cutoff = {}: must be above 0 and below half the rate of the "
                                    "history, {:.6g} Hz; increase the history rate",
                                    cutoff_hz, 0.5 / interval),
                        {"low-pass cutoff", "the history rate"});
  }
  if (values.empty()) return {};
  const double k = std::tan(std::numbers::pi * cutoff_hz * interval);
  std::vector<double> forth = butterworth(values, k);
  std::reverse(forth.begin(), forth.end());
  std::vector<double> back = butterworth(forth, k);
  std::reverse(back.begin(), back.end());
  return back;
}

bool settled(const InflationSummary& summary, double duration) {
  return summary.inflation_time && *summary.inflation_time <= 0.9 * duration;
}

std::vector<StageSummary> summarise_stages(const std::vector<HistoryRow>& rows,
                                           const std::vector<AirRow>& air, const std::vector<double>& lines,
                                           const std::vector<double>& cuts, double low_pass_hz,
                                           double start_up) {
  std::vector<StageSummary> stages;
  if (rows.empty()) return stages;
  std::vector<double> smooth;
  if (low_pass_hz > 0) smooth = low_pass(means_of(rows), rows.front().time, low_pass_hz);
  for (std::size_t i = 0; i <= cuts.size(); ++i) {
    StageSummary stage;
    stage.begin = i == 0 ? 0 : cuts[i - 1];
    stage.end = i < cuts.size() ? cuts[i] : rows.back().time;
    if (i < lines.size()) stage.line = lines[i];
    const auto last = rows.begin() + rows_until(rows, stage.end);
    auto first = rows.begin() + rows_until(rows, stage.begin);
    if (first == last) continue;
    if (const auto after = first_after(rows, start_up); after > first && after < last) first = after;
    const auto peak = std::max_element(first, last, [](auto& a, auto& b) { return a.largest < b.largest; });
    stage.peak_load = peak->largest, stage.peak_time = peak->time;
    if (!smooth.empty())
      stage.smooth_peak =
          *std::max_element(smooth.begin() + (first - rows.begin()), smooth.begin() + (last - rows.begin()));
    const double fifth = stage.end - 0.2 * (stage.end - stage.begin);
    stage.last_load = mean_between(rows, fifth, stage.end, &HistoryRow::mean);
    if (!air.empty()) stage.drag_area = mean_between(air, fifth, stage.end, &AirRow::drag_area);
    if (stage.line) {
      const auto pulled = std::max_element(
          first, last, [](auto& a, auto& b) { return a.reefing_largest < b.reefing_largest; });
      stage.line_peak = pulled->reefing_largest, stage.line_peak_time = pulled->time;
    }
    stages.push_back(stage);
  }
  return stages;
}

namespace {

/// The first of the areas whose mean is that of the full canopy: of the last fifth, or where the canopy is largest
/// within it and then contracts, of those that follow.
std::size_t begin_of_full(const std::vector<AreaAt>& areas) {
  constexpr double contracted = 0.95;  // of the largest area: less is no scatter of a canopy that still grows
  const std::size_t last = areas.size() - areas.size() / 5;
  const auto largest = std::ranges::max_element(areas, {}, &AreaAt::area);
  const auto least = std::ranges::min_element(largest, areas.end(), {}, &AreaAt::area);
  const auto at = static_cast<std::size_t>(largest - areas.begin());
  const bool past = least->area < contracted * largest->area;
  return at >= last && past ? at + 1 : last;
}

}  // namespace

std::optional<Filling> filling_of(const std::vector<AreaAt>& areas) {
  constexpr double folded =
      0.5;  // of the area when full: a canopy that starts with more has not opened since
  if (areas.size() < 5) return {};
  const std::size_t last = begin_of_full(areas);
  double full = 0;
  for (std::size_t i = last; i < areas.size(); ++i) full += areas[i].area / double(areas.size() - last);
  if (areas.front().area > folded * full) return {};
  full *= 1 - 1e-9;  // a constant area reaches its mean to rounding only
  std::size_t first = 0;
  while (first < last && areas[first].area < full) ++first;
  if (first == last || first == 0) return {};
  const AreaAt &a = areas[first - 1], &b = areas[first];
  const double share = (full - a.area) / (b.area - a.area);
  Filling filling{a.time + share * (b.time - a.time), 0};
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < first; ++i) {
    if (!(areas[i].area > 0 && areas[i].time > 0)) continue;
    const double t = std::log(areas[i].time / filling.time);
    products += t * std::log(areas[i].area / full), squares += t * t;
  }
  if (squares > 0) filling.exponent = products / squares;
  return filling;
}

std::optional<Filling> filling_of(const std::vector<InflationFrame>& frames) {
  std::vector<AreaAt> areas;
  for (const InflationFrame& frame : frames) areas.push_back({frame.time, frame.size.projected_area});
  return filling_of(areas);
}

HighestLoad highest_load(const std::vector<HistoryRow>& rows, double start_up) {
  if (rows.empty()) return {};
  auto first = first_after(rows, start_up);
  if (first == rows.end()) first = rows.begin();
  const auto peak =
      std::max_element(first, rows.end(), [](auto& a, auto& b) { return a.largest < b.largest; });
  return {peak->largest, peak->time};
}

InflationSummary summarise(const std::vector<HistoryRow>& rows, double low_pass_hz, double start_up) {
  InflationSummary summary;
  if (rows.empty()) return summary;
  std::vector<double> load = means_of(rows);
  const std::size_t last = rows.size() - std::max<std::size_t>(1, rows.size() / 5);
  const double count = static_cast<double>(rows.size() - last);
  for (std::size_t i = last; i < rows.size(); ++i) summary.last_load += load[i] / count;
  double variance = 0;
  for (std::size_t i = last; i < rows.size(); ++i)
    variance += std::pow(load[i] - summary.last_load, 2) / count;
  summary.unsteadiness = std::sqrt(variance) / summary.last_load;

  if (low_pass_hz > 0) {
    load = low_pass(load, rows.front().time, low_pass_hz);
    auto begin = load.begin() + (first_after(rows, start_up) - rows.begin());
    if (begin == load.end()) begin = load.begin();
    const auto highest = std::max_element(begin, load.end());
    summary.smooth_peak = *highest;
    summary.smooth_peak_time = rows[highest - load.begin()].time;
    const auto full = std::find_if(begin, load.end(), [&](double f) { return f >= summary.last_load; });
    if (full != load.end()) summary.filling_time = rows[full - load.begin()].time;
    summary.settling_time = settling_time(load, summary.last_load, rows.front().time, 2 / low_pass_hz);
  }
  std::size_t settled = rows.size();
  while (settled > 0 && std::abs(load[settled - 1] / summary.last_load - 1) <= steady_band) --settled;
  if (settled < rows.size()) summary.inflation_time = settled == 0 ? 0 : rows[settled - 1].time;
  return summary;
}

}  // namespace ripstop::inline fsi
