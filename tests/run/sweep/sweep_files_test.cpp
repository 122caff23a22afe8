// Files of a sweep in addition to its runs.
#include "ripstop/run/sweep/sweep_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "ripstop/core/file.h"

namespace ripstop {
namespace {

const std::filesystem::path stratos_file =
    std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml";

struct SweepFiles : testing::Test {
  TemporaryFolder folder{"sweep-files"};
  std::vector<SweepAxis> axes;
  std::vector<SweepPoint> points;
  std::vector<SweepRow> rows;

  void sweep(std::vector<SweepAxis> over) {
    axes = std::move(over);
    points = sweep_points(stratos_file, {}, axes);
    rows.assign(points.size(), {});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].done = true;
      rows[i].result.drag = 100 + double(i);
      rows[i].result.converged = i != 1;
    }
  }
  /// Of the lines in drag.svg.
  std::size_t colours() const {
    const std::string svg = read_file(folder.path / "drag.svg");
    const std::regex colour(R"(stroke(=\"|:|: )rgb\([^)]*\))");
    std::set<std::string> found;
    for (std::sregex_iterator at(svg.begin(), svg.end(), colour); at != std::sregex_iterator(); ++at)
      found.insert(at->str());
    return found.size();
  }
};

const SweepAxis speeds = sweep_axis("flow.speed_m_s", {"10", "20", "30"}, "--speeds");

TEST_F(SweepFiles, ItsTableAndItsJsonHaveARowForEveryRun) {
  sweep({speeds, sweep_axis("materials.f-111.darcy_1_m2", {"50", "60"}, "--vary")});
  rows[5] = {};
  rows[5].error = "the flow diverged";
  const TextTable table = sweep_table(axes, points, rows);
  ASSERT_EQ(table.rows.size(), 6u);
  EXPECT_EQ(table.columns[0], "flow.speed_m_s");
  EXPECT_EQ(table.columns[1], "materials.f-111.darcy_1_m2");
  const auto drag = std::find(table.columns.begin(), table.columns.end(), "drag_n") - table.columns.begin();
  const std::size_t status = table.columns.size() - 2;
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_EQ(table.rows[i].size(), table.columns.size());
    EXPECT_EQ(table.rows[i][0], points[i].values[0]);
    EXPECT_EQ(table.rows[i].back(), points[i].folder);
    EXPECT_EQ(table.rows[i][drag], i == 5 ? "" : std::to_string(100 + i));
  }
  EXPECT_EQ(table.rows[0][status], "converged");
  EXPECT_EQ(table.rows[1][status], "not converged");
  EXPECT_EQ(table.rows[5][status], "failed: the flow diverged");

  const auto json = nlohmann::json::parse(sweep_json("a sweep", axes, points, rows));
  EXPECT_EQ(json.at("title"), "a sweep");
  ASSERT_EQ(json.at("runs").size(), 6u);
  EXPECT_EQ(json.at("runs")[2].at("values").at("flow.speed_m_s"), points[2].values[0]);
  EXPECT_EQ(json.at("runs")[2].at("result").at("drag_n"), 102);
  EXPECT_FALSE(json.at("runs")[5].contains("result"));
}

TEST_F(SweepFiles, APlotHasALineForEveryValueOfTheOtherAxis) {
  sweep({speeds});
  write_sweep_plots(folder.path, "one", axes, points, rows);
  const std::size_t one = colours();
  sweep({speeds, sweep_axis("materials.f-111.darcy_1_m2", {"50", "60"}, "--vary")});
  write_sweep_plots(folder.path, "two", axes, points, rows);
  EXPECT_EQ(colours(), one + 1);
  // The second of two that may lie on one another is dashed.
  const std::string drag = read_file(folder.path / "drag.svg");
  EXPECT_NE(drag.find("stroke-dasharray"), std::string::npos);
  for (const char* file : {"drag", "drag_area", "drag_coefficient", "wall_time", "iterations", "diameters"})
    for (const char* ending : {".svg", ".png"})
      EXPECT_TRUE(std::filesystem::exists(folder.path / (std::string(file) + ending))) << file;
}

TEST_F(SweepFiles, NothingIsDrawnWithoutNumbersOrWithoutAResult) {
  sweep({sweep_axis("flow.engine", {"builtin", "openfoam"}, "--vary")});
  write_sweep_plots(folder.path, "words", axes, points, rows);
  sweep({speeds});
  rows.assign(rows.size(), {});
  write_sweep_plots(folder.path, "waiting", axes, points, rows);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

// At one speed the measurement is a level; over speeds it is points; over two designs it is not shown.
TEST_F(SweepFiles, MeasurementsAreInThePlotOfDragAndNotOfTime) {
  const auto colours_of = [&](const char* file) {
    const std::string svg = read_file(folder.path / file);
    const std::regex colour(R"((stroke|fill)(=\"|:|: )rgb\([^)]*\))");
    std::set<std::string> found;
    for (std::sregex_iterator at(svg.begin(), svg.end(), colour); at != std::sregex_iterator(); ++at)
      found.insert(std::regex_replace(at->str(), std::regex("stroke|fill"), ""));
    return found.size();
  };
  const auto more_than_time = [&] {
    write_sweep_plots(folder.path, "t", axes, points, rows);
    return colours_of("drag.svg") - colours_of("wall_time.svg");
  };
  sweep({sweep_axis("materials.f-111.darcy_1_m2", {"50", "60"}, "--vary")});
  EXPECT_EQ(more_than_time(), 1u);
  sweep({sweep_axis("parachute.lines.length_m", {"1.5", "1.6"}, "--vary")});
  EXPECT_EQ(more_than_time(), 1u);
  sweep({sweep_axis("parachute.vent_diameter_m", {"0.1", "0.12"}, "--vary"),
         sweep_axis("flow.speed_m_s", {"20", "30"}, "--speeds")});
  EXPECT_EQ(more_than_time(), 0u);  // of two speeds
  sweep({speeds});
  EXPECT_GE(more_than_time(), 1u);
}

TEST_F(SweepFiles, AxesWithoutASecondValueOrWithWordsAreNotDrawnOver) {
  sweep({sweep_axis("flow.viscosity_ratio", {"10"}, "--vary"),
         sweep_axis("materials.f-111.darcy_1_m2", {"50", "60"}, "--vary")});
  write_sweep_plots(folder.path, "second", axes, points, rows);
  EXPECT_TRUE(std::filesystem::exists(folder.path / "drag.svg"));
  std::filesystem::remove_all(folder.path);
  std::filesystem::create_directories(folder.path);
  sweep({sweep_axis("flow.viscosity_ratio", {"10"}, "--vary")});
  write_sweep_plots(folder.path, "none", axes, points, rows);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

TEST_F(SweepFiles, ARunThatHasNotBegunWaits) {
  sweep({speeds});
  rows[2] = {};
  const TextTable table = sweep_table(axes, points, rows);
  EXPECT_EQ(table.rows[2][table.columns.size() - 2], "waiting");
  EXPECT_EQ(nlohmann::json::parse(sweep_json("t", axes, points, rows)).at("runs")[2].at("status"), "waiting");
}

}  // namespace
}  // namespace ripstop
