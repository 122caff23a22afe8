// Grips that slip and samples that are copies: noticed where they are, and not where they are not.
#include <gtest/gtest.h>

#include <random>

#include "../f111_curve.h"
#include "ripstop/core/least_squares.h"
#include "ripstop/material/clean.h"
#include "ripstop/material/copies.h"
#include "synthetic.h"

namespace ripstop {
namespace {

struct PulledLaw {
  const char* name;
  std::function<double(double)> load;
};

std::vector<PulledLaw> pulled_laws() {
  using std::exp;
  return {{"F-111", [](double e) { return polynomial(f111_curve, 1, e); }},
          {"cubic", [](double e) { return 52e3 * e - 220e3 * e * e + 450e3 * e * e * e; }},
          {"J", [](double e) { return 500 * (exp(10 * e) - 1); }},
          {"knee", [](double e) { return 9000 * (1 - exp(-e / 0.12)); }},
          {"S", [](double e) { return 20e3 * e + 900 * (1 - exp(-e / 0.04)) + 60e3 * e * e * e; }}};
}

TensileRecord pulled(const PulledLaw& law, std::mt19937& random, int points = 400, double noise = 0.003) {
  SyntheticRecord wanted;
  wanted.load = law.load;
  wanted.failure_strain = 0.3;
  wanted.points = points;
  wanted.noise = noise;
  return synthetic_record(wanted, random);
}

CleanRecord cleaned(const TensileRecord& record) {
  return clean_record(record, LoadKind::per_width);
}

double highest(const TensileRecord& record) {
  return *std::max_element(record.force.begin(), record.force.end());
}

/// From the middle of the pull on.
std::size_t middle_of(const TensileRecord& record) {
  const auto peak = std::max_element(record.force.begin(), record.force.end()) - record.force.begin();
  return static_cast<std::size_t>(peak) / 2;
}

TEST(Slip, AFallAPlateauAndASawToothAreNoticedWhereTheyAre) {
  std::mt19937 random(41);
  int fallen = 0, stood = 0, sawn = 0, all = 0;
  for (const PulledLaw& law : pulled_laws()) {
    for (int i = 0; i < 20; ++i, ++all) {
      const TensileRecord whole = pulled(law, random);
      const std::size_t middle = middle_of(whole);
      const double tenth = 0.1 * highest(whole);
      TensileRecord fall = whole, saw = whole, still = whole;
      for (std::size_t k = middle; k < whole.force.size(); ++k) {
        fall.force[k] -= tenth;
        saw.force[k] -= tenth * (1 - static_cast<double>((k - middle) % 30) / 30);
      }
      // The coupon rests while the grip travels on.
      const double way = 0.1 * (whole.displacement.back() - whole.displacement.front());
      for (std::size_t k = middle; k < whole.force.size(); ++k) still.displacement[k] += way;
      for (int k = 0; k < 30; ++k) {
        const double x = whole.displacement[middle] + way * k / 30;
        const auto at = static_cast<std::ptrdiff_t>(middle) + k;
        still.displacement.insert(still.displacement.begin() + at, x);
        still.force.insert(still.force.begin() + at, whole.force[middle - 1]);
        still.line.insert(still.line.begin() + at, whole.line[middle] + k);
      }
      const CleanRecord found = cleaned(fall);
      fallen += !found.slip.empty();
      if (!found.slip.empty()) {
        EXPECT_NE(found.slip.find("the force falls from"), std::string::npos) << found.slip;
        const auto from = found.slip.find("(line ") + 6;
        EXPECT_NEAR(std::stoi(found.slip.substr(from)), whole.line[middle], 30) << found.slip;
      }
      const CleanRecord rests = cleaned(still), teeth = cleaned(saw);
      stood += !rests.slip.empty();
      sawn += teeth.slip.find("falls") != std::string::npos;
    }
  }
  EXPECT_GE(fallen, 0.95 * all);
  EXPECT_GE(stood, 0.95 * all);
  EXPECT_GE(sawn, 0.95 * all);
}

// 1500 whole records: none is called a slip.
TEST(Slip, WholeRecordsAreNotDoubted) {
  std::mt19937 random(43);
  for (const PulledLaw& law : pulled_laws())
    for (int points : {100, 400, 1500})
      for (int i = 0; i < 100; ++i) {
        const CleanRecord record = cleaned(pulled(law, random, points));
        EXPECT_EQ(record.slip, "") << law.name << ", " << points << " points";
      }
}

/// Every row of which `stays` is true.
TensileRecord thinned(const TensileRecord& whole, const std::function<bool(std::size_t)>& stays) {
  TensileRecord thin = whole;
  thin.displacement.clear(), thin.force.clear(), thin.line.clear();
  for (std::size_t i = 0; i < whole.force.size(); ++i) {
    if (!stays(i)) continue;
    thin.displacement.push_back(whole.displacement[i]);
    thin.force.push_back(whole.force[i]);
    thin.line.push_back(whole.line[i]);
  }
  return thin;
}

TensileRecord resampled_record(const TensileRecord& whole, std::size_t rows) {
  TensileRecord other = whole;
  other.displacement.clear(), other.force.clear(), other.line.clear();
  const std::vector<double>& x = whole.displacement;
  std::size_t k = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double at =
        x.front() + (x.back() - x.front()) * static_cast<double>(i) / static_cast<double>(rows - 1);
    while (k + 2 < x.size() && x[k + 1] < at) ++k;
    const double part = (at - x[k]) / (x[k + 1] - x[k]);
    other.displacement.push_back(at);
    other.force.push_back(whole.force[k] + part * (whole.force[k + 1] - whole.force[k]));
    other.line.push_back(static_cast<int>(i) + 6);
  }
  return other;
}

TEST(Copies, AreKnownHoweverTheyAreChanged) {
  std::mt19937 random(47);
  std::normal_distribution<double> normal;
  for (const PulledLaw& law : pulled_laws()) {
    const TensileRecord whole = pulled(law, random);
    const double peak = highest(whole);
    std::vector<std::pair<const char*, TensileRecord>> copies{
        {"scaled", whole},
        {"stretched", whole},
        {"shifted", whole},
        {"pounds and inches", whole},
        {"rounded", whole},
        {"noise added", whole},
        {"shifted and half", thinned(whole, [](std::size_t i) { return i % 2 == 1; })},
        {"without its start", thinned(whole, [](std::size_t i) { return i > 4; })},
        {"a tenth of the rows gone", thinned(whole, [](std::size_t i) { return i % 10 != 3; })},
        {"cut at both ends",
         thinned(whole, [&](std::size_t i) { return i > 8 && i < middle_of(whole) * 8 / 5; })},
        {"resampled", resampled_record(whole, 300)}};
    for (auto& [change, copy] : copies) {
      for (std::size_t i = 0; i < copy.force.size(); ++i) {
        double &f = copy.force[i], &x = copy.displacement[i];
        const std::string what = change;
        if (what == "scaled") f *= 1.07;
        if (what == "stretched") x *= 1.05;
        if (what.starts_with("shifted")) x += 1.3e-3, f += 0.01 * peak;
        if (what == "pounds and inches")
          f = std::round(f / 4.448 * 100) / 100 * 4.448, x = std::round(x / 0.0254 * 1e4) / 1e4 * 0.0254;
        if (what == "rounded") f = std::round(2000 * f / peak) / 2000 * peak;
        if (what == "noise added") f += 2e-4 * peak * normal(random);
      }
      const double own = own_noise(cleaned(whole), cleaned(copy));
      const bool changed_noise = std::string(change) == "rounded" || std::string(change) == "noise added";
      EXPECT_LT(own, changed_noise ? 0.3 : surely_copied) << law.name << ", " << change;
    }
  }
}

// 900 pairs of samples of one law, with noise down to that of a very good machine.
TEST(Copies, IndependentSamplesAreNotTakenForCopies) {
  std::mt19937 random(53);
  for (const PulledLaw& law : pulled_laws())
    for (const auto& [points, noise] :
         {std::pair{100, 0.003}, std::pair{400, 0.003}, std::pair{400, 1e-4}, std::pair{1500, 1e-4}}) {
      std::vector<CleanRecord> records;
      for (int i = 0; i < 10; ++i) records.push_back(cleaned(pulled(law, random, points, noise)));
      EXPECT_TRUE(find_copies(records).empty()) << law.name << ", " << points << " points, noise " << noise;
    }
}

TensileRecord rounded(TensileRecord record, double step) {
  for (double& force : record.force) force = std::round(force / step) * step;
  return record;
}

// Loads rounded to 5 N, of which there are 80 to 800 up to the break: 24 campaigns of five pulls each.
TEST(Copies, PullsWhoseLoadsAreRoundedCoarselyAreNoCopies) {
  std::mt19937 random(59);
  const std::vector<PulledLaw> laws = pulled_laws();
  for (int campaign = 0; campaign < 24; ++campaign) {
    const PulledLaw& law = laws[static_cast<std::size_t>(campaign) % laws.size()];
    const int points = campaign % 3 == 0 ? 150 : campaign % 3 == 1 ? 400 : 1000;
    const double noise = campaign % 2 == 0 ? 1e-3 : 3e-3;
    std::vector<CleanRecord> records;
    for (int i = 0; i < 5; ++i) records.push_back(cleaned(rounded(pulled(law, random, points, noise), 5)));
    EXPECT_TRUE(find_copies(records).empty()) << law.name << ", campaign " << campaign;
  }
}

TEST(Copies, OfCoarselyRoundedRecordsAreKnown) {
  std::mt19937 random(61);
  for (const PulledLaw& law : pulled_laws()) {
    const TensileRecord whole = rounded(pulled(law, random), 5);
    TensileRecord scaled = whole, stretched = whole, shifted = whole, pounds = whole;
    for (std::size_t i = 0; i < whole.force.size(); ++i) {
      scaled.force[i] *= 1.07;
      stretched.displacement[i] *= 1.05;
      shifted.displacement[i] += 1.3e-3;
      pounds.force[i] = std::round(whole.force[i] / 4.448 * 100) / 100 * 4.448;
    }
    const TensileRecord half = thinned(whole, [](std::size_t i) { return i % 2 == 1; });
    for (const TensileRecord& copy : {scaled, stretched, shifted, pounds, half})
      EXPECT_LT(own_noise(cleaned(whole), cleaned(copy)), surely_copied) << law.name;
  }
}

}  // namespace
}  // namespace ripstop
