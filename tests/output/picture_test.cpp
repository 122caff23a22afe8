#include "ripstop/output/picture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "read_png.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/colour.h"
#include "ripstop/output/flow_picture.h"

namespace ripstop {
namespace {

/// Two cells side by side across the flow, x from -1 to 0 to 1, and a line from a confluence upstream.
CanopyMesh two_cells() {
  CanopyMesh mesh;
  Patch patch;
  patch.rows = 2;
  patch.columns = 3;
  patch.cell_area = {1, 1, 0};
  mesh.patches = {patch};
  for (double y : {-0.5, 0.5}) {
    for (double x : {-1., 0., 1.}) mesh.start.push_back({x, y, 2});
  }
  mesh.start.push_back({0, 0, 0});
  mesh.springs = {{6, 0, 1, 1, 0, 0, 0}};
  mesh.rigging.lines = {{0, {0}, 1}};
  return mesh;
}

CanopyPicture pressures() {
  CanopyPicture picture;
  picture.title = "Two cells";
  picture.quantity = "pressure [Pa]";
  picture.cell_values = {10, 30, 0};
  picture.range = ColourRange{10, 30};
  return picture;
}

TEST(CanopyPicture, TheColourBarRunsFromTheLowestToTheHighestColourOfTheRange) {
  const TemporaryFolder folder("picture");
  const CanopyMesh mesh = two_cells();
  const ColourRange range = write_canopy_picture(folder.path / "c.png", mesh, mesh.start, pressures());
  EXPECT_EQ(range.low, 10);
  EXPECT_EQ(range.high, 30);
  const Png png = read_png(folder.path / "c.png");
  int longest = 0;  // run of pixels in one row whose lightness rises, from the first to the last colour
  for (int y = 0; y < png.height; ++y) {
    for (int x = 0; x < png.width; ++x) {
      if (!png.shows(x, y, scale_colour(0)) || (x > 0 && png.shows(x - 1, y, scale_colour(0)))) continue;
      int end = x;
      const auto level = [&](int at) {
        const unsigned char* p = png.rgb.data() + 3 * (static_cast<std::size_t>(y) * png.width + at);
        return lightness({p[0] / 255., p[1] / 255., p[2] / 255.});
      };
      while (end + 1 < png.width && level(end + 1) >= level(end) - 0.003 && level(end + 1) < 0.935) ++end;
      if (png.shows(end, y, scale_colour(1))) longest = std::max(longest, end - x);
    }
  }
  EXPECT_GT(longest, 250);
}

TEST(CanopyPicture, EachCellHasItsOwnColourInItsPlace) {
  const TemporaryFolder folder("picture-cells");
  const CanopyMesh mesh = two_cells();
  write_canopy_picture(folder.path / "c.png", mesh, mesh.start, pressures());
  const Png png = read_png(folder.path / "c.png");
  EXPECT_EQ(png.width, 1800);
  EXPECT_EQ(png.height, 1200);
  // Seen from upstream +x is on the left. Hue survives shading: violet has green least, yellow blue least.
  const auto pixel = [&](int x, int y) {
    return png.rgb.data() + 3 * (static_cast<std::size_t>(y) * png.width + x);
  };
  const int middle = 1104 + 672 / 2, y = 84 + 644 / 2 + 60;
  const unsigned char *high = pixel(middle - 100, y), *low = pixel(middle + 200, y);
  EXPECT_GT(high[0], high[2] + 60);
  EXPECT_GT(high[1], high[2] + 60);
  EXPECT_GT(low[2], low[1] + 30);
  EXPECT_GT(low[0], low[1] + 30);
}

TEST(FlowPicture, TheStreamGoesFromLeftToRightThroughTheColoursOfItsSpeeds) {
  const TemporaryFolder folder("flow-picture");
  FlowField field;
  field.grid = {{-1, 0, 0}, {2, 0.1, 4}, 20, 1, 40};
  for (int k = 0; k < 40; ++k)
    for (int i = 0; i < 20; ++i) field.velocity.push_back({0, 0, k < 15 ? 0.0 : k < 25 ? 2.5 : 5.0});
  write_flow_picture(folder.path / "p.png", "title", {{"t = 1 s", &field}});
  const Png png = read_png(folder.path / "p.png");
  const auto middle = [&](Colour colour) {  // of the pixels that have it, along the page
    double sum = 0, count = 0;
    for (int y = 0; y < png.height; ++y)
      for (int x = 0; x < png.width; ++x)
        if (png.shows(x, y, colour)) sum += x, ++count;
    EXPECT_GT(count, 0.02 * png.width * png.height);  // more than the scale has of it
    return sum / count;
  };
  EXPECT_LT(middle(scale_colour(0)), middle(scale_colour(0.5)));
  EXPECT_LT(middle(scale_colour(0.5)), middle(scale_colour(1)));
}

TEST(FlowPicture, HasThreeShotsInARowAndARowForEachThree) {
  const TemporaryFolder folder("flow-rows");
  FlowField field;
  field.grid = {{-1, 0, 0}, {2, 0.1, 4}, 4, 1, 8};
  field.velocity.assign(32, {0, 0, 5});
  std::vector<int> height, width;
  std::vector<FlowShot> shots;
  for (int n = 1; n <= 7; ++n) {
    shots.push_back({fmt::format("shot {}", n), &field});
    write_flow_picture(folder.path / "p.png", "title", shots);
    const Png png = read_png(folder.path / "p.png");
    height.push_back(png.height), width.push_back(png.width);
  }
  EXPECT_EQ(height[0], height[2]);
  EXPECT_LT(height[2], height[3]);
  EXPECT_EQ(height[3], height[5]);
  EXPECT_EQ(height[6] - height[5], height[5] - height[2]);
  EXPECT_LT(width[1], width[2]);
  EXPECT_EQ(width[2], width[6]);
}

TEST(CanopyPicture, TheTitleIsThereOnlyWhenItIsGiven) {
  const TemporaryFolder folder("picture-title");
  const CanopyMesh mesh = two_cells();
  CanopyPicture untitled = pressures();
  untitled.title.clear();
  const auto dark_pixels_on_top = [&](const CanopyPicture& picture) {
    write_canopy_picture(folder.path / "c.png", mesh, mesh.start, picture);
    const Png png = read_png(folder.path / "c.png");
    int count = 0;
    for (int i = 0; i < 80 * png.width; ++i) count += png.rgb[3 * static_cast<std::size_t>(i)] < 100;
    return count;
  };
  EXPECT_EQ(dark_pixels_on_top(untitled), 0);
  EXPECT_GT(dark_pixels_on_top(pressures()), 300);  // a missing font would leave it blank
}

TEST(CanopyPicture, WithoutARangeTheFiniteValuesAreShownAndOthersAreGrey) {
  const TemporaryFolder folder("picture-range");
  const CanopyMesh mesh = two_cells();
  CanopyPicture picture = pressures();
  picture.range.reset();
  picture.cell_values = {std::numeric_limits<double>::quiet_NaN(), 30, 1e9};  // the last is a hole
  const ColourRange range = write_canopy_picture(folder.path / "c.svg", mesh, mesh.start, picture);
  EXPECT_LT(range.low, 30);
  EXPECT_GT(range.high, 30);
  EXPECT_LT(range.high, 100);
  const std::string svg = read_file(folder.path / "c.svg");
  EXPECT_TRUE(svg.starts_with("<?xml"));
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(CanopyPicture, WhatCannotBeDrawnIsAnErrorAndNoFile) {
  const TemporaryFolder folder("picture-errors");
  const CanopyMesh mesh = two_cells();
  const auto expect_error = [&](ExitCode code, const char* name, const CanopyMesh& m,
                                const std::vector<Vec3>& positions, const CanopyPicture& picture) {
    try {
      write_canopy_picture(folder.path / name, m, positions, picture);
      ADD_FAILURE() << "no Error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
    }
  };
  expect_error(ExitCode::bad_data, "a.png", CanopyMesh{}, {}, {});
  CanopyMesh holes = mesh;
  holes.patches[0].cell_area = {0, 0, 0};
  expect_error(ExitCode::bad_data, "a.png", holes, mesh.start, pressures());
  expect_error(ExitCode::bad_data, "a.png", mesh, {}, pressures());
  std::vector<Vec3> blown_up = mesh.start;
  blown_up[2].y = std::numeric_limits<double>::infinity();
  expect_error(ExitCode::bad_data, "a.png", mesh, blown_up, pressures());
  CanopyPicture short_values = pressures(), empty_range = pressures(), bad_text = pressures();
  short_values.cell_values.pop_back();
  empty_range.range = ColourRange{1, 1};
  bad_text.title = "\xff\xfe";
  expect_error(ExitCode::bad_data, "a.png", mesh, mesh.start, short_values);
  expect_error(ExitCode::bad_data, "a.png", mesh, mesh.start, empty_range);
  expect_error(ExitCode::bad_data, "a.png", mesh, mesh.start, bad_text);
  expect_error(ExitCode::usage, "a.jpg", mesh, mesh.start, pressures());
  expect_error(ExitCode::io, "none/a.png", mesh, mesh.start, pressures());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

// Whoever looks is as far away as the canopy is large.
TEST(CanopyPicture, ACanopyOfATenthOfTheSizeLooksAsTheLargeOne) {
  const TemporaryFolder folder("picture-size");
  const CanopyMesh mesh = two_cells();
  std::vector<Vec3> large = mesh.start, small;
  large[0].z = 2.6;  // not flat: perspective shows
  for (const Vec3& x : large) small.push_back(0.1 * x);
  write_canopy_picture(folder.path / "large.png", mesh, large, pressures());
  write_canopy_picture(folder.path / "small.png", mesh, small, pressures());
  const Png a = read_png(folder.path / "large.png"), b = read_png(folder.path / "small.png");
  int other = 0, cloth = 0;
  for (int y = 84; y < 728; ++y)
    for (int x = 24; x < 1088; ++x)  // the oblique view, which has no scale in metres
      for (int c = 0; c < 3; ++c) {
        const std::size_t at = 3 * (static_cast<std::size_t>(y) * a.width + x) + c;
        other += std::abs(a.rgb[at] - b.rgb[at]) > 8, cloth += a.rgb[at] < 200;
      }
  EXPECT_GT(cloth, 100'000);
  EXPECT_LT(other, 100);
}

TEST(CanopyPicture, ACanopyCollapsedToAPointIsStillAPicture) {
  const TemporaryFolder folder("picture-point");
  const CanopyMesh mesh = two_cells();
  EXPECT_NO_THROW(
      write_canopy_picture(folder.path / "c.png", mesh, std::vector<Vec3>(mesh.start.size()), pressures()));
}

TEST(Colours, OfAFieldWithoutARangeAreThoseOfItsLowestValue) {
  const Colour lowest = scale_colour(0), none = scale_colour(std::nan(""));
  EXPECT_EQ(none.red, lowest.red);
  EXPECT_EQ(none.blue, lowest.blue);
}

}  // namespace
}  // namespace ripstop
