// Shapes and stresses with exact solutions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "builders.h"

namespace ripstop {
namespace {

using namespace testing;
using std::numbers::pi;

TEST(ClothEquilibrium, AHangingChainIsAnElasticCatenary) {
  // 2 m of chain of w N/m over a span of 1.6 m, T = K e; s along the unstretched chain, V = w L / 2:
  //   x = H s / K + H / w [asinh(V / H) - asinh((V - w s) / H)]
  //   z = -[sqrt(H^2 + V^2) - sqrt(H^2 + (V - w s)^2)] / w - (V s - w s^2 / 2) / K
  const int segments = 100;
  const double length = 2.0, span = 1.6, k = 3000, density = 1.0, w = density * gravity, v = 0.5 * w * length;
  Mesh mesh = chain(segments, {0, 0, 0}, {span, 0, 0}, length / segments, {{k}, 0}, density);
  mesh.fixed.push_back(segments);
  for (int i = 0; i <= segments; ++i) mesh.start[i].z = -0.5 * std::sin(pi * i / segments);
  Loads loads;
  for (double mass : mesh.mass) loads.node_force.push_back({0, 0, -gravity * mass});
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  ThreadTeam team(1);
  const RelaxResult result = relax(state, *cloth, loads, {1e-5, 400000}, team);
  ASSERT_TRUE(result.converged) << result.residual;
  const auto x_of = [&](double h, double s) {
    return h * s / k + h / w * (std::asinh(v / h) - std::asinh((v - w * s) / h));
  };
  double low = 0.1, high = 100;
  for (int i = 0; i < 100; ++i) {
    const double h = 0.5 * (low + high);
    (x_of(h, length) < span ? low : high) = h;
  }
  const double h = low;
  const auto z_of = [&](double s) {
    return -(std::hypot(h, v) - std::hypot(h, v - w * s)) / w - (v * s - 0.5 * w * s * s) / k;
  };
  const double sag = -z_of(0.5 * length);
  const std::vector<Vec3> x = positions(state, *cloth);
  for (int i = 0; i <= segments; ++i) {
    const double s = length * i / segments;
    EXPECT_NEAR(x[i].x, x_of(h, s), 1e-3 * sag);
    EXPECT_NEAR(x[i].z, z_of(s), 1e-3 * sag);
  }
  const std::vector<double> tension = spring_tensions(*cloth, state);
  EXPECT_NEAR(tension[segments / 2] / h, 1, 1e-3);
  EXPECT_NEAR(tension[0] / std::hypot(h, v - 0.5 * w * length / segments), 1, 1e-3);
}

struct Inflated {
  std::vector<Vec3> x;
  std::vector<CellStress> stress;
};

Inflated inflated(const Mesh& mesh, double pressure) {
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  ThreadTeam team(1);
  const Loads loads{std::vector<double>(mesh.cell_count(), pressure), {}};
  EXPECT_TRUE(relax(state, *cloth, loads, {1e-7, 100000}, team).converged);
  return {positions(state, *cloth), cell_stress(*cloth, state)};
}

// Largest error of N = p R along the hoop in the middle third of a free tube of `columns`.
double cylinder_error(int columns) {
  const double radius = 0.2, pressure = 2000, h = 2 * pi * radius / columns;
  Mesh mesh;
  PatchSpec tube;
  tube.rows = 2 * columns / 3, tube.columns = columns, tube.periodic = true;
  tube.position = [=](int row, int column) {
    const double t = 2 * pi * column / columns;
    return Vec3{radius * std::cos(t), radius * std::sin(t), h * row};
  };
  add_patch(mesh, tube, {});
  mesh.fixed.clear();
  const auto [x, stress] = inflated(mesh, pressure);
  double worst = 0;
  for (int row = tube.rows / 3; row < 2 * tube.rows / 3; ++row)
    for (int column = 0; column < columns; ++column) {
      const Vec3 p = x[mesh.patches[0].node(row, column)];
      const CellStress& s = stress[row * columns + column];
      worst = std::max(worst, std::abs(s.principal_max / (pressure * std::hypot(p.x, p.y)) - 1));
      EXPECT_LT(std::abs(s.principal_min), 2e-3 * s.principal_max);  // its ends are free
    }
  return worst;
}

TEST(ClothEquilibrium, APressurisedCylinderCarriesPressureTimesRadius) {
  const double coarse = cylinder_error(24), fine = cylinder_error(48);
  EXPECT_LT(fine, 3e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
}

// Zone of a sphere between the latitudes +-50 degrees, its rims held where a uniformly
// blown-up sphere has them.
double sphere_error(int columns) {
  const double radius = 0.25, strain = 0.01;
  const int rows = columns / 3 + 1;
  const auto at = [=](double r) {
    return [=](int row, int column) {
      const double latitude = (-50 + 100.0 * row / (rows - 1)) * pi / 180, t = 2 * pi * column / columns;
      return Vec3{r * std::cos(latitude) * std::cos(t), r * std::cos(latitude) * std::sin(t),
                  r * std::sin(latitude)};
    };
  };
  Mesh mesh;
  PatchSpec zone;
  zone.rows = rows, zone.columns = columns, zone.periodic = true;
  zone.position = at(radius * (1 + strain)), zone.rest = at(radius);
  FabricSpec fabric;
  fabric.coefficients = {30006};
  add_patch(mesh, zone, fabric);
  for (int column = 0; column < columns; ++column) {
    mesh.fixed.push_back(mesh.patches[0].node(0, column));
    mesh.fixed.push_back(mesh.patches[0].node(rows - 1, column));
  }
  // N = K (1 - xi + 2 B) e for equal strains, B = xi / (2 sqrt2); nominal, so N / (1 + e) per present length.
  const double n = 30006 * (0.8 + 2 * 0.2 / (2 * std::sqrt(2.0))) * strain;
  const double pressure = 2 * n / (radius * (1 + strain)) / (1 + strain);
  const auto [x, stress] = inflated(mesh, pressure);
  double worst = 0;
  for (int row = rows / 3; row < 2 * rows / 3; ++row)
    for (int column = 0; column < columns; ++column) {
      const CellStress& s = stress[row * columns + column];
      const double expected = 0.5 * pressure * norm(x[mesh.patches[0].node(row, column)]);
      worst = std::max(
          {worst, std::abs(s.principal_max / expected - 1), std::abs(s.principal_min / expected - 1)});
      EXPECT_NEAR(s.von_mises / expected, 1, 0.03);
    }
  return worst;
}

TEST(ClothEquilibrium, APressurisedSphereCarriesHalfPressureTimesRadius) {
  const double coarse = sphere_error(36), fine = sphere_error(72);
  EXPECT_LT(fine, 0.01);
  EXPECT_GT(std::log2(coarse / fine), 1.5);
}

TEST(ClothEquilibrium, APulledCouponGivesItsCurveBackForAnySpacing) {
  const double xi = 0.2, eps = 0.01;
  const SpringLaw curve{f111_curve, 1};
  const LatticeLaws laws = lattice_laws(curve.coefficients, xi, eps, 1, 0.33);
  for (double aspect : {0.6, 1.0, 1.7}) {
    const double h = 0.005;
    const int rows = 17, columns = 41;
    Mesh mesh;
    PatchSpec coupon;
    coupon.rows = rows, coupon.columns = columns;
    coupon.position = [=](int row, int column) { return Vec3{aspect * h * column, h * row, 0}; };
    FabricSpec fabric;
    fabric.xi = xi, fabric.eps = eps;
    const int patch = add_patch(mesh, coupon, fabric);
    Patch& p = mesh.patches[patch];
    p.law[along_row] = p.law[along_column] = laws.axial;
    p.law[shear_up] = p.law[shear_down] = laws.shear;
    p.law[bend_row] = p.law[bend_column] = laws.bending;
    const ClothPtr cloth = make_cloth(mesh);
    for (double strain : {0.01, 0.1, 0.3}) {
      // Pulled by forces on its ends: nothing is clamped, so the strain is homogeneous
      // but for the last cells.
      const double load = curve.tension(strain);
      Loads loads;
      loads.node_force.assign(mesh.node_count(), {});
      for (int row = 0; row < rows; ++row) {
        const double force = load * h * (row == 0 || row == rows - 1 ? 0.5 : 1.0);
        loads.node_force[p.node(row, 0)].x = -force;
        loads.node_force[p.node(row, columns - 1)].x = force;
      }
      ClothState state = start_state(*cloth);
      ThreadTeam team(1);
      const RelaxResult result = relax(state, *cloth, loads, {1e-6, 200000}, team);
      ASSERT_TRUE(result.converged) << aspect << ' ' << strain << ' ' << result.residual;
      const std::vector<Vec3> x = positions(state, *cloth);
      const double gauge = norm(x[p.node(8, 30)] - x[p.node(8, 10)]) / (20 * aspect * h) - 1;
      // Square cells: within 0.1 % of the curve. Others match in small strain; the curve of their slanted
      // diagonals leaves a little at large strain.
      EXPECT_NEAR(gauge / strain, 1, aspect == 1.0 || strain < 0.05 ? 2e-3 : 0.02) << aspect << " " << strain;
      const CellStress s = cell_stress(*cloth, state)[8 * columns + 20];
      const double width = norm(x[p.node(9, 20)] - x[p.node(8, 20)]) / h;
      EXPECT_NEAR(s.principal_max * width / load, 1, 2e-4) << aspect << " " << strain;
      EXPECT_NEAR(s.principal_min / load, 0, 2e-4);
    }
  }
}

TEST(ClothEquilibrium, AStripOfYarnsAloneCarriesItsTensionOverItsWidth) {
  // xi = 0: no contraction, so N = T / w exactly in every cell, also the border's.
  FabricSpec fabric;
  fabric.xi = 0, fabric.eps = 0;
  const Mesh mesh = rectangle(6, 9, 0.01, fabric);
  const ClothPtr cloth = make_cloth(mesh);
  std::vector<Vec3> x = mesh.start;
  for (Vec3& p : x) p.x *= 1.05;
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, x);
  const double n = 30006 * 0.05 - 18936 * 0.0025;
  const std::vector<CellStress> stress = cell_stress(*cloth, state);
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 8; ++column) {
      EXPECT_NEAR(stress[row * 9 + column].principal_max, n, 1e-9 * n);
      EXPECT_NEAR(stress[row * 9 + column].principal_min, 0, 1e-9 * n);
      EXPECT_NEAR(stress[row * 9 + column].von_mises, n, 1e-9 * n);
      EXPECT_NEAR(stress[row * 9 + column].max_strain, 0.05, 1e-12);
    }
}

// Hencky's membrane, clamped flat at r = a. N = (E t p^2 a^2)^(1/3) n(r / a):
//   n'' + 3 n'/s + 1 / (8 n^2) = 0,  n'(0) = 0,  n'(1) + (1 - nu) n(1) = 0,
//   w0 = (p a^4 / E t)^(1/3) int s / 2n
struct Hencky {
  double centre_tension, centre_deflection;
};
Hencky hencky(double nu) {
  const auto shoot = [&](double n0, double* deflection) {
    const int count = 4000;
    const double h = 1.0 / count;
    double n = n0, slope = 0, w = 0;
    const auto curve = [](double s, double y, double dy) {
      const double source = -1 / (8 * y * y);
      return s > 0 ? source - 3 * dy / s : source / 4;
    };
    for (int i = 0; i < count; ++i) {
      const double s = i * h;
      const double k1 = slope, l1 = curve(s, n, slope);
      const double k2 = slope + 0.5 * h * l1, l2 = curve(s + 0.5 * h, n + 0.5 * h * k1, k2);
      const double k3 = slope + 0.5 * h * l2, l3 = curve(s + 0.5 * h, n + 0.5 * h * k2, k3);
      const double k4 = slope + h * l3, l4 = curve(s + h, n + h * k3, k4);
      const double middle = n + 0.5 * h * k2;
      const double next = n + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      w += h / 6 * (s / (2 * n) + 4 * (s + 0.5 * h) / (2 * middle) + (s + h) / (2 * next));
      slope += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
      n = next;
    }
    if (deflection) *deflection = w;
    return slope + (1 - nu) * n;
  };
  double low = 0.3, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (shoot(middle, nullptr) < 0 ? low : high) = middle;
  }
  Hencky result{low, 0};
  shoot(low, &result.centre_deflection);
  return result;
}

// Polar lattice with spokes to a node in its centre. Under an even pressure its shear springs only feel the
// two normal strains, which the lattice carries alike, so for this load it is an isotropic membrane with
// E t / (1 - nu^2) = K (1 - xi + B), nu = B / (1 - xi + B), B = xi / (2 sqrt2): nu = 0.081 for xi = 0.2.
double polar_deflection(int rows, double radius, double pressure, double xi) {
  const int columns = 48;
  Mesh mesh;
  PatchSpec disk;
  disk.rows = rows, disk.columns = columns, disk.periodic = true;
  disk.position = [=](int row, int column) {
    const double r = radius * (row + 0.5) / (rows - 0.5), t = 2 * pi * column / columns;
    return Vec3{r * std::cos(t), r * std::sin(t), 0};
  };
  FabricSpec fabric;
  fabric.coefficients = {30006};
  fabric.xi = xi, fabric.eps = 0;
  add_patch(mesh, disk, fabric);
  const Patch& patch = mesh.patches[0];
  // Spokes over half a spacing, as wide as the innermost ring's share of the circle.
  mesh.start.push_back({0, 0, 0});
  mesh.mass.push_back(1e-6);
  mesh.laws.push_back({{30006}, 1});
  mesh.parts.push_back("spoke");
  const double hub = 0.5 * radius / (rows - 0.5);
  for (int column = 0; column < columns; ++column)
    mesh.springs.push_back({patch.node(0, column), mesh.node_count() - 1, hub, pi * hub / columns, 0, 0, 0});
  for (int column = 0; column < columns; ++column) mesh.fixed.push_back(patch.node(rows - 1, column));
  const ClothPtr cloth = make_cloth(mesh);
  Loads loads{std::vector<double>(mesh.cell_count(), pressure), {}};
  loads.node_force.assign(mesh.node_count(), {});
  for (int column = 0; column < columns; ++column)
    loads.node_force[patch.node(0, column)].z = -pressure * pi * hub * hub / columns;
  ClothState state = start_state(*cloth);
  ThreadTeam team(1);
  EXPECT_TRUE(relax(state, *cloth, loads, {1e-6, 200000}, team).converged);
  return -positions(state, *cloth).back().z;  // rows go outward: the area vectors point to -z
}

TEST(ClothEquilibrium, AClampedCircularMembraneIsHenckys) {
  EXPECT_NEAR(hencky(0.3).centre_deflection, 0.653,
              0.001);  // as tabulated, e.g. Fichter, NASA TP-3658 (1997)
  const double xi = 0.2, radius = 0.1, pressure = 20;
  const double coupling = xi / (2 * std::sqrt(2.0)), stiff = 1 - xi + coupling, nu = coupling / stiff;
  EXPECT_NEAR(nu, 0.081, 0.0005);
  const double modulus = 30006 * stiff * (1 - nu * nu);
  const double exact = std::cbrt(pressure * std::pow(radius, 4) / modulus) * hencky(nu).centre_deflection;
  std::vector<double> error;
  for (int rows : {6, 11, 21}) error.push_back(polar_deflection(rows, radius, pressure, xi) / exact - 1);
  EXPECT_LT(std::abs(error[2]), 0.005);
  EXPECT_GT(std::log2(std::abs(error[0] / error[1])), 1.2) << error[0] << " " << error[1] << " " << error[2];
  EXPECT_GT(std::log2(std::abs(error[1] / error[2])), 1.2) << error[0] << " " << error[1] << " " << error[2];
}

Mesh clamped_square(int size, double side, double damping) {
  FabricSpec fabric;
  fabric.damping = damping;
  Mesh mesh = rectangle(size, size, side / (size - 1), fabric);
  const Patch& p = mesh.patches[0];
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      if (row == 0 || column == 0 || row + 1 == size || column + 1 == size)
        mesh.fixed.push_back(p.node(row, column));
  return mesh;
}

TEST(ClothEquilibrium, RelaxationEndsWhereDampedTimeStepsEnd) {
  const Mesh mesh = clamped_square(13, 0.12, 0.004);
  const ClothPtr cloth = make_cloth(mesh), damped = make_cloth(mesh, {false, 60});
  const Loads loads{std::vector<double>(mesh.cell_count(), 1500.0), {}};
  ThreadTeam team(1);
  ClothState relaxed = start_state(*cloth), stepped = start_state(*damped);
  ASSERT_TRUE(relax(relaxed, *cloth, loads, {1e-9, 200000}, team).converged);
  step(stepped, *damped, loads, 0.7 * stability_limit(*damped, stepped).stable_step, 60000, team);
  EXPECT_LT(kinetic_energy(*damped, stepped), 1e-16);
  const std::vector<Vec3> a = positions(relaxed, *cloth), b = positions(stepped, *damped);
  double rise = 0, apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    rise = std::max(rise, a[i].z), apart = std::max(apart, norm(a[i] - b[i]));
  EXPECT_GT(rise, 0.005);
  EXPECT_LT(apart, 1e-7 * rise);
}

// A line's nodes lie outside of the lattice's rows, which threads share out.
TEST(ClothEquilibrium, ALineRelaxesTheSameOnAnyNumberOfThreads) {
  const Mesh mesh = chain(40, {0, 0, 0}, {0.9, 0, 0.3}, 0.025, {{200, 0}, 1}, 0.1);
  const ClothPtr cloth = make_cloth(mesh);
  Loads loads;
  for (const double mass : reference_masses(mesh)) loads.node_force.push_back({0, 0, -gravity * mass});
  std::vector<std::vector<Vec3>> ends;
  for (const int threads : {1, 2, 3}) {
    ThreadTeam team(threads);
    ClothState state = start_state(*cloth);
    relax(state, *cloth, loads, {1e-6, 5000}, team);
    ends.push_back(positions(state, *cloth));
    EXPECT_EQ(ends.back(), ends.front()) << threads;
  }
}

TEST(ClothEquilibrium, RelaxationEndsOnTheResidualItReportsAndIsTheSameOnAnyNumberOfThreads) {
  const Mesh mesh = clamped_square(21, 0.2, 0);
  const ClothPtr cloth = make_cloth(mesh);
  const Loads loads{std::vector<double>(mesh.cell_count(), 500.0), {}};
  std::vector<Vec3> first;
  for (int threads : {1, 2, 3}) {
    ThreadTeam team(threads);
    ClothState state = start_state(*cloth);
    int reports = 0;
    const RelaxResult result =
        relax(state, *cloth, loads, {1e-4, 50000}, team, [&](const RelaxProgress&) { ++reports; });
    ASSERT_TRUE(result.converged);
    EXPECT_GT(reports, 1);
    const std::vector<Vec3> x = positions(state, *cloth);
    if (threads > 1) {
      EXPECT_EQ(x, first);
      continue;
    }
    first = x;
    double moved = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      moved += norm(x[i] - mesh.start[i]) / static_cast<double>(x.size());
    EXPECT_NEAR(result.mean_displacement, moved, 1e-12);
    const std::vector<Vec3> none(x.size());
    const auto rss = [&](const std::vector<Vec3>& force) {
      std::vector<char> fixed(x.size(), 0);
      for (int node : mesh.fixed) fixed[node] = 1;
      double sum = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        if (!fixed[i]) sum += dot(force[i], force[i]);
      return std::sqrt(sum);
    };
    const double residual = rss(reference_forces(mesh, {}, loads, x, none));
    const double internal = rss(reference_forces(mesh, {}, {}, x, none));  // equals the applied load
    EXPECT_NEAR(residual / internal, result.residual, 1e-6);
    EXPECT_LE(result.residual, 1e-4);
    // The supports of the rim carry the load on all other nodes.
    const std::vector<Vec3> all = reference_forces(mesh, {}, loads, x, none);
    const std::vector<Vec3> springs = reference_forces(mesh, {}, {}, x, none);
    Vec3 pushed;
    for (std::size_t i = 0; i < x.size(); ++i) pushed += all[i] - springs[i];
    EXPECT_LT(norm(pushed - pressure_force(*cloth, state, loads)), 1e-10);
    for (int node : mesh.fixed) pushed -= all[node] - springs[node];
    EXPECT_LT(norm(force_on_fixed(*cloth, state) - pushed), 1e-3 * norm(pushed));
  }
}

// Without other supports: under a force on every node by its area the cloth moves by f / hold, wrinkled or
// not.
TEST(ClothEquilibrium, HeldClothGoesAsFarAsItsHoldLets) {
  for (const double buckling : {1e-6, std::numeric_limits<double>::infinity()}) {
    FabricSpec fabric;
    fabric.buckling_strain = buckling;
    const Mesh mesh = rectangle(9, 13, 0.02, fabric);
    const ClothPtr cloth = make_cloth(mesh);
    const Vec3 by_area{30, 0, -40};  // [Pa]
    Loads loads;
    for (const double mass : mesh.mass) loads.node_force.push_back(mass / fabric.areal_density * by_area);
    ClothState state = start_state(*cloth);
    ThreadTeam team(1);
    RelaxOptions options;
    options.tolerance = 1e-8;
    options.regularisation = 1000;
    const RelaxResult result = relax(state, *cloth, loads, options, team);
    EXPECT_TRUE(result.converged) << result.residual;
    EXPECT_NEAR(result.regularisation_share, 1, 1e-6);
    const std::vector<Vec3> x = positions(state, *cloth);
    for (std::size_t node = 0; node < x.size(); ++node)
      EXPECT_LT(norm(x[node] - mesh.start[node] - by_area / options.regularisation), 1e-8) << node;
  }
}

}  // namespace
}  // namespace ripstop
