#include "ripstop/output/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

constexpr Colour red{1, 0, 0}, blue{0, 0, 1};

/// A rectangle at depth z, seen along -z: the default camera's eye is at large z.
void add_rectangle(Scene& scene, double x0, double y0, double x1, double y1, double z, Colour colour) {
  const int first = static_cast<int>(scene.points.size());
  scene.points.insert(scene.points.end(), {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}});
  scene.quads.push_back({{first, first + 1, first + 2, first + 3}, colour});
}

std::uint32_t part(std::uint32_t argb, char which) {
  return argb >> (which == 'a' ? 24 : which == 'r' ? 16 : which == 'g' ? 8 : 0) & 255;
}

Camera two_metres_high() {
  Camera camera;
  camera.height = 2;
  return camera;
}

TEST(Render, ARectangleCoversExactlyItsPixels) {
  Scene scene;
  add_rectangle(scene, -0.5, -0.25, 0.5, 0.25, 0, red);
  for (int samples : {1, 3}) {
    const Raster raster = render(scene, two_metres_high(), 96, 64, samples);  // 32 pixels a metre
    ASSERT_EQ(raster.argb.size(), 96u * 64);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 96; ++x) {
        const bool inside = x >= 32 && x < 64 && y >= 24 && y < 40;
        const std::uint32_t pixel = raster.argb[y * 96 + x];
        ASSERT_EQ(part(pixel, 'a'), inside ? 255u : 0u) << x << ' ' << y;
        ASSERT_EQ(part(pixel, 'r') > 100u, inside);
      }
    }
  }
}

TEST(Render, APixelHalfCoveredIsHalfTransparent) {
  Scene scene;
  add_rectangle(scene, 0, -0.5, 1.5 / 32, 0.5, 0, red);  // one and a half pixels wide
  const Raster raster = render(scene, two_metres_high(), 64, 64, 4);
  EXPECT_EQ(part(raster.argb[32 * 64 + 31], 'a'), 0u);
  EXPECT_EQ(part(raster.argb[32 * 64 + 32], 'a'), 255u);
  EXPECT_EQ(part(raster.argb[32 * 64 + 33], 'a'), 128u);
}

TEST(Render, TheNearerSurfaceHidesTheFartherWhateverTheOrder) {
  for (double distance : {0.0, 3.0}) {
    for (bool near_first : {true, false}) {
      Scene scene;
      if (near_first) add_rectangle(scene, -0.5, -0.5, 0.5, 0.5, 0.1, blue);
      add_rectangle(scene, -0.8, -0.8, 0.8, 0.8, -0.1, red);
      if (!near_first) add_rectangle(scene, -0.5, -0.5, 0.5, 0.5, 0.1, blue);
      Camera camera = two_metres_high();
      camera.distance = distance;
      const Raster raster = render(scene, camera, 64, 64);
      EXPECT_GT(part(raster.argb[32 * 64 + 32], 'b'), 100u);
      EXPECT_EQ(part(raster.argb[32 * 64 + 32], 'r'), 0u);
      EXPECT_GT(part(raster.argb[32 * 64 + 10], 'r'), 50u);
    }
  }
}

TEST(Render, ALineIsSeenBeforeTheClothAndHiddenBehindIt) {
  for (double z : {0.5, -0.5}) {
    Scene scene;
    add_rectangle(scene, -0.5, -0.5, 0.5, 0.5, 0, red);
    scene.points.insert(scene.points.end(), {{-0.9, 0, z}, {0.9, 0, z}});
    scene.lines = {{4, 5, 3, blue}};
    const Raster raster = render(scene, two_metres_high(), 64, 64, 1);
    EXPECT_EQ(part(raster.argb[32 * 64 + 32], 'b'), z > 0 ? 255u : 0u);
    EXPECT_EQ(part(raster.argb[32 * 64 + 8], 'b'), 255u);  // outside the cloth
    EXPECT_EQ(part(raster.argb[32 * 64], 'a'), 0u);        // beyond its end
  }
}

TEST(Render, TheNearerLineHidesTheFartherWhateverTheOrder) {
  for (bool near_first : {true, false}) {
    Scene scene;
    scene.points = {{-0.9, 0, 0.5}, {0.9, 0, 0.5}, {0, -0.9, -0.5}, {0, 0.9, -0.5}};
    scene.lines = {{0, 1, 5, blue}, {2, 3, 5, red}};
    if (!near_first) std::swap(scene.lines[0], scene.lines[1]);
    const Raster raster = render(scene, two_metres_high(), 64, 64, 1);
    EXPECT_EQ(part(raster.argb[32 * 64 + 32], 'b'), 255u) << near_first;
    EXPECT_EQ(part(raster.argb[32 * 64 + 32], 'r'), 0u) << near_first;
    EXPECT_EQ(part(raster.argb[16 * 64 + 32], 'r'), 255u) << near_first;
  }
}

TEST(Render, TheRimOfTheNearerSurfaceIsDarkAllRoundAndNotWhereItLiesOnTheFarther) {
  for (const double behind : {-0.5, -1e-4}) {
    Scene scene;
    add_rectangle(scene, -0.8, -0.8, 0.8, 0.8, behind, red);
    add_rectangle(scene, -0.5, -0.5, 0.5, 0.5, 0, blue);
    const Raster raster = render(scene, two_metres_high(), 128, 128, 1);  // 64 pixels a metre
    const auto blue_at = [&](int x, int y) { return part(raster.argb[y * 128 + x], 'b'); };
    const std::uint32_t middle = blue_at(64, 64);
    EXPECT_GT(middle, 100u);
    for (const auto& [x, y] : {std::pair{32, 64}, {95, 64}, {64, 32}, {64, 95}}) {
      if (behind < -0.1)
        EXPECT_LT(blue_at(x, y) + 20, middle) << x << " " << y;
      else
        EXPECT_EQ(blue_at(x, y), middle) << x << " " << y;
    }
  }
}

TEST(Render, BothSidesOfTheClothLookTheSame) {
  Scene scene;
  add_rectangle(scene, -0.5, -0.5, 0.5, 0.5, 0, red);
  Scene turned = scene;
  std::reverse(std::begin(turned.quads[0].corner), std::end(turned.quads[0].corner));
  EXPECT_EQ(render(scene, two_metres_high(), 32, 32).argb, render(turned, two_metres_high(), 32, 32).argb);
}

TEST(Render, TheTwoFlanksOfAFoldDifferInBrightness) {
  Scene scene;  // two separate cells that lean 45 degrees to the left and to the right
  scene.points = {{-1, -1, -1}, {0, -1, 0},  {0, 1, 0},  {-1, 1, -1},
                  {0, -1, 0},   {1, -1, -1}, {1, 1, -1}, {0, 1, 0}};
  scene.quads = {{{0, 1, 2, 3}, red}, {{4, 5, 6, 7}, red}};
  const Raster raster = render(scene, two_metres_high(), 64, 64);
  EXPECT_GT(part(raster.argb[32 * 64 + 16], 'r'), part(raster.argb[32 * 64 + 48], 'r') + 40);
}

TEST(Project, PerspectiveIsTheRatioOfDistances) {
  Camera camera = two_metres_high();
  camera.distance = 4;
  const Projected at_target = project(camera, {1, 0, 0}, 200, 200);
  const Projected twice_as_far = project(camera, {1, 0, -4}, 200, 200);
  EXPECT_DOUBLE_EQ(at_target.x, 200);
  EXPECT_DOUBLE_EQ(twice_as_far.x, 150);
  EXPECT_GT(twice_as_far.depth, at_target.depth);
  EXPECT_FALSE(project(camera, {0, 0, 4}, 200, 200).visible);  // at the eye
  EXPECT_FALSE(project(camera, {0, 0, 5}, 200, 200).visible);
}

TEST(Project, TheDepthOfAPlaneIsLinearOnThePicture) {
  Camera camera = two_metres_high();
  camera.distance = 3;
  const auto on_plane = [&](double s) { return project(camera, {s, 0.2, 1 - 2 * s}, 100, 100); };
  const Projected a = on_plane(-0.3), b = on_plane(0.1), c = on_plane(0.7);
  EXPECT_NEAR((b.depth - a.depth) / (b.x - a.x), (c.depth - a.depth) / (c.x - a.x), 1e-12);
}

TEST(Camera, HasARightHandedFrameAndFitsItsPointsWithTheMargin) {
  std::vector<Vec3> points;
  for (double x : {-1., 2.}) {
    for (double y : {-1., 0.5}) {
      for (double z : {0., 1.}) points.push_back({x, y, z});
    }
  }
  for (double distance : {0.0, 9.0}) {
    const Camera camera =
        fitted(camera_from({0.3, 0.2, 0.1}, {-0.5, 0.4, -0.8}, {0, 1, 0}, distance), points, 1.5, 0.1);
    EXPECT_NEAR(norm(cross(camera.right, camera.up) - camera.toward_eye), 0, 1e-15);
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (Vec3 point : points) {
      const Projected at = project(camera, point, 300, 200);
      left = std::min(left, at.x), right = std::max(right, at.x);
      top = std::min(top, at.y), bottom = std::max(bottom, at.y);
    }
    EXPECT_NEAR(left + right, 300, 1e-9);
    EXPECT_NEAR(top + bottom, 200, 1e-9);
    // It fills the height but for a tenth at either end, or the width with the same border in pixels.
    EXPECT_NEAR(std::max((bottom - top) / 160, (right - left) / 240), 1, 1e-12);
  }
  EXPECT_THROW(fitted({}, {}, 1, 0.1), Error);
}

TEST(ColourScale, LightnessRisesEvenlyFromEndToEnd) {
  for (int i = 0; i <= 100; ++i) EXPECT_NEAR(lightness(scale_colour(i / 100.)), 0.33 + 0.006 * i, 0.002) << i;
  EXPECT_NEAR(lightness({1, 1, 1}), 1, 1e-6);
  EXPECT_NEAR(lightness({0, 0, 0}), 0, 1e-6);
  for (double beyond : {-3., 0.}) EXPECT_EQ(scale_colour(beyond).red, scale_colour(0).red);
  for (double beyond : {1., 7.}) EXPECT_EQ(scale_colour(beyond).red, scale_colour(1).red);
}

TEST(ColourRange, SpansTheFiniteValuesWithoutTheClippedOnes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(colour_range({nan, 3, -1, 2}).low, -1);
  EXPECT_EQ(colour_range({nan, 3, -1, 2}).high, 3);
  std::vector<double> values;
  for (int i = 0; i <= 100; ++i) values.push_back(i);
  values[50] = 1e6;
  EXPECT_EQ(colour_range(values, 0.01).low, 1);
  EXPECT_EQ(colour_range(values, 0.01).high, 100);
  EXPECT_LT(colour_range({5, 5}).low, 5);
  EXPECT_GT(colour_range({5, 5}).high, 5);
  EXPECT_THROW(colour_range({nan}), Error);
}

}  // namespace
}  // namespace ripstop
