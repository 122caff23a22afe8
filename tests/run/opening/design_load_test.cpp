// Which opening load is used for design, and which methods are outside their range.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "ripstop/case/tape.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/validity.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/parachute/disk_gap_band.h"
#include "ripstop/run/opening/fastest.h"
#include "ripstop/run/opening/handbook.h"
#include "ripstop/run/opening/load.h"
#include "tests/refusal.h"
#include "tests/run/opening/method_of.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

Case sized_canopy(double diameter) {
  return checked(flat_circular_case(diameter, 1500, 20));
}

/// 2.4 kg at 20 m/s, near the ground.
LoadRequest drop(double mass = 2.4, double speed = 20) {
  LoadRequest r;
  r.payload_mass = mass, r.speed = speed, r.height = 300;
  return r;
}

bool mentions(const std::vector<std::string>& all, const std::string& text) {
  return std::any_of(all.begin(), all.end(),
                     [&](const std::string& one) { return one.find(text) != one.npos; });
}

// Handbook methods of finite mass give some 100 to 140 N for this drop, a computed opening 718 N. 1.76 m is smaller
// than the canopies on which filling distances were measured; the design load is C_x C_D S0 q.
TEST(DesignLoad, OfASmallSlowCanopyIsThatOfInfiniteMass) {
  const LoadResult r = run_load(resolve(sized_canopy(1.76)), drop());
  const double q = 0.5 * standard_air(300).density * 400, expected = 1.7 * 0.80 * r.reference_area * q;
  EXPECT_NEAR(r.design_load, expected, 1e-9 * expected);
  EXPECT_GT(r.design_load, 718);
  EXPECT_EQ(r.design_load_from.find("infinite mass, C_x C_D S0 q with C_D 0.80 (handbook, in descent)"), 0u);
  const StageLoads& stage = r.stages.front();
  EXPECT_FALSE(method(stage, "Pflanz").applies) << "straight down gravity adds a third to the speed";
  for (const char* name : {"momentum-impulse", "trajectory"}) {
    EXPECT_TRUE(method(stage, name).applies) << name;
    EXPECT_LT(method(stage, name).load, 170) << name;
  }
  EXPECT_NE(stage.caution.find("nominal diameter of 1.76 m is outside the range"), std::string::npos)
      << stage.caution;
  EXPECT_NE(stage.caution.find("fills faster is larger"), std::string::npos);
  EXPECT_LT(stage.highest, 0.25 * r.design_load);
}

// C_x is the handbook's, for drag coefficients of 0.75 to 0.80.
TEST(DesignLoad, WithTheHandbooksOpeningCoefficientHasAtLeastItsDragCoefficient) {
  const auto designed = [](double drag_coefficient,
                           std::optional<double> opening_coefficient = std::nullopt) {
    LoadRequest asked = drop();
    asked.drag_coefficient = drag_coefficient, asked.opening_coefficient = opening_coefficient;
    return run_load(resolve(sized_canopy(1.76)), asked);
  };
  const LoadResult handbook = designed(0.80), small = designed(0.64);
  EXPECT_EQ(handbook.design_load_from, "infinite mass, C_x C_D S0 q");
  EXPECT_NEAR(small.design_load, handbook.design_load, 1e-9 * handbook.design_load);
  EXPECT_NE(small.design_load_from.find("with C_D 0.80 (handbook, in descent)"), std::string::npos)
      << small.design_load_from;
  EXPECT_NEAR(designed(0.88).design_load, 0.88 / 0.80 * handbook.design_load, 1e-9 * handbook.design_load);
  // of the user, for this coefficient
  EXPECT_NEAR(designed(0.64, small.opening_coefficient).design_load, 0.64 / 0.80 * handbook.design_load,
              1e-9 * handbook.design_load);
}

TEST(DesignLoad, WithinTheirRangeTheMethodsApplyAndTheDesignLoadStays) {
  LoadRequest asked = drop(100, 60);
  asked.path_angle = 0;
  const LoadResult r = run_load(resolve(sized_canopy(8.5)), asked);
  for (const char* name : {"Pflanz", "Ludtke", "momentum-impulse", "trajectory"})
    EXPECT_TRUE(method(r.stages.front(), name).applies) << name;
  EXPECT_EQ(r.design_load, method(r.stages.front(), "infinite mass").load);
  EXPECT_LT(r.stages.front().highest, r.design_load);
}

// Straight down, near its rate of descent, the weight adds to the load of a small drogue.
TEST(DesignLoad, IsThatOfAMethodThatAppliesAndHasMoreThanInfiniteMass) {
  LoadRequest asked = drop(23, 25);
  asked.path_angle = 90;
  const LoadResult r = run_load(resolve(sized_canopy(1.1)), asked);
  const StageLoads& stage = r.stages.front();
  double largest = 0;
  for (const MethodLoad& m : stage.methods)
    if (m.applies) largest = std::max(largest, m.load);
  ASSERT_GT(largest, 1.01 * method(stage, "infinite mass").load);
  EXPECT_EQ(r.design_load, largest);
  EXPECT_NE(r.design_load_from.find("more than infinite mass"), std::string::npos) << r.design_load_from;
}

TEST(DesignLoad, OfAMeasurementIsTheMeasurement) {
  LoadRequest asked = drop();
  asked.measured_load = 251;
  const LoadResult r = run_load(resolve(sized_canopy(1.76)), asked);
  EXPECT_EQ(r.design_load, 251);
  EXPECT_EQ(r.design_load_from, "measured, as given");
  asked.measured_load = 0;
  EXPECT_NE(refusal_of([&] { run_load(resolve(sized_canopy(1.76)), asked); }, ExitCode::usage)
                .find("measured opening load"),
            std::string::npos);
}

TEST(DesignLoad, AtMach088IsOutsideTheRangeOfEveryMethod) {
  LoadRequest asked = drop(100, 300);
  asked.height = 1000, asked.path_angle = 0;
  const LoadResult r = run_load(resolve(sized_canopy(8.5)), asked);
  for (const MethodLoad& m : r.stages.front().methods) {
    if (m.method != infinite_mass_method) {
      EXPECT_FALSE(m.applies) << m.method;
    }
  }
  EXPECT_TRUE(mentions(r.warnings, "Mach number of 0.892 is outside the range")) << r.warnings.front();
}

TEST(DesignLoad, LinesThatDoNotHoldItAreAWarningInWords) {
  Case given = sized_canopy(8.5);
  Line line = suspension_line(given);
  line.break_load_n = 100;
  given.materials.insert_or_assign(line.name, line);
  const LoadResult r = run_load(resolve(given), drop(100, 60));
  ASSERT_TRUE(r.margins);
  EXPECT_EQ(r.margins->weakest, "line");
  EXPECT_TRUE(mentions(r.warnings, "line exceeds its allowable load"));
  // The margin of the warning is the one that the result states.
  EXPECT_TRUE(mentions(r.warnings, "(margin of safety " + margin_text(*r.smallest_margin) + ")"));
  EXPECT_TRUE(mentions(r.warnings, ". The load is that under the highest design load"));
}

// A steady run of the example has 1.43 times the mean tension in the lines at the corners of a cross.
TEST(DesignLoad, OfACrossTheMostLoadedLineCarriesMoreThanAnEqualShare) {
  const Case cross = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/cross/case.toml");
  const LoadResult r = run_load(resolve(cross), drop(2.4, 28));
  EXPECT_NEAR(r.line_load_factor, 1.43, 1e-12);
  EXPECT_NEAR(r.margins->members.front().load, 1.43 * r.design_load / cross.parachute.lines.count, 1e-9);
}

// The stage is cut when it has filled to half: the drag area continues from there. Compared with small steps
// in time.
TEST(DesignLoad, AStageCutBeforeItHasFilledContinuesFromItsDragArea) {
  LoadRequest asked = drop(50, 60);
  asked.height = 2000, asked.path_angle = 0, asked.filling_constant = 8;
  const Case given = sized_canopy(4);
  const double filling = run_load(resolve(given), asked).stages.front().filling_time * std::sqrt(0.5);
  asked.reefing = {{0.5, 0.7 * filling}};
  const LoadResult r = run_load(resolve(given), asked);
  ASSERT_EQ(r.stages.size(), 2u);
  const double open = r.drag_coefficient * r.reference_area;
  EXPECT_NEAR(r.stages[1].drag_area_before, 0.5 * open * 0.49, 1e-9 * open);
  for (std::size_t i = 1; i < r.flight.size(); ++i)
    EXPECT_LT(std::abs(r.flight[i].drag_area - r.flight[i - 1].drag_area), 0.02 * open)
        << r.flight[i].state.time;
  const double mass = r.payload_mass + r.parachute_mass, t1 = 0.7 * filling, dt = 1e-5;
  const double before = 0.245 * open, t2 = r.stages[1].filling_time, end = t2 * std::sqrt(1.7);
  double v = 60, down = 0, time = 0, peak = 0;
  for (; time < t1 + 2 * t2; time += dt) {
    const double s = time - t1, grown = std::pow(std::min(s, end) / t2, 2);
    double area = s < 0 ? 0.5 * open * std::pow(time / filling, 2)
                        : before + (open - before) * std::min(grown, 1.0) + open * std::max(grown - 1, 0.0);
    if (s > end) area = open * (1.7 - 0.7 * std::min(1.0, (s - end) / t2));
    const double speed = std::hypot(v, down), drag = 0.5 * standard_air(2000).density * speed * area / mass;
    peak = std::max(peak, drag * mass * speed);
    v -= dt * drag * v, down += dt * (9.80665 - drag * down);
  }
  EXPECT_NEAR(r.peak_load / peak, 1, 2e-3);
}

TEST(DesignLoad, AComputedPeakOutsideTheHandbooksRangeIsReportedWithTheReason) {
  const std::vector<MethodLoad> methods = {{infinite_mass_method, 900, 0, false, ""},
                                           {"Pflanz", 107, 0, false, ""},
                                           {"trajectory", 134, 0, false, ""}};
  const auto above = handbook_disagreement(718, 1.25, methods);
  ASSERT_TRUE(above);
  EXPECT_NE(above->find("718 N is 5.4 times the highest finite-mass handbook load (trajectory: 134 N)"),
            std::string::npos)
      << *above;
  EXPECT_NE(above->find("design for at least 718 N"), std::string::npos) << *above;
  EXPECT_NE(handbook_disagreement(80, {}, methods)->find("at least 134 N"), std::string::npos);
  EXPECT_NE(above->find("after 1.2 nominal diameters"), std::string::npos) << *above;
  EXPECT_TRUE(handbook_disagreement(80, {}, methods));
  EXPECT_FALSE(handbook_disagreement(150, {}, methods));  // within the scatter of openings
  EXPECT_FALSE(handbook_disagreement(718, {}, {}));
}

// Coupled openings of solid canopies with a heavy payload exceed the infinite-mass load (docs/validation/inflation.md).
TEST(DesignLoad, WithAHeavyPayloadOfASolidCanopyIsWarnedOf) {
  Case disk_gap_band = flat_circular_case(1.76, 1500, 20);
  disk_gap_band.parachute.canopy = DiskGapBand{1.0, 0.09, 0.07, 0.3};
  const Settings solid = resolve(sized_canopy(1.76)), slotted = resolve(checked(disk_gap_band));
  const auto caution = [](const Settings& canopy, const LoadRequest& asked) {
    const LoadResult r = run_load(canopy, asked);
    EXPECT_EQ(mentions(r.warnings, "the payload is heavy for this canopy"), !r.design_load_caution.empty());
    return r.design_load_caution;
  };
  EXPECT_EQ(caution(solid, drop(2.4)), "");
  LoadRequest heavy = drop(40);
  heavy.path_angle = 0;
  EXPECT_NE(caution(solid, heavy).find("up to 2.5 times"), std::string::npos);
  EXPECT_EQ(caution(slotted, heavy), "");
  LoadRequest measured = heavy;
  measured.measured_load = 1000;
  EXPECT_EQ(caution(solid, measured), "");
  EXPECT_TRUE(mentions(run_fastest(solid, heavy, 0).warnings, "the payload is heavy for this canopy"));
}

TEST(DesignLoad, TheRangeOfTheFiniteMassMethodsOmitsInfiniteMassAndMethodsThatDoNotApply) {
  std::vector<MethodLoad> methods;
  methods = {{infinite_mass_method, 617, 0, true, ""}};
  EXPECT_FALSE(finite_mass_range(methods));
  methods.push_back({"Pflanz", 700, 0, false, ""});
  EXPECT_FALSE(finite_mass_range(methods));
  methods.push_back({"Ludtke", 500, 0, true, ""});
  methods.push_back({"trajectory", 485, 0, true, ""});
  methods.push_back({"momentum-impulse", 520, 0, true, ""});
  methods.push_back({computed_method, 900, 0, true, ""});
  const auto range = finite_mass_range(methods);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->lowest, 485);
  EXPECT_EQ(range->highest, 520);
}

TEST(DesignLoad, AMeasuredLoadBelowEveryEstimateIsWarnedOf) {
  const Settings canopy = resolve(sized_canopy(1.76));
  LoadRequest asked = drop();
  const double lowest = run_load(canopy, asked).stages.front().lowest;
  const auto warned = [&](double measured) {
    asked.measured_load = measured;
    return mentions(run_load(canopy, asked).warnings, "is below every applicable estimate");
  };
  EXPECT_TRUE(warned(0.9 * lowest));
  EXPECT_FALSE(warned(1.1 * lowest));
}

// The mass ratio of a reefed stage is that of its own drag area.
TEST(DesignLoad, AReefedStageWithAHeavyPayloadIsNamedInTheCaution) {
  LoadRequest asked = drop(20, 27);
  asked.reefing = {{0.2, 1}};
  const LoadResult r = run_load(resolve(sized_canopy(4.43)), asked);
  ASSERT_GT(r.stages.back().mass_ratio, 1);
  EXPECT_EQ(r.design_load_caution.find("the payload is heavy for the stage from 0.00 s"), 0u)
      << r.design_load_caution;
}

TEST(DesignLoad, AComputedOpeningAboveTheInfiniteMassLoadIsWarnedOf) {
  EXPECT_FALSE(above_infinite_mass(1149, 1000, true));  // within the scatter of openings
  const auto above = above_infinite_mass(1820, 1000, true);
  ASSERT_TRUE(above);
  EXPECT_NE(above->find("1.8 times the infinite-mass load of 1000 N"), std::string::npos) << *above;
  EXPECT_NE(above->find("at least 1820 N at this speed and mass"), std::string::npos) << *above;
  EXPECT_NE(above_infinite_mass(1820, 1000, false)->find("with a payload that hardly decelerates"),
            std::string::npos);
}

LoadResult load_in(std::optional<double> case_height, std::optional<double> case_density, LoadRequest asked) {
  Case given = flat_circular_case(1.76, 1500, 20);
  given.flow.height_m = case_height, given.flow.density_kg_m3 = case_density;
  return run_load(resolve(checked(given)), asked);
}

// A default height would make the load of a case at sea level 9 % smaller at 1000 m, without a word.
TEST(DesignLoad, WithoutAHeightTheAirIsThatOfTheCase) {
  LoadRequest asked = drop();
  asked.height.reset();
  const LoadResult sea = load_in(0, {}, asked), hill = load_in(300, {}, asked),
                   thin = load_in({}, 1.1, asked);
  EXPECT_EQ(sea.height, 0);
  EXPECT_EQ(sea.density, standard_air(0).density);
  EXPECT_EQ(sea.air_source, "flow.height_m = 0 m of the case");
  EXPECT_TRUE(sea.steady_reached);
  EXPECT_EQ(hill.height, 300);
  EXPECT_EQ(thin.density, 1.1);
  EXPECT_NEAR(thin.height, standard_height(1.1), 1e-9);
  EXPECT_EQ(thin.air_source, "flow.density_kg_m3 of the case");
  for (const LoadResult* r : {&sea, &hill, &thin}) {
    EXPECT_DOUBLE_EQ(r->stages.front().density, r->density);
    EXPECT_NEAR(r->design_load / r->density, sea.design_load / sea.density, 1e-9 * sea.design_load);
  }
}

TEST(DesignLoad, AGivenHeightOrGroundReplacesTheAirOfTheCaseAndStatesSo) {
  const LoadResult given = load_in({}, 1.1, drop());
  EXPECT_EQ(given.density, standard_air(300).density);
  EXPECT_NE(given.air_source.find("in place of the 1.1 kg/m3 of the case"), std::string::npos)
      << given.air_source;
  LoadRequest plateau = drop();
  plateau.height.reset(), plateau.ground = 1500;
  const LoadResult high = load_in(0, {}, plateau);
  EXPECT_EQ(high.height, 1500);
  EXPECT_EQ(high.density, standard_air(1500).density);
  EXPECT_EQ(load_in({}, 1.1, plateau).density, 1.1) << "a density that is given stays";
  EXPECT_EQ(load_in(2000, {}, plateau).height, 2000);
}

// Denser than the standard atmosphere anywhere: all of the flight has that air.
TEST(DesignLoad, ADensityThatNoHeightHasIsTaken) {
  LoadRequest asked = drop();
  asked.height.reset();
  const LoadResult r = load_in({}, 5, asked);
  EXPECT_EQ(r.height, lowest_height);
  EXPECT_DOUBLE_EQ(r.flight.front().density, 5);
}

TEST(DesignLoad, TheResultHasTheStateAtLineStretch) {
  LoadRequest asked = drop();
  asked.path_angle = 40;
  const auto json = nlohmann::json::parse(to_json(run_load(resolve(sized_canopy(1.76)), asked)));
  EXPECT_EQ(json.at("speed_m_s"), 20);
  EXPECT_EQ(json.at("path_angle_deg"), 40);
  EXPECT_EQ(json.at("height_m"), 300);
  EXPECT_EQ(json.at("density_kg_m3"), standard_air(300).density);
  EXPECT_FALSE(json.at("air_from").get<std::string>().empty());
  EXPECT_EQ(json.at("stages").at(0).at("path_angle_deg"), 40);
  EXPECT_EQ(json.at("required_load_n"), json.at("highest_design_load_n"));
}

// Drag area 10 % and scatter of openings 15 %, as independent parts; a measured load has the scatter only.
TEST(DesignLoad, TheHighestOneContainsTheUncertainty) {
  const Settings canopy = resolve(sized_canopy(1.76));
  LoadRequest asked = drop();
  asked.drag_coefficient = 0.7;
  const LoadResult r = run_load(canopy, asked);
  EXPECT_NEAR(r.highest_design_load / r.design_load, 1 + std::hypot(0.10, 0.15), 1e-12);
  EXPECT_EQ(r.required_load, r.highest_design_load);
  EXPECT_EQ(r.hardware.rated, r.highest_design_load);
  asked.measured_load = 500;
  const LoadResult measured = run_load(canopy, asked);
  EXPECT_NEAR(measured.highest_design_load, 575, 1e-9);
  EXPECT_EQ(measured.load_uncertainty_from.find("drag area"), std::string::npos)
      << measured.load_uncertainty_from;
}

// `check` chooses the tape, and `inflate` compares with the infinite-mass load; both are that of `load`.
TEST(DesignLoad, OfTheTapeAndOfAnInflationIsThatOfTheLoadCommand) {
  for (const std::optional<double> coefficient :
       {std::optional<double>(), std::optional(0.64), std::optional(0.9)}) {
    Case given = flat_circular_case(1.76, 1500, 20);
    given.inflation.drag_coefficient = coefficient;
    given.parachute.tape.material.reset();
    const Settings resolved = resolve(checked(given));
    LoadRequest asked = drop();
    asked.height.reset();
    const LoadResult load = run_load(resolved, asked);
    const auto edge = std::find_if(load.margins->members.begin(), load.margins->members.end(),
                                   [](const Margin& m) { return m.member == "hem" || m.member == "tape"; });
    ASSERT_NE(edge, load.margins->members.end());
    EXPECT_NEAR(tape_material(checked(given)).used, edge->used.value(), 1e-9);
    const double q = 0.5 * load.density * 400;
    const OpeningEstimate estimate =
        opening_estimate(resolved.parachute(), load.drag_coefficient * load.reference_area * q, q);
    EXPECT_NEAR(estimate.load.value(), load.design_load, 1e-9 * load.design_load);
  }
}

TEST(DesignLoad, TheDragCoefficientOfTheCaseIsTaken) {
  Case given = flat_circular_case(1.76, 1500, 20);
  given.inflation.drag_coefficient = 0.687;
  const LoadResult r = run_load(resolve(checked(given)), drop());
  EXPECT_EQ(r.drag_coefficient, 0.687);
  EXPECT_EQ(r.drag_source, "inflation.drag_coefficient of the case");
}

TEST(ValidRanges, AreSoundAndNameTheirSource) {
  for (const ValidRange& r : valid_ranges()) {
    EXPECT_LT(r.low, r.high) << r.model;
    EXPECT_GE(r.refused_above, r.high) << r.model;
    EXPECT_GT(std::string(r.source).size(), 5u) << r.model;
  }
  EXPECT_TRUE(outside_range(flow_model, {{"Mach number", 0.29}, {"Reynolds number", 1e5}}).empty());
  EXPECT_EQ(outside_range(flow_model, {{"Mach number", 0.31}}).size(), 1u);
  const auto too_fast = [] { outside_range(scaled_drag_model, {{"Mach number", 1.1}}); };
  EXPECT_NE(refusal_of(too_fast, ExitCode::usage).find("above 1 it gives no result"), std::string::npos);
}

}  // namespace
}  // namespace ripstop
