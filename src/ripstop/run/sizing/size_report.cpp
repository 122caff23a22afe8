#include "ripstop/run/sizing/size_report.h"

#include "ripstop/core/build_info.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/report/report_tables.h"

namespace ripstop::inline run {
namespace {

template <class Value>
ReportPlot flight_plot(const SizeResult& r, const char* id, const char* title, ReportColumn y, Value value) {
  ReportPlot plot{id, title, {"time since line stretch", "s"}, std::move(y), {}};
  ReportSeries series;
  series.name = "drag area by the filling law";
  const double end = 3 * r.opening.front().filling_time;
  for (const FlightRow& row : r.flight) {
    if (row.state.time > end) break;
    series.x.push_back(row.state.time);
    series.y.push_back(value(row));
  }
  plot.series.push_back(std::move(series));
  return plot;
}

ReportRun sizing(const SizeResult& r) {
  ReportRun run;
  add_result(run, to_json(r), "result.json");
  run.kind = "size";
  run.name = r.family;
  run.title = r.given.title;
  run.headline = {"nominal_diameter_m",    "drag_coefficient",       "drag_coefficient_basis",
                  "parachute_mass_kg",     "packed_volume_m3",       "design_load_n",
                  "highest_design_load_n", "smallest_margin_member", "smallest_margin_of_safety"};
  for (ReportTable& table : run.tables)
    if (table.id == "margins members")
      table.title = "Margins under the design load";
    else if (table.id == "margins_under_highest_design_load members")
      table.title = "Margins under the highest design load";
  run.tables.push_back(bill_table(resolve(r.given)));
  run.warnings = r.warnings;
  run.case_file = r.case_text;
  run.provenance = {{"made by", "ripstop size, Ripstop " + std::string(version())}};
  run.plots = {flight_plot(r, "force", "Opening: force on the riser", {"force", "N"},
                           [](const FlightRow& row) { return row.force; }),
               flight_plot(r, "speed", "Opening: speed", {"speed", "m/s"},
                           [](const FlightRow& row) { return row.state.speed; })};
  return run;
}

}  // namespace

Report size_report(const SizeResult& result, const std::vector<std::filesystem::path>& runs) {
  Report report;
  report.title = result.given.title;
  report.runs.push_back(sizing(result));
  for (const std::filesystem::path& folder : runs) report.runs.push_back(reports_of(folder).front());
  return report;
}

}  // namespace ripstop::inline run
