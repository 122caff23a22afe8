// The files of `ripstop load`.
#include <algorithm>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/opening/load.h"

namespace ripstop::inline run {
namespace {

constexpr double shown_after_peak =
    12;  // of the time to the last stage's peak: the long descent is left to the table

CsvTable table_of(const std::vector<FlightRow>& rows) {
  CsvTable table{columns_of<FlightRow>(), {}};
  for (const FlightRow& row : rows) table.rows.push_back(row_of(row));
  return table;
}

template <class Value>
PlotSeries series_of(const std::string& name, const std::vector<FlightRow>& rows, double end, Value value) {
  PlotSeries series;
  series.name = name;
  series.markers = false;
  for (const FlightRow& row : rows) {
    if (row.state.time > end) break;
    series.x.push_back(row.state.time);
    series.y.push_back(value(row));
  }
  return series;
}

double end_of_plot(const LoadResult& r) {
  const StageLoads& last = r.stages.back();
  return last.begin + std::max(shown_after_peak * last.filling_time / 4, 3 * last.filling_time);
}

}  // namespace

void write_load(const std::filesystem::path& folder, const LoadResult& r) {
  make_results_folder(folder, "load");
  write_csv(folder / "trajectory.csv", table_of(r.flight));
  if (!r.record_flight.empty()) write_csv(folder / "trajectory_computed.csv", table_of(r.record_flight));
  const double end = end_of_plot(r);
  const auto plot = [&](const char* file, const char* label, auto value) {
    Plot picture;
    picture.title = r.title;
    picture.x.label = "time since line stretch [s]";
    picture.y.label = label;
    picture.series.push_back(series_of("drag area by the filling law", r.flight, end, value));
    if (!r.record_flight.empty())
      picture.series.push_back(series_of("drag area of the computed opening", r.record_flight, end, value));
    write_plot(folder / file, picture);
  };
  plot("force.png", "force on the riser [N]", [](const FlightRow& row) { return row.force; });
  plot("speed.png", "speed [m/s]", [](const FlightRow& row) { return row.state.speed; });
  write_file(folder / "result.json", to_json(r));
}

}  // namespace ripstop::inline run
