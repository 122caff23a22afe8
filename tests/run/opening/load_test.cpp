#include "ripstop/run/opening/load.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/opening/filling.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/sizing/size.h"
#include "tests/refusal.h"
#include "tests/run/opening/method_of.h"
#include "tests/run/steady/finished_run.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

Case flat_circular() {
  Overrides overrides;
  overrides.set.push_back({"parachute.mesh.cloth_nodes", "1500"});
  return read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml", overrides);
}

/// With a filling constant of its own: the handbook's is not for a canopy of a metre.
LoadRequest request(double mass = 2.4, double speed = 30) {
  LoadRequest r;
  r.payload_mass = mass, r.speed = speed, r.height = 500;
  r.filling_constant = 8;
  return r;
}

std::string refused(const LoadRequest& asked) {
  return refusal_of([&] { run_load(resolve(flat_circular()), asked); }, ExitCode::usage);
}

// n D0 / v for the open canopy, with the root of the share of the area that a stage adds.
TEST(Load, AStageFillsAsItsOwnShareOfTheAreaDoes) {
  LoadRequest asked = request();
  asked.reefing = {{0.1, 2}, {0.4, 2}};
  const LoadResult r = run_load(resolve(flat_circular()), asked);
  ASSERT_EQ(r.stages.size(), 3u);
  const double shares[] = {0.1, 0.3, 0.6};
  for (int n = 0; n < 3; ++n)
    EXPECT_NEAR(r.stages[n].filling_time,
                r.filling_constant * r.nominal_diameter / r.stages[n].speed * std::sqrt(shares[n]), 1e-12)
        << n;
}

// Knacke, NWC TP 6575, Table 5-6 (page 5-44), unreefed, and Fig. 5-51 (page 5-59): read in github.com/nrdptel/hpr-sim,
// crates/hpr-sim/src/recovery.rs, a transcription of the print.
TEST(Load, FillingConstantsAreTheHandbooks) {
  EXPECT_EQ(known_filling("flat-circular").constant, 8);
  EXPECT_EQ(known_filling("extended-skirt").constant, 10);
  EXPECT_EQ(known_filling("cross").constant, 11.7);
  EXPECT_EQ(known_filling("ringslot").constant, 14);
  EXPECT_EQ(known_filling("ringsail").constant, 7);
  for (const char* solid : {"flat-circular", "conical", "extended-skirt"})
    EXPECT_EQ(known_filling(solid).exponent, 2) << solid;
  EXPECT_EQ(known_filling("ringslot").exponent, 1);
}

// Knacke: t_f = 4.0 D_0 / v^0.85 in feet and seconds below 150 ft/s for solid flat circular canopies, n D_0 / v above.
TEST(Load, BelowFortySixMetresASecondTheFillingTimeIsKnackesForLowSpeeds) {
  LoadRequest asked = request(2.4, 20);
  asked.filling_constant.reset();
  const LoadResult slow = run_load(resolve(flat_circular()), asked);
  const double feet = slow.nominal_diameter / 0.3048, speed = 20 / 0.3048;
  EXPECT_NEAR(slow.stages[0].filling_time, 4.0 * feet / std::pow(speed, 0.85), 1e-12);
  asked.speed = 60;
  const LoadResult fast = run_load(resolve(flat_circular()), asked);
  EXPECT_NEAR(fast.stages[0].filling_time, 8 * fast.nominal_diameter / 60, 1e-12);
  for (const LoadResult* r : {&slow, &fast}) {
    EXPECT_TRUE(method(r->stages[0], "Pflanz").applies) << method(r->stages[0], "Pflanz").note;
    EXPECT_NE(r->stages[0].caution.find("nominal diameter of 1 m is outside"), std::string::npos)
        << r->stages[0].caution;
  }
  asked.speed = 160, asked.height = 3000;
  EXPECT_FALSE(method(run_load(resolve(flat_circular()), asked).stages[0], "Ludtke").applies);
}

TEST(Load, AHeavyPayloadOpensOnALevelPathAndIsRefusedOnlyWhereItAccelerates) {
  LoadRequest asked = request(1e6, 30);
  asked.path_angle = 0;
  const LoadResult r = run_load(resolve(flat_circular()), asked);
  EXPECT_NEAR(method(r.stages[0], "Pflanz").load / method(r.stages[0], "infinite mass").load,
              r.drag_coefficient / r.design_drag_coefficient, 1e-3);
  asked.path_angle = 90;
  EXPECT_NE(refused(asked).find("still accelerates under the open canopy"), std::string::npos);
}

// A canopy of a centimetre fills in microseconds and decelerates for seconds.
TEST(Load, TheFlightOfATinyCanopyHasNoMoreRowsThanOthers) {
  SizeRequest tiny;
  tiny.payload_mass = 0.001, tiny.descent_rate = 100, tiny.height = 30000;
  const SizeResult r = run_size(tiny);
  EXPECT_LT(r.opening.front().filling_time, 1e-2);
  EXPECT_LT(r.flight.size(), 2000u) << "a size flies the opening only";
  LoadRequest asked;
  asked.payload_mass = 0.001, asked.speed = 300, asked.height = 30000;
  EXPECT_LT(run_load(resolve(r.given), asked).flight.size(), 200000u);
}

/// Summary of a stage over its applicable methods.
void expect_judged(const StageLoads& stage) {
  double highest = 0, lowest = 1e300, sum = 0;
  int count = 0;
  for (const MethodLoad& m : stage.methods)
    if (m.applies)
      highest = std::max(highest, m.load), lowest = std::min(lowest, m.load), sum += m.load, ++count;
  ASSERT_GT(count, 0);
  EXPECT_EQ(stage.highest, highest);
  EXPECT_EQ(stage.lowest, lowest);
  EXPECT_NEAR(stage.spread, (highest - lowest) / (sum / count), 1e-12);
}

TEST(Load, ListsTheMethodsAndWhichApply) {
  const LoadResult r = run_load(resolve(flat_circular()), request());
  ASSERT_EQ(r.stages.size(), 1u);
  const StageLoads& stage = r.stages[0];
  EXPECT_EQ(stage.methods.size(), 5u);
  const double area = r.design_drag_coefficient * r.reference_area;
  EXPECT_NEAR(method(stage, "infinite mass").load,
              0.5 * standard_air(500).density * 900 * area * r.opening_coefficient, 1e-9);
  EXPECT_NEAR(stage.filling_time, r.filling_constant * r.nominal_diameter / 30, 1e-12);
  for (const MethodLoad& m : stage.methods) {
    EXPECT_GT(m.load, 0) << m.method;
    EXPECT_LE(m.load, method(stage, "infinite mass").load * 1.001) << m.method;
    if (!m.applies) {
      EXPECT_NE(m.note, "") << m.method;
    }
  }
  expect_judged(stage);
  EXPECT_TRUE(method(stage, "trajectory").applies);
  // The design load is the load of one of the methods; the hardware also carries its uncertainty.
  EXPECT_EQ(method(stage, r.design_method).load, r.design_load);
  EXPECT_EQ(r.hardware.rated, r.highest_design_load);
  LoadRequest measured = request();
  measured.measured_load = 500;
  EXPECT_EQ(run_load(resolve(flat_circular()), measured).design_method, "");
}

TEST(Load, EndsInTheSteadyDescentOfItsMass) {
  const LoadResult r = run_load(resolve(flat_circular()), request());
  EXPECT_TRUE(r.steady_reached);
  const double density = standard_air(500 - r.steady_drop).density;
  EXPECT_NEAR(r.steady_speed / terminal_speed(r.payload_mass + r.parachute_mass,
                                              r.drag_coefficient * r.reference_area, density),
              1, 2e-3);
}

/// Residual of the trajectory in `rows` by the trapezoidal rule: of momentum over the first, of energy over
/// the first.
struct Balance {
  double level = 0, down = 0, energy = 0;
};
Balance balance(const std::vector<FlightRow>& rows, double mass) {
  const auto angle = [](const FlightRow& row) { return row.state.path_angle * std::numbers::pi / 180; };
  const auto of = [&](const FlightRow& row) {
    return Vec3{row.force * std::cos(angle(row)), row.force * std::sin(angle(row)),
                row.force * row.state.speed};
  };
  Vec3 sum;
  for (std::size_t i = 1; i < rows.size(); ++i)
    sum = sum + (of(rows[i - 1]) + of(rows[i])) * (0.5 * (rows[i].state.time - rows[i - 1].state.time));
  const FlightState &a = rows.front().state, &b = rows.back().state;
  const auto change = [&](double (*turn)(double)) {
    return mass * (b.speed * turn(angle(rows.back())) - a.speed * turn(angle(rows.front())));
  };
  const double momentum = mass * a.speed, energy = 0.5 * mass * a.speed * a.speed;
  return {
      (change([](double x) { return std::cos(x); }) + sum.x) / momentum,
      (change([](double x) { return std::sin(x); }) + sum.y - mass * standard_gravity * (b.time - a.time)) /
          momentum,
      (0.5 * mass * b.speed * b.speed - energy + mass * standard_gravity * (b.height - a.height) + sum.z) /
          energy};
}

// Over whole flights with every stage and every joint between them. The rule's own error goes with the square of the
// steps, 400 a filling: some 1 / 400^2.
TEST(Load, EveryFlightKeepsMomentumAndEnergy) {
  for (const double angle : {0.0, 45.0, 90.0})
    for (const double mass : {0.5, 8.0, 100.0})
      for (const bool reefed : {false, true}) {
        LoadRequest asked = request(mass, 70);
        asked.path_angle = angle, asked.height = 3000;
        if (reefed) asked.reefing = {{0.1, 2}, {0.4, 2}};
        const LoadResult r = run_load(resolve(flat_circular()), asked);
        const Balance left = balance(r.flight, r.payload_mass + r.parachute_mass);
        for (const double open : {left.level, left.down, left.energy})
          EXPECT_NEAR(open, 0, 1e-5) << angle << " " << mass << " " << reefed;
      }
}

TEST(Load, AComputedOpeningIsOneOfTheMethodsThatAreJudged) {
  const TemporaryFolder folder("load-opening");
  const Case given = small_opening();
  InflationObserver quiet;
  run_inflation_in(
      {{folder.path / "run", false}, 1, 0}, resolve(given), {"given", {}},
      [&] { return InflationProblem{parachute_mesh(resolve(given)), given.inflation, 500, false, 1, 6}; },
      quiet);
  LoadRequest asked = request();
  asked.opening = folder.path / "run";
  const LoadResult r = run_load(resolve(given), asked);
  ASSERT_EQ(r.stages.size(), 1u);
  EXPECT_EQ(method(r.stages[0], "computed opening").load, *r.record_peak_load);
  EXPECT_NE(method(r.stages[0], "computed opening").note.find("one disk-gap-band parachute"),
            std::string::npos);
  EXPECT_TRUE(std::any_of(r.warnings.begin(), r.warnings.end(), [](const std::string& text) {
    return text.find("not a prediction") != std::string::npos;
  }));
  asked.speed = 1;
  EXPECT_NE(refusal_of([&] { run_load(resolve(given), asked); }, ExitCode::usage).find("give --angle 0"),
            std::string::npos);
  asked = request();
  asked.opening = folder.path / "run";
  expect_judged(r.stages[0]);
  // That canopy was not reefed.
  asked.reefing = {{0.3, 1}};
  const LoadResult reefed = run_load(resolve(given), asked);
  for (const StageLoads& stage : reefed.stages)
    for (const MethodLoad& one : stage.methods) EXPECT_NE(one.method, "computed opening");
}

TEST(Load, TakesTheDragAreaOfASteadyRunAndNamesIt) {
  const TemporaryFolder folder("load-steady");
  fly_square_law(folder.path / "run");
  LoadRequest asked = request();
  asked.steady = folder.path / "run";
  const LoadResult r = run_load(resolve(square_law_case()), asked);
  EXPECT_NEAR(r.drag_coefficient * r.reference_area, 1.1, 1e-3);
  EXPECT_EQ(r.drag_source, "steady run " + asked.steady.string() + ", drag area 1.1 m2");
}

TEST(Load, AHeavyPayloadIsAtInfiniteMass) {
  LoadRequest asked = request(20000, 900);
  asked.path_angle = 0;
  const StageLoads stage = run_load(resolve(flat_circular()), asked).stages[0];
  EXPECT_TRUE(method(stage, "infinite mass").applies);
  EXPECT_LT(stage.spread, 0.02);
}

TEST(Load, ReefingInStagesLowersTheHighestLoad) {
  const double open = run_load(resolve(flat_circular()), request(8, 60)).peak_load;
  LoadRequest asked = request(8, 60);
  asked.reefing = {{0.1, 2}, {0.4, 2}};
  const LoadResult r = run_load(resolve(flat_circular()), asked);
  ASSERT_EQ(r.stages.size(), 3u);
  EXPECT_LT(r.peak_load, 0.6 * open);
  EXPECT_NEAR(r.stages[1].begin, 2, 1e-9);
  EXPECT_NEAR(r.stages[2].begin, 4, 1e-9);
  EXPECT_LT(r.stages[1].speed, 60);
  EXPECT_FALSE(method(r.stages[2], "Pflanz").applies);
}

TEST(Load, OfAStageThatIsCutBeforeItHasFilledOnlyTheTrajectoryApplies) {
  LoadRequest asked = request(8, 25);
  asked.reefing = {{0.1, 0.05}};
  const StageLoads stage = run_load(resolve(flat_circular()), asked).stages[0];
  ASSERT_GT(stage.filling_time, 0.05);
  for (const MethodLoad& m : stage.methods) EXPECT_EQ(m.applies, m.method == "trajectory") << m.method;
}

TEST(Load, WithASnatchSpeedHasTheSnatchLoad) {
  LoadRequest asked = request();
  EXPECT_FALSE(run_load(resolve(flat_circular()), asked).snatch);
  asked.snatch_speed = 5;
  const LoadResult r = run_load(resolve(flat_circular()), asked);
  ASSERT_TRUE(r.snatch);
  EXPECT_NEAR(r.snatch->line_load * 12, r.snatch->load, 1e-9 * r.snatch->load);
}

TEST(Load, WithASnatchLoadAboveTheDesignLoadTheHardwareIsForTheSnatchLoad) {
  LoadRequest asked = request();
  const auto warned = [](const LoadResult& r) {
    return std::any_of(r.warnings.begin(), r.warnings.end(), [](const std::string& text) {
      return text.find("exceeds the design load") != std::string::npos;
    });
  };
  asked.snatch_speed = 0.1;
  const LoadResult slow = run_load(resolve(flat_circular()), asked);
  ASSERT_LT(slow.snatch->load, slow.design_load);
  EXPECT_FALSE(warned(slow));
  EXPECT_EQ(slow.hardware.rated, slow.highest_design_load);
  asked.snatch_speed = 60;
  const LoadResult fast = run_load(resolve(flat_circular()), asked);
  ASSERT_GT(fast.snatch->load, fast.design_load);
  EXPECT_TRUE(warned(fast));
  EXPECT_EQ(fast.hardware.rated, fast.snatch->load);
}

// Every estimate is that of flight/opening_load.h, whose own tests have its numbers, in the conditions of its stage.
TEST(Load, EveryMethodIsAskedInTheConditionsOfItsStage) {
  LoadRequest asked = request(8, 60);
  asked.path_angle = 30, asked.height = 2000, asked.impulse_integral = 0.4;
  asked.reefing = {{0.3, 2}};
  const LoadResult r = run_load(resolve(flat_circular()), asked);
  ASSERT_EQ(r.stages.size(), 2u);
  const double open = r.drag_coefficient * r.reference_area;
  EXPECT_EQ(r.stages[0].height, 2000);
  EXPECT_EQ(r.stages[0].speed, 60);
  for (const StageLoads& stage : r.stages) {
    const bool last = &stage == &r.stages.back();
    EXPECT_DOUBLE_EQ(stage.drag_area, last ? open : 0.3 * open);
    EXPECT_DOUBLE_EQ(stage.drag_area_before, last ? 0.3 * open : 0);
    EXPECT_EQ(stage.density, standard_air(stage.height).density);
    const auto begin = std::find_if(r.flight.begin(), r.flight.end(),
                                    [&](const FlightRow& row) { return row.state.time >= stage.begin; });
    ASSERT_NE(begin, r.flight.end());
    EXPECT_EQ(begin->state.speed, stage.speed);
    EXPECT_EQ(begin->state.height, stage.height);
    OpeningConditions c{r.payload_mass + r.parachute_mass,
                        stage.speed,
                        stage.density,
                        stage.drag_area,
                        stage.filling_time,
                        2,
                        r.opening_coefficient,
                        begin->state.path_angle};
    EXPECT_DOUBLE_EQ(stage.ballistic_parameter, ballistic_parameter(c));
    EXPECT_DOUBLE_EQ(stage.mass_ratio, mass_ratio(c));
    EXPECT_DOUBLE_EQ(method(stage, "infinite mass").load,
                     r.design_drag_coefficient / r.drag_coefficient * infinite_mass_load(c).load);
    EXPECT_EQ(method(stage, "infinite mass").time, 0);
    EXPECT_DOUBLE_EQ(method(stage, "Pflanz").load, pflanz_load(c).load);
    EXPECT_DOUBLE_EQ(method(stage, "Pflanz").time, pflanz_load(c).time);
    const MomentumImpulse impulse = momentum_impulse_load(c, 0.4);
    EXPECT_DOUBLE_EQ(method(stage, "momentum-impulse").load, impulse.load.load);
    EXPECT_EQ(method(stage, "momentum-impulse").applies, !last);
    const bool slowed = pflanz_load(c).load <= 0.9 * infinite_mass_load(c).load;
    c.exponent = 6;  // Ludtke's of solid cloth
    EXPECT_DOUBLE_EQ(method(stage, "Ludtke").load, ludtke_load(c).load);
    EXPECT_DOUBLE_EQ(method(stage, "Ludtke").time, ludtke_load(c).time);
    for (const char* fills : {"Pflanz", "Ludtke"}) {
      EXPECT_EQ(method(stage, fills).applies, !last);
      EXPECT_EQ(method(stage, fills).note,
                last ? "assumes filling from zero drag area, unlike this stage" : "");
    }
    EXPECT_EQ(method(stage, "infinite mass").applies, !slowed);
    EXPECT_EQ(method(stage, "infinite mass").note,
              slowed ? "constant speed is assumed; with this payload the speed decreases during filling"
                     : "the speed decreases little during filling");
    EXPECT_EQ(method(stage, "momentum-impulse")
                      .note.find("assumes filling from zero drag area; the speed after filling is ") == 0,
              last);
  }
  // The highest force of the whole flight, and of each stage its own.
  const auto highest =
      std::max_element(r.flight.begin(), r.flight.end(),
                       [](const FlightRow& a, const FlightRow& b) { return a.force < b.force; });
  EXPECT_EQ(r.peak_load, highest->force);
  EXPECT_EQ(r.peak_time, highest->state.time);
  for (const StageLoads& stage : r.stages) {
    const MethodLoad& flown = method(stage, "trajectory");
    const auto row = std::find_if(r.flight.begin(), r.flight.end(),
                                  [&](const FlightRow& other) { return other.force == flown.load; });
    ASSERT_NE(row, r.flight.end());
    EXPECT_NEAR(row->state.time - stage.begin, flown.time, 1e-12);
  }
  EXPECT_EQ(r.steady_time, r.flight.back().state.time);
  EXPECT_EQ(r.steady_speed, r.flight.back().state.speed);
  EXPECT_EQ(r.steady_drop, 2000 - r.flight.back().state.height);
}

TEST(Load, SlowFillingUnderGravityExcludesMethodsWithoutIt) {
  const StageLoads stage = run_load(resolve(flat_circular()), request(8, 15)).stages[0];
  const double share = standard_gravity * stage.filling_time / 15;
  ASSERT_GT(share, 0.3);
  EXPECT_FALSE(method(stage, "Pflanz").applies || method(stage, "Ludtke").applies);
  const std::string note = method(stage, "Pflanz").note;
  EXPECT_EQ(note.find("neglects gravity, which adds "), 0u) << note;
  EXPECT_NEAR(std::stod(note.substr(29)), 100 * share, 0.51) << note;
  LoadRequest level = request(8, 15);
  level.path_angle = 0;  // none along the path
  EXPECT_TRUE(method(run_load(resolve(flat_circular()), level).stages[0], "Pflanz").applies);
}

// Between two legs no row is left out and none is there twice.
TEST(Load, TheRowsOfItsLegsFollowEachOtherWithoutAGap) {
  LoadRequest asked = request(8, 60);
  asked.reefing = {{0.1, 2}, {0.4, 2}};
  const std::vector<FlightRow> rows = run_load(resolve(flat_circular()), asked).flight;
  const auto step = [&](std::size_t i) { return rows[i].state.time - rows[i - 1].state.time; };
  EXPECT_EQ(rows[0].state.time, 0);
  for (std::size_t i = 2; i + 1 < rows.size(); ++i) {
    EXPECT_GT(step(i), 0) << i;
    EXPECT_LT(step(i), 1.01 * std::max(step(i - 1), step(i + 1))) << i;
  }
}

TEST(Load, GivenValuesReplaceThoseOfTheHandbook) {
  LoadRequest asked = request();
  asked.filling_constant.reset();
  const LoadResult own = run_load(resolve(flat_circular()), asked);
  EXPECT_DOUBLE_EQ(own.drag_coefficient, 0.775);
  EXPECT_EQ(own.drag_source, "middle of 0.75 to 0.80 (Knacke)");
  EXPECT_EQ(own.opening_coefficient, 1.7);
  EXPECT_EQ(own.filling_constant, 8);
  EXPECT_EQ(own.filling_exponent, 2);
  EXPECT_EQ(own.ludtke_exponent, 6);
  EXPECT_EQ(own.filling_source, known_filling("flat-circular").source);
  EXPECT_NE(own.opening_source, "given");
  asked.filling_constant = 5;
  EXPECT_EQ(run_load(resolve(flat_circular()), asked).filling_source,
            own.filling_source);  // the exponents are still its
  asked.drag_coefficient = 0.6, asked.opening_coefficient = 1.5, asked.filling_exponent = 1;
  const LoadResult given = run_load(resolve(flat_circular()), asked);
  EXPECT_EQ(given.drag_coefficient, 0.6);
  EXPECT_EQ(given.opening_coefficient, 1.5);
  EXPECT_EQ(given.filling_constant, 5);
  EXPECT_EQ(given.filling_exponent, 1);
  EXPECT_EQ(given.ludtke_exponent, 1);
  for (const std::string& source : {given.drag_source, given.opening_source, given.filling_source})
    EXPECT_EQ(source, "given");
}

TEST(Load, TheSnatchOfAPackedCanopyFollowsFromHowItIsSlowed) {
  Case given = flat_circular();
  given.parachute.riser.length_m = 0.5;
  Line line = suspension_line(given);
  line.break_load_n = 400;
  given.materials.insert_or_assign(line.name, line);
  LoadRequest asked = request();
  asked.packed_drag_area = 0.05, asked.payload_drag_area = 0.01;
  const LoadResult r = run_load(resolve(given), asked);
  ASSERT_TRUE(r.snatch);
  const Design& design = given.parachute;
  const double apart = speed_difference_at_stretch({2.4, 0.01}, {r.parachute_mass, 0.05}, 30,
                                                   standard_air(500).density, design.lines.length_m + 0.5);
  EXPECT_DOUBLE_EQ(r.snatch->speed_difference, apart);
  const SnatchLoad load =
      snatch_load(2.4, r.parachute_mass, apart,
                  {{"", suspension_line(given).coefficients_n, design.lines.count, design.lines.length_m},
                   {"", riser_line(given).coefficients_n, 1, 0.5}});
  EXPECT_DOUBLE_EQ(r.snatch->load, load.load);
  EXPECT_DOUBLE_EQ(*r.snatch->time, load.time);
  EXPECT_DOUBLE_EQ(*r.snatch->stretch, load.stretch);
  EXPECT_DOUBLE_EQ(r.snatch->line_load, load.load / design.lines.count);
  EXPECT_DOUBLE_EQ(r.snatch->line_margin.value(), 400 / r.snatch->line_load);
}

TEST(Load, ImpossibleInputIsRefused) {
  EXPECT_NE(refused(request(-2)).find("payload mass (kg) of -2"), std::string::npos);
  EXPECT_NE(refused(request(2, 0)).find("speed at line stretch (m/s) of 0"), std::string::npos);
  EXPECT_NE(refused(request(50, 10)).find("is above the 10 m/s of the deployment"), std::string::npos);
  LoadRequest asked = request();
  asked.reefing = {{0.4, 2}, {0.1, 2}};
  EXPECT_NE(refused(asked).find("reefed stage"), std::string::npos);
  asked = request();
  asked.ground = 600;
  EXPECT_NE(refused(asked).find("above the ground"), std::string::npos);
  for (const double angle : {120.0, -91.0, std::nan("")}) {
    asked = request();
    asked.path_angle = angle;
    EXPECT_NE(refused(asked).find("below the horizon"), std::string::npos) << angle;
  }
  using Coefficient = std::optional<double> LoadRequest::*;
  for (const auto& [coefficient, name] :
       {std::pair<Coefficient, const char*>{&LoadRequest::drag_coefficient, "drag coefficient of 0"},
        {&LoadRequest::opening_coefficient, "opening coefficient C_x of 0"},
        {&LoadRequest::filling_constant, "filling constant n of 0"},
        {&LoadRequest::filling_exponent, "exponent of the drag area of 0"}}) {
    asked = request();
    asked.*coefficient = 0.0;
    EXPECT_NE(refused(asked).find(name), std::string::npos) << name << "\n" << refused(asked);
  }
  asked = request();
  asked.steady = "/nowhere";
  EXPECT_NE(refused(asked).find("no finished run"), std::string::npos);
  asked.steady.clear();
  asked.opening = "/nowhere";
  EXPECT_NE(refused(asked).find("no finished run of ripstop inflate"), std::string::npos);
}

TEST(Load, ItsFilesHaveTheWholeWay) {
  const TemporaryFolder folder("load");
  LoadResult r = run_load(resolve(flat_circular()), request());
  write_load(folder.path, r);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "trajectory_computed.csv"));
  r.record_flight.assign(r.flight.begin(), r.flight.begin() + 10);
  write_load(folder.path, r);
  EXPECT_EQ(read_csv(folder.path / "trajectory_computed.csv").rows.size(), 10u);
  const CsvTable table = read_csv(folder.path / "trajectory.csv");
  EXPECT_EQ(table.rows.size(), r.flight.size());
  const std::vector<double> force = table.column("force_n"), time = table.column("time_s");
  EXPECT_DOUBLE_EQ(*std::max_element(force.begin(), force.end()), r.peak_load);
  EXPECT_TRUE(std::is_sorted(time.begin(), time.end()));
  for (const char* file : {"force.png", "speed.png", "result.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.path / file)) << file;
}

}  // namespace
}  // namespace ripstop
