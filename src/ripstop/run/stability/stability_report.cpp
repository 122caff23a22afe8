#include "ripstop/run/stability/stability_report.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/report/report_tables.h"

namespace ripstop::inline run {
namespace {

struct Drawn {
  const char *id, *symbol, *title;
  double StabilityRow::*value;
  std::optional<double> StabilityRow::*error;
};
constexpr Drawn curves[] = {
    {"c_t", "C_T", "Force along the axis", &StabilityRow::c_t, &StabilityRow::c_t_error},
    {"c_n", "C_N", "Force normal to the axis, positive: reduces the angle", &StabilityRow::c_n,
     &StabilityRow::c_n_error},
    {"c_m", "C_m", "Moment about the confluence, positive: increases the angle", &StabilityRow::c_m,
     &StabilityRow::c_m_error}};

/// The values, and one standard error above and below them.
ReportPlot plot_of(const StabilityResult& result, const Drawn& curve) {
  ReportPlot plot;
  plot.id = curve.id, plot.title = curve.title;
  plot.x = {"angle of attack", "°"}, plot.y = {curve.symbol, ""};
  const std::pair<const char*, double> lines[] = {
      {"", 0}, {" + standard error", 1}, {" - standard error", -1}};
  for (const auto& [suffix, errors] : lines) {
    ReportSeries series;
    series.name = std::string(curve.symbol) + suffix;
    series.dashed = errors != 0;
    for (const StabilityRow& row : result.rows) {
      if (errors != 0 && !(row.*curve.error)) continue;
      series.x.push_back(row.angle);
      series.y.push_back(row.*curve.value + errors * (row.*curve.error).value_or(0));
    }
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace

std::string write_stability_report(ClaimedFolder& folder, const StabilityResult& result,
                                   const std::filesystem::path& axis) {
  try {
    ReportRun run = report_of(axis);
    run.kind = "stability", run.name = folder.path().filename().string();
    run.values.clear(), run.plots.clear();
    std::erase_if(run.tables,
                  [](const ReportTable& table) { return table.id != "bill" && table.id != "sources"; });
    add_result(run, to_json(result), folder.path() / "result.json");
    run.headline = {"trim_angles_deg",   "stable_trim_angles_deg", "speed_m_s",
                    "reference_area_m2", "reference_length_m",     "cells_across"};
    for (const Drawn& curve : curves) run.plots.push_back(plot_of(result, curve));
    write_file(folder.own(report_name), report_page(report_on({std::move(run)}, result.title)));
    return {};
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    if (known && known->code() == ExitCode::io) throw;  // the same command will write it once there is room
    return fmt::format("no report was written: {}", error.what());
  }
}

}  // namespace ripstop::inline run
