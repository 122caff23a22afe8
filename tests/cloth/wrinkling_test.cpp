// Cloth that wrinkles, against solutions of tension field theory.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "builders.h"

namespace ripstop {
namespace {

using namespace testing;
using std::numbers::pi;

constexpr double buckling = 1e-6;

// Cloth of modulus E h, Poisson's ratio 1/3: C_xx = (1 - xi + B) K, C_xy = C_gg = B K with B = xi / (2 sqrt2) are
// isotropic where 1 - xi = 2 B, and E h = 8/3 B K.
FabricSpec isotropic(double modulus) {
  FabricSpec fabric;
  fabric.xi = 1 / (1 + std::numbers::sqrt2 / 2), fabric.eps = 0;
  fabric.coefficients = {modulus * 3 / 8 * 2 * std::numbers::sqrt2 / fabric.xi};
  fabric.buckling_strain = buckling;
  return fabric;
}

// Two sheets of the same cut, tied at their rims and blown up by `pressure` from a slight bulge.
struct Bag {
  std::vector<Vec3> upper, lower;
  std::vector<CellStress> stress;
};
Bag blown_up(const PatchSpec& sheet, const FabricSpec& fabric, double pressure,
             const std::function<bool(int row, int column)>& on_rim,
             const std::function<double(Vec3)>& bulge) {
  Mesh mesh;
  add_patch(mesh, sheet, fabric);
  add_patch(mesh, sheet, fabric);
  const Patch &up = mesh.patches[0], &down = mesh.patches[1];
  for (int row = 0; row < up.rows; ++row)
    for (int column = 0; column < up.columns; ++column) {
      if (on_rim(row, column)) mesh.ties.push_back({down.node(row, column), {{up.node(row, column), 1.0}}});
      mesh.start[up.node(row, column)].z += bulge(mesh.start[up.node(row, column)]);
      mesh.start[down.node(row, column)].z -= bulge(mesh.start[down.node(row, column)]);
    }
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  Loads loads{std::vector<double>(mesh.cell_count(), pressure), {}};
  std::fill(loads.cell_pressure.begin() + mesh.cell_count() / 2, loads.cell_pressure.end(), -pressure);
  ThreadTeam team(1);
  const RelaxResult result = relax(state, *cloth, loads, {1e-4, 200000}, team);
  EXPECT_TRUE(result.converged) << result.residual;
  const std::vector<Vec3> x = positions(state, *cloth);
  const auto half = x.begin() + mesh.node_count() / 2;
  return {{x.begin(), half}, {half, x.end()}, cell_stress(*cloth, state)};
}

// Diagonal 1.2 m, 0.6 mm of E = 588 MPa, Poisson's ratio 1/3, 5 kPa. Each sheet rises by 0.216 to 0.220 m in the
// literature of airbags (Contri and Schrefler 1988 onward).
double rise_of_an_airbag(int cells, double buckling_strain) {
  const double side = 1.2 / std::numbers::sqrt2, h = side / cells;
  FabricSpec fabric = isotropic(588e6 * 0.6e-3);
  fabric.buckling_strain = buckling_strain;
  PatchSpec sheet;
  sheet.rows = sheet.columns = cells + 1;
  sheet.position = [=](int row, int column) {
    return Vec3{column * h - 0.5 * side, row * h - 0.5 * side, 0};
  };
  const Bag bag = blown_up(
      sheet, fabric, 5000,
      [=](int row, int column) { return row == 0 || column == 0 || row == cells || column == cells; },
      [=](Vec3 p) { return 0.02 * std::cos(pi * p.x / side) * std::cos(pi * p.y / side); });
  const int middle = (cells + 1) * (cells + 1) / 2;
  EXPECT_NEAR(bag.upper[middle].z, -bag.lower[middle].z, 1e-3);
  return bag.upper[middle].z;
}

TEST(Wrinkling, ASquareAirbagRisesAsInTheLiteratureOnCoarseAndFineCells) {
  const double coarse = rise_of_an_airbag(16, buckling), fine = rise_of_an_airbag(32, buckling);
  for (const double rise : {coarse, fine}) {
    EXPECT_GT(rise, 0.216);
    EXPECT_LT(rise, 0.220);
  }
  EXPECT_NEAR(coarse / fine, 1, 0.005);
  // Cloth that carries compression remains flat, the more so the coarser the mesh.
  EXPECT_LT(rise_of_an_airbag(16, std::numeric_limits<double>::infinity()), 0.2);
}

// Mylar balloon (Taylor 1919, Paulsen 1994): two disks of inextensible cloth without hoop tension have an
// inflated radius of 0.7627 of the flat one and are 1.198 of it thick; K(1/2), the lemniscate, gives both.
struct Balloon {
  double radius, thickness, largest_second;
};
Balloon mylar_balloon(int rows, int columns) {
  const double flat = 0.5, hole = 0.005;
  FabricSpec fabric;
  fabric.coefficients = {3e6};
  fabric.buckling_strain = buckling;
  PatchSpec disk;
  disk.rows = rows, disk.columns = columns, disk.periodic = true;
  disk.position = [=](int row, int column) {
    const double r = hole + (flat - hole) * (rows - 1 - row) / (rows - 1), t = 2 * pi * column / columns;
    return Vec3{r * std::cos(t), r * std::sin(t), 0};
  };
  const Bag bag = blown_up(
      disk, fabric, 5000, [](int row, int) { return row == 0; },
      [=](Vec3 p) { return 0.05 * (1 - (p.x * p.x + p.y * p.y) / (flat * flat)); });
  Balloon balloon{0, 0, 0};
  for (int column = 0; column < columns; ++column) {
    const Vec3 rim = bag.upper[column], pole = bag.upper[(rows - 1) * columns + column];
    balloon.radius += std::hypot(rim.x, rim.y) / columns;
    balloon.thickness += 2 * std::abs(pole.z) / columns;
  }
  // The outer third: further in the hoops have hardly shrunk.
  for (int cell = 0; cell < rows / 3 * columns; ++cell) {
    const CellStress& stress = bag.stress[cell];
    balloon.largest_second =
        std::max(balloon.largest_second, std::abs(stress.principal_min) / stress.principal_max);
  }
  balloon.thickness /= balloon.radius;
  balloon.radius /= flat;
  return balloon;
}

TEST(Wrinkling, AMylarBalloonHasItsExactShapeAndNoHoopTension) {
  const Balloon balloon = mylar_balloon(25, 48);
  EXPECT_NEAR(balloon.radius, 0.7627, 0.01 * 0.7627);
  EXPECT_NEAR(balloon.thickness, 1.198, 0.02 * 1.198);
  EXPECT_LT(balloon.largest_second, 0.005);
}

// Strip of height h pulled by P with a moment M: where M > P h / 6 the inner side is wrinkled over
//   b / h = 3 M / (P h) - 1/2            (Stein and Hedgepeth 1961, NASA TN D-813)
struct Bent {
  double height, moment;  // wrinkled height over h, M / (P h)
};

// Least squares over the taut springs along the middle: the strain is linear over the height,
// 0 where wrinkles begin.
double wrinkled_rows(const std::vector<double>& strain) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t row = 0; row < strain.size(); ++row) {
    if (strain[row] < 0.1 * strain.back()) continue;
    const auto at = static_cast<double>(row);
    n += 1, x += at, y += strain[row], xx += at * at, xy += at * strain[row];
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return (slope * x - y) / n / slope;
}

Bent bent_strip(double strain, double curvature) {
  const int rows = 33, columns = 65;
  const double spacing = 0.005, height = (rows - 1) * spacing, length = (columns - 1) * spacing;
  FabricSpec fabric;
  fabric.coefficients = {30000};
  fabric.buckling_strain = buckling;
  Mesh mesh = rectangle(rows, columns, spacing, fabric);
  const Patch& patch = mesh.patches[0];
  for (Vec3& p : mesh.start) p -= Vec3{0.5 * length, 0.5 * height, 0};
  const double turn = 0.5 * curvature * length;
  for (int row = 0; row < rows; ++row)
    for (const int side : {-1, 1}) {
      const int node = patch.node(row, side < 0 ? 0 : columns - 1);
      const double y = mesh.start[node].y;
      mesh.start[node] = {side * (0.5 * length * (1 + strain) + y * std::sin(turn)), y * std::cos(turn), 0};
      mesh.fixed.push_back(node);
    }
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  ThreadTeam team(1);
  EXPECT_TRUE(relax(state, *cloth, {}, {1e-5, 100000, 1}, team).converged);
  const std::vector<Vec3> x = positions(state, *cloth);
  const auto middle = [&](int row) { return x[patch.node(row, columns / 2)]; };
  std::vector<double> strains;
  double axis = 0, pull = 0, moment = 0;
  for (int row = 0; row < rows; ++row) {
    axis += middle(row).y / rows;
    strains.push_back(norm(x[patch.node(row, columns / 2 + 1)] - middle(row)) / spacing - 1);
  }
  for (int row = 0; row < rows; ++row) {
    const int node = patch.node(row, columns - 1);
    const Vec3 force = force_on(*cloth, state, {node});
    pull -= force.x;
    moment += force.y * x[node].x - force.x * (x[node].y - axis);
  }
  const double narrowed = middle(rows - 1).y - middle(0).y;
  return {wrinkled_rows(strains) / (rows - 1), moment / (pull * narrowed)};
}

TEST(Wrinkling, AStripUnderPullAndMomentWrinklesOverSteinAndHedgepethsHeight) {
  const double strain = 0.001, height = 0.16;
  for (const double ratio : {1.5, 2.5, 5.0}) {  // of the curvature to that at which it begins to wrinkle
    const Bent bent = bent_strip(strain, ratio * 2 * strain / height);
    EXPECT_GT(bent.height, 0.1);
    EXPECT_NEAR(bent.height, 3 * bent.moment - 0.5, 0.006) << ratio;
  }
}

// Annulus between a fixed rim of radius 2 a and a hub of radius a that is turned: its torque over 4 pi E h a^2 angle.
double twisted_annulus(int rows) {
  const double hub = 0.1, modulus = 1e5, angle = 1e-3;
  const int columns = static_cast<int>(std::lround(2 * pi * (rows - 1) / std::log(2)));  // cells are squares
  PatchSpec annulus;
  annulus.rows = rows, annulus.columns = columns, annulus.periodic = true;
  const auto at = [=](int row, double turn) {
    const double r = 2 * hub * std::pow(0.5, static_cast<double>(row) / (rows - 1));
    return Vec3{r * std::cos(turn), r * std::sin(turn), 0};
  };
  annulus.rest = [=](int row, int column) { return at(row, 2 * pi * column / columns); };
  annulus.position = [=](int row, int column) {
    return at(row, 2 * pi * column / columns + angle * row / (rows - 1));
  };
  Mesh mesh;
  add_patch(mesh, annulus, isotropic(modulus));
  for (const int row : {0, rows - 1})
    for (int column = 0; column < columns; ++column) mesh.fixed.push_back(mesh.patches[0].node(row, column));
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  ThreadTeam team(1);
  EXPECT_TRUE(relax(state, *cloth, {}, {1e-4, 100000, 1}, team).converged);
  double torque = 0;
  for (int column = 0; column < columns; ++column) {
    const int node = mesh.patches[0].node(rows - 1, column);
    const Vec3 force = force_on(*cloth, state, {node}), x = mesh.start[node];
    torque += x.y * force.x - x.x * force.y;
  }
  return torque / (4 * pi * modulus * hub * hub * angle);
}

// Mansfield 1968: s^2 / ln((4 - s^2) / (1 - s^2)) at its largest. Pure shear has E h / 4 in a tension field; a lattice
// that wrinkles spring by spring has one diagonal left, B K / 2 = 3/16 E h: three quarters.
TEST(Wrinkling, ATwistedAnnulusHasThreeQuartersOfMansfieldsTorque) {
  double mansfield = 0;
  for (double s = 0.01; s < 1; s += 0.001)
    mansfield = std::max(mansfield, s * s / std::log((4 - s * s) / (1 - s * s)));
  const double coarse = twisted_annulus(9), fine = twisted_annulus(33);
  EXPECT_NEAR(fine / mansfield, 0.74, 0.01);
  EXPECT_NEAR(coarse / fine, 1, 0.025);
}

TEST(Wrinkling, ARelaxationIsTheSameToTheLastBitOnAnyNumberOfThreads) {
  FabricSpec fabric;
  fabric.buckling_strain = buckling;
  Mesh mesh = rectangle(21, 21, 0.01, fabric);
  for (const int corner : {0, 20, 20 * 21, 21 * 21 - 1}) mesh.fixed.push_back(corner);
  for (Vec3& p : mesh.start) p = 0.9 * p;  // slack between its corners
  const ClothPtr cloth = make_cloth(mesh);
  const Loads loads{std::vector<double>(mesh.cell_count(), 20.0), {}};
  const auto relaxed = [&](int threads) {
    ClothState state = start_state(*cloth);
    ThreadTeam team(threads);
    const RelaxResult result = relax(state, *cloth, loads, {1e-4, 100000}, team);
    EXPECT_TRUE(result.converged) << result.residual;
    return positions(state, *cloth);
  };
  const std::vector<Vec3> alone = relaxed(1);
  for (const int threads : {2, 3}) EXPECT_EQ(relaxed(threads), alone) << threads;
}

// Rows of yarns alone: pulled along x, pushed together along y, untouched elsewhere.
TEST(Wrinkling, StressDistinguishesTautWrinkledAndSlackCloth) {
  FabricSpec fabric;
  fabric.xi = 0, fabric.eps = 0;
  fabric.buckling_strain = buckling;
  const Mesh mesh = rectangle(6, 9, 0.01, fabric);
  const ClothPtr cloth = make_cloth(mesh);
  const auto stretched = [&](double along, double across) {
    std::vector<Vec3> x = mesh.start;
    for (Vec3& p : x) p = {along * p.x, across * p.y, 0};
    ClothState state = start_state(*cloth);
    set_positions(state, *cloth, x);
    return cell_stress(*cloth, state)[2 * 9 + 3];
  };
  const double k = SpringLaw{f111_curve}.tension(0.02);
  const CellStress taut = stretched(1.02, 1.02);
  EXPECT_EQ(taut.tautness, Tautness::taut);
  EXPECT_NEAR(taut.warp, k / 1.02, 1e-9 * k);
  EXPECT_NEAR(taut.weft, k / 1.02, 1e-9 * k);
  const CellStress wrinkled = stretched(1.02, 0.9);
  EXPECT_EQ(wrinkled.tautness, Tautness::wrinkled);
  EXPECT_NEAR(wrinkled.weft, k / 0.9, 1e-9 * k);  // rows are weft
  EXPECT_NEAR(wrinkled.warp, -buckling * f111_curve[0] / 1.02, 1e-9 * k);
  EXPECT_NEAR(std::abs(wrinkled.direction.x), 1, 1e-12);
  EXPECT_EQ(stretched(0.9, 0.95).tautness, Tautness::slack);
}

}  // namespace
}  // namespace ripstop
