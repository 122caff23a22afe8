#include "ripstop/run/report/report_plots.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "ripstop/core/words.h"
#include "ripstop/fsi/cluster_motion.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/canopy_curves.h"
#include "ripstop/run/report/report_tables.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

/// Without rows where there is no such file.
CsvTable table_in(const fs::path& file) {
  return fs::exists(file) ? read_csv(file) : CsvTable();
}

/// Columns of a table over another one; nothing without rows.
void add_plot(std::vector<ReportPlot>& plots, const CsvTable& table, const std::string& x, ReportPlot plot,
              const std::vector<std::pair<std::string, std::string>>& columns) {
  if (table.rows.empty()) return;
  const std::vector<double> along = table.column(x);
  for (const auto& [column, name] : columns) {
    if (std::find(table.columns.begin(), table.columns.end(), column) == table.columns.end()) continue;
    plot.series.push_back(thinned({name, along, table.column(column), true, false}));
  }
  if (!plot.series.empty()) plots.push_back(std::move(plot));
}

ReportPlot plot(const char* id, const char* title, ReportColumn x, ReportColumn y) {
  ReportPlot made;
  made.id = id;
  made.title = title;
  made.x = std::move(x);
  made.y = std::move(y);
  return made;
}

const ReportColumn seconds{"time", "s"}, newtons{"axial force", "N"}, iterations{"coupling iteration", ""};

std::vector<ReportPlot> steady_plots(const fs::path& folder) {
  std::vector<ReportPlot> plots = iteration_plots(table_in(folder / "iterations.csv"));
  ReportPlot history = plot("history", "Drag over time", seconds, newtons);
  add_plot(plots, table_in(folder / "history.csv"), "time_s", history,
           {{"drag_n", "drag"}, {"force_x_n", "side force along x"}, {"force_y_n", "side force along y"}});
  const CsvTable pressure = table_in(folder / "pressure.csv");
  add_plot(plots, pressure, "arc_m",
           plot("pressure", "Pressure along a gore", {"distance along the cloth from the vent", "m"},
                {"pressure coefficient", ""}),
           {{"cp_inside", "inside"}, {"cp_outside", "outside"}, {"cp_load", "cloth load"}});
  add_plot(plots, pressure, "z_m",
           plot("profile", "Profile", {"distance along the stream", "m"}, {"radius", "m"}),
           {{"radius_m", "mean over the gores"}});
  return plots;
}

void add_line_plot(std::vector<ReportPlot>& plots, const fs::path& folder) {
  std::vector<ReportPlot> lines;
  add_plot(lines, table_in(folder / "lines.csv"), "line",
           plot("lines", "Line tensions", {"line", ""}, {"tension", "N"}),
           {{"free_tension_n", "below the skirt"},
            {"largest_tension_n", "maximum along the line"},
            {"peak_tension_n", "maximum of the opening"}});
  for (ReportPlot& found : lines) {
    for (ReportSeries& series : found.series) series.line = false;
    plots.push_back(found);
  }
}

/// Drag of the case's measured rows over the speed that its speed_basis takes.
ReportSeries known_drag(const Settings& resolved, const char* name, std::optional<double> Measured::*drag) {
  ReportSeries series{name, {}, {}, false, false};
  for (const Measured& row : resolved.measured()) {
    if (!(row.*drag)) continue;
    const bool nominal = resolved.flow().speed_basis == SpeedBasis::nominal;
    series.x.push_back(nominal ? row.nominal_speed_m_s : row.measured_speed_m_s);
    series.y.push_back(*(row.*drag));
  }
  return series;
}

void add_drag_over_speed(std::vector<ReportPlot>& plots, const std::vector<ReportRun>& runs,
                         const Settings& resolved) {
  std::vector<std::pair<double, double>> points;
  for (const ReportRun& run : runs)
    if (run.kind == "steady") points.emplace_back(number_of(run, "speed_m_s"), number_of(run, "drag_n"));
  std::sort(points.begin(), points.end());
  std::set<double> speeds;
  for (const auto& point : points) speeds.insert(point.first);
  if (speeds.size() < 2) return;
  ReportPlot made = plot("drag-speed", "Drag over speed", {"speed", "m/s"}, {"drag", "N"});
  ReportSeries computed{"computed", {}, {}, speeds.size() == runs.size(), false};
  for (const auto& [speed, drag] : points) {
    computed.x.push_back(speed);
    computed.y.push_back(drag);
  }
  made.series.push_back(computed);
  for (ReportSeries& series :
       std::vector{known_drag(resolved, "measured", &Measured::drag_n),
                   known_drag(resolved, "published nonlinear model", &Measured::printed_nonlinear_n)})
    if (!series.x.empty()) made.series.push_back(series);
  plots.push_back(made);
}

}  // namespace

ReportSeries thinned(ReportSeries series) {
  constexpr std::size_t enough = 3000;
  const std::size_t count = series.x.size();
  if (count <= enough) return series;
  const std::size_t stretch = 2 * count / enough + 1;
  ReportSeries kept{series.name, {}, {}, series.line, series.dashed};
  const auto keep = [&](std::size_t i) {
    kept.x.push_back(series.x[i]);
    kept.y.push_back(series.y[i]);
  };
  for (std::size_t begin = 0; begin < count; begin += stretch) {
    const auto first = series.y.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = series.y.begin() + static_cast<std::ptrdiff_t>(std::min(begin + stretch, count));
    const auto [least, most] = std::minmax_element(first, last);
    const auto a = static_cast<std::size_t>(least - series.y.begin()),
               b = static_cast<std::size_t>(most - series.y.begin());
    keep(std::min(a, b));
    if (a != b) keep(std::max(a, b));
  }
  return kept;
}

std::vector<ReportPlot> iteration_plots(const CsvTable& rows) {
  std::vector<ReportPlot> plots;
  add_plot(plots, rows, "iteration",
           plot("forces", "Axial forces, equal in equilibrium", iterations, newtons),
           {{"drag_n", "air load"},
            {"nodal_load_n", "cloth load"},
            {"line_tension_n", "line load"},
            {"momentum_deficit_n", "momentum deficit"}});
  ReportPlot changes = plot("changes", "Convergence", iterations, {"relative change or residual", ""});
  changes.logarithmic = true;
  add_plot(
      plots, rows, "iteration", changes,
      {{"drag_change", "change of drag"}, {"omega", "change of shape"}, {"flow_residual", "flow residual"}});
  return plots;
}

std::vector<ReportPlot> opening_plots(const ReportRun& run, const CsvTable& history, const CsvTable& smooth,
                                      const CsvTable& balance) {
  std::vector<ReportPlot> plots;
  ReportPlot load = plot("load", "Load on the riser", {"time from deployment", "s"}, {"axial load", "N"});
  load.over_time = true;
  add_plot(plots, history, "time_s", load,
           {{"load_largest_n", "maximum in the interval"}, {"load_mean_n", "load"}});
  if (!plots.empty()) {
    std::vector<ReportPlot> filtered;
    add_plot(filtered, smooth, "time_s", load, {{"load_n", "low-passed"}});
    if (!filtered.empty()) plots[0].series.push_back(filtered[0].series[0]);
    const double end = plots[0].series[0].x.back();
    for (const auto& [key, name] : {std::pair{"steady_load_n", "steady"},
                                    {"knacke_load_n", "infinite mass, C_x C_D S0 q"},
                                    {"measured_peak_n", "measured peak"},
                                    {"printed_peak_n", "peak, published model"}}) {
      const double level = number_of(run, key);
      if (std::isfinite(level)) plots[0].series.push_back({name, {0, end}, {level, level}, true, true});
    }
  }
  ReportPlot size = plot("size", "Diameters", {"time from deployment", "s"}, {"diameter", "m"});
  ReportPlot stress =
      plot("stress", "Maximum stress", {"time from deployment", "s"}, {"von Mises stress", "N/m"});
  ReportPlot energy = plot("energy", "Energy balance", {"time from deployment", "s"}, {"energy", "J"});
  size.over_time = stress.over_time = energy.over_time = true;
  add_plot(plots, balance, "time_s", size,
           {{"projected_diameter_m", "projected"}, {"skirt_diameter_m", "skirt"}});
  add_plot(plots, balance, "time_s", stress, {{"max_von_mises_n_m", "maximum in the cloth"}});
  add_plot(plots, balance, "time_s", energy,
           {{"pressure_work_j", "work of the pressure"},
            {"kinetic_energy_j", "kinetic"},
            {"elastic_energy_j", "elastic"},
            {"damped_energy_j", "damped"}});
  return plots;
}

std::vector<ReportPlot> canopy_plots(const fs::path& folder) {
  std::vector<ReportPlot> plots;
  if (!fs::exists(folder / "canopies.csv")) return plots;
  const auto rows = read_rows<CanopyRow>(folder / "canopies.csv");
  const auto add = [&](const char* id, const char* title, ReportColumn y, double CanopyRow::*value) {
    ReportPlot made = plot(id, title, seconds, std::move(y));
    made.over_time = true;
    for (const PlotSeries& curve : canopy_curves(rows, [&](const CanopyRow& row) { return row.*value; }))
      made.series.push_back(thinned({curve.name, curve.x, curve.y, true, false}));
    plots.push_back(std::move(made));
  };
  add("spread", "Spread angle of the canopies", {"angle", "°"}, &CanopyRow::spread);
  add("risers", "Riser loads of the canopies", {"load", "N"}, &CanopyRow::riser_load);
  add("mouths", "Areas of the mouths of the canopies", {"area", "m²"}, &CanopyRow::mouth_area);
  return plots;
}

std::vector<ReportPlot> plots_of(const ReportRun& run, const fs::path& folder) {
  std::vector<ReportPlot> plots =
      run.kind == "opening"
          ? opening_plots(run, table_in(folder / "history.csv"), table_in(folder / "history_low_pass.csv"),
                          table_in(folder / "balance.csv"))
          : steady_plots(folder);
  for (ReportPlot& found : canopy_plots(folder)) plots.push_back(std::move(found));
  add_line_plot(plots, folder);
  return plots;
}

std::vector<ReportPlot> comparison_plots(const std::vector<ReportRun>& runs, const Settings& resolved) {
  std::vector<ReportPlot> plots;
  add_drag_over_speed(plots, runs, resolved);
  // The representative series of each plot.
  for (const auto& [id, name] : {std::pair{"forces", "air load"},
                                 {"history", "drag"},
                                 {"profile", "mean over the gores"},
                                 {"pressure", "cloth load"},
                                 {"lines", "maximum along the line"},
                                 {"load", "load"},
                                 {"size", "projected"}}) {
    ReportPlot all;
    for (const ReportRun& run : runs)
      for (const ReportPlot& one : run.plots) {
        if (one.id != id) continue;
        for (const ReportSeries& series : one.series) {
          if (series.name != name) continue;
          if (all.series.empty()) {
            all = one;
            all.series.clear();
            all.title = one.title + ": " + name;
            all.over_time = false;
          }
          all.series.push_back(series);
          all.series.back().name = run.name;
        }
      }
    if (all.series.size() > 1) plots.push_back(all);
  }
  return plots;
}

}  // namespace ripstop::inline run
