#include "ripstop/run/stability/stability_files.h"

#include <fmt/format.h>

#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"

namespace ripstop {

Plot stability_plot(const StabilityResult& result) {
  Plot plot{result.title, {"angle of attack [deg]"}, {"coefficient"}, {}};
  const auto add = [&](const char* name, double StabilityRow::*value,
                       std::optional<double> StabilityRow::*error) {
    PlotSeries series;
    series.name = name;
    for (const StabilityRow& row : result.rows) {
      series.x.push_back(row.angle), series.y.push_back(row.*value);
      series.bars.push_back((row.*error).value_or(0));
    }
    plot.series.push_back(series);
  };
  add("C_T", &StabilityRow::c_t, &StabilityRow::c_t_error);
  add("C_N", &StabilityRow::c_n, &StabilityRow::c_n_error);
  add("C_m", &StabilityRow::c_m, &StabilityRow::c_m_error);
  return plot;
}

void write_stability_files(ClaimedFolder& folder, const StabilityResult& result) {
  CsvTable table{columns_of<StabilityRow>(), {}};
  for (const StabilityRow& row : result.rows) table.rows.push_back(row_of(row));
  write_csv(folder.own("stability.csv"), table);
  if (!result.rows.empty())
    for (const char* name : {"stability.svg", "stability.png"})
      write_plot(folder.own(name), stability_plot(result));
  write_file(folder.own("result.json"), to_json(result));
}

void write_angle_history(ClaimedFolder& folder, const FlowRecord& record) {
  CsvTable table{{"time_s", "step_s", "courant", "force_x_n", "force_y_n", "force_z_n", "moment_x_n_m",
                  "moment_y_n_m", "moment_z_n_m"},
                 {}};
  for (const FlowStep& step : record.steps) {
    const BodyLoad& load = step.bodies.at(0);
    table.rows.push_back({step.time, step.length, step.courant, load.force.x, load.force.y, load.force.z,
                          load.moment.x, load.moment.y, load.moment.z});
  }
  write_csv(folder.own("history.csv"), table);
}

}  // namespace ripstop
