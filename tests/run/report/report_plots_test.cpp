// Plots of a report out of tables that a test wrote: every series has its column, its name and its axis.
#include "ripstop/run/report/report_plots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

using Numbers = std::vector<double>;

std::vector<std::string> names_of(const ReportPlot& plot) {
  std::vector<std::string> names;
  for (const ReportSeries& series : plot.series) names.push_back(series.name);
  return names;
}

std::vector<std::string> ids_of(const std::vector<ReportPlot>& plots) {
  std::vector<std::string> ids;
  for (const ReportPlot& plot : plots) ids.push_back(plot.id);
  return ids;
}

struct ReportPlots : testing::Test {
  TemporaryFolder folder{"report-plots"};

  /// Two rows; column i has 10 i + 1 and 10 i + 2.
  void table(const char* name, const std::vector<std::string>& columns) const {
    CsvTable made{columns, {{}, {}}};
    for (std::size_t i = 0; i < columns.size(); ++i)
      for (int row = 0; row < 2; ++row) made.rows[row].push_back(10.0 * double(i) + row + 1);
    write_csv(folder.path / name, made);
  }
  /// That the series of a plot are, in turn, these columns of such a table over its column `x`.
  static void expect_columns(const ReportPlot& plot, int x, const std::vector<int>& columns) {
    ASSERT_EQ(plot.series.size(), columns.size()) << plot.id;
    for (std::size_t s = 0; s < columns.size(); ++s) {
      EXPECT_EQ(plot.series[s].x, (Numbers{10.0 * x + 1, 10.0 * x + 2})) << plot.id << " " << s;
      EXPECT_EQ(plot.series[s].y, (Numbers{10.0 * columns[s] + 1, 10.0 * columns[s] + 2})) << plot.id;
    }
  }
};

TEST_F(ReportPlots, OfASteadyRunHaveTheColumnsOfItsTables) {
  table("iterations.csv", {"iteration", "drag_n", "nodal_load_n", "line_tension_n", "momentum_deficit_n",
                           "drag_change", "omega", "flow_residual"});
  table("history.csv", {"time_s", "drag_n", "force_x_n", "force_y_n"});
  table("pressure.csv", {"arc_m", "radius_m", "z_m", "cp_inside", "cp_outside", "cp_load"});
  table("lines.csv", {"line", "free_tension_n", "largest_tension_n"});
  ReportRun run;
  run.kind = "steady";
  const std::vector<ReportPlot> plots = plots_of(run, folder.path);
  ASSERT_EQ(ids_of(plots),
            (std::vector<std::string>{"forces", "changes", "history", "pressure", "profile", "lines"}));
  expect_columns(plots[0], 0, {1, 2, 3, 4});
  expect_columns(plots[1], 0, {5, 6, 7});
  expect_columns(plots[2], 0, {1, 2, 3});
  expect_columns(plots[3], 0, {3, 4, 5});
  expect_columns(plots[4], 2, {1});
  expect_columns(plots[5], 0, {1, 2});
  EXPECT_EQ(names_of(plots[0]),
            (std::vector<std::string>{"air load", "cloth load", "line load", "momentum deficit"}));
  EXPECT_EQ(names_of(plots[5]), (std::vector<std::string>{"below the skirt", "maximum along the line"}));
  for (const ReportPlot& plot : plots) {
    EXPECT_EQ(plot.logarithmic, plot.id == "changes") << plot.id;
    EXPECT_FALSE(plot.over_time) << plot.id;
    EXPECT_FALSE(plot.title.empty() || plot.x.text.empty() || plot.y.text.empty()) << plot.id;
    for (const ReportSeries& series : plot.series) {
      EXPECT_EQ(series.line, plot.id != "lines") << plot.id;
      EXPECT_FALSE(series.dashed) << plot.id;
    }
  }
  EXPECT_EQ(plots[0].y.unit, "N");
  EXPECT_EQ(plots[2].x.unit, "s");
  EXPECT_EQ(plots[5].x.text, "line");
}

TEST_F(ReportPlots, OfAnOpeningHaveItsLevelsAndRunOverTheTimeOfItsFrames) {
  table("history.csv", {"time_s", "load_mean_n", "load_largest_n"});
  table("history_low_pass.csv", {"time_s", "load_n"});
  table("balance.csv", {"time_s", "projected_diameter_m", "skirt_diameter_m", "max_von_mises_n_m",
                        "pressure_work_j", "kinetic_energy_j", "elastic_energy_j", "damped_energy_j"});
  table("lines.csv", {"line", "peak_tension_n"});
  ReportRun run;
  run.kind = "opening";
  run.values = {{"steady_load_n", "40.5"},
                {"knacke_load_n", "60"},
                {"measured_peak_n", "null"},
                {"printed_peak_n", "70"}};
  const std::vector<ReportPlot> plots = plots_of(run, folder.path);
  ASSERT_EQ(ids_of(plots), (std::vector<std::string>{"load", "size", "stress", "energy", "lines"}));
  const ReportPlot& load = plots[0];
  EXPECT_EQ(names_of(load),
            (std::vector<std::string>{"maximum in the interval", "load", "low-passed", "steady",
                                      "infinite mass, C_x C_D S0 q", "peak, published model"}));
  EXPECT_EQ(load.series[0].y, (Numbers{21, 22}));
  EXPECT_EQ(load.series[1].y, (Numbers{11, 12}));
  EXPECT_EQ(load.series[2].y, (Numbers{11, 12}));
  const Numbers levels = {40.5, 60, 70};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(load.series[3 + i].x, (Numbers{0, 2}));
    EXPECT_EQ(load.series[3 + i].y, (Numbers{levels[i], levels[i]}));
    EXPECT_TRUE(load.series[3 + i].line && load.series[3 + i].dashed);
  }
  expect_columns(plots[1], 0, {1, 2});
  expect_columns(plots[2], 0, {3});
  expect_columns(plots[3], 0, {4, 5, 6, 7});
  expect_columns(plots[4], 0, {1});
  for (const ReportPlot& plot : plots) EXPECT_EQ(plot.over_time, plot.id != "lines") << plot.id;
  EXPECT_EQ(names_of(plots[4]), std::vector<std::string>{"maximum of the opening"});
}

TEST_F(ReportPlots, WithoutATableOrWithoutRowsThereIsNone) {
  ReportRun run;
  run.kind = "steady";
  EXPECT_TRUE(plots_of(run, folder.path).empty());
  write_csv(folder.path / "iterations.csv", CsvTable{{"iteration", "drag_n"}, {}});
  write_csv(folder.path / "history.csv", CsvTable{{"time_s", "something_else"}, {{1, 2}}});
  EXPECT_TRUE(plots_of(run, folder.path).empty());
  write_csv(folder.path / "lines.csv", CsvTable{{"free_tension_n"}, {{1}}});
  EXPECT_THROW(plots_of(run, folder.path), Error);  // no common axis
}

// A screen has some 2000 columns: the data within one of them are represented by their smallest and largest
// value.
TEST_F(ReportPlots, OfManyRowsKeepEveryPeak) {
  const auto series_of = [&](int count) {
    CsvTable history{{"time_s", "load_mean_n", "load_largest_n"}, {}};
    for (int i = 0; i < count; ++i)
      history.rows.push_back({0.5 * i, 0.01 * i,
                              i % 997 == 0   ? 1000.0 + i
                              : i % 991 == 0 ? -1000.0 - i
                                             : 0.0});
    write_csv(folder.path / "history.csv", history);
    ReportRun run;
    run.kind = "opening";
    return plots_of(run, folder.path).at(0).series.at(0);
  };
  EXPECT_EQ(series_of(3000).x.size(), 3000u);
  const int count = 10000;
  const ReportSeries thin = series_of(count);
  ASSERT_EQ(thin.x.size(), thin.y.size());
  EXPECT_LE(thin.x.size(), 3000u);
  EXPECT_TRUE(thin.line);
  EXPECT_EQ(thin.name, "maximum in the interval");
  EXPECT_TRUE(std::is_sorted(thin.x.begin(), thin.x.end()));
  EXPECT_EQ(std::adjacent_find(thin.x.begin(), thin.x.end()), thin.x.end());  // no point twice
  for (int i = 1; i < count; ++i) {
    if (i % 997 != 0 && i % 991 != 0) continue;
    const auto at = std::find(thin.x.begin(), thin.x.end(), 0.5 * i);
    ASSERT_NE(at, thin.x.end()) << i;
    EXPECT_EQ(thin.y[at - thin.x.begin()], i % 997 == 0 ? 1000.0 + i : -1000.0 - i);
  }
}

ReportRun steady_run(const char* name, const char* speed, const char* drag) {
  ReportRun run;
  run.kind = "steady", run.name = name;
  run.values = {{"speed_m_s", speed}, {"drag_n", drag}};
  return run;
}

TEST_F(ReportPlots, OverSeveralRunsDragIsPlottedOverSpeedWithMeasurements) {
  Case given = checked(flat_circular_case(1, 1500, 10));
  given.measured.resize(2);
  given.measured[0].nominal_speed_m_s = 10, given.measured[0].measured_speed_m_s = 11;
  given.measured[0].drag_n = 50;
  given.measured[1].nominal_speed_m_s = 20, given.measured[1].measured_speed_m_s = 22;
  given.measured[1].printed_nonlinear_n = 210;
  const std::vector<ReportRun> runs = {steady_run("b", "20", "200"), steady_run("a", "10", "49"),
                                       steady_run("c", "20", "190")};
  given.flow.speed_basis = SpeedBasis::nominal;
  ReportPlot drag = comparison_plots(runs, resolve(given)).at(0);
  EXPECT_EQ(drag.id, "drag-speed");
  EXPECT_EQ(names_of(drag), (std::vector<std::string>{"computed", "measured", "published nonlinear model"}));
  EXPECT_EQ(drag.series[0].x, (Numbers{10, 20, 20}));
  EXPECT_EQ(drag.series[0].y, (Numbers{49, 190, 200}));
  EXPECT_FALSE(drag.series[0].line);  // two at one speed: no line through them
  EXPECT_EQ(drag.series[1].x, Numbers{10});
  EXPECT_EQ(drag.series[1].y, Numbers{50});
  EXPECT_EQ(drag.series[2].x, Numbers{20});
  EXPECT_EQ(drag.series[2].y, Numbers{210});
  EXPECT_FALSE(drag.series[1].line || drag.series[2].line);

  given.flow.speed_basis = SpeedBasis::measured;
  drag = comparison_plots({runs[0], runs[1]}, resolve(given)).at(0);
  EXPECT_TRUE(drag.series[0].line);
  EXPECT_EQ(drag.series[1].x, Numbers{11});
  EXPECT_TRUE(comparison_plots({runs[0], runs[2]}, resolve(given)).empty());  // one speed
}

TEST_F(ReportPlots, OfAClusterHaveACurveForEachCanopy) {
  EXPECT_TRUE(canopy_plots(folder.path).empty());
  CsvTable rows{
      {"time_s", "canopy", "spread_angle_deg", "azimuth_deg", "riser_load_n", "mouth_area_m2", "gap_m"}, {}};
  for (const double time : {0.1, 0.2})
    for (const double canopy : {1.0, 2.0})
      rows.rows.push_back({time, canopy, 10 * time + canopy, 0, 100 * time + canopy, time / canopy, 1});
  write_csv(folder.path / "canopies.csv", rows);
  ReportRun run;
  run.kind = "opening";
  const std::vector<ReportPlot> plots = plots_of(run, folder.path);
  ASSERT_EQ(ids_of(plots), (std::vector<std::string>{"spread", "risers", "mouths"}));
  for (const ReportPlot& plot : plots) {
    EXPECT_EQ(names_of(plot), (std::vector<std::string>{"canopy 1", "canopy 2"}));
    EXPECT_EQ(plot.series[1].x, (Numbers{0.1, 0.2}));
    EXPECT_TRUE(plot.over_time);
  }
  EXPECT_EQ(plots[0].series[1].y, (Numbers{3, 4}));
  EXPECT_EQ(plots[1].series[0].y, (Numbers{11, 21}));
  EXPECT_EQ(plots[2].series[1].y, (Numbers{0.05, 0.1}));
}

TEST_F(ReportPlots, CommonPlotsOfTwoRunsAreOverlaidWithTheirNames) {
  table("history.csv", {"time_s", "load_mean_n", "load_largest_n"});
  table("balance.csv", {"time_s", "projected_diameter_m", "skirt_diameter_m"});
  std::vector<ReportRun> runs(3);
  for (std::size_t i = 0; i < 3; ++i) {
    runs[i].kind = "opening", runs[i].name = std::string(1, char('a' + i));
    if (i != 1) runs[i].plots = plots_of(runs[i], folder.path);  // the second has no tables
  }
  const std::vector<ReportPlot> plots =
      comparison_plots(runs, resolve(checked(flat_circular_case(1, 1500, 10))));
  ASSERT_EQ(ids_of(plots), (std::vector<std::string>{"load", "size"}));
  for (const ReportPlot& plot : plots) {
    EXPECT_EQ(names_of(plot), (std::vector<std::string>{"a", "c"}));
    EXPECT_FALSE(plot.over_time);
    expect_columns(plot, 0, {1, 1});
  }
  EXPECT_EQ(plots[0].title, "Load on the riser: load");
  EXPECT_EQ(plots[1].title, "Diameters: projected");
  EXPECT_EQ(plots[1].y.unit, "m");
  EXPECT_TRUE(comparison_plots({runs[0], runs[1]}, resolve(checked(flat_circular_case(1, 1500, 10))))
                  .empty());  // nothing to compare
}

}  // namespace
}  // namespace ripstop
