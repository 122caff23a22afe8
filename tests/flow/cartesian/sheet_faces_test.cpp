#include "ripstop/flow/cartesian/sheet_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../../diverges.h"
#include "even_axis.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/flow/bodies.h"

namespace ripstop {
namespace {

using cartesian::Axis;
using cartesian::sheet_faces;
using cartesian::SheetFace;
using testing::even_axis;

double area_of(const std::vector<Triangle>& surface) {
  double sum = 0;
  for (const Triangle& t : surface) sum += 0.5 * norm(cross(t.b - t.a, t.c - t.a));
  return sum;
}

// |x| + |y| + |z| <= radius, with corners on cell centres and edges along diagonals: every tie there can be.
std::vector<Triangle> octahedron(Vec3 c, double radius) {
  std::vector<Triangle> faces;
  for (int s = 0; s < 8; ++s) {
    const double x = s & 1 ? radius : -radius, y = s & 2 ? radius : -radius, z = s & 4 ? radius : -radius;
    faces.push_back({c + Vec3{x, 0, 0}, c + Vec3{0, y, 0}, c + Vec3{0, 0, z}});
  }
  return faces;
}

TEST(SheetFaces, AFreeEdgeLongerThanAnySheetIsAnError) {
  const Axis x = even_axis(-1, 2, 8);
  for (const double far : {1e12, 1e100}) {
    const std::string message = divergence([&] {
      sheet_faces(x, x, x, {{{0, 0, 0}, {far, 0, 0.1}, {0, 0.5, 0}}});
    });
    EXPECT_TRUE(says(message, "free edge")) << message;
  }
}

TEST(SheetFaces, AClosedSurfacePartsItsInsideFromItsOutsideWithoutAHole) {
  const int n = 20;
  const Axis x = even_axis(-1, 2, n);
  for (const Vec3 centre : {Vec3{0.05, 0.05, 0.05}, Vec3{0.013, -0.021, 0.037}}) {
    const double radius =
        0.6 + 1e-7;  // no centre exactly on a face, where inside and outside have no meaning
    std::map<std::tuple<int, int, int, int>, int> crossings;
    for (const SheetFace& f : sheet_faces(x, x, x, octahedron(centre, radius))) {
      ++crossings[{f.axis, f.i, f.j, f.k}];
    }
    const auto inside = [&](int i, int j, int k) {
      const auto at = [&](int c) { return -1 + (c + 0.5) * 2.0 / n; };
      return std::abs(at(i) - centre.x) + std::abs(at(j) - centre.y) + std::abs(at(k) - centre.z) < radius;
    };
    int parted = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 1; k < n; ++k) {
        for (int j = 1; j < n; ++j) {
          for (int i = 1; i < n; ++i) {
            const bool differ = inside(i, j, k) != inside(i - (axis == 0), j - (axis == 1), k - (axis == 2));
            const auto found = crossings.find({axis, i, j, k});
            EXPECT_EQ(found != crossings.end() && found->second % 2 == 1, differ)
                << axis << " " << i << " " << j << " " << k;
            parted += differ;
          }
        }
      }
    }
    EXPECT_GT(parted, 300);
  }
}

/// How many cells air gets to from the lowest corner of a box of n^3 cells without passing a sheet.
int cells_reached(int n, const std::vector<SheetFace>& faces) {
  const auto cell = [&](int i, int j, int k) { return i + n * (j + n * k); };
  const int steps[] = {1, n, n * n};
  std::set<std::pair<int, int>> parted;  // a cell and the axis of its low face
  for (const SheetFace& f : faces) parted.insert({cell(f.i, f.j, f.k), f.axis});
  std::vector<char> reached(static_cast<std::size_t>(n) * n * n, 0);
  std::vector<int> next = {0};
  reached[0] = 1;
  int count = 0;
  while (!next.empty()) {
    const int at = next.back();
    next.pop_back();
    ++count;
    for (int axis = 0; axis < 3; ++axis) {
      const int place = at / steps[axis] % n;
      for (const int way : {-1, 1}) {
        if (place + way < 0 || place + way >= n) continue;
        const int to = at + way * steps[axis];
        if (reached[to] || parted.count({std::max(at, to), axis})) continue;
        reached[to] = 1, next.push_back(to);
      }
    }
  }
  return count;
}

// The plane passes through cell centres, to rounding: each of them is on one side or the other for all its neighbours.
TEST(SheetFaces, ASheetThroughCellCentresLetsNoAirPastItsFaces) {
  const int n = 12;
  const Axis x = even_axis(-1, 2, n);
  for (const Vec3 normal :
       {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{1, 0, -1}, Vec3{-1, 0, 1}, Vec3{1, 1, 0}, Vec3{-1, 1, 0},
        Vec3{0, 1, -1}, Vec3{2, 0, 1}, Vec3{1, 2, 1}, Vec3{-1, 1, 2}, Vec3{1, -2, -1}, Vec3{1, 1, -2}}) {
    const Vec3 unit = normal / norm(normal);
    for (const Vec3 centre : {Vec3{}, (0.5 * 2 / n) * Vec3{1, 1, 1}}) {
      std::vector<Triangle> plane = turned(disk(5, {}), unit);
      for (Triangle& t : plane) t.a += centre, t.b += centre, t.c += centre;
      const int all = n * n * n, reached = cells_reached(n, sheet_faces(x, x, x, plane));
      EXPECT_GT(reached, all / 4) << unit.x << " " << unit.y << " " << unit.z;
      EXPECT_LT(reached, 3 * all / 4) << unit.x << " " << unit.y << " " << unit.z;
    }
  }
}

TEST(SheetFaces, AClosedSurfaceWithCornersInCellCentresLetsNoAirIn) {
  const int n = 20;
  const double radius = 0.6;  // of an octahedron about a cell's centre
  const Axis x = even_axis(-1, 2, n);
  int within = 0, on = 0;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const int off = std::abs(i - 10) + std::abs(j - 10) + std::abs(k - 10);  // in cells
        within += off < 6, on += off == 6;
      }
    }
  }
  const int shut_in =
      n * n * n - cells_reached(n, sheet_faces(x, x, x, octahedron({0.05, 0.05, 0.05}, radius)));
  EXPECT_GE(shut_in, within);
  EXPECT_LE(shut_in, within + on);
}

TEST(SheetFaces, TheSharesOfAllFacesAddUpToTheSheet) {
  const Axis x = even_axis(-1, 2, 40), z = even_axis(0, 4, 60);
  for (const Vec3 centre : {Vec3{0, 0, 2}, Vec3{0.013, -0.007, 2.031}}) {
    for (const auto& surface :
         {disk(0.65, centre), hemispherical_cup(0.65, centre), rigid_disk_gap_band(centre)}) {
      double sum = 0;
      for (const SheetFace& f : sheet_faces(x, x, z, surface)) sum += f.area;
      EXPECT_NEAR(sum / area_of(surface), 1, 0.015);
    }
  }
}

// No length is meant in metres.
TEST(SheetFaces, OfASheetInAGridAsManyTimesAsLargeAreTheSame) {
  const Vec3 centre{0.013, -0.007, 2.031};
  std::vector<Triangle> surface = hemispherical_cup(0.65, centre);
  for (const Triangle& t : hemispherical_cup(0.61, centre))
    surface.push_back(t);  // a second layer close to it
  for (const Triangle& t : rigid_disk_gap_band({0.1, 0.05, 1.2})) surface.push_back(t);
  const std::vector<SheetFace> once =
      sheet_faces(even_axis(-1, 2, 40), even_axis(-1, 2, 40), even_axis(0, 4, 60), surface);
  ASSERT_GT(once.size(), 1000u);
  for (const double scale : {1.0 / 64, 64.0}) {  // exact in floating point
    std::vector<Triangle> scaled = surface;
    for (Triangle& t : scaled) t.a *= scale, t.b *= scale, t.c *= scale;
    const Axis x = even_axis(-scale, 2 * scale, 40), z = even_axis(0, 4 * scale, 60);
    const std::vector<SheetFace> faces = sheet_faces(x, x, z, scaled);
    ASSERT_EQ(faces.size(), once.size()) << scale;
    for (std::size_t n = 0; n < faces.size(); ++n) {
      const SheetFace &a = once[n], &b = faces[n];
      ASSERT_EQ(std::tie(a.axis, a.i, a.j, a.k, a.triangle, a.against, a.hem),
                std::tie(b.axis, b.i, b.j, b.k, b.triangle, b.against, b.hem));
      ASSERT_NEAR(b.area / (scale * scale), a.area, 1e-12) << n;
      ASSERT_NEAR(b.cover, a.cover, 1e-12) << n;
      ASSERT_NEAR(norm(b.across - a.across), 0, 1e-12) << n;
      ASSERT_NEAR(norm(b.outward - a.outward), 0, 1e-12) << n;
    }
  }
}

TEST(SheetFaces, DoNotDependOnTheNumberOfThreads) {
  std::vector<Triangle> surface = rigid_disk_gap_band({0.013, -0.007, 2.031});
  for (const Triangle& t : hemispherical_cup(0.61, {0.1, 0.05, 2})) surface.push_back(t);
  const Axis x = even_axis(-1, 2, 40), z = even_axis(0, 4, 60);
  const std::vector<SheetFace> alone = sheet_faces(x, x, z, surface);
  ASSERT_GT(alone.size(), 500u);
  const auto same = [](const SheetFace& a, const SheetFace& b) {
    return std::tie(a.axis, a.i, a.j, a.k, a.triangle, a.against, a.hem, a.area, a.cover) ==
               std::tie(b.axis, b.i, b.j, b.k, b.triangle, b.against, b.hem, b.area, b.cover) &&
           a.point == b.point && a.outward == b.outward && a.normal == b.normal && a.across == b.across;
  };
  for (const int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    const std::vector<SheetFace> shared = sheet_faces(x, x, z, surface, &team);
    EXPECT_TRUE(std::equal(alone.begin(), alone.end(), shared.begin(), shared.end(), same)) << threads;
  }
}

// A tube along z: next to its hems lines that do not meet it have mostly passed it by, and only the row in which it ends
// is open in part.
TEST(SheetFaces, NextToAHemAFaceIsOpenWhereTheSheetHasEndedAndNotWhereItHasBentAway) {
  const double h = 0.05, radius = 0.4137, low = 0.67, high = 1.39;  // 2/5 and 4/5 into their cells
  const Axis x = even_axis(-1, 2, 40), z = even_axis(0, 2, 40);
  const auto surface = revolve({{radius, low}, {radius, high}}, {0.013, -0.007, 0}, 360);
  int part = 0;
  for (const SheetFace& f : sheet_faces(x, x, z, surface)) {
    ASSERT_NE(f.axis, 2);
    const bool lowest = f.k == static_cast<int>(low / h), highest = f.k == static_cast<int>(high / h);
    EXPECT_NEAR(f.cover, lowest ? 0.6 : highest ? 0.8 : 1, 1e-12) << f.i << " " << f.j << " " << f.k;
    part += f.cover < 1;
  }
  EXPECT_GT(part, 100);
}

// A hem along the grid passes all lines of a row at once.
TEST(SheetFaces, AHemAlongTheGridCoversAFaceByAsMuchAsItPasses) {
  const double h = 0.05;
  const Axis x = even_axis(-1, 2, 40), z = even_axis(0, 2, 40);
  for (double share = 0.2; share < 0.85; share += 0.05) {
    const double low = -0.4, high = 0.3 + share * h;
    const std::vector<Triangle> surface = {{{low, low, 1.013}, {high, low, 1.013}, {high, 0.5, 1.013}},
                                           {{low, low, 1.013}, {high, 0.5, 1.013}, {low, 0.5, 1.013}}};
    int faces = 0;
    for (const SheetFace& f : sheet_faces(x, x, z, surface)) {
      if (f.i != 26 || f.j < 15 || f.j > 26) continue;
      EXPECT_NEAR(f.cover, share, 0.04) << f.j;
      ++faces;
    }
    EXPECT_EQ(faces, 12) << share;
  }
}

}  // namespace
}  // namespace ripstop
