#include "ripstop/run/stability/stability_files.h"

#include <fmt/format.h>

#include <numbers>

#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"

namespace ripstop::inline run {

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

namespace {

/// Coefficients over alpha in aircraft axes, mirrored to negative angles: the nose points from the canopy to the
/// confluence, and alpha, normal force, lift and pitching moment are positive nose up.
CsvTable six_dof_table(const std::vector<StabilityRow>& rows) {
  CsvTable table{{"alpha_rad", "c_a", "c_n", "c_d", "c_l", "c_m"}, {}};
  const auto add = [&](const StabilityRow& row, double sign) {
    table.rows.push_back({sign * row.angle * std::numbers::pi / 180, row.c_t, sign * row.c_n, row.c_d,
                          -sign * row.c_l, sign * row.c_m});
  };
  for (std::size_t i = rows.size(); i-- > 0;)
    if (rows[i].angle > 0) add(rows[i], -1);
  for (const StabilityRow& row : rows) add(row, 1);
  return table;
}

}  // namespace

void write_stability_files(ClaimedFolder& folder, const StabilityResult& result) {
  CsvTable table{columns_of<StabilityRow>(), {}};
  for (const StabilityRow& row : result.rows) table.rows.push_back(row_of(row));
  write_csv(folder.own("stability.csv"), table);
  write_csv(folder.own("six_dof.csv"), six_dof_table(result.rows));
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

}  // namespace ripstop::inline run
