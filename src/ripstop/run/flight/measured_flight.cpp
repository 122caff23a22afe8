#include "ripstop/run/flight/measured_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/case/cluster.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/parachute/design.h"
#include "ripstop/run/json.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/report/report_tables.h"
#include "ripstop/run/steady/finished_steady.h"

namespace ripstop::inline run {
namespace {

using table::Quantity;

/// The samples of a column, without empty cells and with times that increase.
SensorRecord record_of(const table::Column& time, const table::Column& column,
                       std::vector<std::string>& notes) {
  SensorRecord record;
  std::size_t repeated = 0;
  for (std::size_t i = 0; i < time.values.size(); ++i) {
    if (!std::isfinite(time.values[i]) || !std::isfinite(column.values[i])) continue;
    if (!record.time.empty() && !(time.values[i] > record.time.back())) {
      ++repeated;
      continue;
    }
    record.time.push_back(time.values[i]), record.value.push_back(column.values[i]);
  }
  if (repeated > 0)
    notes.push_back(
        fmt::format("{}: {} rows whose time does not increase are left out", column.heading, repeated));
  return record;
}

void read_log(const std::filesystem::path& file, const MeasuredFlightRequest& request, FlightRecords& records,
              std::vector<std::string>& notes) {
  const table::Table read =
      table::read_table(file, {{Quantity::time, Quantity::altitude, Quantity::acceleration, Quantity::force},
                               request.columns,
                               request.decimal});
  if (read.specimens.size() > 1)
    throw Error(ExitCode::bad_data,
                fmt::format("{} has {} records; keep one of them", file.string(), read.specimens.size()));
  const table::Specimen& log = read.specimens.front();
  const table::Column& time = need_only(read, log, Quantity::time);
  const table::Column* height = find_only(read, log, Quantity::altitude);
  const table::Column* acceleration = find_only(read, log, Quantity::acceleration);
  const table::Column* force = find_only(read, log, Quantity::force);
  if (!height && !acceleration && !force) refuse_missing(read, log, "altitude, acceleration or force");
  if (height) {
    records.height = record_of(time, *height, notes);
    for (double& value : records.height.value) value += request.height_zero;
  }
  if (acceleration) records.acceleration = record_of(time, *acceleration, notes);
  if (force) records.force = record_of(time, *force, notes);
}

/// Of the payload and the parachute of the case, or as given.
void find_mass(const Settings& resolved, const MeasuredFlightRequest& request, MeasuredFlight& f) {
  if (request.mass) {
    f.mass = *request.mass, f.mass_from = "given";
    return;
  }
  if (!resolved.payload().mass_kg)
    throw Error(ExitCode::usage,
                "the case has no payload.mass_kg: use --mass for the mass that descends, parachute included");
  f.mass = *resolved.payload().mass_kg + parachute_mass(resolved);
  f.mass_from = "payload and parachute of the case";
}

void compare_with(const std::filesystem::path& folder, MeasuredFlight& f) {
  const FinishedSteady run = finished_steady(folder);
  f.warnings.insert(f.warnings.end(), run.warnings.begin(), run.warnings.end());
  FlightComparison c;
  c.run = folder.string(), c.drag_area = run.result.drag_area;
  c.drag_area_uncertainty = run.drag_uncertainty * c.drag_area;
  double nearest = 0;
  for (std::size_t i = 0; i < f.phases.size(); ++i) {
    if (!f.phases[i].drag_area) continue;
    const double apart = std::abs(std::log(c.drag_area / *f.phases[i].drag_area));
    if (c.phase != 0 && apart >= nearest) continue;
    nearest = apart, c.phase = static_cast<int>(i + 1);
    c.difference = c.drag_area / *f.phases[i].drag_area - 1;
  }
  f.computed.push_back(c);
}

/// Drag area over height: measured with its error, and the computed ones over the whole descent.
Plot drag_area_plot(const MeasuredFlight& f) {
  Plot plot{f.title, {"height above ground [m]"}, {"drag area [m²]", true}, {}};
  PlotSeries measured;
  measured.name = "measured, one standard error", measured.line = false;
  for (const DragAreaAtHeight& point : f.drag_areas) {
    measured.x.push_back(point.height), measured.y.push_back(point.drag_area);
    measured.bars.push_back(point.uncertainty);
  }
  if (!measured.x.empty()) plot.series.push_back(measured);
  for (const FlightComparison& c : f.computed)
    plot.series.push_back({std::filesystem::path(c.run).filename().string() + ", computed",
                           {0, f.highest},
                           {c.drag_area, c.drag_area},
                           true,
                           false,
                           true});
  return plot;
}

Plot height_plot(const MeasuredFlight& f) {
  PlotSeries deployed{"deployment", {}, {}};
  deployed.line = false;
  for (const LoggedDeployment& d : f.deployments)
    deployed.x.push_back(d.time), deployed.y.push_back(d.height);
  Plot plot{f.title,
            {"time [s]"},
            {"height above ground [m]"},
            {{"measured", f.height.time, f.height.value, true, false}}};
  if (!deployed.x.empty()) plot.series.push_back(deployed);
  return plot;
}

ReportPlot shown(const Plot& plot, const std::string& id, const std::string& title, ReportColumn x,
                 ReportColumn y) {
  ReportPlot result;
  result.id = id, result.title = title, result.x = std::move(x), result.y = std::move(y);
  result.logarithmic = plot.y.logarithmic;
  for (const PlotSeries& s : plot.series) result.series.push_back({s.name, s.x, s.y, s.line, s.dashed});
  return result;
}

}  // namespace

std::string to_json(const MeasuredFlight& flight) {
  return json_text(flight);
}

MeasuredFlight compare_flight(const Settings& resolved, const MeasuredFlightRequest& request) {
  require_one_canopy(resolved, "a comparison with a flight");
  MeasuredFlight f;
  f.title = resolved.title();
  find_mass(resolved, request, f);
  FlightRecords records;
  for (const std::filesystem::path& log : request.logs) {
    read_log(log, request, records, f.notes);
    f.logs.push_back(log.string());
  }
  if (records.height.time.empty())
    throw Error(ExitCode::bad_data,
                "no log has a column of the altitude, from which the drag area is computed");
  FlightLogSetup setup;
  setup.mass = f.mass, setup.mass_uncertainty = request.mass_uncertainty * f.mass;
  setup.ground = request.ground, setup.body_drag_area = request.body_drag_area;
  setup.nominal_diameter = nominal_diameter(resolved.parachute());
  f.nominal_area = nominal_area(resolved.parachute());
  FlightLog log = analyse_flight(records, setup);
  f.highest = log.highest, f.highest_time = log.highest_time, f.height_noise = log.height_noise;
  f.phases = std::move(log.phases), f.deployments = std::move(log.deployments);
  f.drag_areas = std::move(log.drag_areas);
  f.notes.insert(f.notes.end(), log.notes.begin(), log.notes.end());
  f.height = std::move(records.height);
  for (const std::filesystem::path& run : request.runs) compare_with(run, f);
  return f;
}

void write_measured_flight(const std::filesystem::path& folder, const MeasuredFlight& flight) {
  make_results_folder(folder, "compare-flight");
  write_file(folder / "result.json", to_json(flight));
  CsvTable table{{"height_m", "drag_area_m2", "drag_area_uncertainty_m2"}, {}};
  for (const DragAreaAtHeight& point : flight.drag_areas)
    table.rows.push_back({point.height, point.drag_area, point.uncertainty});
  write_csv(folder / "drag-area.csv", table);
  const Plot areas = drag_area_plot(flight), heights = height_plot(flight);
  for (const char* kind : {".png", ".svg"}) {
    if (!areas.series.empty()) write_plot(folder / (std::string("drag-area") + kind), areas);
    write_plot(folder / (std::string("height") + kind), heights);
  }
  ReportRun run;
  run.kind = "flight-log", run.name = folder.filename().string(), run.title = flight.title;
  add_result(run, to_json(flight), folder / "result.json");
  run.headline = {"mass_kg", "highest_m", "nominal_area_m2"};
  run.plots = {shown(heights, "height", "Height", {"time", "s"}, {"height above ground", "m"})};
  if (!areas.series.empty())
    run.plots.push_back(
        shown(areas, "drag_area", "Drag area", {"height above ground", "m"}, {"drag area", "m²"}));
  run.warnings = flight.notes;
  run.warnings.insert(run.warnings.end(), flight.warnings.begin(), flight.warnings.end());
  write_file(folder / report_name, report_page(report_on({std::move(run)}, flight.title)));
}

}  // namespace ripstop::inline run
