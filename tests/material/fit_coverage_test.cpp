// Bands over many synthetic campaigns whose law is no polynomial: they hold the law as often as they claim, and are no
// wider than they must be. Prints the table of docs/validation/fit.md.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "../f111_curve.h"
#include "ripstop/core/least_squares.h"
#include "ripstop/material/curve_fit.h"
#include "synthetic.h"

namespace ripstop {
namespace {

constexpr int campaigns = 300;
constexpr std::array strains{0.005, 0.01, 0.02, 0.03, 0.05};

const double least_share = 0.95 - 3 * std::sqrt(0.95 * 0.05 / campaigns);

struct CoverageLaw {
  const char* name;
  std::function<double(double)> load;
  double stiffness;  // at no strain
  double failure_strain;
  double slack = 0.002;      // [m]
  double width = 0.05;       // 0: a line
  double odd_slack = 0.002;  // of every third sample
  double noise = 0.003;
  int samples = 5;
  int points = 400;
};

const std::function<double(double)> cubic = [](double e) {
  return 52e3 * e - 220e3 * e * e + 450e3 * e * e * e;
};

/// What holds, with laws far from any polynomial of degree 2: toes, knees, both.
std::vector<CoverageLaw> laws_that_hold() {
  using std::exp;
  return {
      {"F-111, quadratic", [](double e) { return polynomial(f111_curve, 1, e); }, 30006, 0.33},
      {"cubic", cubic, 52e3, 0.3},
      {"cubic, slack 30 % of the pull", cubic, 52e3, 0.3, 0.018, 0.05, 0.018},
      {"cubic, slack in every third sample", cubic, 52e3, 0.3, 0.0, 0.05, 0.018},
      {"J: exp(5 e) - 1", [](double e) { return 2000 * (exp(5 * e) - 1); }, 10e3, 0.3},
      {"J: exp(10 e) - 1", [](double e) { return 500 * (exp(10 * e) - 1); }, 5e3, 0.3},
      {"knee: 1 - exp(-e/0.12)", [](double e) { return 9000 * (1 - exp(-e / 0.12)); }, 75e3, 0.3},
      {"S: knee at 0.04, stiffening",
       [](double e) { return 20e3 * e + 900 * (1 - exp(-e / 0.04)) + 60e3 * e * e * e; }, 42500, 0.25},
      {"S: knee at 0.02, stiffening",
       [](double e) { return 20e3 * e + 600 * (1 - exp(-e / 0.02)) + 80e3 * e * e * e; }, 50e3, 0.3},
      {"line, quadratic", [](double e) { return 211895 * e + 489633 * e * e; }, 211895, 0.06, 0.001, 0,
       0.001},
      {"line: exp(20 e) - 1", [](double e) { return 8000 * (exp(20 * e) - 1); }, 160e3, 0.06, 0.001, 0,
       0.001},
      {"cubic, 2 samples", cubic, 52e3, 0.3, 0.002, 0.05, 0.002, 0.003, 2},
      {"cubic, 10 samples", cubic, 52e3, 0.3, 0.002, 0.05, 0.002, 0.003, 10},
      {"cubic, noise 0.1 %", cubic, 52e3, 0.3, 0.002, 0.05, 0.002, 0.001},
      {"knee, 60 points a record", [](double e) { return 9000 * (1 - exp(-e / 0.12)); }, 75e3, 0.3, 0.002,
       0.05, 0.002, 0.003, 5, 60},
  };
}

/// What does not: a knee or toe much finer than the tested strain, and a law without stiffness at its start, whose toe cannot be
/// told from slack.
std::vector<CoverageLaw> laws_that_do_not_hold() {
  using std::exp;
  return {
      {"S: knee at 0.02, noise 0.1 %",
       [](double e) { return 20e3 * e + 600 * (1 - exp(-e / 0.02)) + 80e3 * e * e * e; }, 50e3, 0.3, 0.002,
       0.05, 0.002, 0.001},
      {"toe: half the stiffness below 0.01",
       [](double e) { return 30e3 * (e - 0.005 * (1 - exp(-e / 0.01))); }, 15e3, 0.3},
      {"toe: no stiffness at 0", [](double e) { return 30e3 * (e - 0.01 * (1 - exp(-e / 0.01))); }, 0, 0.3},
  };
}

struct Found {
  std::array<double, strains.size()> held{}, half_width{};  // share of the campaigns, relative to the load
  double stiffness_held = 0, stiffness = 0, stiffness_half_width = 0;
  double degree = 0;
};

Found run_campaigns(const CoverageLaw& law) {
  SyntheticRecord wanted;
  wanted.load = law.load;
  wanted.failure_strain = law.failure_strain;
  wanted.width = law.width;
  wanted.noise = law.noise;
  wanted.points = law.points;
  if (law.width == 0) wanted.length = 0.5;
  std::mt19937 random(1922);
  Found found;
  for (int i = 0; i < campaigns; ++i) {
    std::vector<CleanRecord> samples;
    for (int k = 0; k < law.samples; ++k) {
      wanted.slack = k % 3 == 0 ? law.odd_slack : law.slack;
      samples.push_back(clean_record(synthetic_record(wanted, random),
                                     law.width > 0 ? LoadKind::per_width : LoadKind::whole));
    }
    const MeanCurve curve = mean_curve(samples);
    const FitOptions options;
    const CurveFit fit = fit_curve(curve, choose_degree({curve}, options), options);
    const auto inside = [](double v, double low, double high) {
      return low <= v && v <= high ? 1.0 / campaigns : 0;
    };
    for (std::size_t k = 0; k < strains.size(); ++k) {
      const auto at = static_cast<std::size_t>(strains[k] / curve.tested_strain *
                                               static_cast<double>(curve.strain.size()));
      const std::size_t j = std::min(at, curve.strain.size() - 1);
      const double truth = law.load(curve.strain[j]);
      found.held[k] += inside(truth, fit.band_low[j], fit.band_high[j]);
      found.half_width[k] += 0.5 * (fit.band_high[j] - fit.band_low[j]) / truth / campaigns;
    }
    found.stiffness_held += inside(law.stiffness, fit.k[0].low, fit.k[0].high);
    found.stiffness += fit.k[0].value / campaigns;
    found.stiffness_half_width += 0.5 * (fit.k[0].high - fit.k[0].low) / campaigns;
    found.degree += static_cast<double>(fit.degree) / campaigns;
  }
  std::string row = fmt::format("| {} | {:.1f} |", law.name, found.degree);
  for (double held : found.held) row += fmt::format(" {:.0f} |", 100 * held);
  row += fmt::format(" {:.0f} | {:.1f}, {:.1f}, {:.1f} | {:.0f} of {:.0f} +- {:.0f} |",
                     100 * found.stiffness_held, 100 * found.half_width[1], 100 * found.half_width[2],
                     100 * found.half_width[4], found.stiffness, law.stiffness, found.stiffness_half_width);
  fmt::print("{}\n", row);
  return found;
}

// Of 300 campaigns the share inside has a standard deviation of 1.26 %; three of them below 95 % is 91.2 %. The yardstick
// of the width is the interval from the samples' readings at that strain alone, start known: stiffness and noise.
TEST(Coverage, BandsHoldTheLawAsOftenAsTheyClaimAndAreNoWiderThanTheReadings) {
  const SyntheticRecord usual;
  for (const CoverageLaw& law : laws_that_hold()) {
    const Found found = run_campaigns(law);
    const double n = law.samples, peak = law.load(law.failure_strain);
    for (std::size_t k = 0; k < strains.size(); ++k) {
      EXPECT_GE(found.held[k], least_share) << law.name << " at " << strains[k];
      const double load = law.load(strains[k]);
      const double reading = std::hypot(usual.scatter * load, law.noise * peak) / load;
      EXPECT_LE(found.half_width[k], 2 * student_t(0.95, law.samples - 1) / std::sqrt(n) * reading)
          << law.name << " at " << strains[k];
    }
    EXPECT_GE(found.stiffness_held, least_share) << law.name;
  }
}

// A toe or knee finer than the polynomial, or no stiffness at the start, is not held: nobody who reads the table takes it for
// more than it is.
TEST(Coverage, FeaturesMuchFinerThanTheTestAreNotHeld) {
  for (const CoverageLaw& law : laws_that_do_not_hold()) {
    const Found found = run_campaigns(law);
    EXPECT_LT(found.held.front(), least_share) << law.name << " holds: move it to the others";
  }
}

}  // namespace
}  // namespace ripstop
