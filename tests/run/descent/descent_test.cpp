// Use of a finished steady run for flight: descent.
#include "ripstop/run/descent/descent.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "tests/refusal.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

class DescentOfARun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>("descent");
    fly_square_law(run());
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::filesystem::path run() { return folder_->path / "run"; }
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(DescentOfARun, ItsSpeedCarriesPayloadAndParachute) {
  const FinishedSteady finished = finished_steady(run());
  EXPECT_NEAR(finished.result.drag_area, SquareLawEngine::area, 2e-3 * SquareLawEngine::area);
  const Descent d = run_descent(finished, 4, {0, 2000});
  ASSERT_EQ(d.rows.size(), 2u);
  EXPECT_GT(d.parachute_mass, 0.05);
  for (const DescentRow& row : d.rows)
    EXPECT_NEAR(0.5 * row.density * row.speed * row.speed * d.drag_area,
                (4 + d.parachute_mass) * standard_gravity, 1e-9);
  EXPECT_EQ(d.rows[0].density, standard_air(0).density);
  EXPECT_FALSE(d.rows[0].time);
  EXPECT_GT(*d.rows[1].time * d.rows[1].speed, 2000);
  EXPECT_LT(*d.rows[1].time * d.rows[0].speed, 2000);
}

TEST_F(DescentOfARun, ItsUncertaintyIsTheRunsOwn) {
  const FinishedSteady finished = finished_steady(run());
  EXPECT_GT(finished.drag_uncertainty, 0);
  EXPECT_LT(finished.drag_uncertainty, 0.011);  // a run converges with its ledger closed within 1 %
  const Descent d = run_descent(finished, 4, {0});
  EXPECT_NEAR(d.rows[0].speed_uncertainty / d.rows[0].speed, 0.5 * finished.drag_uncertainty, 1e-12);
}

// A wake that swings by a tenth about a mean that is known to a thousandth.
TEST(DragUncertainty, OfAMeanOverTimeIsItsStandardErrorAndNotItsSwing) {
  SteadyIteration last;
  last.fluid_force = last.nodal_load = last.momentum_deficit = 100;
  last.drag_deviation = 10, last.drag_error = 0.1;
  EXPECT_NEAR(drag_uncertainty(last), 0.1, 1e-12);
  last.in_time = true;
  EXPECT_NEAR(drag_uncertainty(last), 1e-3, 1e-12);
}

TEST_F(DescentOfARun, AFlightFarFromTheRunsIsWarnedOf) {
  const FinishedSteady finished = finished_steady(run());
  const double q = 0.5 * finished.result.density * finished.result.speed * finished.result.speed;
  const double same = q * finished.result.drag_area / standard_gravity - finished.parachute_mass;
  EXPECT_EQ(run_descent(finished, same, {0}).warnings, finished.warnings);
  EXPECT_EQ(run_descent(finished, 0.5 * same, {0}).warnings.size(), finished.warnings.size() + 1);
}

TEST_F(DescentOfARun, ImpossibleDescentsAreRefused) {
  const FinishedSteady finished = finished_steady(run());
  EXPECT_NE(refusal_of([&] { run_descent(finished, -4, {0}); }, ExitCode::usage).find("-4 kg"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { run_descent(finished, std::nan(""), {0}); }, ExitCode::usage).find("above 0"),
            std::string::npos);
  refusal_of([&] { run_descent(finished, 4, {100000}); }, ExitCode::usage);
}

TEST_F(DescentOfARun, AFolderWithoutAConvergedSteadyRunIsRefused) {
  const auto empty = folder_->path / "empty";
  std::filesystem::create_directories(empty);
  EXPECT_NE(refusal_of([&] { finished_steady(empty); }, ExitCode::usage).find("no finished run"),
            std::string::npos);
  refusal_of([&] { finished_steady(folder_->path / "none"); }, ExitCode::usage);
  const auto open = folder_->path / "open";
  EXPECT_FALSE(fly_square_law(open, {{"coupling.max_iterations", "1"}}).converged);
  EXPECT_NE(refusal_of([&] { finished_steady(open); }, ExitCode::bad_data).find("not converged"),
            std::string::npos);
}

}  // namespace
}  // namespace ripstop
