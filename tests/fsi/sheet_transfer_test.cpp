// The air's load face by face becomes a load on cells of cloth: sums kept, smooth, convergent.
#include "ripstop/fsi/sheet_transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "../diverges.h"
#include "loads_on_faces.h"

namespace ripstop {
namespace {

constexpr double pi = std::numbers::pi;

struct Surface {
  std::vector<Vec3> x;
  std::vector<Cell> cells;
  int rows, columns;
  std::vector<Triangle> triangles() const { return surface_of(cells, x); }
};

// Rows of nodes from `inner` to `outer` degrees off the axis on a sphere of 0.5 m with its top at (0,
// 0, 1.5); outside is downstream. `ripple` waves the radius between 8 gores.
Surface cap(int rows, int columns, double inner = 6, double outer = 85, double ripple = 0) {
  Surface s{{}, {}, rows, columns};
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double t = (inner + (outer - inner) * r / rows) * pi / 180, a = 2 * pi * c / columns;
      const double radius = 0.5 * (1 + ripple * std::cos(8 * a) * std::sin(t));
      s.x.push_back(
          {radius * std::sin(t) * std::cos(a), radius * std::sin(t) * std::sin(a), 1 + 0.5 * std::cos(t)});
    }
  }
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int a = r * columns + c, b = r * columns + (c + 1) % columns;
      s.cells.push_back({{a, a + columns, b + columns, b}});
    }
  }
  return s;
}

// 1 m x 1 m about (0, 0, 1), turned by `angle` about y.
Surface plate(int n, double angle) {
  Surface s{{}, {}, n, n};
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double u = double(i) / n - 0.5, v = double(j) / n - 0.5;
      s.x.push_back({u * std::cos(angle), v, 1 - u * std::sin(angle)});
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      s.cells.push_back({{a, a + 1, a + n + 2, a + n + 1}});
    }
  }
  return s;
}

ClothLoad transfer(const Surface& s, const FlowGrid& grid, const Field& drop) {
  return load_of_flow(loads_of(s.triangles(), grid, drop), grid, s.triangles(), s.cells, s.x);
}

Vec3 centre_of(const Surface& s, std::size_t cell) {
  Vec3 centre;
  for (const int node : s.cells[cell].corner) centre += 0.25 * s.x[node];
  return centre;
}

/// Largest and root-mean-square error of the cell pressures.
struct Misfit {
  double largest = 0, rms = 0;
};
Misfit misfit(const Surface& s, const std::vector<double>& pressure, const Field& drop) {
  Misfit m;
  for (std::size_t c = 0; c < s.cells.size(); ++c) {
    const double d = pressure[c] - drop(centre_of(s, c));
    m.largest = std::max(m.largest, std::abs(d));
    m.rms += d * d / double(s.cells.size());
  }
  m.rms = std::sqrt(m.rms);
  return m;
}

void expect_same(const Wrench& a, const Wrench& b, double scale) {
  EXPECT_LT(norm(a.force - b.force), 1e-12 * scale);
  EXPECT_LT(norm(a.moment - b.moment), 1e-12 * scale);
}

TEST(SheetTransfer, ForceAndMomentAreTheAirsToRoundingForAnySurfaceAndAnyLoads) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (Surface s : {cap(7, 16), cap(20, 40, 1, 170), plate(5, 0), plate(9, 0.6), plate(2, 1.2)}) {
    for (Vec3& p : s.x) p += 0.02 * Vec3{any(random), any(random), any(random)};
    std::vector<SheetLoad> loads(60);
    double scale = 0;
    for (SheetLoad& load : loads) {
      load.triangle = int(random() % s.triangles().size());
      load.point = {any(random), any(random), 1 + any(random)};
      load.outward = {any(random), any(random), any(random)};
      load.outward = load.outward / norm(load.outward);
      const double force = any(random);
      (random() % 2 ? load.force.x : load.force.z) = force;
      load.area = 0.01 * (1.1 + any(random));
      scale += std::abs(force);
    }
    for (const Folds folds : {Folds::few, Folds::filled}) {
      const ClothLoad load = load_of_flow(loads, box(16), s.triangles(), s.cells, s.x, folds);
      expect_same(wrench_of(load, s.cells, s.x), wrench_of(loads), scale);
    }
  }
}

TEST(SheetTransfer, NodeForcesAddUpToTheLoad) {
  const Surface s = cap(10, 24);
  const ClothLoad load = transfer(s, box(24), [](Vec3 p) { return 100 + 30 * p.x; });
  const std::vector<Vec3> nodes = node_forces(load, s.cells, s.x);
  Wrench sum;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    sum.force += nodes[i];
    sum.moment += cross(s.x[i], nodes[i]);
  }
  expect_same(sum, wrench_of(load, s.cells, s.x), 100);
}

TEST(SheetTransfer, AUniformDropIsAUniformPressureOnTheCloth) {
  for (const Surface& s : {cap(30, 64), cap(30, 64, 6, 85, 0.08), plate(20, 0.3)}) {
    for (const int n : {16, 32, 64}) {
      const ClothLoad load = transfer(s, box(n), [](Vec3) { return 120.0; });
      EXPECT_LT(misfit(s, load.pressure, [](Vec3) { return 120.0; }).largest, 1e-9);
    }
  }
}

TEST(SheetTransfer, ALinearDropOnAFlatSheetAtAnyAngleIsLinearOnTheCloth) {
  for (const double angle : {0.0, 0.2, 0.5, pi / 4}) {
    const Surface s = plate(40, angle);
    // Along the sheet: the points of faces at a hem lie off it.
    const Vec3 along = {std::cos(angle), 0, -std::sin(angle)};
    const Field drop = [&](Vec3 p) { return 100 + 70 * dot(p - Vec3{0, 0, 1}, along) - 40 * p.y; };
    EXPECT_LT(misfit(s, transfer(s, box(24), drop).pressure, drop).largest, 1e-9) << angle;
  }
}

// From -20 % at the skirt to the full drop inside, with a dent: smoother than the flow's cells, as a flow is.
double dented(Vec3 p) {
  return 100 * std::tanh(4 * (p.z - 0.95)) + 15 * std::sin(5 * p.x + 1) * std::cos(4 * p.y);
}

TEST(SheetTransfer, TheCellsPressuresConvergeWithTheFlowsGrid) {
  const Surface s = cap(60, 128);
  double last = 0;
  for (const int n : {20, 40, 80}) {
    const double rms = misfit(s, transfer(s, box(n), dented).pressure, dented).rms;
    if (last > 0) {
      EXPECT_LT(rms, 0.35 * last) << n;  // second order: a quarter
    }
    last = rms;
  }
  EXPECT_LT(last, 0.3);  // of 100 Pa
}

// Differences of second order along a row and down a column see a staircase at once: steps of the flow's grid
// would be as large as the field's slope times a flow cell, 8 Pa here.
TEST(SheetTransfer, CellsMuchSmallerThanTheFlowsGetALoadWithoutItsStaircase) {
  const Surface s = cap(120, 256);
  const std::vector<double> pressure = transfer(s, box(20), dented).pressure;
  double rough = 0, exact = 0;
  int count = 0;
  for (int r = 1; r + 1 < s.rows; ++r) {
    for (int c = 0; c < s.columns; ++c) {
      const auto second = [&](const auto& at, int dr, int dc) {
        const auto value = [&](int k) {
          return at(std::size_t((r + k * dr) * s.columns + (c + k * dc + s.columns) % s.columns));
        };
        return value(1) - 2 * value(0) + value(-1);
      };
      for (const auto& [dr, dc] : {std::pair(1, 0), std::pair(0, 1)}) {
        const double got = second([&](std::size_t i) { return pressure[i]; }, dr, dc);
        const double of_field = second([&](std::size_t i) { return dented(centre_of(s, i)); }, dr, dc);
        rough += (got - of_field) * (got - of_field), exact += of_field * of_field;
        ++count;
      }
    }
  }
  RecordProperty("rms_pa", std::to_string(std::sqrt(rough / count)));
  EXPECT_LT(std::sqrt(rough / count), 0.02) << "field itself " << std::sqrt(exact / count);
}

TEST(SheetTransfer, AFieldAboutTheAxisGivesNoSideForceAndNoMoment) {
  const Surface s = cap(40, 96);
  FlowGrid grid{{-0.8, -0.8, 0.3}, {1.6, 1.6, 1.6}, 32, 32, 32};
  const ClothLoad load = transfer(s, grid, [](Vec3 p) { return 100 * p.z; });
  const Wrench sum = wrench_of(load, s.cells, s.x);
  EXPECT_GT(sum.force.z, 50);
  EXPECT_LT(std::hypot(sum.force.x, sum.force.y), 1e-9 * sum.force.z);
  EXPECT_LT(norm(sum.moment), 1e-9 * sum.force.z);
}

// Faces parallel to the sheet represent cloth on both sides of them: their mean normal does not determine the side of
// the pressure. With an error there a closed ring of cloth has a side force.
TEST(SheetTransfer, AWavyCanopyUnderAUniformDropHasNoSideForce) {
  for (const int n : {36, 40, 44, 48}) {
    for (const double ripple : {0.08, 0.15}) {
      const Surface s = cap(60, 256, 6, 85, ripple);
      const std::vector<SheetLoad> loads = loads_of(s.triangles(), box(n), [](Vec3) { return 100.0; });
      const Wrench air = wrench_of(loads);
      EXPECT_LT(std::hypot(air.force.x, air.force.y), 0.001 * air.force.z) << n << " " << ripple;
      // The hem lies along the stream: of the area across it the faces have as much as a staircase has.
      const ClothLoad load = load_of_flow(loads, box(n), s.triangles(), s.cells, s.x);
      EXPECT_LT(residual_traction_share(load, s.cells, s.x), 0.02) << n << " " << ripple;
    }
  }
}

TEST(SheetTransfer, TheRemainderIsSmallAndShrinksWithTheFlowsGrid) {
  const Surface s = cap(60, 128, 6, 85, 0.05);
  const auto share = [&](int n) {
    return residual_traction_share(transfer(s, box(n), dented), s.cells, s.x);
  };
  EXPECT_LT(share(32), 0.01);
  EXPECT_LT(share(128), 0.003);
}

TEST(SheetTransfer, ClothThatTheFlowsGridMissesTakesThePressureOfItsNeighbours) {
  Surface s = cap(30, 64);
  std::vector<SheetLoad> loads = loads_of(s.triangles(), box(32), [](Vec3) { return 80.0; });
  std::erase_if(loads, [](const SheetLoad& load) { return load.point.x > 0; });
  const ClothLoad load = load_of_flow(loads, box(32), s.triangles(), s.cells, s.x);
  for (const double p : load.pressure) EXPECT_NEAR(p, 80, 1e-9);
}

// A pleat of 80 mm, folded over to an S, under cells of 50 mm: the air between its layers is nobody's.
TEST(SheetTransfer, TheDropOfAFaceInAFoldThinnerThanACellIsIgnored) {
  Surface s = plate(100, 0);
  constexpr double half = 0.04;
  for (Vec3& p : s.x) {
    const double u = p.x;
    p.x = u < half ? u : u < 3 * half ? 2 * half - u : u - 4 * half;
    p.z += 0.1 * std::clamp(u, 0.0, 4 * half);
  }
  const FlowGrid grid = box(32);
  std::vector<SheetLoad> loads = loads_of(s.triangles(), grid, [](Vec3) { return 80.0; });
  const auto same_column = [](const SheetLoad& a, const SheetLoad& b) {
    return std::abs(a.point.x - b.point.x) + std::abs(a.point.y - b.point.y) < 1e-9;
  };
  const auto layers = [&](const SheetLoad& load) {
    return std::count_if(loads.begin(), loads.end(),
                         [&](const SheetLoad& o) { return same_column(load, o); });
  };
  int folded = 0;
  for (SheetLoad& load : loads)
    if (layers(load) > 1) load.drop = -300, ++folded;
  EXPECT_GE(folded, 3 * 20);  // layers along the whole pleat
  const ClothLoad load = load_of_flow(loads, grid, s.triangles(), s.cells, s.x);
  for (const double p : load.pressure) EXPECT_NEAR(p, 80, 1e-9);
}

// A sheet with a second one over its middle, 10 mm apart under cells of 50 mm: a pocket open to the air above on both
// sides, whose pressure is 0 there and 80 Pa below and over the second sheet. The additional momentum loss at the
// fold, 300 Pa upward on each of its columns, cannot be found from the pressure of that pocket.
struct Pocket {
  Surface s = plate(40, 0);
  FlowGrid grid = box(32);
  std::vector<SheetLoad> loads;
  double extra = 0;  // [N]

  Pocket() {
    const std::size_t sheet = s.x.size(), cells = s.cells.size();
    for (std::size_t n = 0; n < sheet; ++n) s.x.push_back(s.x[n] + Vec3{0, 0, 0.01});
    for (std::size_t c = 0; c < cells; ++c) {
      Cell upper = s.cells[c];
      if (!in_fold(centre_of(s, c))) continue;
      for (int& node : upper.corner) node += static_cast<int>(sheet);
      std::swap(upper.corner[1], upper.corner[3]);  // its outer side looks down
      s.cells.push_back(upper);
    }
    loads = loads_of(s.triangles(), grid, [](Vec3) { return 80.0; });
    for (SheetLoad& load : loads) {
      const bool folded = in_fold(load.point), turned = load.outward.z < 0;
      load.inside = 80;
      if (!folded && !turned) load.outside = 0;
      if (folded)
        load.drop = turned ? -200 : 100, load.force.z = turned ? 0 : 300 * load.area, extra += load.force.z;
    }
  }
  static bool in_fold(Vec3 p) { return std::abs(p.x) < 0.2; }
  double upward_on_fold(const ClothLoad& load) const {
    const std::vector<Vec3> nodes = node_forces(load, s.cells, s.x);
    double sum = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) sum += in_fold(s.x[n]) ? nodes[n].z : 0;
    return sum;
  }
};

// Open cloth has the drop of its faces, here less than the pressures of its sides.
TEST(SheetTransfer, ClothInFoldsTakesThePressuresOnItsTwoSidesNearby) {
  Pocket f;
  for (SheetLoad& load : f.loads)
    if (!f.in_fold(load.point)) load.drop = 50 * load.cover;
  const ClothLoad load = load_of_flow(f.loads, f.grid, f.s.triangles(), f.s.cells, f.s.x, Folds::filled);
  for (std::size_t c = 0; c < f.s.cells.size(); ++c) {
    const double off = std::abs(centre_of(f.s, c).x);
    if (off < 0.1) {
      EXPECT_NEAR(load.pressure[c], 80, 1e-9) << off;
    }
    if (off > 0.36) {
      EXPECT_NEAR(load.pressure[c], 50, 1e-9) << off;
    }
  }
}

TEST(SheetTransfer, ForceOnClothInFoldsStaysThere) {
  const Pocket f;
  const auto on_fold = [&](Folds folds) {
    return f.upward_on_fold(load_of_flow(f.loads, f.grid, f.s.triangles(), f.s.cells, f.s.x, folds));
  };
  EXPECT_NEAR(on_fold(Folds::filled), f.extra, 0.15 * f.extra);
  EXPECT_LT(on_fold(Folds::few), 0.8 * f.extra);
}

// Input from a motion of the cloth that has diverged.
TEST(SheetTransfer, ClothThatIsNowhereOrFartherThanAnyCanopyIsAnError) {
  const FlowGrid grid = box(16);
  Surface s = cap(8, 32);
  const std::vector<Triangle> surface = s.triangles();
  const std::vector<SheetLoad> loads = loads_of(surface, grid, [](Vec3) { return 100.0; });
  for (const double far : {1e9, 1e300, double(INFINITY), double(NAN)}) {
    s.x[40].x = far;
    const std::string message =
        divergence([&] { load_of_flow(loads, grid, surface, s.cells, s.x, Folds::filled); });
    EXPECT_TRUE(says(message, "diverged")) << message;
  }
}

}  // namespace
}  // namespace ripstop
