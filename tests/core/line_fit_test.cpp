#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/least_squares.h"

namespace ripstop {
namespace {

TEST(LineFit, OfPointsOnALineIsTheLineWithoutError) {
  const std::vector<double> x{1, 2, 4, 7}, y{1, -1, -5, -11};
  const LineFit line = fit_line(x, y);
  EXPECT_NEAR(line.slope, -2, 1e-14);
  EXPECT_NEAR(line.intercept, 3, 1e-14);
  EXPECT_NEAR(line.r2, 1, 1e-14);
  EXPECT_NEAR(line.band(5), 0, 1e-12);
}

TEST(LineFit, HasTheErrorsOfTheTextbook) {
  // Anscombe's first set (The American Statistician 27, 1973): 3.00 + 0.500 x,
  // R2 = 0.67, errors 1.125, 0.118.
  const std::vector<double> x{10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5},
      y{8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
  const LineFit line = fit_line(x, y);
  EXPECT_NEAR(line.slope, 0.500, 5e-4);
  EXPECT_NEAR(line.intercept, 3.00, 5e-3);
  EXPECT_NEAR(line.r2, 0.67, 5e-3);
  EXPECT_NEAR(line.slope_error, 0.118, 5e-4);
  EXPECT_NEAR(line.intercept_error, 1.125, 5e-4);
  EXPECT_NEAR(line.scatter, 1.237, 5e-4);
  // Narrowest at the mean: t(95 %, 9) s / sqrt(11).
  EXPECT_NEAR(line.band(9), 2.262 * 1.2366 / std::sqrt(11.0), 1e-3);
  EXPECT_GT(line.band(14), line.band(9));
}

TEST(LineFit, TwoPointsAreExactAndDetermineNoError) {
  const LineFit line = fit_line(std::vector<double>{1, 3}, std::vector<double>{2, -2});
  EXPECT_NEAR(line.slope, -2, 1e-14);
  EXPECT_EQ(line.scatter, 0);
  EXPECT_EQ(line.slope_error, 0);
  EXPECT_EQ(line.intercept_error, 0);
  EXPECT_EQ(line.band(2), 0);
}

TEST(LineFit, NeedsTwoDifferentX) {
  EXPECT_THROW(fit_line(std::vector<double>{1, 1}, std::vector<double>{1, 2}), Error);
  EXPECT_THROW(fit_line(std::vector<double>{1}, std::vector<double>{1}), Error);
  EXPECT_THROW(fit_line(std::vector<double>{1, 2, 3}, std::vector<double>{1, 2}), Error);
  EXPECT_THROW(fit_line(std::vector<double>{}, std::vector<double>{}), Error);
}

}  // namespace
}  // namespace ripstop
