#include "ripstop/flow/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

using std::numbers::pi;

/// value(t) in the middle of steps whose lengths alternate.
template <class Value>
Record record_of(double length, int steps, const Value& value, double begin = 0) {
  Record record;
  record.begin = begin;
  double time = begin;
  for (int n = 0; n < steps; ++n) {
    const double step = (n % 2 == 0 ? 0.8 : 1.2) * length / steps;
    record.values.push_back(value(time + 0.5 * step));
    record.until.push_back(time += step);
  }
  return record;
}

TEST(Statistics, MeansOverPartsAreExactForStepsThatLieInSeveral) {
  const Record record{{1, 3, 4}, {2, 5, -1}, 0};
  const std::vector<double> halves = means_over_parts(record, 0, 2);
  EXPECT_NEAR(halves[0], (2 + 5) / 2.0, 1e-12);
  EXPECT_NEAR(halves[1], (5 - 1) / 2.0, 1e-12);
  for (const int parts : {1, 3, 7, 500}) {  // whatever the parts, they hold the whole
    double sum = 0;
    for (const double mean : means_over_parts(record, 0, parts)) sum += mean / parts;
    EXPECT_NEAR(sum, (2 + 10 - 1) / 4.0, 1e-12) << parts;
  }
  EXPECT_NEAR(means_over_parts(record, 2, 1)[0], (5 - 1) / 2.0, 1e-12);
  EXPECT_THROW(means_over_parts(record, 4, 2), Error);
  EXPECT_THROW(means_over_parts(record, 0, 0), Error);
}

TEST(Statistics, AStartUpIsFoundAndARecordWithoutOneIsKept) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.05);
  const Record settling = record_of(
      100, 2000, [&](double t) { return 1 + 3 * std::exp(-t / 5) + noise(random); }, 7);
  EXPECT_GT(end_of_start_up(settling), 7 + 15);
  EXPECT_LT(end_of_start_up(settling), 7 + 35);
  const Record settled = record_of(100, 2000, [&](double) { return 1 + noise(random); });
  EXPECT_LT(end_of_start_up(settled), 20);
}

/// x' = -x / memory + noise: standard deviation 1, and a mean over a time T that is off by sqrt(2 memory / T).
Record remembering(double memory, double length, int steps, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 1);
  double x = noise(random);
  const double keep = std::exp(-length / steps / memory);
  Record record;
  for (int n = 0; n < steps; ++n) {
    record.until.push_back(length * (n + 1) / steps);
    record.values.push_back(x = keep * x + std::sqrt(1 - keep * keep) * noise(random));
  }
  return record;
}

// Independent samples would have an error of 1 / sqrt(steps), four to twenty-two times less.
TEST(Statistics, TheStandardErrorAccountsForCorrelation) {
  for (const double memory : {0.1, 1.0, 3.0}) {
    double squares = 0, estimates = 0;
    int covered = 0;
    constexpr int records = 200;
    for (unsigned seed = 0; seed < records; ++seed) {
      const MeanOverTime e = mean_over_time(remembering(memory, 200, 4000, seed), 0);
      squares += e.mean * e.mean / records;
      estimates += e.standard_error / records;
      covered += std::abs(e.mean) < 2 * e.standard_error ? 1 : 0;
      EXPECT_NEAR(e.deviation, 1, 0.6);
    }
    const double real = std::sqrt(squares);
    EXPECT_NEAR(real, std::sqrt(2 * memory / 200), 0.15 * real) << memory;
    EXPECT_GT(estimates, 0.9 * real) << memory;  // rather too much than too little
    EXPECT_LT(estimates, 1.6 * real) << memory;
    EXPECT_GE(covered, 0.9 * records) << memory;  // of six parts, as of Student's t with five degrees
  }
}

TEST(Statistics, ARecordWithoutVariationHasNoFiniteError) {
  EXPECT_EQ(mean_over_time(record_of(100, 5000, [](double) { return 0.0; }), 0).standard_error,
            std::numeric_limits<double>::infinity());
}

TEST(Statistics, AnOscillationHasItsFrequencyAndNoiseHasNone) {
  const auto wave = [](double t) { return 3 + std::sin(2 * pi * 0.31 * t); };
  const Peak peak = strongest_frequency({record_of(100, 5000, wave)}, 0);
  EXPECT_NEAR(peak.frequency, 0.31, 0.01);
  EXPECT_GT(peak.share, 0.95);
  const auto between = [](double t) { return 3 + std::sin(2 * pi * 0.305 * t); };  // 30 and a half in all
  EXPECT_GT(strongest_frequency({record_of(100, 5000, between)}, 0).share, 0.95) << "it leaks to no others";
  EXPECT_EQ(strongest_frequency({record_of(6, 500, wave)}, 0).frequency, 0) << "shorter than four periods";
  EXPECT_LT(strongest_frequency({remembering(0.05, 100, 5000, 3)}, 0).share, 0.3);
}

}  // namespace
}  // namespace ripstop
