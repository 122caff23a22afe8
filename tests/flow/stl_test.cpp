#include "ripstop/flow/stl.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <numbers>

#include "../refusal.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

/// A unit sphere of triangles that point outward.
std::vector<Triangle> sphere(int rows, int columns) {
  const auto at = [&](int row, int column) {
    const double theta = std::numbers::pi * row / rows,
                 phi = 2 * std::numbers::pi * (column % columns) / columns;
    return Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  };
  std::vector<Triangle> surface;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      surface.push_back({at(row, column), at(row + 1, column), at(row + 1, column + 1)});
      surface.push_back({at(row, column), at(row + 1, column + 1), at(row, column + 1)});
    }
  }
  return surface;
}

double area(const std::vector<Triangle>& surface) {
  double sum = 0;
  for (const Triangle& t : surface) sum += 0.5 * norm(cross(t.b - t.a, t.c - t.a));
  return sum;
}

double volume(const std::vector<Triangle>& surface) {
  double sum = 0;
  for (const Triangle& t : surface) sum += dot(t.a, cross(t.b, t.c)) / 6;
  return sum;
}

TEST(Stl, TheSurfaceComesBackWithItsAreaVolumeAndOrientation) {
  const TemporaryFolder folder("stl-sphere");
  const std::vector<Triangle> surface = sphere(40, 80);
  write_stl(folder.path / "s.stl", surface);
  const std::vector<Triangle> read = read_stl(folder.path / "s.stl");
  ASSERT_EQ(read.size(), surface.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    // Coordinates up to 1 round to float within half of 2^-24.
    EXPECT_LE(norm(read[i].a - surface[i].a), 0.5 * std::sqrt(3.) * 0x1p-24);
    EXPECT_LE(norm(read[i].b - surface[i].b), 0.5 * std::sqrt(3.) * 0x1p-24);
    EXPECT_LE(norm(read[i].c - surface[i].c), 0.5 * std::sqrt(3.) * 0x1p-24);
  }
  EXPECT_NEAR(area(read), area(surface), 1e-6 * area(surface));
  EXPECT_NEAR(volume(read), volume(surface), 1e-6);  // > 0: outward
  EXPECT_NEAR(volume(read), 4. / 3 * std::numbers::pi, 0.02);
}

TEST(Stl, TheNormalInTheFileIsTheUnitNormalOrZeroWithoutArea) {
  const TemporaryFolder folder("stl-normal");
  write_stl(folder.path / "n.stl", {{{0, 0, 0}, {0, 3, 0}, {0, 0, 4}}, {{1, 1, 1}, {1, 1, 1}, {2, 2, 2}}});
  const std::string bytes = read_file(folder.path / "n.stl");
  ASSERT_EQ(bytes.size(), 84u + 2 * 50);
  float normal[3];
  std::memcpy(normal, bytes.data() + 84, sizeof(normal));
  EXPECT_EQ((std::vector<float>{normal[0], normal[1], normal[2]}), (std::vector<float>{1, 0, 0}));
  std::memcpy(normal, bytes.data() + 84 + 50, sizeof(normal));
  EXPECT_EQ((std::vector<float>{normal[0], normal[1], normal[2]}), (std::vector<float>{0, 0, 0}));
}

TEST(Stl, CutTextAndNonFiniteSurfacesAreErrors) {
  const TemporaryFolder folder("stl-bad");
  write_stl(folder.path / "a.stl", sphere(3, 4));
  const std::string bytes = read_file(folder.path / "a.stl");
  for (std::size_t length : {std::size_t{0}, std::size_t{83}, bytes.size() - 1}) {
    write_file(folder.path / "cut.stl", bytes.substr(0, length));
    EXPECT_THROW(read_stl(folder.path / "cut.stl"), Error) << length;
  }
  write_file(folder.path / "text.stl", "solid cube\n" + std::string(200, ' ') + "endsolid cube\n");
  EXPECT_THROW(read_stl(folder.path / "text.stl"), Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_stl(folder.path / "b.stl", {{{0, 0, nan}, {1, 0, 0}, {0, 1, 0}}}), Error);
  EXPECT_THROW(write_stl(folder.path / "b.stl", {{{0, 0, 1e39}, {1, 0, 0}, {0, 1, 0}}}), Error);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "b.stl"));
}

TEST(Stl, ATextFileHasTheSameTrianglesAsABinaryOne) {
  const TemporaryFolder folder("stl-text");
  const std::vector<Triangle> surface = {{{0, 0, 0.5}, {0, 3, 0}, {0, 0, 4}},
                                         {{1, 1, 1}, {1, 2, 1}, {2, 2, 2}}};
  std::string text = "solid made by hand\r\n";
  for (const Triangle& t : surface) {
    text += " facet normal 0 0 0\r\n  outer loop\r\n";
    for (const Vec3 p : {t.a, t.b, t.c}) text += fmt::format("   vertex {:e} {:g} {:g}\r\n", p.x, p.y, p.z);
    text += "  endloop\r\n endfacet\r\n";
  }
  write_file(folder.path / "a.stl", text + "endsolid\r\n");
  const std::vector<Triangle> read = read_stl(folder.path / "a.stl");
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(read[n].a, surface[n].a);
    EXPECT_EQ(read[n].b, surface[n].b);
    EXPECT_EQ(read[n].c, surface[n].c);
  }
  write_file(folder.path / "b.stl", text.substr(0, text.find("endloop") - 40));
  EXPECT_NE(refusal_of([&] { read_stl(folder.path / "b.stl"); }, ExitCode::bad_data).find("b.stl"),
            std::string::npos);
}

TEST(Stl, ASurfaceWithoutTrianglesOrWithInfiniteOnesIsRefused) {
  const TemporaryFolder folder("stl-empty");
  write_stl(folder.path / "none.stl", {});
  EXPECT_THROW(read_stl(folder.path / "none.stl"), Error);
  write_stl(folder.path / "s.stl", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  EXPECT_EQ(read_stl(folder.path / "s.stl").size(), 1u);
  std::string bytes = read_file(folder.path / "s.stl");
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(bytes.data() + 84 + 12, &infinite, sizeof infinite);
  write_file(folder.path / "s.stl", bytes);
  EXPECT_THROW(read_stl(folder.path / "s.stl"), Error);
}

}  // namespace
}  // namespace ripstop
