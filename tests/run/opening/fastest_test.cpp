// The fastest safe deployment is the speed at which the weakest member is at its limit.
#include "ripstop/run/opening/fastest.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ripstop/core/error.h"
#include "ripstop/run/margins.h"
#include "ripstop/run/opening/snatch.h"
#include "tests/refusal.h"

namespace ripstop {
namespace {

Settings circular_with(std::vector<Setting> more = {}) {
  Overrides overrides;
  overrides.set = std::move(more);
  return resolve(
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml", overrides));
}

LoadRequest level_request() {
  LoadRequest r;
  r.payload_mass = 5, r.height = 500, r.path_angle = 0, r.filling_constant = 8;
  return r;
}

const SafeSpeed& by(const FastestResult& r, std::string_view method) {
  for (const SafeSpeed& s : r.methods)
    if (s.method == method) return s;
  throw std::runtime_error("no method " + std::string(method));
}

TEST(Fastest, HasTheSpeedAtWhichTheWeakestMemberIsAtItsLimitByEveryMethod) {
  const Settings resolved = circular_with({{"hardware.swivel.rated_load_n", "600"}});
  const FastestResult r = run_fastest(resolved, level_request());
  for (const SafeSpeed& safe : r.methods) {
    ASSERT_TRUE(safe.speed) << safe.method;
    LoadRequest there = level_request();
    there.speed = *safe.speed;
    const LoadResult loaded = run_load(resolved, there);
    for (const MethodLoad& m : loaded.stages[0].methods) {
      if (m.method == safe.method) {
        EXPECT_NEAR(m.load / safe.load, 1, 1e-9) << m.method;
        EXPECT_NEAR(*weakest(load_margins(resolved, m.load))->used, 1, 3e-3) << m.method;
      }
    }
    EXPECT_LT(*safe.lowest, *safe.speed);
    EXPECT_GT(*safe.highest, *safe.speed);
  }
  EXPECT_EQ(by(r, infinite_mass_method).member, "swivel");
  EXPECT_EQ(r.design_method, infinite_mass_method);
}

TEST(Fastest, WithoutATapeAHemOfTheClothCarriesTheLoadOfALine) {
  const Settings resolved = circular_with({{"parachute.tape.material", "none"}});
  const Margins margins = load_margins(resolved, 1200);
  const auto hem = std::find_if(margins.members.begin(), margins.members.end(),
                                [](const Margin& m) { return m.member == "hem"; });
  ASSERT_NE(hem, margins.members.end());
  EXPECT_NEAR(hem->load, experience(resolved.parachute()).line_load_factor * 100 / 0.02, 1e-6);
  EXPECT_NEAR(*hem->used, 1.5 * hem->load / (*hem->strength * 0.8 * 0.95 * 0.95 * 0.95), 1e-9);
  EXPECT_EQ(margins.weakest, "hem");
  EXPECT_EQ(run_fastest(resolved, level_request()).design().member, "hem");
}

// F = C_x C_D S0 rho v^2 / 2 = F_allowed, and 1 + u times that at the lower end.
TEST(Fastest, OfInfiniteMassIsTheRootOfTheAllowableLoad) {
  const Settings resolved = circular_with({{"hardware.link.rated_load_n", "400"}});
  const FastestResult r = run_fastest(resolved, level_request());
  LoadRequest there = level_request();
  there.speed = 10;
  const double at_ten = run_load(resolved, there).design_load;
  const SafeSpeed& safe = r.design();
  EXPECT_NEAR(*safe.speed / (10 * std::sqrt(400 / at_ten)), 1, 2e-3);
  EXPECT_NEAR(*safe.lowest / (10 * std::sqrt(400 / (at_ten * (1 + r.load_uncertainty)))), 1, 2e-3);
  EXPECT_NEAR(r.load_uncertainty, std::hypot(0.1, 0.15), 1e-12);
}

TEST(Fastest, IsSlowerWithAMarginToKeepAndAbsentWhereNothingIsAtItsLimit) {
  const Settings resolved = circular_with({{"hardware.link.rated_load_n", "400"}});
  const double without = *run_fastest(resolved, level_request()).design().speed;
  EXPECT_NEAR(*run_fastest(resolved, level_request(), 1).design().speed * std::sqrt(2.0) / without, 1, 2e-3);
  const FastestResult weak =
      run_fastest(circular_with({{"hardware.link.rated_load_n", "0.01"}}), level_request());
  EXPECT_TRUE(weak.design().unsafe_at);
  EXPECT_FALSE(weak.design().speed);
  ASSERT_EQ(weak.warnings.size(), 2u);
  EXPECT_TRUE(weak.warnings[0].starts_with("the payload is heavy for this canopy")) << weak.warnings[0];
  EXPECT_TRUE(weak.warnings[1].starts_with("no deployment is safe by the method infinite mass"))
      << weak.warnings[1];
  LoadRequest measured = level_request();
  measured.measured_load = 100;
  EXPECT_NE(refusal_of([&] { run_fastest(resolved, measured); }, ExitCode::usage).find("measured"),
            std::string::npos);
  EXPECT_THROW(run_fastest(resolved, level_request(), -0.1), Error);
}

// Found without its uncertainty, the load at the slowest speed is allowed; with it, it is not.
TEST(Fastest, IsAbsentWhereTheLowerEndIsBelowTheSlowestDeployment) {
  const auto with = [](double rated) {
    return run_fastest(circular_with({{"hardware.link.rated_load_n", fmt::format("{}", rated)}}),
                       level_request());
  };
  const double at_slowest = with(0.01).design().load;
  const FastestResult between = with(1.1 * at_slowest), above = with(1.4 * at_slowest);
  EXPECT_TRUE(between.design().unsafe_at);
  EXPECT_FALSE(between.design().lowest);
  EXPECT_NE(between.warnings.back().find("uncertainty of 18 %"), std::string::npos)
      << between.warnings.back();
  ASSERT_TRUE(above.design().lowest && above.design().speed);
  LoadRequest there = level_request();
  there.speed = *above.design().lowest;
  const LoadResult loaded = run_load(circular_with(), there);
  for (const MethodLoad& m : loaded.stages[0].methods)
    if (m.method == infinite_mass_method) {
      EXPECT_LE(m.load * (1 + above.load_uncertainty), 1.4 * at_slowest);
    }
}

// A payload on a steep path near its rate of descent is accelerated while the canopy fills. The trajectory then has more
// than infinite mass, and is the design load of ripstop load too.
TEST(Fastest, OnASteepPathNearTheRateOfDescentIsForTheDesignLoad) {
  LoadRequest steep = level_request();
  steep.payload_mass = 4, steep.path_angle = 90, steep.opening_coefficient = 1.05;
  steep.speed = 13;
  const double allowed = 1.18 * run_load(circular_with(), steep).design_load;
  const FastestResult found =
      run_fastest(circular_with({{"hardware.link.rated_load_n", fmt::format("{}", allowed)}}), steep);
  ASSERT_TRUE(found.design().lowest);
  steep.speed = *found.design().lowest;
  const LoadResult there = run_load(circular_with(), steep);
  EXPECT_NE(there.design_method, infinite_mass_method);
  EXPECT_NEAR(there.design_load * (1 + found.load_uncertainty) / allowed, 1, 3e-3);
  EXPECT_EQ(found.design().note, "the larger load of the method trajectory is used");
  EXPECT_EQ(there.stages[0].methods[0].note,
            "constant speed is assumed; on this path the speed increases during filling");
}

// On a steep path the search begins at the speed above which the canopy decelerates the payload, which is stated.
TEST(Fastest, WithoutASafeSpeedNamesThePathAndTheHeightOfTheSearch) {
  LoadRequest asked = level_request();
  const Settings weak = circular_with({{"hardware.link.rated_load_n", "1"}});
  EXPECT_EQ(run_fastest(weak, asked).advice.find("--angle"), std::string::npos);
  asked.path_angle = 60;
  const std::string advice = run_fastest(weak, asked).advice;
  for (const char* text :
       {"no speed", "path 60 deg below the horizon, 500 m above sea level", "--angle", "--height"})
    EXPECT_NE(advice.find(text), std::string::npos) << text << "\n" << advice;
}

// A load that does not depend on the speed, as the weight in a descent, is carried too. One that is too large at the
// speed of a flight is none at a lower speed.
TEST(Fastest, WithALeastLoadIsTheSpeedAtWhichThatLoadIsCarried) {
  const Settings resolved = circular_with({{"hardware.link.rated_load_n", "400"}});
  const LoadUncertainty third{0.3, "given"};
  const auto with = [&](const std::function<double(double)>& least) {
    return run_fastest(resolved, level_request(), 0, third, least).design();
  };
  const SafeSpeed free = with({}), light = with([](double) { return 0.99 * 400 / 1.3; }),
                  heavy = with([](double) { return 1.01 * 400 / 1.3; });
  EXPECT_EQ(light.lowest, free.lowest);
  EXPECT_TRUE(heavy.unsafe_at && !heavy.lowest);
  EXPECT_NEAR(*free.speed / *free.lowest, std::sqrt(1.3), 2e-3);
  const double half = 0.5 * *free.lowest;
  const SafeSpeed rising = with([&](double speed) { return 400 / 1.3 * speed / half; });
  EXPECT_NEAR(*rising.lowest / half, 1, 2e-3);
}

TEST(Hardware, AStretchingPartNeedsItsKindSinceTheFactorsDependOnIt) {
  const std::vector<Setting> cord = {{"hardware.cord.breaking_load_n", "9000"},
                                     {"hardware.cord.length_m", "5"},
                                     {"hardware.cord.stiffness_n", "40000"}};
  EXPECT_NE(refusal_of([&] { circular_with(cord); }, ExitCode::usage).find("kind = \"textile\""),
            std::string::npos);
  const auto used = [&](const char* kind) {
    std::vector<Setting> whole = cord;
    whole.push_back({"hardware.cord.kind", kind});
    const Margins margins = load_margins(circular_with(whole), 1000);
    EXPECT_EQ(margins.members.back().member, "cord");
    return *margins.members.back().used;
  };
  // 1 / (0.8 x 0.95 x 0.95 x 0.95)
  EXPECT_NEAR(used("textile") / used("metal"), 1.4579, 1e-3);
}

TEST(Hardware, WarnsOfStrengthsThatLackTheFactorsOfATextilePart) {
  const auto warns = [](std::vector<Setting> cord, const std::string& of) {
    const FastestResult r = run_fastest(circular_with(cord), level_request());
    return std::any_of(r.warnings.begin(), r.warnings.end(),
                       [&](const std::string& text) { return text.find("hardware.cord: " + of) == 0; });
  };
  const Setting textile{"hardware.cord.kind", "textile"}, metal{"hardware.cord.kind", "metal"},
      rated{"hardware.cord.rated_load_n", "9000"}, breaking{"hardware.cord.breaking_load_n", "9000"};
  EXPECT_TRUE(warns({textile, rated}, "the rated load of a textile part"));
  EXPECT_TRUE(warns({breaking}, "without kind it is metal"));
  EXPECT_FALSE(warns({metal, rated}, "") || warns({rated}, "") || warns({metal, breaking}, "") ||
               warns({textile, breaking}, ""));
}

TEST(Hardware, NeedsExactlyOneStrengthAndItsStretchInFull) {
  for (const std::vector<Setting>& wrong :
       {std::vector<Setting>{{"hardware.a.strands", "2"}},
        {{"hardware.a.rated_load_n", "9"}, {"hardware.a.breaking_load_n", "9"}},
        {{"hardware.a.rated_load_n", "9"}, {"hardware.a.length_m", "2"}}})
    EXPECT_NE(refusal_of([&] { circular_with(wrong); }, ExitCode::usage).find("hardware.a"),
              std::string::npos);
}

// The energy of the snatch in a stiffer or shorter part is a higher load, and in a longer or softer one a lower load.
TEST(Snatch, ChangesWithLengthAndStiffnessOfAShockCord) {
  const Settings resolved = circular_with({{"hardware.cord.kind", "textile"},
                                           {"hardware.cord.breaking_load_n", "9000"},
                                           {"hardware.cord.length_m", "5"},
                                           {"hardware.cord.stiffness_n", "5000"}});
  LoadRequest asked = level_request();
  asked.speed = 30, asked.snatch_speed = 8;
  const SnatchResult snatch = run_load(resolved, asked).snatch.value();
  ASSERT_EQ(snatch.changes.back().part, "cord");
  const SnatchChange& cord = snatch.changes.back();
  EXPECT_GT(*cord.half_length, 1.2 * snatch.load);
  EXPECT_LT(*cord.double_length, snatch.load / 1.2);
  EXPECT_LT(*cord.half_stiffness, snatch.load / 1.2);
  EXPECT_GT(*cord.double_stiffness, 1.2 * snatch.load);
  LoadRequest without = asked;
  EXPECT_GT(run_load(circular_with(), without).snatch->load, 2 * snatch.load);
}

TEST(Snatch, HasTheRatioOfTheBreakingLoadsOfLinesAndRiserAndWarnsBelowOne) {
  LoadRequest asked = level_request();
  asked.speed = 30, asked.snatch_speed = 8;
  const LoadResult without = run_load(circular_with(), asked);
  EXPECT_NEAR(*without.snatch->line_margin, 3180 / without.snatch->line_load, 1e-9);
  EXPECT_FALSE(without.snatch->riser_margin);
  const LoadResult with = run_load(circular_with({{"parachute.riser.length_m", "1"}}), asked);
  EXPECT_NEAR(*with.snatch->riser_margin, 3180 / with.snatch->load, 1e-9);
  const auto breaks = [](const LoadResult& r, const char* part) {
    return std::any_of(r.warnings.begin(), r.warnings.end(), [&](const std::string& text) {
      return text.find(fmt::format("the snatch load breaks {}", part)) == 0;
    });
  };
  EXPECT_EQ(breaks(with, "the riser"), *with.snatch->riser_margin < 1);
  asked.snatch_speed = 30;
  const LoadResult fast = run_load(circular_with({{"parachute.riser.length_m", "1"}}), asked);
  EXPECT_LT(*fast.snatch->riser_margin, 1);
  EXPECT_TRUE(breaks(fast, "the riser"));
  asked.snatch_speed = 1;
  const LoadResult slow = run_load(circular_with({{"parachute.riser.length_m", "1"}}), asked);
  EXPECT_GT(*slow.snatch->riser_margin, 1);
  EXPECT_FALSE(breaks(slow, "the riser") || breaks(slow, "a line"));
}

TEST(Snatch, OfTheDeploymentOfTheCaseIsComputedAtTheSpeedOfTheRequest) {
  LoadRequest asked = level_request();
  asked.speed = 30;
  EXPECT_FALSE(run_load(circular_with(), asked).snatch);
  const Settings resolved = circular_with({{"deployment.relative_speed_m_s", "12"}});
  const SnatchResult snatch = run_load(resolved, asked).snatch.value();
  EXPECT_EQ(snatch.from, "[deployment] of the case");
  EXPECT_NEAR(snatch.speed_difference, 12, 3);
  EXPECT_GT(snatch.load, 0);
}

double of_member(const Margins& margins, const std::string& member) {
  const auto same = [&](const Margin& m) { return m.member == member; };
  return std::find_if(margins.members.begin(), margins.members.end(), same)->load;
}

// Both are snatch loads, of other speeds and by other models: a part has to carry the larger one.
TEST(Snatch, OfTwoModelsIsTheLargerOneWithAWarningOfBoth) {
  const Settings deployed = circular_with({{"deployment.relative_speed_m_s", "3"}});
  LoadRequest asked = level_request();
  asked.speed = 30, asked.snatch_speed = 20;
  const LoadResult r = run_load(deployed, asked);
  ASSERT_TRUE(r.snatch && r.snatch->other_load);
  EXPECT_NE(r.snatch->model, deployment_model);
  EXPECT_GT(*r.snatch->other_speed_difference, 3);
  ASSERT_GT(r.snatch->load, *r.snatch->other_load);
  LoadRequest alone = asked;
  alone.snatch_speed.reset();
  const LoadResult of_case = run_load(deployed, alone);
  EXPECT_EQ(of_case.snatch->load, *r.snatch->other_load);
  EXPECT_EQ(of_case.snatch->model, deployment_model);
  EXPECT_EQ(r.required_load, std::max(r.snatch->load, r.highest_design_load));
  EXPECT_EQ(r.hardware.rated, r.required_load);
  ASSERT_GT(r.snatch->load, r.design_load);
  for (const Margin& m : r.margins->members)  // the edges of the packed canopy do not carry the snatch load
    EXPECT_NEAR(m.load,
                of_member(load_margins(deployed, m.member == "tape" || m.member == "hem" ? r.design_load
                                                                                         : r.snatch->load),
                          m.member),
                1e-9 * m.load)
        << m.member;
  const auto two = [](const LoadResult& result) {
    return std::count_if(result.warnings.begin(), result.warnings.end(),
                         [](const std::string& text) { return text.starts_with("two snatch loads"); });
  };
  EXPECT_EQ(two(r), 1);
  EXPECT_EQ(two(of_case), 0);
}

TEST(Fastest, CarriesTheSnatchLoadToo) {
  const auto fastest = [](const std::vector<Setting>& more, std::optional<double> difference) {
    LoadRequest asked = level_request();
    asked.snatch_speed = difference;
    return run_fastest(circular_with(more), asked);
  };
  const std::vector<Setting> link = {{"hardware.link.rated_load_n", "1500"}};
  const FastestResult without = fastest(link, {}), slow = fastest(link, 1), fast = fastest(link, 30);
  EXPECT_FALSE(without.snatch);
  EXPECT_NE(without.advice.find("the snatch load and the stress"), std::string::npos) << without.advice;
  ASSERT_LT(slow.snatch->load, 1500);
  EXPECT_EQ(slow.design().speed, without.design().speed) << "the opening has the larger load";
  EXPECT_EQ(slow.advice.find("snatch"), std::string::npos) << slow.advice;
  ASSERT_GT(fast.snatch->load, 1500);
  EXPECT_FALSE(fast.design().speed);
  EXPECT_NE(fast.advice.find("the margin of safety of the link is below the required 0"), std::string::npos)
      << fast.advice;
}

}  // namespace
}  // namespace ripstop
