// Sheets that move through the grid, in unsteady flow: added mass, drift, and compliant cloth.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"

namespace ripstop {
namespace {

using std::numbers::pi;

constexpr double air_density = 1.2, across_disk = 1;

/// Turned about its middle by an angle to the stream [rad].
std::vector<Triangle> disk_at(double z, double angle = 0) {
  const Vec3 middle{0.013, 0.021, z};
  std::vector<Triangle> surface = disk(across_disk, middle);
  for (Triangle& t : surface)
    for (Vec3* p : {&t.a, &t.b, &t.c}) {
      const Vec3 d = *p - middle;
      *p = middle + Vec3{d.x * std::cos(angle), d.y, -d.x * std::sin(angle)};
    }
  return surface;
}

FlowProblem disk_in_air(double speed, double linear, double z, double angle = 0) {
  FlowProblem problem;
  problem.grid = graded({{-3, -3, 0}, {6, 6, 9}, 40, 40, 72}, {-0.75, -0.75, 2.0}, {0.75, 0.75, 5.5}, 1.2);
  problem.air.velocity = {0, 0, speed};
  problem.air.density = air_density;
  problem.sides = Sides::entraining;
  problem.outlet = Outlet::still_air;
  problem.bodies = {sheet_body(disk_at(z, angle), {linear, 0})};
  return problem;
}

std::unique_ptr<FlowEngine> engine_on_one_thread() {
  CartesianSettings settings;
  settings.threads = 1;
  return make_cartesian(settings);
}

SheetMotion all_with(const std::vector<Triangle>& surface, Vec3 velocity) {
  SheetMotion motion;
  motion.velocity.assign(surface.size(), velocity);
  return motion;
}

// An impermeable disk that starts in still air has an added mass of 8/3 rho a^3 (Lamb, Hydrodynamics, 108). It has
// moved by a ten-thousandth of its diameter at the end, before vortices are shed at its edge.
TEST(MovingSheet, ADiskThatIsSetInMotionHasItsAddedMass) {
  constexpr double drift = 0.05, gains = 50, step = 2e-4;
  const double exact = -8.0 / 3 * air_density * std::pow(across_disk / 2, 3) * gains;
  const auto engine = engine_on_one_thread();
  const auto flow = engine->start(disk_in_air(drift, 1e6, 4));
  double force = 0;
  for (int n = 0; n < 3; ++n) {
    const std::vector<Triangle> surface = disk_at(4 + drift * n * step);
    flow->place(0, surface, all_with(surface, {0, 0, drift + gains * (n + 1) * step}));
    force = flow->step(step).force.z;
  }
  EXPECT_NEAR(force / exact, 1, 0.1);
}

struct Drift {
  double mean = 0,
         swing = 0;  // drag over q S, and the root mean square of the part that varies with the cells
};

/// Of a disk that drifts upstream at 9 of the 10 m/s between it and the air.
Drift drift_of(double linear, double angle = 0) {
  constexpr double along = -9, stream = 1, cell = 0.075;
  const auto engine = engine_on_one_thread();
  const auto flow = engine->start(disk_in_air(stream, linear, 4.9, angle));
  std::vector<double> drag;
  for (double z = 4.9; z > 2.6;) {
    const std::vector<Triangle> surface = disk_at(z, angle);
    flow->place(0, surface, all_with(surface, {0, 0, along}));
    const double length = cell / 8 / std::abs(along);  // eight steps a cell
    drag.push_back(flow->step(length).force.z / (0.5 * air_density * 100 * pi / 4));
    z += along * length;
  }
  Drift drift;
  double squares = 0;
  int count = 0;
  for (std::size_t n = drag.size() / 3; n + 4 < drag.size(); ++n) {
    double around = 0;
    for (std::size_t i = n - 4; i < n + 4; ++i) around += drag[i] / 8;
    squares += std::pow(drag[n] - around, 2), drift.mean += drag[n], ++count;
  }
  drift.mean /= count;
  drift.swing = std::sqrt(squares / count) / drift.mean;
  return drift;
}

class PorousDisk : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Degrees, PorousDisk, testing::Values(0, 30),
                         [](const auto& of) { return std::to_string(static_cast<int>(of.param)); });

TEST_P(PorousDisk, DriftsThroughTheGridWithoutASwingAndHasTheDragOfOneAtRest) {
  const double angle = GetParam() * pi / 180;
  const Drift drift = drift_of(30, angle);
  EXPECT_LT(drift.swing, 0.03);
  // At rest in a stream of 10 m/s, as long after its start.
  const auto engine = engine_on_one_thread();
  const auto flow = engine->start(disk_in_air(10, 30, 4, angle));
  double time = 0, sum = 0, weight = 0;
  flow->march(1000, 0.5, [&](const FlowStep& step) {
    time = step.time;
    if (time > 2.3 / 9 / 3) sum += step.length * step.force.z, weight += step.length;
    return time < 2.3 / 9;
  });
  EXPECT_NEAR(drift.mean / (sum / weight / (0.5 * air_density * 100 * pi / 4)), 1, 0.02);
}

// A porous disk that is let go falls faster until the air carries it: its drag is then K / (1 + K / 4)^2 of q S
// (Taylor, R&M 2236, 1944). The grid falls along at the speed that it has at first.
TEST(MovingSheet, ADiskThatFallsComesToItsTerminalSpeed) {
  constexpr double loss = 1, mass = 1, gravity = 9.81, area = pi / 4 * across_disk * across_disk;
  const double coefficient = loss / std::pow(1 + loss / 4, 2),
               terminal = std::sqrt(2 * mass * gravity / (air_density * area * coefficient));
  constexpr double first = 4.5, high = 5.2, step = 4e-3, duration = 2.2;
  FlowProblem problem = disk_in_air(first, 0, high);
  problem.bodies[0].drop().quadratic = 0.5 * air_density * loss;
  const auto engine = engine_on_one_thread();
  const auto flow = engine->start(problem);
  double z = high, rises = 0, sum = 0, count = 0;  // rises: through the grid [m/s]
  for (double time = 0; time < duration; time += step) {
    const std::vector<Triangle> surface = disk_at(z);
    flow->place(0, surface, all_with(surface, {0, 0, rises}));
    rises += step * (flow->step(step).force.z / mass - gravity);
    z += step * rises;
    if (time > 0.75 * duration) sum += first - rises, ++count;
  }
  EXPECT_GT(terminal, 1.2 * first);
  EXPECT_NEAR(sum / count / terminal, 1, 0.02);
}

// With the law in the sheet's face and not where the sheet is the swing is more than twice the drag.
TEST(MovingSheet, ATightDiskSwingsByAPartOfItsDragOnly) {
  EXPECT_LT(drift_of(1e6).swing, 0.15);
}

/// A band of 0.3 m folded into a star of 18 points, as a disk-gap-band begins.
std::vector<Triangle> folded_band() {
  std::vector<Triangle> surface;
  constexpr int folds = 36, rows = 12;
  const auto corner = [](int fold, int row) {
    const double radius = fold % 2 == 0 ? 0.06 : 0.14, angle = 2 * pi * (fold % folds) / folds;
    return Vec3{0.013 + radius * std::cos(angle), 0.021 + radius * std::sin(angle), 1.0 + 0.025 * row};
  };
  for (int n = 0; n < folds; ++n) {
    for (int row = 0; row < rows; ++row) {
      const Vec3 a = corner(n, row), b = corner(n + 1, row), c = corner(n + 1, row + 1),
                 d = corner(n, row + 1);
      surface.push_back({a, b, c}), surface.push_back({a, c, d});
    }
  }
  return surface;
}

// All of it lies within two cells of a hem, and bends out of nearly every column that it comes into.
TEST(MovingSheet, AFoldedBandDoesNotLeak) {
  FlowProblem problem;
  problem.grid = {{-0.6, -0.6, 0}, {1.2, 1.2, 2}, 30, 30, 50};
  problem.air.velocity = {0, 0, 10};
  problem.bodies = {sheet_body(folded_band(), {1e4, 0})};
  const auto engine = engine_on_one_thread();
  const auto flow = engine->start(problem);
  for (const SheetMotion& motion : {SheetMotion{}, all_with(folded_band(), {})}) {
    flow->place(0, folded_band(), motion);
    int faces = 0;
    for (const SheetLoad& load : flow->sheet_loads()) {
      if (load.point.z < 1.06 || load.point.z > 1.24) continue;  // next to its ends
      EXPECT_EQ(load.cover, 1) << load.point.x << " " << load.point.y << " " << load.point.z;
      ++faces;
    }
    EXPECT_GT(faces, 100);
  }
}

}  // namespace
}  // namespace ripstop
