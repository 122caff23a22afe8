#include "ripstop/calibration/coupon_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <set>

#include "../f111_curve.h"
#include "../material/synthetic.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/least_squares.h"

namespace ripstop {
namespace {

constexpr double true_shear = 0.2, true_bending = 0.01;

/// The 45 deg curve of the true cloth, from a coupon finer than any that is fitted.
std::function<double(double)> true_bias() {
  Fabric fabric;
  fabric.name = "true";
  fabric.coefficients_n_m = f111_curve;
  fabric.shear_fraction = true_shear;
  fabric.bending_fraction = true_bending;
  fabric.areal_density_kg_m2 = 0.0407;
  fabric.thickness_m = 7.6e-5;
  fabric.tested_strain = 0.33;
  std::vector<double> x, y;
  for (int i = 1; i <= 20; ++i) x.push_back(0.02 * i);
  ThreadTeam team(1);
  for (const CouponPoint& p :
       pull_coupon(coupon_mesh(fabric, {0.2, 0.05, 45, 16, 1}), x, {1e-5, false}, team).points)
    y.push_back(p.load);
  const std::vector<double> c = fit_polynomial(x, y, 1, 5);
  return [c](double e) { return polynomial(c, 1, e); };
}

struct Campaign {
  TemporaryFolder folder{"campaign"};
  Bench bench;

  /// Noise and scatter of a real bench by default.
  Campaign(unsigned seed, const std::function<double(double)>& bias, int samples = 4, double scatter = 0.03,
           double noise = 0.003) {
    std::mt19937 random(seed);
    bench.file = folder.path / "bench.toml";
    write_file(bench.file, "# written by a test\n");
    bench.name = "cloth";
    bench.areal_density_kg_m2 = 0.0407;
    bench.thickness_m = 7.6e-5;
    bench.degree = 2;
    bench.zero_offset = true;
    for (int orientation : {0, 45})
      for (int i = 0; i < samples; ++i) {
        SyntheticRecord record;
        record.orientation = orientation;
        record.load = orientation == 45 ? bias : [](double e) { return polynomial(f111_curve, 1, e); };
        record.scatter = scatter;
        record.noise = noise;
        record.failure_strain = 0.3;
        if (scatter == 0) record.failure_scatter = 0;
        const std::string name = fmt::format("{}-{}.csv", orientation, i);
        write_file(folder.path / name, synthetic_csv(record, random));
        BenchCoupon coupon;
        coupon.file = name;
        bench.coupons.push_back(coupon);
      }
  }
};

double r2_of(const CouponFit& fit, const std::string& name) {
  for (const CouponComparison& c : fit.coupons)
    if (c.name == name) return c.r2;
  return -1;
}

struct CouponFitting : ::testing::Test {
  static void SetUpTestSuite() { bias = new std::function<double(double)>(true_bias()); }
  static void TearDownTestSuite() { delete bias; }
  static std::function<double(double)>* bias;
  ThreadTeam team{1};
};
std::function<double(double)>* CouponFitting::bias = nullptr;

TEST_F(CouponFitting, CleanRecordsGiveXiBack) {
  const Campaign campaign(1, *bias, 2, 0, 1e-4);
  const CouponFit fit = fit_coupons(fit_material(campaign.bench), campaign.bench, {}, team);
  // The search's coupon has 6 cells across, the true one 12: 0.3 % in the load.
  EXPECT_NEAR(fit.fabric.shear_fraction, true_shear, 0.003);
  EXPECT_NEAR(fit.fabric.coefficients_n_m[0], f111_curve[0], 0.01 * f111_curve[0]);
  EXPECT_GT(r2_of(fit, "warp"), 0.9999);
  EXPECT_GT(r2_of(fit, "bias"), 0.9999);
  EXPECT_LT(fit.seconds, 120);
  // Two samples are the fewest that leave an interval.
  EXPECT_LT(fit.shear_low, fit.fabric.shear_fraction);
  EXPECT_GT(fit.shear_high, fit.fabric.shear_fraction);
}

TEST_F(CouponFitting, ASearchThatEndsBeforeItConvergesHasAWarning) {
  const Campaign campaign(1, *bias, 2, 0, 0);
  CouponFitOptions quick;
  quick.final_cells = 6;
  const auto unfinished = [&] {
    const CouponFit fit = fit_coupons(fit_material(campaign.bench), campaign.bench, quick, team);
    return std::any_of(fit.warnings.begin(), fit.warnings.end(), [](const std::string& text) {
      return text.find("was not converged after") != std::string::npos;
    });
  };
  EXPECT_FALSE(unfinished());
  quick.most_evaluations = 3;
  EXPECT_TRUE(unfinished());
}

// Yarns that pull two percent more move xi as far as a bias curve of two percent less.
TEST_F(CouponFitting, XisIntervalIsAsWideForSamplesOfTheYarnsThatScatterAsForThoseOfTheBias) {
  CouponFitOptions quick;
  quick.final_cells = 6;
  double width[2];
  for (const int which : {0, 1}) {
    const Campaign campaign(1, *bias, 2, 0, 0);
    std::mt19937 random(2);
    SyntheticRecord stiffer;
    stiffer.orientation = which == 0 ? 0 : 45;
    const std::function<double(double)> usual =
        which == 0 ? [](double e) { return polynomial(f111_curve, 1, e); } : *bias;
    stiffer.load = [&](double e) { return 1.02 * usual(e); };
    stiffer.scatter = stiffer.failure_scatter = stiffer.noise = 0;
    stiffer.failure_strain = 0.3;
    write_file(campaign.folder.path / fmt::format("{}-1.csv", stiffer.orientation),
               synthetic_csv(stiffer, random));
    const CouponFit fit = fit_coupons(fit_material(campaign.bench), campaign.bench, quick, team);
    width[which] = fit.shear_high - fit.shear_low;
  }
  EXPECT_GT(width[0], 0);
  EXPECT_NEAR(width[1] / width[0], 1, 0.1);
}

TEST_F(CouponFitting, WithoutA45DegTestNothingIsFittedWhichIsReported) {
  Campaign campaign(1, *bias, 2);
  campaign.bench.coupons.resize(2);
  CouponFitOptions quick;
  quick.final_cells = 6;
  quick.start_bending = 0.03;
  const CouponFit fit = fit_coupons(fit_material(campaign.bench), campaign.bench, quick, team);
  EXPECT_FALSE(fit.searched);
  ASSERT_EQ(fit.notes.size(), 1u);
  EXPECT_NE(fit.notes[0].find("no 45 deg test"), std::string::npos);
  EXPECT_NE(fit.notes[0].find("eps = 0.03 are not measured"), std::string::npos) << fit.notes[0];
  EXPECT_TRUE(std::isnan(fit.shear_low) && std::isnan(fit.shear_high));
}

// A record of another cloth in place of the one that the material was fitted to.
TEST_F(CouponFitting, ALatticeThatDoesNotFollowItsRecordIsNamed) {
  Campaign campaign(1, *bias, 2, 0, 0);
  campaign.bench.coupons.resize(2);
  CouponFitOptions quick;
  quick.final_cells = 6;
  MaterialFit fit = fit_material(campaign.bench);
  EXPECT_TRUE(fit_coupons(fit, campaign.bench, quick, team).warnings.empty());
  for (DirectionFit& direction : fit.directions)
    for (std::size_t i = 0; i < direction.curve.load.size(); ++i)
      direction.curve.load[i] = 1e4 * std::sqrt(direction.curve.strain[i]);
  const CouponFit other = fit_coupons(fit, campaign.bench, quick, team);
  ASSERT_EQ(other.warnings.size(), 1u);
  EXPECT_EQ(other.warnings[0].find("the simulated warp coupon follows its record with R2 = "), 0u)
      << other.warnings[0];
  EXPECT_LT(r2_of(other, "warp"), 0.95);
}

// [NFM] reaches R2 = 0.979 at 0 deg and 0.994 at 45 deg: the yardstick for records with a bench's noise.
TEST_F(CouponFitting, NoisyRecordsAreMetBetterThanThePapersYardstick) {
  for (unsigned seed : {11u, 12u}) {
    const Campaign campaign(seed, *bias, 4, 0.05, 0.01);
    const CouponFit fit = fit_coupons(fit_material(campaign.bench), campaign.bench, {}, team);
    EXPECT_GT(r2_of(fit, "warp"), 0.979) << seed;
    EXPECT_GT(r2_of(fit, "bias"), 0.994) << seed;
    EXPECT_LT(fit.shear_low, fit.shear_high) << seed;
    EXPECT_NEAR(fit.fabric.shear_fraction, true_shear, 0.04) << seed;
  }
}

TEST_F(CouponFitting, TheOptimumDoesNotDependOnTheStart) {
  const Campaign campaign(21, *bias);
  const MaterialFit material = fit_material(campaign.bench);
  for (const double threshold : {0.02, 0.0}) {  // xi alone; xi and eps
    std::vector<CouponFit> found;
    for (double shear : {0.05, 0.2, 0.45}) {
      CouponFitOptions options;
      options.start_shear = shear;
      options.bending_threshold = threshold;
      options.final_cells = 6;
      options.final_points = 4;
      std::set<double> bending;
      found.push_back(fit_coupons(material, campaign.bench, options, team,
                                  [&](int, double, double eps, double) { bending.insert(eps); }));
      EXPECT_EQ(bending.size() > 1, threshold == 0) << shear;
    }
    for (const CouponFit& fit : found) {
      EXPECT_NEAR(fit.fabric.shear_fraction, found[0].fabric.shear_fraction, 0.001) << threshold;
      EXPECT_NEAR(fit.fabric.bending_fraction, found[0].fabric.bending_fraction, 0.005) << threshold;
    }
  }
}

TEST_F(CouponFitting, TestsInThePlaneDoNotDetermineEpsWhichIsReported) {
  const Campaign campaign(31, *bias);
  CouponFitOptions quick;
  quick.final_cells = 6;
  quick.start_bending = 0.02;
  const CouponFit fit = fit_coupons(fit_material(campaign.bench), campaign.bench, quick, team);
  EXPECT_LT(fit.bending_effect, 0.02);
  EXPECT_EQ(fit.fabric.bending_fraction, quick.start_bending);
  EXPECT_NE(fit.notes.front().find("do not determine"), std::string::npos);
}

TEST_F(CouponFitting, RescalingTakesTheClampsBack) {
  const Campaign campaign(41, *bias, 2, 0, 1e-4);
  const CouponFit fit = fit_coupons(fit_material(campaign.bench), campaign.bench, {}, team);
  EXPECT_LT(fit.rescale, 1.0005);
  EXPECT_GT(fit.rescale, 0.99);
  const CouponComparison& warp = fit.coupons.front();
  for (std::size_t i = 0; i < warp.strain.size(); ++i)
    EXPECT_NEAR(warp.simulated[i] / polynomial(f111_curve, 1, warp.strain[i]), 1, 0.005);
}

TEST_F(CouponFitting, TheMaterialFileReadsBackToTheSameMaterial) {
  const Campaign campaign(51, *bias);
  const MaterialFit fit = fit_material(campaign.bench);
  const std::filesystem::path file = campaign.folder.path / "cloth.toml";
  write_file(file, material_to_toml(fit.material));
  const Fabric &before = std::get<Fabric>(fit.material), after = std::get<Fabric>(read_material(file));
  EXPECT_EQ(after.coefficients_n_m, before.coefficients_n_m);
  EXPECT_EQ(after.tested_strain, before.tested_strain);
  EXPECT_EQ(after.break_load_n_m, before.break_load_n_m);
  EXPECT_EQ(after.name, "cloth");
  // Beyond the tests the material has a warning, within them it has none.
  EXPECT_TRUE(material_warnings(after, 0.9 * after.tested_strain).empty());
  ASSERT_EQ(material_warnings(after, 1.1 * after.tested_strain).size(), 1u);
  EXPECT_NE(material_warnings(after, 1.1 * after.tested_strain)[0].find("exceeds the tested strain"),
            std::string::npos);
}

TEST_F(CouponFitting, OneSampleAndUnitsWrongBy1000AreRefused) {
  const auto refused = [](const Bench& bench, const std::string& reason) {
    try {
      fit_material(bench);
      ADD_FAILURE() << "not refused: " << reason;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  };
  Campaign one(61, *bias, 1);
  refused(one.bench, "one sample only");
  one.bench.single_samples = true;
  EXPECT_NO_THROW(fit_material(one.bench));
  for (const double wrong : {1000.0, 0.001}) {
    Campaign mass(62, *bias), thickness(62, *bias), force(62, *bias);
    mass.bench.areal_density_kg_m2 = 0.0407 * wrong;
    refused(mass.bench, "factor of 1000");
    thickness.bench.thickness_m = 7.6e-5 * wrong;
    refused(thickness.bench, "factor of 1000");
    for (BenchCoupon& c : force.bench.coupons) {
      const std::filesystem::path file = force.folder.path / c.file;
      std::string text = read_file(file);
      text.replace(text.find("force [N]"), 9, wrong > 1 ? "force [kN]" : "force [mN]");
      write_file(file, text);
    }
    refused(force.bench, "factor of 1000");
  }
}

TEST(RealRecords, NylonRibbonsAreMetBetterThanThePapersYardstick) {
  const Bench bench =
      read_bench(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "validation/nylon-ribbons/bench.toml");
  ThreadTeam team(1);
  const MaterialFit material = fit_material(bench);
  EXPECT_TRUE(material.weft_differs);
  EXPECT_EQ(std::count(material.notes.begin(), material.notes.end(), "warp and weft differ: separate curves"),
            1);
  const CouponFit fit = fit_coupons(material, bench, {}, team);
  EXPECT_GT(r2_of(fit, "warp"), 0.979);
  EXPECT_GT(r2_of(fit, "weft"), 0.979);
  EXPECT_GT(r2_of(fit, "bias"), 0.994);
  // The clamps' factor is one for all yarns.
  const auto& tested = std::get<Fabric>(material.material);
  ASSERT_FALSE(tested.weft_coefficients_n_m.empty());
  for (std::size_t k = 0; k < tested.weft_coefficients_n_m.size(); ++k)
    EXPECT_DOUBLE_EQ(fit.fabric.weft_coefficients_n_m[k], fit.rescale * tested.weft_coefficients_n_m[k]);
  EXPECT_NE(fit.rescale, 1);
}

TEST(Examples, TheSyntheticCampaignGivesItsTruthBackWithinItsIntervals) {
  const Bench bench =
      read_bench(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/fit-ripstop/bench.toml");
  ThreadTeam team(1);
  const MaterialFit material = fit_material(bench);
  const CurveFit& warp = material.direction("warp")->fit;
  for (std::size_t k : {0u, 1u}) {
    EXPECT_LT(warp.k[k].low, f111_curve[k]);
    EXPECT_GT(warp.k[k].high, f111_curve[k]);
  }
  const CouponFit fit = fit_coupons(material, bench, {}, team);
  EXPECT_LT(fit.shear_low, true_shear);
  EXPECT_GT(fit.shear_high, true_shear);
  // Samples whose stiffness scatters by some percent leave xi open by about as much, not by all of its range.
  EXPECT_NEAR(0.5 * (fit.shear_low + fit.shear_high), fit.fabric.shear_fraction, 1e-12);
  EXPECT_LT(fit.shear_high - fit.shear_low, 0.5 * true_shear);
}

}  // namespace
}  // namespace ripstop
