// The tape of a parachute that names none follows from its load, and there may be none.
#include "ripstop/case/tape.h"

#include <gtest/gtest.h>

#include <numbers>

#include "../small_case.h"
#include "ripstop/canopy/margins.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/payload.h"
#include "ripstop/case/resolve.h"
#include "ripstop/case/summary.h"
#include "ripstop/core/error.h"
#include "ripstop/parachute/ringslot.h"
#include "ripstop/run/sizing/fabric.h"
#include "ripstop/run/sizing/pattern.h"

namespace ripstop {
namespace {

Case without_a_name(double diameter, double speed) {
  Case given = flat_circular_case(diameter, 1500, speed);
  given.parachute.tape.material.reset();
  return checked(given);
}

// The tables of docs/ were computed with it.
TEST(Tape, OfEveryExampleIsNamed) {
  for (const CanopyFamily* family : families()) {
    const Case given =
        read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / family->example / "case.toml");
    EXPECT_EQ(given.parachute.tape.material, "nylon-tape") << family->example;
  }
}

// [NFM]'s tape would be 19 g there.
TEST(Tape, OfASmallCanopyIsLighterThanItsCloth) {
  const PartMasses named = summarize(resolve(checked(flat_circular_case(0.5, 1500, 10)))).mass;
  EXPECT_GT(named.tape, named.cloth);
  for (const double speed : {5.0, 10.0, 30.0, 50.0}) {
    const PartMasses mass = summarize(resolve(without_a_name(0.5, speed))).mass;
    // Twelve gores of 0.225 m with 15 mm of seam on either side, hems of 20 mm along 1.73 m of skirt and vent.
    const double cut = std::numbers::pi / 4 * 0.25 + 12 * 0.03 * 0.265 + 0.02 * 1.73;
    EXPECT_NEAR(mass.cloth, 0.0407 * cut, 5e-4);
    EXPECT_LT(mass.tape, mass.cloth) << speed;
  }
}

TEST(Tape, GrowsWithSpeedAndWithSize) {
  const auto mass_per_length = [](double diameter, double speed) {
    const Case given = without_a_name(diameter, speed);
    const Tape* tape = reinforcement_tape(given);
    return tape ? tape->linear_density_kg_m : 0;
  };
  EXPECT_EQ(mass_per_length(1, 10), 0);
  EXPECT_GT(mass_per_length(1, 50), 0);
  EXPECT_GT(mass_per_length(1, 100), mass_per_length(1, 50));
  EXPECT_GT(mass_per_length(4, 20), 0);
  EXPECT_GT(mass_per_length(10, 20), mass_per_length(4, 20));
}

// C_x 1.7 times the upper end of 0.75 to 0.80 times S0 q, over 12 lines; the factors of [margins] as everywhere.
TEST(Tape, IsTheLightestThatCarriesALinesLoadAtTheOpening) {
  const Case given = without_a_name(2, 50);
  const double load = 1.7 * 0.80 * nominal_area(given.parachute) * 0.5 * 1.2 * 50 * 50 / 12;
  const double left = 0.8 * 0.95 * 0.95 * 0.95 / 1.5;
  const Tape* chosen = reinforcement_tape(given);
  ASSERT_TRUE(chosen);
  EXPECT_GE(chosen->break_load_n * left, load);
  int lighter = 0;
  for (const auto& [name, material] : given.materials)
    if (const Tape* tape = std::get_if<Tape>(&material))
      if (tape->linear_density_kg_m < chosen->linear_density_kg_m) {
        ++lighter;
        const double strength = tape->break_load_n > 0 ? tape->break_load_n : 142;  // [NFM]'s, at 30 % strain
        EXPECT_LT(strength * left, load) << name;
      }
  EXPECT_GE(lighter, 1);
  Case safe = given;
  safe.margins.safety_factor = 4;
  EXPECT_GT(reinforcement_tape(checked(safe))->break_load_n, chosen->break_load_n);
}

TEST(Tape, IsNoneUpToTheLoadThatAHemOfTheClothCarries) {
  const Case given = without_a_name(1, 10);
  const double strength = 0.02 * canopy_fabric(given).break_load_n_m * 0.8 * 0.95 * 0.95 * 0.95 / 1.5;
  EXPECT_EQ(tape_for(given, 0.99 * strength).name, no_tape);
  EXPECT_EQ(tape_for(given, 1.01 * strength).name, "nylon-tape-200-lbf");
  const TapeMaterial beyond = tape_for(given, 1e6);
  EXPECT_EQ(beyond.name, "nylon-tape-1000-lbf");
  EXPECT_NE(beyond.from.find("too weak"), std::string::npos) << beyond.from;
}

TEST(Tape, OfAPayloadIsForTheSpeedAtWhichItOpens) {
  Case given = flat_circular_case(3, 1500, 5);
  given.parachute.tape.material.reset();
  EXPECT_EQ(tape_material(checked(given)).name, no_tape);
  given.payload.mass_kg = 10;
  EXPECT_NE(tape_material(checked(given)).name, no_tape);
  EXPECT_NE(tape_material(checked(given)).from.find("20 m/s"), std::string::npos);
}

TEST(UsualOpening, IsAtTheDeploymentSpeedOfTheCaseAlsoIfAnOpeningWithThePayloadIsComputed) {
  Case given = flat_circular_case(3, 1500, 5);
  given.parachute.tape.material.reset();
  given.payload.mass_kg = 10;
  const UsualOpening assumed = usual_opening(checked(given));
  EXPECT_EQ(assumed.speed, least_deployment_speed);
  EXPECT_EQ(assumed.from.find("assumed"), 0u) << assumed.from;
  given.payload.deployment_speed_m_s = 30;
  const UsualOpening known = usual_opening(checked(given));
  EXPECT_EQ(known.speed, 30);
  EXPECT_EQ(known.from, "payload.deployment_speed_m_s of the case");
  EXPECT_NEAR(known.load / assumed.load, 2.25, 1e-12);
  EXPECT_NE(tape_material(checked(given)).from.find("at 30 m/s (payload.deployment_speed_m_s of the case)"),
            std::string::npos);
  given.inflation.mass = InflationSettings::Mass::payload, given.inflation.air = AirModel::coupled;
  EXPECT_EQ(usual_opening(checked(given)).speed, 30);
  given.payload.deployment_speed_m_s.reset();
  EXPECT_EQ(usual_opening(checked(given)).speed, 5);
  EXPECT_EQ(usual_opening(checked(given)).from, "flow.speed_m_s");
}

TEST(Tape, HasItsOriginAndIsWrittenOut) {
  const Case given = without_a_name(1, 50);
  const Settings resolved = resolve(given);
  const Source& source = resolved.source("parachute.tape.material");
  EXPECT_FALSE(source.given);
  EXPECT_NE(source.from.find("the lightest tape that carries"), std::string::npos) << source.from;
  EXPECT_EQ(resolved.written().parachute.tape.material, "nylon-tape-200-lbf");
  const Case again = parse_case(case_toml(resolve(given)), "written.toml");
  EXPECT_EQ(case_toml(resolve(again)), case_toml(resolve(given)));
  int tapes = 0;
  for (const auto& [name, material] : again.materials) tapes += std::holds_alternative<Tape>(material);
  EXPECT_EQ(tapes, 1);
  const Case named = checked(flat_circular_case(1, 1500, 50));
  EXPECT_TRUE(resolve(named).source("parachute.tape.material").given);
}

TEST(Tape, OfARingslotIsThereForItsVerticalTapes) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/ringslot/case.toml");
  given.parachute.tape.material.reset();
  given.flow.speed_m_s = 5;
  EXPECT_EQ(tape_material(checked(given)).name, "nylon-tape-200-lbf");
  given.parachute.canopy.as<Ringslot>()->vertical_tapes = 0;
  EXPECT_EQ(tape_material(checked(given)).name, no_tape);
}

TEST(NoTape, OfAnyFamilyLeavesClothAndLinesThatFindTheirRest) {
  for (const CanopyFamily* family : families()) {
    Overrides none;
    none.set = {{"parachute.tape.material", "none", "--set"},
                {"parachute.mesh.cloth_nodes", "1500", "--set"}};
    if (std::string(family->type) == "ringslot")
      none.set.push_back({"parachute.vertical_tapes", "0", "--set"});
    const Case given = read_case(
        std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / family->example / "case.toml", none);
    EXPECT_EQ(reinforcement_tape(given), nullptr);
    EXPECT_TRUE(parachute_mesh(resolve(given)).rigging.tape_springs.empty()) << family->type;
    EXPECT_EQ(summarize(resolve(given)).mass.tape, 0) << family->type;
    const PatternResult pattern = run_pattern(resolve(given), {}, 400);
    EXPECT_TRUE(pattern.pattern.tapes.empty()) << family->type;
    const FabricSolution still = run_fabric(resolve(given), 100);
    EXPECT_TRUE(still.result.converged) << family->type;
    EXPECT_NEAR(still.result.line_tension / still.result.pressure_load, 1, 0.01) << family->type;
  }
}

std::string refused(const std::string& example, std::vector<Setting> set) {
  Overrides overrides;
  overrides.set = std::move(set);
  try {
    read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / example / "case.toml", overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(NoTape, IsRefusedWhereVerticalTapesAreAskedFor) {
  const std::string said = refused("ringslot", {{"parachute.tape.material", "none", "--set"}});
  EXPECT_NE(said.find("parachute.vertical_tapes = 2"), std::string::npos) << said;
  EXPECT_NE(said.find("parachute.tape.material"), std::string::npos) << said;
}

TEST(Tape, ThatThereIsNotAndAWordThatIsNoNameAreRefused) {
  const std::string near = refused("conical", {{"parachute.tape.material", "nylon-tap", "--set"}});
  EXPECT_NE(near.find("parachute.tape.material"), std::string::npos) << near;
  EXPECT_NE(near.find("did you mean \"nylon-tape\""), std::string::npos) << near;
  EXPECT_NE(
      refused("conical", {{"parachute.tape.material", "spectra-line", "--set"}}).find("a tape is needed"),
      std::string::npos);
  EXPECT_NE(refused("conical", {{"parachute.tape.material", "../x", "--set"}}).find("must be a name"),
            std::string::npos);
  EXPECT_NE(refused("conical", {{"parachute.tape.material", "3", "--set"}}).find("must be text"),
            std::string::npos);
}

}  // namespace
}  // namespace ripstop
