#include "ripstop/fsi/transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ripstop {
namespace {

FlowGrid box(int n) {
  return {{-1, -1, 0}, {2, 2, 2}, n, n, n};
}

// A flat sheet of m x m quads of 1 m x 1 m round (0, 0, 1), turned by `angle` about y; faces downstream at 0.
struct Sheet {
  std::vector<Vec3> x;
  std::vector<Cell> cells;
  Vec3 normal;

  Sheet(int m, double angle) : normal{std::sin(angle), 0, std::cos(angle)} {
    for (int j = 0; j <= m; ++j) {
      for (int i = 0; i <= m; ++i) {
        const double u = double(i) / m - 0.5, v = double(j) / m - 0.5;
        x.push_back({u * std::cos(angle), v, 1 - u * std::sin(angle)});
      }
    }
    for (int j = 0; j < m; ++j) {
      for (int i = 0; i < m; ++i) {
        const int a = j * (m + 1) + i;
        cells.push_back({{a, a + 1, a + m + 2, a + m + 1}});
      }
    }
  }
};

TEST(Transfer, TheSurfaceHasTheAreaOfItsCells) {
  const Sheet sheet(7, 0.4);
  double area = 0;
  for (const Triangle& t : surface_of(sheet.cells, sheet.x)) {
    const Vec3 a = 0.5 * cross(t.b - t.a, t.c - t.a);
    area += norm(a);
    EXPECT_NEAR(dot(a, sheet.normal), norm(a), 1e-12);
  }
  EXPECT_NEAR(area, 1.0, 1e-12);
}

// Linear pressure on either side with a jump across the sheet: both sides are read from clean cells only, at a point
// up to two cells away.
TEST(Transfer, AJumpOfPressureIsReadOnBothSidesAtAnyAngleToTheGrid) {
  constexpr double jump = 400, slope = 30;  // [Pa], [Pa/m]
  for (const double angle : {0.0, 0.3, std::numbers::pi / 4}) {
    const Sheet sheet(24, angle);
    FlowField field;
    field.grid = box(40);
    const std::vector<int> cut = cut_cells(field.grid, surface_of(sheet.cells, sheet.x));
    const Vec3 h = field.grid.spacing();
    field.pressure.resize(field.grid.cells());
    for (int k = 0; k < 40; ++k) {
      for (int j = 0; j < 40; ++j) {
        for (int i = 0; i < 40; ++i) {
          const Vec3 p = field.grid.origin + Vec3{(i + 0.5) * h.x, (j + 0.5) * h.y, (k + 0.5) * h.z};
          const double distance = dot(p - Vec3{0, 0, 1}, sheet.normal);
          field.pressure[field.grid.index(i, j, k)] = (distance < 0 ? jump : 0) + slope * p.y;
        }
      }
    }
    for (const int cell : cut) field.pressure[cell] = 1e6;  // must never be read
    const std::vector<Cell> cells(sheet.cells);  // no memory beyond: the address sanitizer sees a step there
    const SidePressures sides = sample_sides(field, cut, cells, sheet.x);
    for (std::size_t c = 0; c < sheet.cells.size(); ++c) {
      double y = 0;
      for (const int node : sheet.cells[c].corner) y += 0.25 * sheet.x[node].y;
      EXPECT_NEAR(sides.inside[c], jump + slope * y, slope * 2 * h.y);
      EXPECT_NEAR(sides.outside[c], slope * y, slope * 2 * h.y);
    }
    const Vec3 force = pressure_force(sheet.cells, sheet.x, sides.difference());
    EXPECT_NEAR(norm(force - jump * sheet.normal), 0, 0.02 * jump) << angle;
  }
}

TEST(Transfer, HolesHaveNeitherSurfaceNorLoad) {
  Sheet sheet(4, 0);
  sheet.cells[5].corner[0] = -1;
  EXPECT_EQ(surface_of(sheet.cells, sheet.x).size(), 2 * 15u);
  const std::vector<double> one(sheet.cells.size(), 1.0);
  EXPECT_NEAR(pressure_force(sheet.cells, sheet.x, one).z, 15.0 / 16, 1e-12);
}

}  // namespace
}  // namespace ripstop
