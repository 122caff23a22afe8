#include "ripstop/fsi/acceleration.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ripstop {
namespace {

// g(x) = b + A x with four eigenvalues; the fixed point, 3, is known.
std::vector<double> answer(const std::vector<double>& x, double slope) {
  std::vector<double> g(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double factor = slope * (i % 4 == 0 ? 1.0 : i % 4 == 1 ? 0.8 : i % 4 == 2 ? 0.5 : -0.2);
    g[i] = 3.0 + factor * (x[i] - 3.0);
  }
  return g;
}

double error(const std::vector<double>& x) {
  double largest = 0;
  for (const double value : x) largest = std::max(largest, std::abs(value - 3.0));
  return largest;
}

int iterations(Acceleration update, double slope, double relaxation) {
  Accelerator accelerator;
  accelerator.update = update;
  accelerator.relaxation = relaxation;
  std::vector<double> x(40);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(1.0 + double(i));
  const std::vector<double> weight(x.size(), 0.1);
  for (int k = 1; k <= 300; ++k) {
    x = accelerator.next(x, answer(x, slope), weight);
    if (error(x) < 1e-8) return k;
  }
  return 1000;
}

TEST(Accelerator, AndersonSolvesALinearMapInAboutAsManyStepsAsItHasEigenvalues) {
  EXPECT_LE(iterations(Acceleration::anderson, 0.9, 1.0), 12);
  EXPECT_GT(iterations(Acceleration::none, 0.9, 1.0), 60);
}

TEST(Accelerator, AitkenAndAndersonConvergeWhereTheBareMapDiverges) {
  EXPECT_EQ(iterations(Acceleration::none, -1.3, 1.0), 1000);
  EXPECT_LT(iterations(Acceleration::anderson, -1.3, 0.5), 20);
  EXPECT_LT(iterations(Acceleration::aitken, -1.3, 0.5), 100);
}

// Forces [N] of a flow that settled from one coupling iteration to the next, hardly knowing the load: Stratos
// IV with tight cloth at 25 m/s.
TEST(Accelerator, AnswersThatDriftDoNotThrowTheGuessesOff) {
  Accelerator accelerator;
  std::vector<double> load(5, 336.2);
  const std::vector<double> weight(5, 0.2);
  for (const double force : {340.93, 337.81, 335.63, 334.42, 332.32, 333.95, 332.59, 332.44, 332.15}) {
    load = accelerator.next(load, std::vector<double>(5, force), weight);
    EXPECT_NEAR(load.front(), force, 0.01 * force);
  }
}

TEST(Accelerator, AFixedPointStaysWhereItIs) {
  Accelerator accelerator;
  const std::vector<double> x(5, 3.0), weight(5, 1.0);
  EXPECT_EQ(accelerator.next(x, x, weight), x);
  EXPECT_EQ(accelerator.next(x, x, weight), x);
}

TEST(Accelerator, AnswersThatJitterAreAveraged) {
  Accelerator accelerator;
  const std::vector<double> weight(3, 1.0);
  std::vector<double> x(3, 7.0);
  double sum = 7;
  const double answers[] = {104, 96, 101, 99, 95, 105};
  for (int n = 0; n < 6; ++n) {
    accelerator.average(1);
    x = accelerator.next(x, std::vector<double>(3, answers[n]), weight);
    sum += answers[n];
    EXPECT_NEAR(x.front(), sum / (n + 2), 1e-12 * sum) << n;
  }
}

TEST(Accelerator, AnswersThatSettleMayWeighTheMoreTheLaterTheyAre) {
  Accelerator accelerator;
  const std::vector<double> weight(3, 1.0);
  std::vector<double> x(3, 7.0);
  accelerator.update = Acceleration::none;
  const double answers[] = {104, 96, 101, 99};
  double sum = 0, weights = 0;
  for (int n = 0; n < 4; ++n) {
    if (n > 0) accelerator.average(2);
    x = accelerator.next(x, std::vector<double>(3, answers[n]), weight);
    sum += (n + 1) * answers[n], weights += n + 1;
    EXPECT_NEAR(x.front(), sum / weights, 1e-12 * sum) << n;
  }
}

TEST(Accelerator, ACopyContinuesLikeTheOriginal) {
  Accelerator original;
  std::vector<double> x(8, 0.0);
  const std::vector<double> weight(8, 1.0);
  for (int k = 0; k < 3; ++k) x = original.next(x, answer(x, 0.8), weight);
  Accelerator copy = original;
  EXPECT_EQ(copy.next(x, answer(x, 0.8), weight), original.next(x, answer(x, 0.8), weight));
}

}  // namespace
}  // namespace ripstop
