#include "ripstop/run/opening/measured_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/json.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {
namespace {

/// Load over time, times ascending.
struct LoadRecord {
  std::vector<double> time, load;

  /// Linear between two rows.
  double at(double t) const {
    const auto above = std::upper_bound(time.begin(), time.end(), t);
    if (above == time.begin()) return load.front();
    if (above == time.end()) return load.back();
    const auto i = static_cast<std::size_t>(above - time.begin());
    const double share = (t - time[i - 1]) / (time[i] - time[i - 1]);
    return load[i - 1] + share * (load[i] - load[i - 1]);
  }
  std::pair<double, double> peak() const {  // time, load
    const auto highest = std::max_element(load.begin(), load.end());
    return {time[static_cast<std::size_t>(highest - load.begin())], *highest};
  }
};

/// Effect of a shift of the measured time.
struct Overlap {
  double begin = 0, end = 0;  // [s]
  double mean_square = std::numeric_limits<double>::infinity(), computed_impulse = 0, measured_impulse = 0;
};

Overlap overlap_of(const LoadRecord& computed, const LoadRecord& measured, double shift) {
  constexpr int pieces = 2000;
  Overlap o;
  o.begin = std::max(computed.time.front(), measured.time.front() + shift);
  o.end = std::min(computed.time.back(), measured.time.back() + shift);
  if (!(o.end > o.begin)) return o;
  const double step = (o.end - o.begin) / pieces;
  double squares = 0;
  for (int i = 0; i < pieces; ++i) {
    const double t = o.begin + (i + 0.5) * step, a = computed.at(t), b = measured.at(t - shift);
    squares += (a - b) * (a - b);
    o.computed_impulse += a * step, o.measured_impulse += b * step;
  }
  o.mean_square = squares / pieces;
  return o;
}

/// The shift of least mean square difference among those for which at least half of the shorter record overlaps: by a
/// scan, and by a finer one about the best.
double best_shift(const LoadRecord& computed, const LoadRecord& measured) {
  constexpr int tries = 400;
  const double length = computed.time.back() - computed.time.front(),
               other = measured.time.back() - measured.time.front();
  const double least = 0.5 * std::min(length, other);
  double low = computed.time.front() + least - measured.time.back(),
         high = computed.time.back() - least - measured.time.front();
  double best = 0;
  for (int round = 0; round < 3; ++round) {
    double smallest = std::numeric_limits<double>::infinity();
    const double step = (high - low) / tries;
    for (int i = 0; i <= tries; ++i) {
      const double shift = low + i * step;
      const double mean_square = overlap_of(computed, measured, shift).mean_square;
      if (mean_square < smallest) smallest = mean_square, best = shift;
    }
    low = best - step, high = best + step;
  }
  return best;
}

LoadRecord computed_record(const std::filesystem::path& run) {
  if (!finished_result(run) || !std::filesystem::exists(run / "history.csv"))
    refuse_unfinished(run, "inflate");
  const CsvTable table = read_csv(run / "history.csv");
  return {table.column("time_s"), table.column("load_mean_n")};
}

LoadRecord measured_record(const MeasuredLoadRequest& request) {
  using table::Quantity;
  const table::Table read =
      table::read_table(request.file, {{Quantity::time, Quantity::force}, request.columns, request.decimal});
  if (read.specimens.size() > 1)
    throw Error(ExitCode::bad_data, fmt::format("{} has {} records; keep one of them", request.file.string(),
                                                read.specimens.size()));
  const table::Specimen& record = read.specimens.front();
  LoadRecord measured{need_only(read, record, Quantity::time).values,
                      need_only(read, record, Quantity::force).values};
  for (std::size_t i = 1; i < measured.time.size(); ++i)
    if (!(measured.time[i] > measured.time[i - 1]))
      throw Error(
          ExitCode::bad_data,
          fmt::format("{}:{}: the time of {:g} s is not after {:g} s of the row before; "
                      "sort the rows by time",
                      request.file.string(), record.lines[i], measured.time[i], measured.time[i - 1]));
  if (measured.time.size() < 3)
    throw Error(ExitCode::bad_data,
                fmt::format("{}: a load over time has three rows at least", request.file.string()));
  return measured;
}

}  // namespace

std::string to_json(const MeasuredLoad& comparison) {
  return json_text(comparison);
}

MeasuredLoad compare_load(const MeasuredLoadRequest& request) {
  const LoadRecord computed = computed_record(request.run), measured = measured_record(request);
  MeasuredLoad m;
  m.warnings = warnings_of_shown({request.run});
  m.title = nlohmann::json::parse(*finished_result(request.run)).value("title", std::string());
  m.run = request.run.string(), m.file = request.file.string();
  m.shift = request.shift ? *request.shift : best_shift(computed, measured);
  m.shift_from = request.shift ? "given" : "least mean square difference";
  const Overlap overlap = overlap_of(computed, measured, m.shift);
  m.overlap = overlap.end - overlap.begin;
  if (!(m.overlap > 0))
    throw Error(
        ExitCode::usage,
        fmt::format("with a shift of {:g} s the measured load and the computed one have no time in common; "
                    "leave --time-shift out to find it",
                    m.shift));
  std::tie(m.computed_peak_time, m.computed_peak) = computed.peak();
  std::tie(m.measured_peak_time, m.measured_peak) = measured.peak();
  if (!(m.measured_peak > 0))
    throw Error(ExitCode::bad_data,
                fmt::format("{}: the largest force is {:g} N; a load is positive in tension",
                            request.file.string(), m.measured_peak));
  m.measured_peak_time += m.shift;
  m.peak_difference = m.computed_peak / m.measured_peak - 1;
  m.rms_difference = std::sqrt(overlap.mean_square);
  m.computed_impulse = overlap.computed_impulse, m.measured_impulse = overlap.measured_impulse;
  m.time = measured.time, m.measured = measured.load;
  for (double& t : m.time) t += m.shift;
  m.computed_time = computed.time, m.computed = computed.load;
  return m;
}

void write_measured_load(const std::filesystem::path& folder, const MeasuredLoad& comparison) {
  make_results_folder(folder, "compare");
  Plot plot{comparison.title, {"time [s]"}, {"load [N]"}, {}};
  plot.series.push_back({"computed", comparison.computed_time, comparison.computed, true, false, false});
  plot.series.push_back({"measured", comparison.time, comparison.measured, true, false, true});
  for (const char* name : {"load.svg", "load.png"}) write_plot(folder / name, plot);
  write_file(folder / "result.json", to_json(comparison));
}

}  // namespace ripstop::inline run
