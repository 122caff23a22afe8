// The files of `ripstop recovery`.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/descent/recovery.h"
#include "ripstop/run/json.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/report/report_tables.h"

namespace ripstop::inline run {
namespace {

/// All values with a range; the groups of three rows that result.json makes of them are left out.
void add_ranges(ReportRun& run, const RecoveryResult& r) {
  ReportTable table{
      "ranges",
      "Values with their ranges",
      "With the smallest and the largest drag coefficients of all parachutes in descent; design "
      "loads with their uncertainty.",
      {{"stage", ""}, {"quantity", ""}, {"value", ""}, {"low", ""}, {"high", ""}, {"unit", ""}},
      {}};
  const auto add = [&](const std::string& stage, const std::string& quantity, const Ranged& value,
                       const char* unit) {
    table.rows.push_back({stage, quantity, fmt::format("{:.5g}", value.value),
                          fmt::format("{:.5g}", value.low), fmt::format("{:.5g}", value.high), unit});
  };
  for (const RecoveryStage& s : r.stages) {
    add(s.name, "drag coefficient on S0", {s.drag_coefficient, s.descent_drag.low, s.descent_drag.high}, "");
    add(s.name, "design load", {s.design_load, s.lowest_design_load, s.highest_design_load}, "N");
    add(s.name, "airspeed at the opening", s.speed, "m/s");
    add(s.name, "rate of descent at the end", s.descent_rate, "m/s");
    add(s.name, "duration", s.duration, "s");
    add(s.name, "drift", s.drift, "m");
  }
  add("landing", "time since apogee", r.time, "s");
  add("landing", "drift with the wind", r.drift, "m");
  add("landing", "rate of descent", r.landing_speed, "m/s");
  add("landing", "kinetic energy", r.energy, "J");
  for (const SectionEnergy& s : r.sections)
    add("landing", fmt::format("kinetic energy of {:.4g} kg", s.mass), s.energy, "J");
  std::erase_if(run.tables, [](const ReportTable& t) {
    return !t.rows.empty() && !t.rows.front().empty() && t.rows.front().front() == "value";
  });
  run.tables.insert(run.tables.begin(), std::move(table));
}

}  // namespace

std::string to_json(const RecoveryResult& result) {
  return json_text(result);
}

void write_recovery(const std::filesystem::path& folder, const RecoveryResult& r) {
  make_results_folder(folder, "recovery");
  CsvTable table{columns_of<RecoveryRow>(), {}};
  for (const RecoveryRow& row : r.rows) table.rows.push_back(row_of(row));
  write_csv(folder / "trajectory.csv", table);
  const std::string json = to_json(r);
  ReportRun run;
  run.kind = "recovery", run.name = folder.filename().string();
  add_result(run, json, folder / "result.json");
  run.values.push_back({"landing_speed_m_s", nlohmann::json(r.landing_speed.value).dump()});
  run.values.push_back({"energy_j", nlohmann::json(r.energy.value).dump()});
  add_ranges(run, r);
  run.headline = {"total_mass_kg", "apogee_m", "landing_speed_m_s", "energy_j"};
  const auto plot = [&](const std::string& name, const std::string& title, const ReportColumn& y,
                        auto value) {
    Plot picture;
    picture.title = r.title, picture.x.label = "time since apogee [s]";
    picture.y.label = fmt::format("{} [{}]", y.text, y.unit);
    ReportPlot page{name, title, {"time since apogee", "s"}, y, {}};
    for (int open = 0; open <= static_cast<int>(r.stages.size()); ++open) {
      PlotSeries series;
      series.markers = false;
      series.name = open == 0 ? "before the first opening" : r.stages[open - 1].name;
      for (const RecoveryRow& row : r.rows) {
        if (row.open != open) continue;
        series.x.push_back(row.flight.state.time), series.y.push_back(value(row));
      }
      if (series.x.size() < 2) continue;
      page.series.push_back({series.name, series.x, series.y});
      picture.series.push_back(std::move(series));
    }
    run.plots.push_back(std::move(page));
    write_plot(folder / (name + ".png"), picture);
  };
  plot("height", "Height", {"height above the ground", "m"},
       [&](const RecoveryRow& row) { return row.flight.state.height - r.ground; });
  plot("speed", "Speed", {"speed", "m/s"}, [](const RecoveryRow& row) { return row.flight.state.speed; });
  write_file(folder / "result.json", json);
  write_file(folder / report_name, report_page(report_on({std::move(run)}, r.title)));
}

}  // namespace ripstop::inline run
