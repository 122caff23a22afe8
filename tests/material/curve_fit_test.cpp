#include "ripstop/material/curve_fit.h"

#include <gtest/gtest.h>

#include <random>

#include "../f111_curve.h"
#include "ripstop/core/error.h"
#include "ripstop/core/least_squares.h"
#include "synthetic.h"

namespace ripstop {
namespace {

SyntheticRecord f111_record() {
  SyntheticRecord record;
  record.load = [](double e) { return polynomial(f111_curve, 1, e); };
  return record;
}

std::vector<CleanRecord> bench_of(const SyntheticRecord& wanted, int samples, std::mt19937& random) {
  std::vector<CleanRecord> records;
  for (int i = 0; i < samples; ++i) {
    records.push_back(clean_record(synthetic_record(wanted, random), LoadKind::per_width));
  }
  return records;
}

TEST(LeastSquares, APolynomialComesBackFromItsPoints) {
  const std::vector<double> c{3, -2, 0.5, 7};
  std::vector<double> x, y;
  for (int i = 1; i <= 30; ++i) x.push_back(1e-3 * i), y.push_back(polynomial(c, 0, x.back()));
  const std::vector<double> found = fit_polynomial(x, y, 0, 3);
  for (std::size_t k = 0; k < c.size(); ++k) EXPECT_NEAR(found[k] / c[k], 1, 1e-6) << k;
  EXPECT_THROW(fit_polynomial(std::span(x).first(2), std::span(y).first(2), 0, 3), Error);
}

TEST(LeastSquares, StudentsTIsThatOfTheTables) {
  EXPECT_NEAR(student_t(0.95, 1), 12.7062, 1e-4);
  EXPECT_NEAR(student_t(0.95, 4), 2.77645, 1e-5);
  EXPECT_NEAR(student_t(0.99, 10), 3.16927, 1e-5);
  EXPECT_NEAR(student_t(0.6827, 1000), 1.0005, 1e-3);
}

TEST(CurveFit, ExactRecordsGiveTheirCoefficientsBack) {
  SyntheticRecord exact = f111_record();
  exact.scatter = exact.failure_scatter = exact.noise = 0;
  std::mt19937 random(1);
  const CurveFit fit = fit_curve(mean_curve(bench_of(exact, 3, random)), 2, {});
  EXPECT_NEAR(fit.k[0].value, 30006, 30);
  EXPECT_NEAR(fit.k[1].value, -18936, 60);
  EXPECT_NEAR(fit.offset.value, 0, 5);
  EXPECT_GT(fit.r2, 0.99999);
  EXPECT_EQ(fit.rising_until, fit.tested_strain);
}

TEST(CurveFit, TheMeanCurveGoesAsFarAsTheFirstSampleThatFailedAndKeepsEachSamplesEnd) {
  std::mt19937 random(3);
  const std::vector<CleanRecord> samples = bench_of(f111_record(), 4, random);
  const MeanCurve curve = mean_curve(samples);
  ASSERT_EQ(curve.names.size(), 4u);
  ASSERT_EQ(curve.failure_strain.size(), 4u);
  ASSERT_EQ(curve.failure_load.size(), 4u);
  ASSERT_EQ(curve.samples.size(), 4u);
  double first = samples[0].failure_strain;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(curve.names[i], samples[i].name);
    EXPECT_EQ(curve.failure_strain[i], samples[i].failure_strain);
    EXPECT_EQ(curve.failure_load[i], samples[i].failure_load);
    first = std::min(first, samples[i].failure_strain);
  }
  EXPECT_EQ(curve.tested_strain, first);
  const double step = curve.strain[1] - curve.strain[0];
  EXPECT_NEAR(curve.strain.front(), 0.5 * step, 1e-12);
  EXPECT_NEAR(curve.strain.back(), first - 0.5 * step, 1e-12);
  for (std::size_t k = 0; k < curve.strain.size(); ++k) {
    double sum = 0;
    for (const std::vector<double>& sample : curve.samples) sum += sample.at(k);
    EXPECT_NEAR(curve.load[k], sum / 4, 1e-9 * sum) << k;
  }
}

// Of two samples Student's t has one degree of freedom: 12.7 standard errors either way.
TEST(CurveFit, TwoSamplesHaveAnErrorAndAWideInterval) {
  std::mt19937 random(5);
  const CurveFit fit = fit_curve(mean_curve(bench_of(f111_record(), 2, random)), 2, {});
  for (const Estimate& k : fit.k) {
    EXPECT_GT(k.standard_error, 0);
    EXPECT_TRUE(std::isfinite(k.standard_error));
  }
  EXPECT_NEAR((fit.k[1].high - fit.k[1].value) / fit.k[1].standard_error, 12.7062, 1e-3);
  EXPECT_NEAR((fit.k[1].value - fit.k[1].low) / fit.k[1].standard_error, 12.7062, 1e-3);
  const CurveFit single = fit_curve(mean_curve(bench_of(f111_record(), 1, random)), 2, {});
  for (double none : {single.k[0].standard_error, single.k[0].low, single.k[0].high, single.band_low[9]})
    EXPECT_TRUE(std::isnan(none));
}

// K_1 and the band are those of a fit two degrees higher, where that lies about the fit.
TEST(CurveFit, TheBandOfADegreeTooLowHoldsTheFitAndTheLaw) {
  std::mt19937 random(6);
  SyntheticRecord bent = f111_record();
  bent.load = [](double e) { return 52e3 * e - 220e3 * e * e + 450e3 * e * e * e; };
  bent.noise = 1e-3;
  const MeanCurve curve = mean_curve(bench_of(bent, 5, random));
  const CurveFit low = fit_curve(curve, 1, {}), enough = fit_curve(curve, 3, {});
  EXPECT_LT(low.k[0].value, 0.8 * 52e3);
  EXPECT_EQ(low.k[0].low, low.k[0].value);
  EXPECT_GT(low.k[0].high, 52e3);
  const std::size_t at = 20;
  EXPECT_EQ(low.band_low[at], low.fit[at]);
  EXPECT_NEAR(low.band_high[at], enough.band_high[at], 0.02 * enough.fit[at]);
  EXPECT_LT(enough.k[0].low, enough.k[0].value);
  EXPECT_LT(enough.k[0].high - enough.k[0].low, 0.5 * (low.k[0].high - low.k[0].low));
}

// (working / strain)^2 beyond the working strain, with which a straight line through a parabola's points keeps near its
// start; by the rule of [NFM] every point counts alike.
TEST(CurveFit, WorkingStrainsCountMost) {
  FitOptions options;
  EXPECT_EQ(strain_weight(0.05, options), 1);
  EXPECT_NEAR(strain_weight(0.1, options), 0.25, 1e-15);
  CleanRecord a;
  for (int i = 0; i <= 300; ++i) {
    a.strain.push_back(1e-3 * i);
    a.load.push_back(polynomial(f111_curve, 1, a.strain.back()));
  }
  a.failure_strain = 0.3;
  const MeanCurve curve = mean_curve({a, a});
  double top = 0, bottom = 0, alike_top = 0, alike_bottom = 0;
  for (std::size_t i = 0; i < curve.strain.size(); ++i) {
    const double e = curve.strain[i], w = strain_weight(e, options);
    top += w * e * curve.load[i], bottom += w * e * e;
    alike_top += e * curve.load[i], alike_bottom += e * e;
  }
  EXPECT_NEAR(fit_curve(curve, 1, options).k[0].value, top / bottom, 1e-6);
  options.rule = DegreeRule::nfm;
  EXPECT_EQ(strain_weight(0.1, options), 1);
  EXPECT_NEAR(fit_curve(curve, 1, options).k[0].value, alike_top / alike_bottom, 1e-6);
  EXPECT_LT(alike_top / alike_bottom, top / bottom - 500);
}

// Two samples that are multiples of one parabola: each predicts the other but for the stiffness, and a straight line
// misses the bend as well.
TEST(CurveFit, ThePredictionErrorIsThatOfTheSampleLeftOut) {
  CleanRecord a;
  for (int i = 0; i <= 300; ++i) {
    a.strain.push_back(1e-3 * i);
    a.load.push_back(polynomial(f111_curve, 1, a.strain.back()));
  }
  a.failure_strain = 0.3;
  CleanRecord b = a;
  for (double& load : b.load) load *= 1.1;
  const MeanCurve curve = mean_curve({a, b});
  EXPECT_NEAR(prediction_error({curve}, 2, {}), std::pow(0.1 / 1.05, 2), 1e-9);
  EXPECT_GT(prediction_error({curve}, 1, {}), 1.05 * std::pow(0.1 / 1.05, 2));
  EXPECT_EQ(choose_degree({curve}, {}), 2);
  EXPECT_TRUE(std::isnan(prediction_error({mean_curve({a})}, 2, {})));
  EXPECT_EQ(choose_degree({mean_curve({a})}, {}), 1);  // by R2
}

// The claim of a 95 % interval is that it holds in 95 of 100 campaigns. 400 campaigns of five samples: the
// count is binomial with a standard deviation of 1.1 %, so 95 +- 3.3 % is three of them.
TEST(CurveFit, IntervalsAndBandsHoldAsOftenAsTheyClaim) {
  constexpr int campaigns = 400;
  SyntheticRecord wanted = f111_record();
  wanted.points = 150;
  std::mt19937 random(2024);
  FitOptions options;
  int k1 = 0, k2 = 0, middle = 0, end = 0;
  for (int i = 0; i < campaigns; ++i) {
    const MeanCurve curve = mean_curve(bench_of(wanted, 5, random));
    const CurveFit fit = fit_curve(curve, 2, options);
    const auto inside = [](double v, double low, double high) { return low <= v && v <= high; };
    k1 += inside(f111_curve[0], fit.k[0].low, fit.k[0].high);
    k2 += inside(f111_curve[1], fit.k[1].low, fit.k[1].high);
    for (auto [count, at] : {std::pair{&middle, 100}, std::pair{&end, 199}})
      *count += inside(wanted.load(curve.strain[at]), fit.band_low[at], fit.band_high[at]);
  }
  for (const auto& [name, count] : {std::pair{"K1", k1}, std::pair{"K2", k2},
                                    std::pair{"band, middle", middle}, std::pair{"band, end", end}}) {
    EXPECT_NEAR(static_cast<double>(count) / campaigns, 0.95, 0.033) << name;
    RecordProperty(name, count);
  }
}

TEST(CurveFit, PointsAsTheIndependentUnitWouldClaimFarTooMuch) {
  // Why the samples are: the naive standard error of K_1, from the residuals of all points, is many times
  // smaller than the true scatter of K_1 between campaigns.
  SyntheticRecord wanted = f111_record();
  std::mt19937 random(7);
  std::vector<double> k1, claimed;
  for (int i = 0; i < 60; ++i) {
    const CurveFit fit = fit_curve(mean_curve(bench_of(wanted, 5, random)), 2, {});
    k1.push_back(fit.k[0].value);
    claimed.push_back(fit.k[0].standard_error);
  }
  EXPECT_NEAR(mean(claimed) / standard_deviation(k1), 1, 0.3);
  EXPECT_GT(standard_deviation(k1), 0.01 * 30006);
}

TEST(CurveFit, TheLowestSufficientDegreeIsChosenForEveryDirection) {
  std::mt19937 random(11);
  SyntheticRecord straight = f111_record();
  straight.load = [](double e) { return 20000 * e; };
  SyntheticRecord bent = straight;
  bent.load = [](double e) { return 2000 * e + 2e6 * e * e * e; };
  const MeanCurve a = mean_curve(bench_of(straight, 3, random));
  const MeanCurve b = mean_curve(bench_of(bent, 3, random));
  EXPECT_EQ(choose_degree({a}, {}), 1);
  EXPECT_GE(choose_degree({a, b}, {}), 2);
  FitOptions strict;
  strict.rule = DegreeRule::nfm;
  EXPECT_EQ(choose_degree({a, b}, strict), 2);
  strict.wanted_r2 = 0.9999999;
  strict.highest_degree = 2;
  EXPECT_THROW(choose_degree({a, b}, strict), Error);
  FitOptions chosen;
  chosen.degree = 4;
  EXPECT_EQ(choose_degree({a}, chosen), 4);
}

TEST(CurveFit, AFitThatTurnsOverInsideTheTestIsFound) {
  std::mt19937 random(13);
  SyntheticRecord flat = f111_record();
  flat.load = [](double e) { return e < 0.1 ? 50000 * e : 5000 + 50 * (e - 0.1); };
  flat.noise = 1e-3;
  const CurveFit fit = fit_curve(mean_curve(bench_of(flat, 3, random)), 2, {});
  EXPECT_LT(fit.rising_until, fit.tested_strain);
  EXPECT_GT(fit.rising_until, 0.1);
}

TEST(CurveFit, AResidualLoadIsReportedAndZeroedOnRequest) {
  std::mt19937 random(17);
  CleanRecord a;
  a.name = "a";
  for (int i = 0; i <= 100; ++i)
    a.strain.push_back(3e-3 * i), a.load.push_back(200 + 20000 * a.strain.back());
  a.failure_strain = 0.3;
  a.failure_load = a.load.back();
  CleanRecord b = a;
  for (double& load : b.load) load *= 1.02;
  const MeanCurve curve = mean_curve({a, b});
  FitOptions free;
  free.zero_offset = false;
  const CurveFit with = fit_curve(curve, 1, free);
  EXPECT_NEAR(with.offset.value, 202, 1e-6);
  EXPECT_NEAR(with.k[0].value, 20200, 1e-4);
  const CurveFit without = fit_curve(curve, 1, {});
  EXPECT_EQ(without.offset.value, 0);
  EXPECT_GT(without.k[0].value, 20200);
}

TEST(CurveFit, ASampleInOtherUnitsIsNotTheSameCloth) {
  std::mt19937 random(19);
  std::vector<CleanRecord> records = bench_of(f111_record(), 3, random);
  for (double& load : records[1].load) load *= 1000;
  EXPECT_THROW(mean_curve(records), Error);
}

}  // namespace
}  // namespace ripstop
