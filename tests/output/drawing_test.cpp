// The strokes that pictures are made of, pixel by pixel.
#include "ripstop/output/drawing.h"

#include <gtest/gtest.h>

#include "read_png.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

constexpr Colour stroke{1, 0, 0}, paper{1, 1, 1};

struct Drawing : testing::Test {
  TemporaryFolder folder{"drawing"};
  Png drawn(const std::function<void(cairo_t*)>& draw) const {
    write_drawing(folder.path / "d.png", 100, 60, draw);
    return read_png(folder.path / "d.png");
  }
  /// Of a column of pixels, how many have the stroke's colour.
  static int reds(const Png& png, int x) {
    int count = 0;
    for (int y = 0; y < png.height; ++y) count += png.shows(x, y, stroke);
    return count;
  }
};

TEST_F(Drawing, APageIsWhiteAndAsLargeAsAsked) {
  const Png png = drawn([](cairo_t*) {});
  EXPECT_EQ(png.width, 100);
  EXPECT_EQ(png.height, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) ASSERT_TRUE(png.shows(x, y, paper)) << x << " " << y;
}

TEST_F(Drawing, AnArrowHasAShaftAndAHeadThatEndsAtItsTip) {
  const Png png = drawn([](cairo_t* page) { draw_arrow(page, 10, 30, 70, 30, 4, stroke); });
  // The head is six widths long, and eight tenths of that wide where it begins.
  EXPECT_EQ(reds(png, 9), 0);
  EXPECT_EQ(reds(png, 20), 4);
  EXPECT_EQ(reds(png, 44), 4);
  EXPECT_NEAR(reds(png, 47), 18, 2);
  EXPECT_NEAR(reds(png, 58), 9, 2);
  EXPECT_LE(reds(png, 68), 2);
  EXPECT_EQ(reds(png, 71), 0);
  EXPECT_TRUE(png.shows(50, 30, stroke) && !png.shows(50, 18, stroke));
  const Png none = drawn([](cairo_t* page) { draw_arrow(page, 50, 30, 50, 30, 4, stroke); });
  for (int x = 0; x < 100; ++x) ASSERT_EQ(reds(none, x), 0);
}

TEST_F(Drawing, AShortArrowIsMostlyHead) {
  const Png png = drawn([](cairo_t* page) { draw_arrow(page, 10, 30, 20, 30, 4, stroke); });
  EXPECT_EQ(reds(png, 12), 4);
  EXPECT_LE(reds(png, 15), 5);  // six tenths of its length, not six widths
  EXPECT_EQ(reds(png, 21), 0);
}

TEST_F(Drawing, LinesAndBoxesCoverTheirPixels) {
  const Png png = drawn([](cairo_t* page) {
    draw_line(page, 5, 10, 25, 10, 2, stroke);
    fill_box(page, 40, 20, 30, 10, stroke);
    fill_box(page, 80, 20, 10, 10, stroke, 0.5);
  });
  EXPECT_EQ(reds(png, 15), 2);
  EXPECT_EQ(reds(png, 26), 0);
  for (const int x : {40, 69}) EXPECT_EQ(reds(png, x), 10);
  for (const int x : {39, 70}) EXPECT_EQ(reds(png, x), 0);
  EXPECT_TRUE(png.shows(85, 25, {1, 0.5, 0.5}));
}

TEST_F(Drawing, ARasterStandsPixelByPixelWithItsCornerWhereItIsPut) {
  Raster raster;
  raster.width = 2, raster.height = 3;
  raster.argb = {0xffff0000, 0xff00ff00, 0xff0000ff, 0xff000000, 0xffffff00, 0x00000000};
  const Png png = drawn([&](cairo_t* page) { draw_raster(page, 30, 40, raster); });
  const Colour expected[] = {stroke, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 1, 0}, paper};
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(png.shows(30 + i % 2, 40 + i / 2, expected[i])) << i;
  EXPECT_TRUE(png.shows(29, 40, paper) && png.shows(32, 40, paper) && png.shows(30, 43, paper));
}

TEST_F(Drawing, TextStandsOnItsLineByItsLeftEndItsMiddleOrItsRightEnd) {
  const auto columns = [&](Align align) {
    TextStyle style;
    style.align = align, style.colour = stroke;
    const Png png = drawn([&](cairo_t* page) { draw_text(page, 50, 40, "HHH", style); });
    int first = 100, last = 0;
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 100; ++x)
        if (!png.shows(x, y, paper)) {
          EXPECT_LT(y, 41);
          first = std::min(first, x), last = std::max(last, x);
        }
    return std::pair(first, last);
  };
  const auto left = columns(Align::left), centre = columns(Align::centre), right = columns(Align::right);
  EXPECT_GE(left.first, 50);
  EXPECT_LT(right.second, 50);
  EXPECT_NEAR(centre.first + centre.second, 99, 3);
  EXPECT_NEAR(left.second - left.first, right.second - right.first, 1);
  EXPECT_GT(left.second - left.first, 30);
}

TEST_F(Drawing, AnEndingThatIsNoPicturesIsRefused) {
  try {
    write_drawing("picture.jpg", 10, 10, [](cairo_t*) {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_STREQ(error.what(), "picture.jpg: the name of a picture must end in .png or .svg");
  }
  EXPECT_THROW(drawn([](cairo_t* page) { draw_text(page, 5, 5, "\xff\xfe"); }), Error);
}

}  // namespace
}  // namespace ripstop
