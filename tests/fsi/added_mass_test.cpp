// The air that goes with a body, against potential flow.
#include "ripstop/fsi/added_mass.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"

namespace ripstop {
namespace {

using std::numbers::pi;

struct Ring {
  double r, z;
};

/// Stokes' stream function at `p` of a vortex ring of unit strength (Lamb, Hydrodynamics, 161).
double stream_function(Ring p, Ring vortex) {
  const double square = std::pow(p.r + vortex.r, 2) + std::pow(p.z - vortex.z, 2);
  const double k = std::sqrt(4 * p.r * vortex.r / square);
  return std::sqrt(p.r * vortex.r) / (2 * pi) *
         ((2 / k - k) * std::comp_ellint_1(k) - 2 / k * std::comp_ellint_2(k));
}

/// Added mass over the density of a thin surface of revolution with this meridian [m3]: rings of vorticity that make it
/// a stream surface of the fluid that it moves through, and their impulse.
double of_potential_flow(const std::vector<Ring>& meridian) {
  const int n = static_cast<int>(meridian.size()) - 1;
  std::vector<Ring> middle;
  std::vector<double> length;
  for (int i = 0; i < n; ++i) {
    const Ring a = meridian[i], b = meridian[i + 1];
    middle.push_back({0.5 * (a.r + b.r), 0.5 * (a.z + b.z)});
    length.push_back(std::hypot(b.r - a.r, b.z - a.z));
  }
  Eigen::MatrixXd made(n, n);
  Eigen::VectorXd asked(n);
  for (int i = 0; i < n; ++i) {
    asked[i] = 0.5 * middle[i].r * middle[i].r;
    for (int j = 0; j < n; ++j)
      made(i, j) =
          length[j] * (i != j ? stream_function(middle[i], middle[j])
                              : middle[i].r / (2 * pi) * (std::log(16 * middle[i].r / length[i]) - 1));
  }
  const Eigen::VectorXd strength = made.partialPivLu().solve(asked);
  double impulse = 0;
  for (int i = 0; i < n; ++i) impulse += pi * middle[i].r * middle[i].r * strength[i] * length[i];
  return impulse;
}

/// From the axis to the rim, closer there: `at` of 0 to 1.
template <class At>
std::vector<Ring> meridian(const At& at) {
  constexpr int parts = 100;
  std::vector<Ring> rings;
  for (int i = 0; i <= parts; ++i) rings.push_back(at(std::sin(0.5 * pi * i / parts)));
  return rings;
}

constexpr double air_density = 1.2, disk_radius = 0.5;
constexpr Vec3 place{0.313, -0.221, 4.07};

double computed(const std::vector<Triangle>& surface) {
  CartesianSettings settings;
  settings.threads = 1;
  return added_mass(*make_cartesian(settings), surface, air_density) / air_density;
}

TEST(AddedMass, OfADiskIsLambs) {
  const double exact = 8.0 / 3 * std::pow(disk_radius, 3);  // Hydrodynamics, 108
  EXPECT_NEAR(of_potential_flow(meridian([](double s) {
                return Ring{disk_radius * s, 0};
              })),
              exact, 0.002 * exact);
  EXPECT_NEAR(computed(disk(2 * disk_radius, place)), exact, 0.05 * exact);
}

TEST(AddedMass, OfAHemisphericalCupIsThatOfPotentialFlow) {
  const double exact = of_potential_flow(meridian([](double s) {
    return Ring{disk_radius * std::sin(0.5 * pi * s), disk_radius * std::cos(0.5 * pi * s)};
  }));
  EXPECT_NEAR(exact, 4.476 * std::pow(disk_radius, 3), 0.01 * exact);
  EXPECT_NEAR(computed(hemispherical_cup(2 * disk_radius, place)), exact, 0.05 * exact);
}

// As a canopy that has hardly opened: half as wide as it is long, twelve cells from its axis to its mouth.
TEST(AddedMass, OfANarrowConeIsThatOfPotentialFlow) {
  constexpr double length = 2, mouth = 0.5;
  constexpr int around = 48, up = 24;
  std::vector<Triangle> cone;
  const auto at = [&](int n, int row) {
    const double part = static_cast<double>(row) / up, angle = 2 * pi * (n % around) / around;
    return place + Vec3{mouth * part * std::cos(angle), mouth * part * std::sin(angle), -length * part};
  };
  for (int n = 0; n < around; ++n)
    for (int row = 0; row < up; ++row) {
      cone.push_back({at(n, row), at(n, row + 1), at(n + 1, row + 1)});
      if (row > 0) cone.push_back({at(n, row), at(n + 1, row + 1), at(n + 1, row)});
    }
  const double exact = of_potential_flow(meridian([](double s) { return Ring{mouth * s, -length * s}; }));
  EXPECT_NEAR(computed(cone), exact, 0.05 * exact);
}

}  // namespace
}  // namespace ripstop
