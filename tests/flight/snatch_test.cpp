#include "ripstop/flight/snatch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

// Knacke's formula for straight curves: F = dv sqrt(m_p m_c / (m_p + m_c) Z P / (e_max l)), a quarter of a swing after
// the first tension.
TEST(Snatch, OfStraightLinesIsTheHandbooksFormula) {
  const double mp = 100, mc = 4, dv = 12, k = 5900, length = 9;
  const int count = 24;
  const SnatchLoad load = snatch_load(mp, mc, dv, {{"lines", {k}, count, length}});
  const double reduced = mp * mc / (mp + mc), stiffness = count * k / length;
  EXPECT_NEAR(load.load, dv * std::sqrt(reduced * stiffness), 1e-6 * load.load);
  EXPECT_NEAR(load.time, std::numbers::pi / 2 * std::sqrt(reduced / stiffness), 1e-4 * load.time);
  EXPECT_NEAR(load.strain[0] * length, load.stretch, 1e-9);
}

TEST(Snatch, PartsInARowAreSofterThanEitherAndShareTheLoad) {
  const SnatchPart lines{"lines", {6000, 2000}, 12, 4}, riser{"riser", {90000, 4e5}, 1, 2};
  const SnatchLoad one = snatch_load(50, 2, 10, {lines}), both = snatch_load(50, 2, 10, {lines, riser});
  EXPECT_LT(both.load, one.load);
  EXPECT_NEAR(both.strand_load[0] * 12, both.load, 1e-9 * both.load);
  EXPECT_NEAR(both.strand_load[1], both.load, 1e-9 * both.load);
}

// The same by small steps in time of the two masses with the nonlinear parts between them.
TEST(Snatch, OfANonlinearRiserAgreesWithSmallTimeSteps) {
  const double mp = 30, mc = 1.5, dv = 15, k1 = 40000, k2 = 3e6, length = 3;
  const SnatchLoad load = snatch_load(mp, mc, dv, {{"riser", {k1, k2}, 1, length}});
  double x = 0, v = dv, t = 0, most = 0, at = 0;
  const double dt = 1e-7, reduced = mp * mc / (mp + mc);
  while (v > 0) {
    const auto force = [&](double s) { return k1 * (s / length) + k2 * (s / length) * (s / length); };
    v -= 0.5 * dt * force(x) / reduced;
    x += dt * v;
    v -= 0.5 * dt * force(x) / reduced;
    t += dt;
    if (force(x) > most) most = force(x), at = t;
  }
  EXPECT_NEAR(load.load / most, 1, 1e-4);
  EXPECT_NEAR(load.time / at, 1, 1e-3);
}

TEST(Snatch, LinesThatCannotTakeTheEnergyAreNamedAsBreaking) {
  EXPECT_THROW(snatch_load(100, 10, 300, {{"lines", {5000, -20000}, 4, 2}}), Error);
  EXPECT_THROW(snatch_load(-1, 10, 30, {{"lines", {5000}, 4, 2}}), Error);
  EXPECT_THROW(snatch_load(1, 10, 30, {}), Error);
}

// A payload without drag and a canopy that is stopped at once come apart at the whole speed.
TEST(Snatch, TheSpeedDifferenceLiesBetweenNoneAndAll) {
  const double all = speed_difference_at_stretch({50, 0}, {0.01, 50}, 40, 1.2, 5);
  EXPECT_NEAR(all, 40, 0.2);
  const double some = speed_difference_at_stretch({50, 0.1}, {2, 0.3}, 40, 1.2, 5);
  EXPECT_GT(some, 0);
  EXPECT_LT(some, 40);
  EXPECT_GT(speed_difference_at_stretch({50, 0.1}, {2, 0.3}, 40, 1.2, 8), some);
  // A payload without drag at v, a canopy at v / (1 + b v t): b v t = 1 at half the speed and (1 - ln 2) / b apart.
  const double b = 0.5 * 1.2 * 0.3 / 2;
  EXPECT_NEAR(speed_difference_at_stretch({50, 0}, {2, 0.3}, 40, 1.2, (1 - std::log(2)) / b), 20, 1e-9);
  EXPECT_THROW(speed_difference_at_stretch({1, 1}, {2, 0.3}, 40, 1.2, 5), Error);
  const auto refusal = [](double payload, double canopy, double speed, double density, double length,
                          double area) -> std::string {
    try {
      speed_difference_at_stretch({payload, 0.1}, {canopy, area}, speed, density, length);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(50, 2, 40, 1.2, 5, 0.3), "accepted");
  for (const double wrong : {0.0, -1.0, std::nan("")}) {
    EXPECT_NE(refusal(wrong, 2, 40, 1.2, 5, 0.3).find("payload mass (kg)"), std::string::npos) << wrong;
    EXPECT_NE(refusal(50, wrong, 40, 1.2, 5, 0.3).find("canopy mass (kg)"), std::string::npos) << wrong;
    EXPECT_NE(refusal(50, 2, wrong, 1.2, 5, 0.3).find("speed (m/s)"), std::string::npos) << wrong;
    EXPECT_NE(refusal(50, 2, 40, wrong, 5, 0.3).find("density (kg/m3)"), std::string::npos) << wrong;
    EXPECT_NE(refusal(50, 2, 40, 1.2, wrong, 0.3).find("length (m) of lines and riser"), std::string::npos)
        << wrong;
    EXPECT_NE(refusal(50, 2, 40, 1.2, 5, wrong).find("drag area (m2) of the packed canopy"),
              std::string::npos)
        << wrong;
  }
  EXPECT_THROW(speed_difference_at_stretch({50, -0.1}, {2, 0.3}, 40, 1.2, 5), Error);
  EXPECT_THROW(speed_difference_at_stretch({50, 0.1}, {2, -0.3}, 40, 1.2, 5), Error);
}

}  // namespace
}  // namespace ripstop
