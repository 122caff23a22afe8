// Limits of the measures of quality: values above them have a warning, and the result is not usable beyond
// the second one.
#include "ripstop/run/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "ripstop/case/assemble.h"
#include "ripstop/run/margins.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

TEST(Quality, WithinItsLimitsHasNoWarning) {
  for (const QualityLimit& limit : quality_limits()) {
    const Judgement judgement = judge({{limit.key, limit.warn}});
    EXPECT_TRUE(judgement.usable && judgement.warnings.empty()) << limit.key;
  }
}

TEST(Quality, EveryMeasureWarnsBeyondItsFirstLimitAndIsRefusedBeyondItsSecond) {
  for (const QualityLimit& limit : quality_limits()) {
    const double past = limit.at_least ? 0.99 : 1.01;
    const Judgement warned = judge({{limit.key, past * limit.warn}});
    EXPECT_TRUE(warned.usable) << limit.key;
    ASSERT_EQ(warned.warnings.size(), 1u) << limit.key;
    EXPECT_EQ(warned.warnings[0].find(limit.name), 0u) << warned.warnings[0];
    EXPECT_NE(warned.warnings[0].find(limit.remedy), std::string::npos) << warned.warnings[0];
    EXPECT_FALSE(judge({{limit.key, std::nan("")}}).usable) << limit.key;
    if (!std::isfinite(limit.refuse)) continue;
    const Judgement refused = judge({{limit.key, past * limit.refuse}});
    EXPECT_FALSE(refused.usable) << limit.key;
    EXPECT_NE(refused.warnings[0].find("must not be used"), std::string::npos) << refused.warnings[0];
  }
}

// A value within the limit must not be refused as an input by these words, see used_run.cpp.
TEST(Quality, AWarningNamesBothLimitsAndItsReasonIsTheMeasureWithItsValue) {
  const std::string warned = judge({{"energy_residual", 0.0712}}).warnings.at(0);
  EXPECT_EQ(warned.find("residual of the energy balance: 7.12 % of the work (values above 5 % cause a "
                        "warning, above 20 % the result is not usable); reduce"),
            0u)
      << warned;
  EXPECT_EQ(warned.find(refused_text), std::string::npos) << warned;
  EXPECT_EQ(reason_of_refusal(warned), "");
  const std::string refused = judge({{"energy_residual", 0.20004}}).warnings.at(0);
  EXPECT_EQ(refused.find("residual of the energy balance: 20.004 % of the work, the result must not be used "
                         "(limit 20 %; values above 5 % cause a warning); reduce"),
            0u)
      << refused;
  EXPECT_EQ(reason_of_refusal(refused), "residual of the energy balance: 20.004 % of the work");
  EXPECT_EQ(reason_of_refusal("2 of 5 openings must not be used"), "2 of 5 openings must not be used");
  EXPECT_EQ(reason_of_refusal("the result must not be used"), "the result must not be used");
}

TEST(Quality, AWarningWithoutItsRefusalKeepsLimitAndRemedy) {
  const std::string refused = judge({{"energy_residual", 0.20004}}).warnings.at(0);
  EXPECT_EQ(without_refusal(refused).find("residual of the energy balance: 20.004 % of the work (limit 20 %; "
                                          "values above 5 % cause a warning); reduce"),
            0u)
      << without_refusal(refused);
  for (const char* text : {"the result must not be used", "2 of 5 openings must not be used", "coarse"})
    EXPECT_EQ(without_refusal(text), text);
}

// Balances reported by two users: 46.6 and 32.7 % had no consequence; openings on default cells have 2.7 %.
TEST(Quality, AnOpenEnergyBalanceIsNotUsable) {
  EXPECT_FALSE(judge({{"energy_residual", 0.46633}}).usable);
  EXPECT_FALSE(judge({{"energy_residual", 0.327}}).usable);
  EXPECT_TRUE(judge({{"energy_residual", 0.027}}).warnings.empty());
}

TEST(Quality, APeakDirectlyAfterTheStartUpIsNoOpeningLoad) {
  EXPECT_FALSE(judge({{"peak_after_start_up", 1.017}}).usable);  // 120 kg under 11.4 m at 40 m/s
  EXPECT_TRUE(judge({{"peak_after_start_up", 12}}).warnings.empty());
}

TEST(Quality, AMeasureThatIsNotInTheListIsAnError) {
  EXPECT_THROW(judge({{"no_such_measure", 1}}), std::logic_error);
}

// The hem of a canopy without tape was judged by load and check, but not in runs.
TEST(MarginMembers, OfARunAreThoseOfALoadAndTheCloth) {
  for (const char* tape : {"none", "nylon-tape"}) {
    Case given = flat_circular_case(1, 500, 20);
    given.parachute.tape.material = tape;
    const Settings resolved = resolve(checked(given));
    const CanopyMesh mesh = parachute_mesh(resolved);
    StressPeak stress;
    stress.warp = 100;
    const Margins run = case_margins(resolved, mesh, std::vector<double>(mesh.springs.size(), 8.0), stress);
    std::set<std::string> of_run, of_load = {"cloth"};
    for (const Margin& m : weakest_of_kinds(run))
      of_run.insert(m.member.starts_with("line") ? "line" : m.member);
    for (const Margin& m : load_margins(resolved, 100).members) of_load.insert(m.member);
    EXPECT_EQ(of_run, of_load) << tape;
    const auto hem = std::find_if(run.members.begin(), run.members.end(),
                                  [](const Margin& m) { return m.member == "hem"; });
    ASSERT_EQ(hem != run.members.end(), std::string(tape) == "none");
    if (hem == run.members.end()) continue;
    double line = 0;
    for (const Margin& m : run.members)
      if (m.member.starts_with("line")) line = std::max(line, m.load);
    EXPECT_NEAR(hem->load, line / 0.02, 1e-9 * hem->load);  // a hem of 20 mm
  }
}

// The lines have their highest loads at different times: their sum is no load of the hardware.
TEST(MarginMembers, HardwareOfAnOpeningCarriesTheLargestRiserLoad) {
  Case given = flat_circular_case(1, 500, 20);
  given.hardware["link"].rated_load_n = 1000;
  const Settings resolved = resolve(checked(given));
  const CanopyMesh mesh = parachute_mesh(resolved);
  const std::vector<double> peaks(mesh.springs.size(), 8.0);
  const Margin opening = case_margins(resolved, mesh, peaks, {}, {}, 50.0).members.back(),
               shape = case_margins(resolved, mesh, peaks, {}).members.back();
  EXPECT_EQ(opening.load, 50);
  EXPECT_EQ(opening.load_from, "largest riser load");
  EXPECT_EQ(*opening.used, 0.05);
  EXPECT_GE(shape.load, 8.0 * resolved.parachute().lines.count) << "the sum of the lines";
  EXPECT_FALSE(shape.load_from);
}

TEST(MarginWarnings, NameEveryKindOfMemberBelowZeroOnce) {
  const auto member = [](const char* name, double used) {
    Margin m;
    m.member = name, m.load = 100 * used, m.unit = "N", m.strength = 100, m.used = used,
    m.margin = 1 / used - 1;
    return m;
  };
  Margins margins;
  margins.members = {member("cloth", 0.5), member("line 1", 1.16), member("line 2", 1.1),
                     member("riser", 6.5)};
  const std::vector<std::string> told = margin_warnings(margins);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].find("line 1 exceeds its allowable load"), 0u) << told[0];
  EXPECT_EQ(told[1].find("riser exceeds its allowable load"), 0u) << told[1];
  EXPECT_NE(told[1].find("6.5 times the allowable 100 N (margin of safety -0.85)"), std::string::npos)
      << told[1];
  EXPECT_TRUE(margin_warnings(std::nullopt).empty());
  margins.members = {member("riser", 1.0003)};
  EXPECT_NE(
      margin_warnings(margins)[0].find("is 1.0003 times the allowable 100 N (margin of safety -0.0003)"),
      std::string::npos)
      << margin_warnings(margins)[0];
}

}  // namespace
}  // namespace ripstop
