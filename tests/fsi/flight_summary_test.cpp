// Statistics of motions whose rate of descent, glide and oscillation are known.
#include "ripstop/fsi/flight_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

constexpr double time_step = 0.01, period = 2.5, descent = 5, drift = 1.5;

/// Tilts a cos(wt) towards x and b sin(wt) towards y [deg].
std::vector<FreeFlightRow> swing(double a, double b, double duration) {
  std::vector<FreeFlightRow> rows;
  for (int n = 1; n <= std::lround(duration / time_step); ++n) {
    FreeFlightRow row;
    row.time = n * time_step, row.step = time_step;
    const double phase = 2 * std::numbers::pi * row.time / period;
    row.tilt_x = a * std::cos(phase), row.tilt_y = b * std::sin(phase);
    row.angle = std::hypot(row.tilt_x, row.tilt_y);
    row.wind = {3, 0, 0};
    row.velocity = {3 + drift + 0.4 * std::cos(phase), 0, -descent + 0.2 * std::sin(2 * phase)};
    rows.push_back(row);
  }
  return rows;
}

TEST(FlightSummary, PlaneSwingHasItsAmplitudeItsPeriodAndNoRoundness) {
  const FlightSummary s = summarise_flight(swing(20, 0, 50));
  ASSERT_TRUE(s.oscillation && s.period && s.largest_oscillation && s.roundness);
  EXPECT_NEAR(s.oscillation->mean, 20, 0.01);
  EXPECT_NEAR(s.largest_oscillation->mean, 20, 0.01);
  EXPECT_NEAR(s.period->mean, period, 0.01);
  EXPECT_LT(*s.roundness, 0.01);
  EXPECT_NEAR(s.peaks, 2 * (50 - s.start_up) / period, 2);
}

// The plane turns once in eight periods.
TEST(FlightSummary, SwingInATurningPlaneHasItsAmplitudeAndItsPeriod) {
  std::vector<FreeFlightRow> rows = swing(20, 0, 50);
  for (FreeFlightRow& row : rows) {
    const double turned = 2 * std::numbers::pi * row.time / (8 * period), tilt = row.tilt_x;
    row.tilt_x = tilt * std::cos(turned), row.tilt_y = tilt * std::sin(turned);
  }
  const FlightSummary s = summarise_flight(rows);
  ASSERT_TRUE(s.oscillation && s.period);
  EXPECT_NEAR(s.oscillation->mean, 20, 0.01);
  EXPECT_NEAR(s.period->mean, period, 0.01);
  EXPECT_NEAR(s.peaks, 2 * (50 - s.start_up) / period, 2);
}

TEST(FlightSummary, ConicalMotionHasARoundnessOfOneAndAConstantAngle) {
  const FlightSummary s = summarise_flight(swing(15, 15, 50));
  ASSERT_TRUE(s.oscillation && s.roundness);
  EXPECT_GT(*s.roundness, 0.9);
  EXPECT_NEAR(s.mean_angle, 15, 0.01);
  EXPECT_NEAR(s.oscillation->mean, 15, 0.01);
}

TEST(FlightSummary, GlideIsMeasuredRelativeToTheWind) {
  const FlightSummary s = summarise_flight(swing(10, 0, 50));
  EXPECT_NEAR(s.descent.mean, descent, 0.01);
  EXPECT_NEAR(s.glide.mean, drift / descent, 0.01);
  ASSERT_TRUE(s.descent.standard_error);
  EXPECT_LT(*s.descent.standard_error, 0.05);
}

// The start-up ends where the faster motion does. Half of that is added to the mean of the rest: 10 s of 40 s.
TEST(FlightSummary, MotionThatChangesLateHasALargerStandardError) {
  constexpr double faster = 0.4, until = 20;
  std::vector<FreeFlightRow> rows = swing(10, 0, 50);
  for (FreeFlightRow& row : rows)
    if (row.time <= until) row.velocity.z -= faster;
  const FlightSummary s = summarise_flight(rows);
  EXPECT_NEAR(s.start_up, until, 1);
  EXPECT_NEAR(s.descent.mean, descent, 0.02);
  ASSERT_TRUE(s.descent.standard_error);
  EXPECT_NEAR(*s.descent.standard_error, faster * 10 / 40, 0.02);
}

TEST(FlightSummary, TooShortAFlightIsRefusedOrHasNoPeriod) {
  EXPECT_THROW(summarise_flight({}), Error);
  EXPECT_FALSE(summarise_flight(swing(10, 0, 1)).period);
}

}  // namespace
}  // namespace ripstop
