#include "ripstop/output/plot.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <limits>

#include "read_png.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/ticks.h"

namespace ripstop {
namespace {

TEST(Ticks, AreRoundAndLieWithinTheAxis) {
  EXPECT_EQ(ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks(-1, 1, 4), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
  EXPECT_EQ(ticks(13, 47, 4), (std::vector<double>{20, 30, 40}));
  EXPECT_EQ(logarithmic_ticks(1e-3, 10, 9), (std::vector<double>{1e-3, 1e-2, 1e-1, 1, 10}));
  EXPECT_LE(logarithmic_ticks(1e-30, 1e30, 8).size(), 8u);
}

TEST(Ticks, LabelsHaveTheDigitsThatTellThemApart) {
  EXPECT_EQ(tick_label(2, 2), "2");
  EXPECT_EQ(tick_label(0.5, 0.5), "0.5");
  EXPECT_EQ(tick_label(1, 0.05), "1.00");
  EXPECT_EQ(tick_label(30000, 10000), "30000");
  EXPECT_EQ(tick_label(2e-5, 1e-5), "2e-05");
  EXPECT_EQ(tick_label(0, 1e-5), "0");
}

/// Pixels of a colour: how many, and their mean position.
struct Spot {
  int count = 0;
  double x = 0, y = 0;
};
Spot spot_of(const Png& png, Colour colour) {
  Spot spot;
  for (int y = 0; y < png.height; ++y) {
    for (int x = 0; x < png.width; ++x) {
      if (png.shows(x, y, colour)) ++spot.count, spot.x += x + 0.5, spot.y += y + 0.5;
    }
  }
  spot.x /= spot.count;
  spot.y /= spot.count;
  return spot;
}

Spot marker_at(double x, double y, bool logarithmic) {
  const TemporaryFolder folder("plot");
  Plot plot{"", {"x", logarithmic, 1, 100}, {"y", false, 0, 1}, {{"", {x}, {y}, false, true, false}}};
  write_plot(folder.path / "p.png", plot);
  return spot_of(read_png(folder.path / "p.png"), series_colour(0));
}

TEST(Plot, MarkersLieWhereTheirValuesAre) {
  const Spot low = marker_at(1, 0, false), high = marker_at(100, 1, false),
             middle = marker_at(50.5, 0.5, false);
  EXPECT_GT(low.count, 60);
  EXPECT_LT(low.x, high.x);
  EXPECT_GT(low.y, high.y);  // y grows upward
  EXPECT_NEAR(middle.x, 0.5 * (low.x + high.x), 0.2);
  EXPECT_NEAR(middle.y, 0.5 * (low.y + high.y), 0.2);
  EXPECT_NEAR(marker_at(10, 0.5, true).x, middle.x, 0.2);  // halfway from 1 to 100 on a logarithmic axis
}

TEST(Plot, EveryDecadeOfALogarithmicAxisIsNamed) {
  const TemporaryFolder folder("plot-decades");
  const auto ink_below = [&](double to) {  // the axis' own line
    Plot plot{"", {"", true, 1, to}, {"", false, 0, 1}, {{"", {1, to}, {0, 1}, true, false, false}}};
    write_plot(folder.path / "p.png", plot);
    const Png png = read_png(folder.path / "p.png");
    const auto dark = [&](int x, int y) {
      return png.rgb[3 * (static_cast<std::size_t>(y) * png.width + x)] < 120;
    };
    int axis = 0, most = 0, count = 0;
    for (int y = 0; y < png.height; ++y) {
      int in_row = 0;
      for (int x = 0; x < png.width; ++x) in_row += dark(x, y);
      if (in_row >= most) most = in_row, axis = y;
    }
    for (int y = axis + 8; y < png.height; ++y)
      for (int x = 0; x < png.width; ++x) count += dark(x, y);
    return count;
  };
  const int two = ink_below(10), six = ink_below(1e5);
  EXPECT_GT(two, 60);
  EXPECT_NEAR(double(six) / two, 3, 0.6);
}

TEST(Plot, IsTheSamePictureWhateverTheProcessDrewBefore) {
  const TemporaryFolder folder("plot-order");
  const Plot plot{"title", {"time [s]"}, {"load [N]"}, {{"load", {0, 1, 2}, {1, 3, 2}}}};
  for (const std::string before : {".png", ".svg"}) {  // fonts are prepared once a process
    const pid_t child = fork();
    if (child == 0) {
      write_plot(folder.path / ("before" + before), plot);
      write_plot(folder.path / ("after" + before + ".png"), plot);
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
  }
  EXPECT_TRUE(read_file(folder.path / "after.png.png") == read_file(folder.path / "after.svg.png"));
}

TEST(Plot, ItsLegendShowsEverySeriesThatHasAName) {
  const TemporaryFolder folder("plot-legend");
  Plot plot{"", {"x", false, 0, 3}, {"y", false, 0, 1}, {}};
  for (const double x : {1.0, 2.0}) plot.series.push_back({"", {x}, {0.5}, false, true, false});
  write_plot(folder.path / "none.png", plot);
  plot.series[0].name = "one", plot.series[1].name = "two";
  write_plot(folder.path / "named.png", plot);
  const Png none = read_png(folder.path / "none.png"), named = read_png(folder.path / "named.png");
  for (const std::size_t i : {0, 1})  // its marker once more
    EXPECT_NEAR(spot_of(named, series_colour(i)).count / (2.0 * spot_of(none, series_colour(i)).count), 1,
                0.1);
}

TEST(Plot, ItsLegendHidesNothingWhereLinesLeaveRoomBetweenTheCorners) {
  const TemporaryFolder folder("plot-between");
  Plot plot{"", {"x", false, 0, 3}, {"y", false, 0, 1}, {}};
  for (const double y : {0.93, 0.07}) plot.series.push_back({"", {0, 3}, {y, y}, true, false, false});
  write_plot(folder.path / "none.png", plot);
  plot.series[0].name = "high", plot.series[1].name = "low";
  write_plot(folder.path / "named.png", plot);
  const Png none = read_png(folder.path / "none.png"), named = read_png(folder.path / "named.png");
  for (const std::size_t i : {0, 1})  // the whole line, and its sample
    EXPECT_GT(spot_of(named, series_colour(i)).count, spot_of(none, series_colour(i)).count);
}

TEST(Plot, ALineHasAGapWhereAValueIsMissing) {
  const TemporaryFolder folder("plot-gap");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Plot plot{"",
            {"x", false, 0, 4},
            {"y", false, 0, 1},
            {{"", {0, 1, 2, 3, 4}, {.5, .5, .5, .5, .5}, true, false, false}}};
  write_plot(folder.path / "whole.png", plot);
  plot.series[0].y[2] = nan;
  write_plot(folder.path / "gap.png", plot);
  const Spot whole = spot_of(read_png(folder.path / "whole.png"), series_colour(0));
  const Spot gap = spot_of(read_png(folder.path / "gap.png"), series_colour(0));
  EXPECT_NEAR(gap.count, 0.5 * whole.count, 0.01 * whole.count);
}

TEST(Plot, AnErrorBarReachesFromItsLowToItsHighEnd) {
  const TemporaryFolder folder("plot-bars");
  Plot plot{"", {"x", false, 0, 4}, {"y", false, 0, 1}, {{"", {2}, {.5}, false, true, false}}};
  write_plot(folder.path / "point.png", plot);
  plot.series[0].bars = {.25};
  write_plot(folder.path / "bar.png", plot);
  plot.series[0].bars = {.125};
  write_plot(folder.path / "half.png", plot);
  const auto count = [&](const char* name) {
    return spot_of(read_png(folder.path / name), series_colour(0)).count;
  };
  const double point = count("point.png"), bar = count("bar.png") - point, half = count("half.png") - point;
  EXPECT_GT(half, 0.1 * point);
  // The caps are the same, and the rest is twice as long: half of the plot's height of 620 is 2 pixels wide.
  EXPECT_NEAR(bar - half, 2 * 0.25 * 620, 20);
  plot.series[0].bars = {.1, .1};
  EXPECT_THROW(write_plot(folder.path / "two.png", plot), Error);
}

TEST(Plot, ConstantAndSingleValuesAndEveryOptionCanBeDrawn) {
  const TemporaryFolder folder("plot-all");
  Plot plot{"Drag", {"speed [m/s]"}, {"drag [N]"}, {{"one", {10}, {43.1}, true, true, true}}};
  write_plot(folder.path / "p.svg", plot);
  EXPECT_NE(read_file(folder.path / "p.svg").find("</svg>"), std::string::npos);
  plot.y.logarithmic = true;
  plot.series.push_back({"two", {10, 20, 30}, {0, 1e-9, 1e3}, true, true, false});  // 0 is left out
  EXPECT_NO_THROW(write_plot(folder.path / "p.png", plot));
}

TEST(Plot, WhatCannotBeDrawnIsAnErrorAndNoFile) {
  const TemporaryFolder folder("plot-errors");
  EXPECT_THROW(write_plot(folder.path / "p.png", Plot{}), Error);
  EXPECT_THROW(write_plot(folder.path / "p.png", Plot{"", {}, {}, {{"", {1, 2}, {1}, true, true, false}}}),
               Error);
  const Plot negative{"", {}, {"", true}, {{"", {1}, {-1}, true, true, false}}};
  EXPECT_THROW(write_plot(folder.path / "p.png", negative), Error);
  const Plot backward{"", {"", false, 2, 1}, {}, {{"", {1}, {1}, true, true, false}}};
  EXPECT_THROW(write_plot(folder.path / "p.png", backward), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

}  // namespace
}  // namespace ripstop
