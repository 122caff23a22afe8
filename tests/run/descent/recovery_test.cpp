// A recovery is the sum of its stages: terminal speeds, times, drift and energies of closed forms.
#include "ripstop/run/descent/recovery.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/run/descent/flown.h"
#include "ripstop/run/report/report_tables.h"
#include "tests/refusal.h"

namespace ripstop {
namespace {

Settings canopy(double diameter, std::vector<Setting> more = {}) {
  Overrides overrides;
  overrides.set = std::move(more);
  overrides.set.push_back({"parachute.nominal_diameter_m", std::to_string(diameter)});
  overrides.set.push_back({"parachute.vent_diameter_m", std::to_string(0.1 * diameter)});
  overrides.set.push_back({"parachute.lines.length_m", std::to_string(1.2 * diameter)});
  return resolve(
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml", overrides));
}

RecoveryRequest request() {
  RecoveryRequest r;
  r.mass = 22, r.apogee = 3000, r.main_height = 300, r.ground = 200;
  return r;
}

bool warns_of(const RecoveryResult& r, const char* text) {
  return std::any_of(r.warnings.begin(), r.warnings.end(),
                     [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}

double drag_area(const RecoveryStage& s) {
  return s.drag_coefficient * s.reference_area;
}

TEST(Recovery, StagesEndAtTheTerminalSpeedOfTheirDragAreas) {
  const RecoveryResult r = run_recovery(canopy(3.5), canopy(0.7), request());
  ASSERT_EQ(r.stages.size(), 2u);
  const RecoveryStage &drogue = r.stages[0], &main = r.stages[1];
  EXPECT_NEAR(main.height, 300, 1e-6);
  // The speed follows the density with a delay of v / (2 g), hence from v^2 / (2 g) above.
  const double rate = drogue.descent_rate.value, above = rate * rate / (2 * standard_gravity);
  EXPECT_NEAR(rate / terminal_speed(r.total_mass, drag_area(drogue), standard_air(500 + above).density), 1,
              5e-4);
  EXPECT_NEAR(main.speed.value, drogue.descent_rate.value, 1e-9);
  const double both = drag_area(drogue) + drag_area(main);  // the drogue remains attached
  EXPECT_NEAR(r.landing_speed.value / terminal_speed(r.total_mass, both, standard_air(200).density), 1, 2e-3);
  EXPECT_NEAR(r.energy.value, 0.5 * r.total_mass * r.landing_speed.value * r.landing_speed.value, 1e-9);
  EXPECT_NEAR(r.time.value, drogue.duration.value + main.duration.value, 1e-9);
  RecoveryRequest released = request();
  released.drogue_released = true;
  EXPECT_NEAR(run_recovery(canopy(3.5), canopy(0.7), released).landing_speed.value /
                  terminal_speed(r.total_mass, drag_area(main), standard_air(200).density),
              1, 2e-3);
}

TEST(Recovery, LoadsAreThoseOfTheSameOpeningsByTheLoadCommand) {
  const RecoveryResult r = run_recovery(canopy(3.5), canopy(0.7), request());
  LoadRequest asked;
  asked.payload_mass = r.total_mass - r.stages[1].mass;
  asked.speed = r.stages[1].speed.value, asked.height = 500, asked.ground = 200;
  asked.path_angle = r.stages[1].path_angle;
  const LoadResult load = run_load(canopy(3.5), asked);
  EXPECT_NEAR(load.design_load / r.stages[1].design_load, 1, 1e-9);
  EXPECT_NEAR(load.stages[0].filling_time / r.stages[1].filling_time, 1, 1e-9);
  EXPECT_TRUE(r.stages[1].margins);
}

TEST(Recovery, RangesFollowTheUncertaintyOfTheDrag) {
  const RecoveryResult r = run_recovery(canopy(3.5), canopy(0.7), request());
  const double u = r.stages[1].drag_uncertainty;
  EXPECT_NEAR(r.landing_speed.low / r.landing_speed.value, 1 / std::sqrt(1 + u), 3e-3);
  EXPECT_NEAR(r.landing_speed.high / r.landing_speed.value, 1 / std::sqrt(1 - u), 3e-3);
  EXPECT_LT(r.time.low, r.time.value);
  EXPECT_GT(r.time.high, r.time.value);
}

std::vector<Setting> with_coefficient(const char* basis, const char* cloth = "f-111-physical") {
  return {{"inflation.drag_coefficient", "0.68"},
          {"inflation.drag_coefficient_basis", basis},
          {"parachute.canopy_material", cloth}};
}

// Flights of Ripstop: the coefficient in descent of a flat circular canopy is larger than the axial one, of a cross
// smaller. A range has both ends, each with the uncertainty of a coefficient.
TEST(Recovery, AnAxialCoefficientHasTheRangeOfTheFlights) {
  const FlownDrag* same = nullptr;
  std::vector<double> same_type;
  for (const FlownDrag& row : flown_drags()) {
    if (row.type != "flat-circular") continue;
    same_type.push_back(row.drag_coefficient / row.axial_coefficient);
    if (row.cloth == "f-111-physical") same = &row;
  }
  ASSERT_TRUE(same);
  const auto drag_of = [](const std::vector<Setting>& more) {
    const RecoveryResult r = run_recovery(canopy(3.5, more), {}, request());
    EXPECT_EQ(r.stages[0].drag_coefficient, 0.68);
    EXPECT_NE(r.stages[0].descent_drag.from, "");
    return r.stages[0].descent_drag;
  };
  const DescentDrag axial = drag_of(with_coefficient("axial"));
  EXPECT_NEAR(axial.low, 0.9 * 0.68, 1e-12);
  EXPECT_NEAR(axial.high, 1.1 * 0.68 * same->drag_coefficient / same->axial_coefficient, 1e-12);
  const DescentDrag other = drag_of(with_coefficient("axial", "pia-c-44378-type-iv"));
  EXPECT_NEAR(other.high, 1.1 * 0.68 * *std::max_element(same_type.begin(), same_type.end()), 1e-12);
  const DescentDrag descent = drag_of(with_coefficient("descent"));
  EXPECT_NEAR(descent.high, 1.1 * 0.68, 1e-12);
  const Settings cross =
      resolve(read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/cross/case.toml"));
  const DescentDrag arms = descent_drag(cross, {0.7, "", 0.1, "axial"});
  EXPECT_LT(arms.low, 0.95 * 0.9 * 0.7);
  EXPECT_NEAR(arms.high, 1.1 * 0.7, 1e-12);
}

// The main opens fastest under a drogue with the smallest drag, and lands slowest with the largest of both.
TEST(Recovery, RangesCombineTheEndsOfBothParachutes) {
  const Settings drogue = canopy(0.7, with_coefficient("descent")),
                 main = canopy(3.5, with_coefficient("axial"));
  const RecoveryResult r = run_recovery(main, drogue, request());
  const RecoveryStage &first = r.stages[0], &second = r.stages[1];
  EXPECT_NEAR(first.descent_rate.high / first.descent_rate.value, 1 / std::sqrt(0.9), 3e-3);
  EXPECT_NEAR(first.descent_rate.low / first.descent_rate.value, 1 / std::sqrt(1.1), 3e-3);
  const double both =
      first.reference_area * first.descent_drag.high + second.reference_area * second.descent_drag.high;
  EXPECT_NEAR(r.landing_speed.low / terminal_speed(r.total_mass, both, standard_air(200).density), 1, 2e-3);
  // C_x C_D S0 q at the fastest opening, with a C_D of at least 0.80, the handbook's, and the scatter of openings.
  const double faster = second.speed.high / second.speed.value, range = second.descent_drag.high / 0.80 - 1;
  ASSERT_GT(range, 0.1);
  EXPECT_NEAR(second.load_uncertainty, std::hypot(range, 0.15), 1e-9);
  EXPECT_NEAR(second.highest_design_load / second.design_load,
              (1 + second.load_uncertainty) * faster * faster, 1e-6);
  EXPECT_LT(second.lowest_design_load, second.design_load);
  EXPECT_LT(r.time.low, r.time.value);
}

// The drag of a canopy is known within a range. Parts that carry only the load of its middle fail at the upper end.
TEST(Recovery, EveryRequiredStrengthIsForTheUpperEndOfTheDesignLoad) {
  const Settings main = canopy(3.5, {{"hardware.swivel.rated_load_n", "5000"}});
  const RecoveryResult r = run_recovery(main, canopy(0.7), request());
  for (const RecoveryStage& s : r.stages) {
    EXPECT_GE(s.highest_design_load, s.design_load);
    EXPECT_EQ(s.hardware.rated, s.highest_design_load);
    EXPECT_GT(s.hardware.metal, s.hardware.rated);
    EXPECT_GT(s.hardware.textile, s.hardware.metal);
  }
  const RecoveryStage& last = r.stages[1];
  EXPECT_GT(last.highest_design_load, 1.05 * last.design_load);
  const Margins expected = load_margins(main, last.highest_design_load);
  ASSERT_EQ(last.margins->members.size(), expected.members.size());
  for (std::size_t i = 0; i < expected.members.size(); ++i)
    EXPECT_EQ(last.margins->members[i].load, expected.members[i].load) << expected.members[i].member;
}

// Margins under the upper end of the load, and the lower end of the safe speed, are one statement.
TEST(Recovery, APartExceedsItsAllowableLoadIfAndOnlyIfItOpensAboveTheSafeSpeed) {
  std::vector<Setting> axial = with_coefficient("axial");
  axial.push_back({"parachute.tape.material", "nylon-tape-525-lbf"});
  const RecoveryResult free = run_recovery(canopy(3.5, axial), canopy(1.8), request());
  for (const std::size_t stage : {0U, 1U})
    for (const double share : {0.7, 0.99, 1.01, 1.4}) {
      const std::vector<Setting> link = {
          {"hardware.link.rated_load_n", fmt::format("{}", share * free.stages[stage].highest_design_load)}};
      std::vector<Setting> main = axial;
      if (stage == 1) main.push_back(link[0]);
      const RecoveryStage s =
          run_recovery(canopy(3.5, main), canopy(1.8, stage == 0 ? link : std::vector<Setting>{}), request())
              .stages[stage];
      const auto part = std::find_if(s.margins->members.begin(), s.margins->members.end(),
                                     [](const Margin& m) { return m.member == "link"; });
      ASSERT_NE(part, s.margins->members.end());
      EXPECT_NEAR(*part->used, 1 / share, 1e-9);
      const bool exceeded = *weakest(*s.margins)->used > 1;
      EXPECT_EQ(exceeded, share < 1) << s.name << share;
      EXPECT_EQ(exceeded, s.safe->unsafe_at || s.speed.high > *s.safe->lowest) << s.name << share;
    }
}

// The forces of the flight are those at its own speed; a slower opening has smaller ones.
TEST(Recovery, TheSafeSpeedOfAFastOpeningIsThatOfTheLoadCommand) {
  std::vector<Setting> link = with_coefficient("descent");
  link.push_back({"hardware.link.rated_load_n", "5000"});
  for (const double delay : {8.0, 10.0, 20.0}) {
    RecoveryRequest late = request();
    late.delay = delay;
    const RecoveryResult r = run_recovery(canopy(3.5, link), {}, late);
    const RecoveryStage& s = r.stages[0];
    LoadRequest asked;
    asked.payload_mass = late.mass, asked.height = s.height + late.ground, asked.path_angle = s.path_angle;
    const SafeSpeed alone = run_fastest(canopy(3.5, link), asked).design();
    ASSERT_TRUE(s.safe->lowest && alone.lowest) << delay;
    EXPECT_NEAR(*s.safe->lowest / *alone.lowest, 1, 0.01) << delay;
    EXPECT_TRUE(warns_of(r, "the fastest safe deployment is")) << delay;
  }
}

// The load of the handbook is that of a canopy that fills slowly; a measured one needs no caution.
TEST(Recovery, AHeavyPayloadQualifiesTheStageAsInTheLoadCommand) {
  const RecoveryResult r = run_recovery(canopy(3.5), canopy(0.7), request());
  LoadRequest asked;
  asked.payload_mass = r.total_mass - r.stages[0].mass;
  asked.speed = r.stages[0].speed.value, asked.height = 3200, asked.path_angle = 0;
  const LoadResult drogue = run_load(canopy(0.7), asked);
  ASSERT_NE(drogue.design_load_caution, "");
  EXPECT_EQ(r.stages[0].design_load_caution, drogue.design_load_caution);
  EXPECT_EQ(run_fastest(canopy(0.7), asked).design_load_caution.empty(), false);
  RecoveryRequest measured = request();
  measured.drogue_measured_load = 500;
  EXPECT_EQ(run_recovery(canopy(3.5), canopy(0.7), measured).stages[0].design_load_caution, "");
}

TEST(Recovery, AMeasuredLoadReplacesTheHandbookAndIsScaledToTheRangeOfSpeeds) {
  RecoveryRequest measured = request();
  measured.main_measured_load = 2000;
  const RecoveryResult r = run_recovery(canopy(3.5), canopy(0.7), measured);
  const RecoveryStage &drogue = r.stages[0], &main = r.stages[1];
  EXPECT_EQ(main.design_load, 2000);
  EXPECT_EQ(main.design_load_from, "measured, as given");
  const double faster = main.speed.high / main.speed.value, slower = main.speed.low / main.speed.value;
  EXPECT_NEAR(main.highest_design_load, 1.15 * 2000 * faster * faster, 1e-6);
  EXPECT_NEAR(main.lowest_design_load, 0.85 * 2000 * slower * slower, 1e-6);
  EXPECT_EQ(main.hardware.rated, main.highest_design_load);
  EXPECT_FALSE(main.safe);
  EXPECT_EQ(drogue.highest_design_load,
            run_recovery(canopy(3.5), canopy(0.7), request()).stages[0].highest_design_load);
  measured.main_measured_load = 400;
  EXPECT_TRUE(warns_of(run_recovery(canopy(3.5), canopy(0.7), measured),
                       "main: the measured load of 400 N is below every applicable estimate"));
}

TEST(Recovery, AMeasuredLoadBelowTheLargestForceOfTheTrajectoryIsNotUsed) {
  const RecoveryStage handbook = run_recovery(canopy(3.5), canopy(0.7), request()).stages[0];
  RecoveryRequest measured = request();
  measured.drogue_measured_load = 100;
  const RecoveryResult r = run_recovery(canopy(3.5), canopy(0.7), measured);
  EXPECT_TRUE(warns_of(r, "drogue: the measured load of 100 N is below the largest force of the trajectory"));
  ASSERT_TRUE(r.stages[0].safe);
  EXPECT_EQ(r.stages[0].safe->lowest, handbook.safe->lowest);
  EXPECT_NE(r.stages[0].design_load_caution, "");
  EXPECT_EQ(r.stages[0].design_load_caution, handbook.design_load_caution);
  EXPECT_EQ(r.stages[0].highest_design_load, handbook.highest_design_load);
}

// The uncertainty leads from the design load to its upper end where both are forces of the trajectories.
TEST(Recovery, TheUncertaintyOfALargestForceOfTheTrajectoryIsThatOfItsRange) {
  RecoveryRequest slow = request();
  slow.speed = 5;
  const RecoveryStage s = run_recovery(canopy(3.5), canopy(0.7), slow).stages[0];
  ASSERT_EQ(s.design_load_from, "largest force of the trajectory");
  ASSERT_TRUE(s.of_trajectory);
  EXPECT_NEAR(s.highest_design_load, (1 + s.load_uncertainty) * s.design_load, 1e-9 * s.design_load);
  EXPECT_GE(s.load_uncertainty, 0.15 - 1e-9);
  EXPECT_EQ(s.load_uncertainty_from.find("largest force of the trajectories"), 0u) << s.load_uncertainty_from;
  EXPECT_FALSE(run_recovery(canopy(3.5), canopy(0.7), request()).stages[1].of_trajectory);
}

TEST(Recovery, AFastFallWithoutTheDragOfTheRocketIsWarnedOf) {
  const auto warned = [](double delay, double area) {
    RecoveryRequest late = request();
    late.delay = delay, late.body_drag_area = area;
    return warns_of(run_recovery(canopy(3.5), {}, late), "without the drag of the rocket");
  };
  EXPECT_TRUE(warned(20, 0));
  EXPECT_FALSE(warned(20, 0.01));
  EXPECT_FALSE(warned(1, 0));
}

TEST(Recovery, WarnsOfAnOpeningWithoutASafeSpeed) {
  const RecoveryResult r =
      run_recovery(canopy(3.5, {{"hardware.link.rated_load_n", "50"}}), canopy(0.7), request());
  ASSERT_TRUE(r.stages[1].safe->unsafe_at);
  EXPECT_TRUE(warns_of(r, "main: it opens at up to "));
  EXPECT_TRUE(warns_of(r, "no speed is safe (infinite mass): the link does not keep its margin"));
}

TEST(Recovery, ASnatchLoadAboveTheDesignLoadDeterminesTheHardware) {
  const Settings main = canopy(3.5, {{"deployment.ejection_impulse_n_s", "300"}});
  const RecoveryStage s = run_recovery(main, canopy(0.7), request()).stages[1];
  ASSERT_TRUE(s.snatch_load);
  ASSERT_GT(*s.snatch_load, s.highest_design_load);
  EXPECT_EQ(s.hardware.rated, *s.snatch_load);
  EXPECT_FALSE(run_recovery(canopy(3.5), {}, request()).stages[0].snatch_load);
}

// A linear cord: E = m1 m2 v^2 / (2 (m1 + m2)), F = sqrt(2 E k / L); of three sections the most even parting.
TEST(Recovery, TheSeparationOfSectionsIsALoadOfTheShockCord) {
  const std::vector<Setting> cord = {{"hardware.cord.kind", "textile"},
                                     {"hardware.cord.breaking_load_n", "20000"},
                                     {"hardware.cord.length_m", "9"},
                                     {"hardware.cord.stiffness_n", "40000"},
                                     {"hardware.swivel.rated_load_n", "9000"}};
  RecoveryRequest asked = request();
  asked.sections = {4, 5, 13}, asked.separation_speed = 10;
  const double load = std::sqrt(9.0 * 13 / 22 * 100 * 40000 / 9);
  const RecoveryStage slow = run_recovery(canopy(3.5, cord), {}, asked).stages[0];
  EXPECT_NEAR(slow.separation_load.value(), load, 1e-4 * load);
  asked.separation_speed = 100;
  const RecoveryStage fast = run_recovery(canopy(3.5, cord), {}, asked).stages[0];
  EXPECT_NEAR(fast.hardware.rated, 10 * load, 1e-3 * load);
  for (std::size_t i = 0; i < fast.margins->members.size(); ++i) {
    const Margin &m = fast.margins->members[i], &before = slow.margins->members[i];
    const bool hardware = m.member == "cord" || m.member == "swivel";
    EXPECT_NEAR(m.load, hardware ? 10 * load : before.load, 1e-3 * load) << m.member;
  }
  EXPECT_NE(refusal_of([&] { run_recovery(canopy(3.5), {}, asked); }, ExitCode::usage).find("shock cord"),
            std::string::npos);
  asked.sections.clear();
  EXPECT_NE(
      refusal_of([&] { run_recovery(canopy(3.5, cord), {}, asked); }, ExitCode::usage).find("--section"),
      std::string::npos);
}

TEST(Recovery, RowsAndTablesNameTheirStage) {
  const RecoveryResult r = run_recovery(canopy(3.5), canopy(0.7), request());
  EXPECT_EQ(r.rows.front().open, 1);
  EXPECT_EQ(r.rows.back().open, 2);
  ReportRun run;
  add_result(run, to_json(r), "result.json");
  std::set<std::string> titles;
  for (const ReportTable& table : run.tables) titles.insert(table.title);
  EXPECT_TRUE(titles.contains("Stages drogue margins")) << fmt::format("{}", fmt::join(titles, "; "));
  EXPECT_TRUE(titles.contains("Stages main margins members"));
}

TEST(Recovery, AWindProfileIsReportedWithItsSpeedAtApogee) {
  const RecoveryResult r =
      run_recovery(canopy(3.5, {{"flight.wind.speed_m_s", "4"}, {"flight.wind.exponent", "0.15"}}),
                   canopy(0.7), request());
  EXPECT_NEAR(r.apogee_wind, 4 * std::pow(300, 0.15), 1e-9);
  EXPECT_EQ(r.wind.exponent, 0.15);
}

TEST(Recovery, DriftIsTheWindTimesTheTimeInItAndAProfileIsSlowerBelow) {
  const RecoveryResult uniform =
      run_recovery(canopy(3.5, {{"flight.wind.speed_m_s", "4"}}), canopy(0.7), request());
  EXPECT_NEAR(uniform.drift.value, 4 * uniform.time.value, 1e-6 * uniform.drift.value);
  EXPECT_NEAR(uniform.stages[0].drift.value + uniform.stages[1].drift.value, uniform.drift.value, 1e-6);
  const RecoveryResult profile =
      run_recovery(canopy(3.5, {{"flight.wind.speed_m_s", "4"}, {"flight.wind.exponent", "0.15"}}),
                   canopy(0.7), request());
  // Mean of (h / 10 m)^0.15 at a constant rate from 300 m to the ground.
  EXPECT_NEAR(profile.stages[1].drift.value / profile.stages[1].duration.value, 4 * std::pow(30, 0.15) / 1.15,
              0.3);
}

TEST(Recovery, BodyAloneFallsDuringADelayAndALateDrogueOpensFaster) {
  RecoveryRequest late = request();
  late.delay = 6, late.body_drag_area = 0;
  const RecoveryResult r = run_recovery(canopy(3.5), canopy(0.7), late);
  EXPECT_NEAR(r.stages[0].time, 6, 1e-9);
  EXPECT_NEAR(r.stages[0].speed.value, std::hypot(20, 6 * standard_gravity), 0.01);
  EXPECT_GT(r.stages[0].design_load,
            2 * run_recovery(canopy(3.5), canopy(0.7), request()).stages[0].design_load);
}

TEST(Recovery, ADrogueThatOpensSlowerThanItDescendsCarriesTheWeight) {
  RecoveryRequest slow = request();
  slow.speed = 2, slow.delay = 0.5;
  const RecoveryStage drogue = run_recovery(canopy(3.5), canopy(0.7), slow).stages[0];
  EXPECT_GT(drogue.design_load, 0.99 * 22 * standard_gravity);
}

TEST(Recovery, WarnsOfAnOpeningBeyondTheRangeOfTheLoadModel) {
  RecoveryRequest high = request();
  high.apogee = 60000, high.delay = 100;
  EXPECT_TRUE(warns_of(run_recovery(canopy(3.5), {}, high), "main: Mach number of"));
  EXPECT_FALSE(warns_of(run_recovery(canopy(3.5), canopy(0.7), request()), "Mach number"));
}

TEST(Recovery, WarnsOfAMainThatIsNotFilledAtTheGround) {
  RecoveryRequest low = request();
  low.main_height = 3;
  EXPECT_TRUE(warns_of(run_recovery(canopy(3.5), canopy(0.7), low), "main: it opens too low"));
  EXPECT_FALSE(warns_of(run_recovery(canopy(3.5), canopy(0.7), request()), "opens too low"));
}

// While a canopy opens, the trajectory has up to C_x times its drag area; a landing then would seem soft.
TEST(Recovery, ALandingDuringTheOpeningIsReportedAndIsNotSlowerThanUnderTheOpenCanopy) {
  const RecoveryResult high = run_recovery(canopy(3.5), canopy(0.7), request());
  EXPECT_FALSE(warns_of(high, "steady descent"));
  for (const double height : {22.0, 26.0, 30.0, 33.0, 40.0}) {
    RecoveryRequest low = request();
    low.main_height = height;
    const RecoveryResult r = run_recovery(canopy(3.5), canopy(0.7), low);
    EXPECT_TRUE(warns_of(r, "steady descent") || warns_of(r, "it is not filled")) << height;
    EXPECT_GE(r.landing_speed.value, 0.998 * high.landing_speed.value) << height;
    EXPECT_GE(r.landing_speed.low, 0.998 * high.landing_speed.low) << height;
    EXPECT_GE(r.energy.low, 0.996 * high.energy.low) << height;
  }
}

TEST(Recovery, WarnsOfADrogueLargerThanTheMain) {
  const RecoveryResult r = run_recovery(canopy(0.7), canopy(3.5), request());
  EXPECT_TRUE(warns_of(r, "exchange the two parachutes"));
  EXPECT_FALSE(warns_of(run_recovery(canopy(3.5), canopy(0.7), request()), "exchange"));
  for (const RecoveryStage& s : r.stages) {
    EXPECT_LE(s.lowest_design_load, s.design_load) << s.name;
    EXPECT_GE(s.highest_design_load, s.design_load) << s.name;
  }
}

TEST(Recovery, AMainAboveTheApogeeAndADelayToTheGroundAreRefused) {
  RecoveryRequest wrong = request();
  wrong.main_height = 3000;
  EXPECT_NE(
      refusal_of([&] { run_recovery(canopy(3.5), canopy(0.7), wrong); }, ExitCode::usage).find("apogee"),
      std::string::npos);
  RecoveryRequest late = request();
  late.apogee = 50, late.delay = 100;
  EXPECT_NE(refusal_of([&] { run_recovery(canopy(3.5), {}, late); }, ExitCode::usage).find("on the ground"),
            std::string::npos);
}

TEST(Recovery, SectionsHeavierThanTheRocketAreRefused) {
  RecoveryRequest asked = request();
  asked.sections = {0.4 * asked.mass, 0.6 * asked.mass};
  EXPECT_EQ(run_recovery(canopy(3.5), {}, asked).sections.size(), 2u);
  asked.sections[0] = asked.mass;
  EXPECT_NE(refusal_of([&] { run_recovery(canopy(3.5), {}, asked); }, ExitCode::usage).find("sections of"),
            std::string::npos);
}

}  // namespace
}  // namespace ripstop
