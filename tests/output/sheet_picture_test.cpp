#include "ripstop/output/sheet_picture.h"

#include <gtest/gtest.h>

#include "read_png.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

// Two cells of 1 m side by side, and the sheet as cut, a metre wider on either side.
TEST(SheetPicture, ShowsEveryCellInItsColourAndTheOutlineAsItWasCut) {
  Mesh mesh;
  Patch patch;
  patch.rows = 2;
  patch.columns = 3;
  patch.cell_area = {1, 1, 0};
  mesh.patches = {patch};
  for (double y : {-0.5, 0.5})
    for (double x : {-1., 0., 1.}) mesh.start.push_back({x, y, 0});
  const TemporaryFolder folder("sheet");
  const std::filesystem::path file = folder.path / "sheet.png";
  const SheetPicture picture{
      "Two cells", "stress [N/m]", {10, 30, 0}, {{-2, -1, 0}, {2, -1, 0}, {2, 1, 0}, {-2, 1, 0}}};
  const ColourRange range = write_sheet_picture(file, mesh, mesh.start, picture);
  EXPECT_EQ(range.low, 10);
  EXPECT_EQ(range.high, 30);
  const Png png = read_png(file);
  // The sheet lies left of the colour bar, which has both colours too.
  const int right = png.width * 3 / 4;
  struct Box {
    int least_x = 1 << 20, most_x = 0, least_y = 1 << 20, most_y = 0, pixels = 0;
  };
  const auto pixel = [&](int x, int y) {
    return png.rgb.data() + 3 * (static_cast<std::size_t>(y) * png.width + x);
  };
  const auto box_of = [&](auto&& is_of) {
    Box box;
    for (int y = 0; y < png.height; ++y)
      for (int x = 0; x < right; ++x)
        if (const unsigned char* rgb = pixel(x, y); is_of(rgb[0], rgb[1], rgb[2]))
          box = {std::min(box.least_x, x), std::max(box.most_x, x), std::min(box.least_y, y),
                 std::max(box.most_y, y), box.pixels + 1};
    return box;
  };
  // Cells are shaded: the lowest value is violet, the highest yellow.
  const Box low = box_of([](int r, int g, int b) { return g < 30 && r > 60 && b > 60; });
  const Box high = box_of([](int r, int g, int b) { return r > 180 && g > 180 && b < 100; });
  const double cell = high.most_x - high.least_x;
  EXPECT_GT(cell, 100);
  EXPECT_NEAR(high.most_y - high.least_y, cell, 3);
  EXPECT_GT(low.pixels, 0.9 * cell * cell);
  EXPECT_GT(high.pixels, 0.9 * cell * cell);
  EXPECT_NEAR(low.most_x, high.least_x, 3);
  // A metre to the left of the cells, dashes along a side of two metres.
  int most = 0;
  for (int x = std::max(0, static_cast<int>(low.least_x - 1.1 * cell)); x < low.least_x - 0.9 * cell; ++x) {
    int inked = 0;
    for (int y = low.least_y; y < low.most_y; ++y) inked += pixel(x, y)[0] < 150;
    most = std::max(most, inked);
  }
  EXPECT_GT(most, 0.3 * cell);
  EXPECT_LT(most, 0.7 * cell);
}

TEST(SheetPicture, AValueForEveryCellIsAskedFor) {
  const auto refused = [](const std::vector<Vec3>& positions, const std::vector<double>& values) {
    try {
      write_sheet_picture("nowhere.png", Mesh(), positions, {"", "", values, {}});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("drawn");
  };
  EXPECT_EQ(refused({}, {1}), "a picture of 0 cells and 0 nodes got 1 values and 0 positions");
  EXPECT_EQ(refused({{}, {}}, {}), "a picture of 0 cells and 0 nodes got 0 values and 2 positions");
}

}  // namespace
}  // namespace ripstop
