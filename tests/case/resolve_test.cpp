// What follows where a case says nothing: from parachute, cloth and other values, never from
// which keys were typed.
#include "ripstop/case/resolve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "fixture.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/engines.h"
#include "ripstop/parachute/flat_circular.h"

namespace ripstop {
namespace {

using Json = nlohmann::ordered_json;

constexpr double d = 0.7 * 3.0;  // its inflated diameter

const std::string open_jet =
    "tunnel = { kind = \"open-jet\", shape = \"rectangle\", width_m = 6, height_m = 5, nozzle_distance_m = "
    "4.5, "
    "collector_distance_m = 14, outside_speed = 0.03, shear_layer_m = 0.1 }\n";

std::string of_calibrated_cloth(const std::string& text) {
  return replaced(text, "gores = 12", "gores = 12\ncanopy_material = \"f-111\"");
}

FlowSettings flow_of(const std::string& text) {
  return resolve(parse_case(text, "case.toml")).flow();
}

/// Every key that stands in a table, with its value as TOML.
void collect(const Json& node, const std::string& name, std::vector<Setting>& leaves) {
  if (node.is_object()) {
    for (const auto& [key, child] : node.items())
      collect(child, name.empty() ? key : name + "." + key, leaves);
  } else if (node.is_array() && !node.empty() && node.front().is_object()) {
    for (std::size_t i = 0; i < node.size(); ++i)
      collect(node[i], name + "[" + std::to_string(i) + "]", leaves);
  } else {
    leaves.push_back({name, node.dump(), "--set"});
  }
}

namespace fs = std::filesystem;

/// A file of the repository.
std::string shipped_text(const char* file) {
  return read_text_file(fs::path(RIPSTOP_SOURCE_DIR) / file);
}

/// The ten lines of the README.
std::string readme_case() {
  const std::string readme = shipped_text("README.md"), fence = "```";
  const std::size_t begin = readme.find(fence + "toml\n") + fence.size() + 5;
  return readme.substr(begin, readme.find(fence, begin) - begin);
}

// A case of each porosity model, cases that give a part of what belongs together, and what people start from.
const std::vector<std::pair<std::string, std::string>> cases = {
    {"sheet", short_case},
    {"sheet in a narrow box", valid_case},
    {"sheet in a box of its own", short_case + "box_m = [8, 8, 10]\n"},
    {"sheet with cells of its own", short_case + "cells = [60, 60, 70]\n"},
    {"sheet with a core of its own", short_case + "core = { size_m = [4.4, 4.4, 5] }\n"},
    {"sheet with another growth", short_case + "core = { growth = 1.2 }\n"},
    {"sheet at another place", short_case + "canopy_position_m = 7.5\n"},
    {"sheet with few iterations", short_case + "max_iterations = 40\n"},
    {"sheet with slip", short_case + "sides = \"slip\"\nconvection = \"upwind\"\n"},
    {"sheet in an open jet",
     short_case + "tunnel = { kind = \"open-jet\", shape = \"octagon\", width_m = 6 }\n"},
    {"sheet in a jet up to its collector", short_case + open_jet},
    {"sheet between walls", short_case + "tunnel = { kind = \"closed\", width_m = 5, height_m = 4, "
                                         "displacement_thickness_m = 0.03 }\n"},
    {"paper in a jet", of_calibrated_cloth(replaced(short_case, "= 3.0\nvent", "= 1.0\nvent")) +
                           "tunnel = { kind = \"open-jet\", width_m = 2 }\n"},
    {"paper", of_calibrated_cloth(replaced(short_case, "= 3.0\nvent", "= 1.0\nvent"))},
    {"paper's numbers as a sheet", of_calibrated_cloth(short_case) + "porosity_model = \"sheet\"\n"},
    {"a sheet's numbers as cells", replaced(short_case, "= 3.0\nvent", "= 1.0\nvent") +
                                       "porosity_model = \"paper\"\nbox_m = [2.5, 2.5, 5]\n"},
    {"README", readme_case()},
    {"Stratos IV, with its opening", shipped_text("examples/stratos-iv/case.toml")},
    {"ringslot", shipped_text("examples/ringslot/case.toml")},
    {"cross", shipped_text("examples/cross/case.toml")},
    {"elliptical, a profile", shipped_text("examples/elliptical/case.toml")},
    {"an opening under a pressure of its own",
     short_case + "[inflation]\npressure_pa = 200\nline_segment_m = 0.1\n"},
};

TEST(Resolved, ToWriteADefaultsOwnValueChangesNothingWhateverTheKey) {
  for (const auto& [name, text] : cases) {
    const std::string plain = case_json(resolve(parse_case(text, "case.toml")));
    std::vector<Setting> leaves;
    collect(Json::parse(plain), "", leaves);
    EXPECT_GT(leaves.size(), 90u) << name;
    for (const Setting& leaf : leaves) {
      Overrides one;
      one.set = {leaf};
      EXPECT_EQ(case_json(resolve(parse_case(text, "case.toml", one))), plain)
          << name << ": " << leaf.key << " = " << leaf.value;
    }
  }
}

TEST(Resolved, ToWriteAnyOfThemTogetherChangesNothing) {
  std::mt19937 random(3);
  for (const auto& [name, text] : cases) {
    const std::string plain = case_json(resolve(parse_case(text, "case.toml")));
    std::vector<Setting> leaves;
    collect(Json::parse(plain), "", leaves);
    for (int i = 0; i < 20; ++i) {
      Overrides some;
      for (const Setting& leaf : leaves)
        if (random() % 3 == 0) some.set.push_back(leaf);
      EXPECT_EQ(case_json(resolve(parse_case(text, "case.toml", some))), plain) << name;
    }
  }
}

TEST(Resolved, AWrittenCaseReadsAgainAsTheSameCase) {
  for (const auto& [name, text] : cases) {
    const Case given = parse_case(text, "case.toml");
    const Case again = parse_case(case_toml(resolve(given)), "written");
    EXPECT_EQ(case_json(resolve(again)), case_json(resolve(given))) << name;
    EXPECT_EQ(flow_grid(resolve(again).flow()), flow_grid(resolve(given).flow())) << name;
  }
}

TEST(Resolved, DoesNotHangOnWhereValuesCameFrom) {
  for (const auto& [name, text] : cases) {
    const Case given = parse_case(text, "case.toml");
    Case made = given;
    made.origins.clear();
    EXPECT_EQ(case_json(resolve(made)), case_json(resolve(given))) << name;
  }
}

TEST(Resolved, ASheetStandsInABoxThatScalesWithTheCanopy) {
  const Case given = parse_case(short_case, "short");
  const FlowSettings flow = resolve(given).flow();
  EXPECT_EQ(flow.porosity_model, PorosityModel::sheet);
  EXPECT_EQ(flow.sides, Sides::entraining);
  EXPECT_EQ(flow.outlet, Outlet::still_air);
  EXPECT_EQ(flow.convection, Convection::second_order);
  EXPECT_NEAR(flow.box_m.x, 6 * d, 1e-9);
  EXPECT_NEAR(flow.box_m.z, 9 * d, 1e-9);
  EXPECT_NEAR(flow.canopy_position_m, 4 * d, 1e-9);
  const FlowGrid grid = flow_grid(flow);
  EXPECT_NEAR(grid.spacing().x / d, 0.04, 0.002);
  EXPECT_NEAR(grid.spacing().z / d, 0.04, 0.002);
  const FlowProblem problem = flow_problem(resolve(given));
  ASSERT_EQ(problem.bodies.size(), 1u);
  ASSERT_TRUE(problem.bodies[0].is_sheet());
  EXPECT_EQ(problem.bodies[0].drop().linear, 8169.3);
}

TEST(Resolved, TheProblemOfTheFlowHasEveryValueOfTheCase) {
  const Case given = parse_case(
      replaced(short_case, "density_kg_m3 = 1.2", "density_kg_m3 = 1.1") +
          "viscosity_pa_s = 1.7e-5\ntemperature_k = 280\nturbulence_intensity = 0.02\n"
          "viscosity_ratio = 5\nresidual = 2e-4\nmax_iterations = 70\naverage_over = 20\nunsteady = true\n"
          "watch = { courant = 0.6, standard_error = 0.03, shortest = 40, longest = 90 }\n",
      "case.toml");
  const SteadyProblem problem = steady_problem(resolve(given));
  EXPECT_EQ(problem.flow.air, (Freestream{{0, 0, 8}, 1.1, 1.7e-5, 280, 0.02, 5}));
  EXPECT_EQ(problem.flow.stopping.residual, 2e-4);
  EXPECT_EQ(problem.flow.stopping.max_iterations, 70);
  EXPECT_EQ(problem.flow.stopping.average_over, 20);
  EXPECT_EQ(problem.flow.grid.cells(), flow_grid(resolve(given).flow()).cells());
  EXPECT_EQ(problem.flow.sides, Sides::entraining);
  EXPECT_EQ(problem.flow.outlet, Outlet::still_air);
  EXPECT_EQ(problem.reference_area, nominal_area(given.parachute));
  EXPECT_EQ(problem.settings.drag_tolerance, resolve(given).coupling().drag_tolerance);
  ASSERT_TRUE(problem.averaging_window.has_value());
  EXPECT_EQ(problem.averaging_window->courant, 0.6);
  EXPECT_EQ(problem.averaging_window->standard_error, 0.03);
  EXPECT_EQ(problem.averaging_window->shortest, 40);
  EXPECT_EQ(problem.averaging_window->longest, 90);
  EXPECT_EQ(problem.averaging_window->length, inflated_diameter(given.parachute));
  EXPECT_FALSE(steady_problem(resolve(parse_case(short_case, "short"))).averaging_window.has_value());
}

TEST(Resolved, AnOpenJetStandsInAWideBoxOfStillAirThatBeginsAtTheNozzle) {
  const Case given = parse_case(
      short_case + "tunnel = { kind = \"open-jet\", shape = \"octagon\", width_m = 6 }\n", "case.toml");
  const FlowSettings flow = resolve(given).flow();
  EXPECT_EQ(flow.sides, Sides::entraining);
  EXPECT_EQ(flow.outlet, Outlet::still_air);
  EXPECT_NEAR(flow.box_m.x, 2.8 * 6, 1e-9);
  EXPECT_NEAR(flow.canopy_position_m, 6, 1e-9);
  EXPECT_NEAR(flow.box_m.z, 6 + 12, 1e-9);
  const FlowProblem problem = flow_problem(resolve(given));
  ASSERT_TRUE(problem.jet.has_value());
  EXPECT_EQ(problem.jet->nozzle, (Nozzle{NozzleShape::octagon, 6, 0}));
  EXPECT_EQ(problem.air.speed(), 8);
  const FlowSettings placed = flow_of(short_case + open_jet);
  EXPECT_EQ(placed.canopy_position_m, 4.5);
  EXPECT_EQ(placed.box_m.z, 14) << "the collector";
  EXPECT_NEAR(placed.box_m.y, 2.8 * 5, 1e-9);
  // The place of the canopy is the same distance.
  const FlowSettings by_place =
      flow_of(short_case + "canopy_position_m = 5\ntunnel = { kind = \"open-jet\", width_m = 6 }\n");
  EXPECT_EQ(by_place.tunnel.nozzle_distance_m, 5);
}

TEST(Resolved, AnAngleOfAttackTurnsTheStreamOfTheFlowProblemAndIsRefusedByASteadyRun) {
  const Settings turned =
      resolve(parse_case(short_case + "angle_of_attack_deg = 30\nazimuth_deg = 90\n", "case.toml"));
  const FlowProblem problem = flow_problem(turned);
  const double speed = turned.flow().speed_m_s;
  EXPECT_NEAR(problem.air.velocity.x, 0, 1e-12);
  EXPECT_NEAR(problem.air.velocity.y, 0.5 * speed, 1e-12);
  EXPECT_NEAR(problem.air.velocity.z, std::sqrt(0.75) * speed, 1e-12);
  try {
    steady_problem(turned);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("flow.angle_of_attack_deg = 30"), std::string::npos);
  }
}

TEST(Resolved, TheWallsOfAClosedTestSectionAreTheSidesOfTheBox) {
  const FlowSettings flow =
      flow_of(short_case +
              "tunnel = { kind = \"closed\", width_m = 9, height_m = 5, displacement_thickness_m = 0.05 }\n");
  EXPECT_EQ(flow.sides, Sides::slip);
  EXPECT_NEAR(flow.box_m.x, 8.9, 1e-12);
  EXPECT_NEAR(flow.box_m.y, 4.9, 1e-12);
  EXPECT_NEAR(flow.box_m.z, 9 * d, 1e-12);
  EXPECT_NEAR(flow.core.size_m.x, 1.8 * d, 1e-12);
  EXPECT_EQ(flow.core.size_m.y, 0) << "too low for cells that grow";
  EXPECT_FALSE(jet_of(flow.tunnel).has_value());
}

TEST(Resolved, WhatATunnelCannotBeIsSaidWithItsKey) {
  const auto tunnel = [](const std::string& keys) { return short_case + "tunnel = { " + keys + " }\n"; };
  const std::string jet = "kind = \"open-jet\", width_m = 6";
  const std::pair<std::string, std::string> mistakes[] = {
      {tunnel("kind = \"open-jet\""), "flow.tunnel.width_m"},
      {tunnel("width_m = 6"), "flow.tunnel.width_m"},
      {tunnel("kind = \"closed\", width_m = 6, shear_layer_m = 0.1"), "flow.tunnel.shear_layer_m"},
      {tunnel(jet + ", displacement_thickness_m = 0.1"), "flow.tunnel.displacement_thickness_m"},
      {tunnel(jet + ", height_m = 5"), "flow.tunnel.height_m"},
      {tunnel("kind = \"closed\", width_m = 6, shape = \"octagon\""), "flow.tunnel.shape"},
      {tunnel("kind = \"closed\", width_m = 6, displacement_thickness_m = 3.1"),
       "flow.tunnel.displacement_thickness_m"},
      {tunnel(jet + ", nozzle_distance_m = 5") + "canopy_position_m = 4\n", "flow.tunnel.nozzle_distance_m"},
      {tunnel(jet + ", collector_distance_m = 12") + "box_m = [17, 17, 14]\n",
       "flow.tunnel.collector_distance_m"},
      {tunnel(jet) + "box_m = [8, 17, 18]\n", "flow.box_m[0]"},
      {tunnel(jet) + "sides = \"zero-gradient\"\n", "flow.sides"},
      {tunnel("kind = \"closed\", width_m = 6") + "sides = \"entraining\"\n", "flow.sides"},
      {tunnel("kind = \"closed\", width_m = 6") + "box_m = [6, 7, 18]\n", "flow.box_m[1]"},
  };
  for (const auto& [text, key] : mistakes) {
    const Outcome outcome = outcome_of(text);
    ASSERT_EQ(outcome.problems.size(), 1u) << key << ": " << outcome.message;
    EXPECT_EQ(outcome.problems[0].key, key) << outcome.message;
  }
}

TEST(Resolved, EachPartOfTheBoxFollowsByItself) {
  const FlowSettings whole = flow_of(short_case);
  // The place alone: box, cells and the core's size stay, the core goes along.
  const FlowSettings placed = flow_of(short_case + "canopy_position_m = 7.5\n");
  EXPECT_EQ(placed.box_m, whole.box_m);
  EXPECT_EQ(placed.cells, whole.cells);
  EXPECT_EQ(placed.core.size_m, whole.core.size_m);
  EXPECT_NEAR(placed.core.start_m, whole.core.start_m + 7.5 - 4 * d, 1e-12);
  // The box alone: the core stays as wide as the canopy asks for.
  const FlowSettings boxed = flow_of(short_case + "box_m = [8, 8, 12]\n");
  EXPECT_EQ(boxed.core.size_m, whole.core.size_m);
  EXPECT_EQ(boxed.cells, whole.cells);
  EXPECT_EQ(boxed.canopy_position_m, 6) << "half the length of a box that is shorter than usual";
  EXPECT_EQ(flow_of(short_case + "box_m = [8, 8, 30]\n").canopy_position_m, whole.canopy_position_m);
  // A core alone and cells alone: the box stays.
  const FlowSettings cored = flow_of(short_case + "core = { size_m = [4.4, 4.4, 5] }\n");
  EXPECT_EQ(cored.box_m, whole.box_m);
  EXPECT_EQ(cored.core.growth, whole.core.growth);
  const FlowSettings coarse = flow_of(short_case + "cells = [60, 60, 70]\n");
  EXPECT_EQ(coarse.box_m, whole.box_m);
  EXPECT_EQ(coarse.core.size_m, whole.core.size_m);
}

TEST(Resolved, InTimeTheCellsLieBesideTheCanopysAxis) {
  EXPECT_EQ(flow_of(short_case).core.off_axis, 0);
  EXPECT_EQ(flow_of(short_case + "unsteady = true\nbox_m = [8, 7.5, 10]\n").core.off_axis, 0)
      << "uniform cells";
  EXPECT_EQ(flow_of(short_case + "unsteady = true\ncore = { off_axis = 0 }\n").core.off_axis, 0);
  const FlowSettings in_time = flow_of(short_case + "unsteady = true\n");
  EXPECT_EQ(in_time.core.off_axis, 0.25);
  const FlowGrid grid = flow_grid(in_time), steady = flow_grid(flow_of(short_case));
  EXPECT_EQ(grid.nx, steady.nx);
  for (const auto& [axis, off] : {std::pair{0, 0.25}, std::pair{1, 0.125}, std::pair{2, 0.0}}) {
    const double cell = grid.width(axis, grid.count(axis) / 2);
    const auto middle = [axis = axis](const FlowGrid& of) {
      return 0.5 * (of.grading[axis].core_low + of.grading[axis].core_high);
    };
    EXPECT_NEAR(middle(grid) - middle(steady), off * cell, 2e-3 * cell) << axis;
    EXPECT_NEAR(grid.edge(axis, 0), steady.edge(axis, 0), 1e-12) << "the box stays where it is";
    EXPECT_NEAR(grid.edge(axis, grid.count(axis)), steady.edge(axis, steady.count(axis)), 1e-12);
  }
}

TEST(Resolved, ABoxThatACoreWouldHalfFillHasUniformCells) {
  EXPECT_EQ(flow_of(valid_case).core.size_m, Vec3{});
  EXPECT_EQ(flow_of(short_case + "box_m = [8, 7.5, 10]\n").core.size_m, Vec3{})
      << "2 x 1.8 x 2.1 m is 7.56 m";
  EXPECT_EQ(flow_of(short_case + "box_m = [8, 7.6, 10]\n").core.size_m, d * (Vec3{1.8, 1.8, 2.2}));
}

TEST(Resolved, WhatTheCaseSaysOfTheCouplingStays) {
  Case given = parse_case(short_case, "case.toml");
  given.coupling.max_iterations = 7, given.coupling.shape_tolerance_m = 3e-3,
  given.coupling.cloth_tolerance = 7e-4;
  const CouplingSettings coupling = resolve(given).coupling();
  EXPECT_EQ(coupling.max_iterations, 7);
  EXPECT_EQ(coupling.shape_tolerance_m, 3e-3);
  EXPECT_EQ(coupling.cloth_tolerance, 7e-4);
}

TEST(Resolved, ACoreThatHasNoRoomSaysWhy) {
  const auto from = [](const std::string& text) -> std::string {
    return resolve(parse_case(text, "case.toml")).source("flow.core.size_m").from;
  };
  EXPECT_EQ(from(short_case), "1.8 x 1.8 x 2.2 inflated diameters of 2.1 m");
  EXPECT_EQ(from(short_case + "box_m = [8, 7.5, 10]\n"),
            "a side of the domain is less than twice as long as the core of this canopy");
  EXPECT_EQ(from(of_calibrated_cloth(replaced(short_case, "= 3.0\nvent", "= 1.0\nvent"))),
            "default of the paper model");
}

TEST(Resolved, TheMeanOfIterationsIsOfNoMoreThanThereAre) {
  EXPECT_EQ(flow_of(short_case).average_over, 60);
  EXPECT_EQ(flow_of(short_case + "max_iterations = 40\n").average_over, 40);
}

TEST(Resolved, ClothWithCalibratedCoefficientsStandsInThePapersBox) {
  const Case given =
      parse_case(of_calibrated_cloth(replaced(short_case, "= 3.0\nvent", "= 1.0\nvent")), "paper");
  const FlowSettings flow = resolve(given).flow();
  EXPECT_EQ(flow.porosity_model, PorosityModel::paper);
  EXPECT_EQ(flow.box_m, (Vec3{2, 2, 4}));
  EXPECT_EQ(flow.canopy_position_m, 2);
  EXPECT_EQ(flow.core.size_m, Vec3{});
  EXPECT_EQ(flow.sides, Sides::zero_gradient);
  EXPECT_EQ(flow.outlet, Outlet::fixed_pressure);
  EXPECT_EQ(flow.residual, 1e-5);
  EXPECT_EQ(flow.average_over, 0);
  EXPECT_EQ(resolve(given).coupling().drag_tolerance, 1e-3);
  EXPECT_FALSE(flow_problem(resolve(given)).bodies.at(0).is_sheet());
}

TEST(Resolved, WhatIsChangedLaterIsFollowedAgain) {
  Case given = parse_case(short_case, "short");
  given.parachute.canopy = FlatCircular{1.5, 0.15};
  EXPECT_NEAR(resolve(given).flow().box_m.x, 3 * d, 1e-9);
  apply({.grid = std::array{60, 60, 70}}, given);
  EXPECT_NEAR(resolve(given).flow().box_m.x, 3 * d, 1e-9);
  EXPECT_EQ(resolve(given).flow().cells, (std::array{60, 60, 70}));
}

TEST(Resolved, EveryValueSaysWhatItFollowedFrom) {
  Overrides overrides;
  overrides.grid = std::array{60, 60, 70};
  overrides.set = {parse_setting("flow.residual=1e-4", "--set")};
  const Settings resolved = resolve(parse_case(short_case + "sides = \"slip\"\n", "case.toml", overrides));
  EXPECT_EQ(source_of(resolved, "flow.sides"), "given in case.toml, line 11");
  EXPECT_EQ(source_of(resolved, "flow.cells"), "given by --grid");
  EXPECT_EQ(source_of(resolved, "flow.residual"), "given by --set");
  EXPECT_EQ(source_of(resolved, "flow.box_m"), "6 x 6 x 9 inflated diameters of 2.1 m");
  EXPECT_EQ(source_of(resolved, "flow.convection"), "default of the sheet model");
  EXPECT_EQ(source_of(resolved, "coupling.drag_tolerance"), "default of the sheet model");
}

TEST(Resolved, TheReadmesBoxStaysWithTheCanopyWhereItStandsAlready) {
  const FlowSettings plain = flow_of(readme_case());
  EXPECT_EQ(plain.box_m, (Vec3{6, 6, 9}) * 0.7);
  EXPECT_NEAR(plain.canopy_position_m, 2.8, 1e-12);
  const FlowSettings placed = flow_of(readme_case() + "canopy_position_m = 2.8\n");
  EXPECT_EQ(placed.box_m, plain.box_m);
  EXPECT_EQ(placed.core.size_m, plain.core.size_m);
  EXPECT_NEAR(placed.core.start_m, plain.core.start_m, 1e-12);
}

TEST(Resolved, OfASheetOpenFoamTakesTheDefaultsThatItHas) {
  const Case given = parse_case(short_case + "engine = \"openfoam\"\n", "case.toml");
  const FlowSettings flow = resolve(given).flow();
  EXPECT_EQ(flow.porosity_model, PorosityModel::sheet);
  EXPECT_EQ(flow.sides, Sides::slip);
  EXPECT_EQ(flow.outlet, Outlet::fixed_pressure);
  EXPECT_EQ(flow.average_over, 0);
  const FlowSettings own = resolve(parse_case(short_case, "case.toml")).flow();
  EXPECT_EQ(own.sides, Sides::entraining);
  EXPECT_EQ(own.outlet, Outlet::still_air);
  EXPECT_EQ(own.average_over, 60);
}

TEST(Resolved, ASheetIsRefusedForAnEngineWithoutSheetsBeforeAnythingIsComputed) {
  EngineRecord engine = engine_of("openfoam");
  engine.word = "without-sheets", engine.can.sheets = false;
  add_engine(engine);
  const Outcome outcome = outcome_of(short_case + "engine = \"without-sheets\"\n");
  ASSERT_EQ(outcome.problems.size(), 1u);
  EXPECT_EQ(outcome.problems[0].key, "flow.engine");
  EXPECT_NE(outcome.problems[0].message.find("f-111-physical"), std::string::npos);
}

TEST(Resolved, WhatOpenFoamHasNotIsRefusedWhenTheCaseIsRead) {
  const std::string paper = of_calibrated_cloth(short_case) + "box_m = [8, 8, 10]\nengine = \"openfoam\"\n";
  EXPECT_TRUE(outcome_of(paper).valid);
  const Outcome jet = outcome_of(paper + "tunnel = { kind = \"open-jet\", width_m = 5 }\nsides = \"slip\"\n" +
                                 "outlet = \"fixed-pressure\"\n");
  ASSERT_EQ(jet.problems.size(), 1u) << jet.message;
  EXPECT_EQ(jet.problems[0].key, "flow.tunnel.kind");
  for (const std::string key : {"sides = \"entraining\"", "average_over = 20", "outlet = \"still-air\""}) {
    const Outcome outcome = outcome_of(paper + key + "\n");
    ASSERT_EQ(outcome.problems.size(), 1u) << key << outcome.message;
    EXPECT_EQ(outcome.problems[0].key, "flow." + key.substr(0, key.find(' ')));
  }
}

TEST(Resolved, AFittedMeshIsOpenFoamsAndOfASheet) {
  const std::string fitted = "mesh = \"fitted\"\ncloth_levels = 2\n", openfoam = "engine = \"openfoam\"\n";
  const auto key_of = [](const std::string& flow) {
    const Outcome outcome = outcome_of(flow);
    return outcome.problems.empty() ? "none" : outcome.problems[0].key;
  };
  EXPECT_EQ(key_of(short_case + openfoam + fitted), "none");
  EXPECT_EQ(key_of(short_case + fitted), "flow.mesh");
  EXPECT_EQ(key_of(of_calibrated_cloth(short_case) + "box_m = [8, 8, 10]\n" + openfoam + fitted),
            "flow.mesh");
  EXPECT_EQ(key_of(short_case + openfoam + "cloth_levels = 2\n"), "flow.cloth_levels");
}

TEST(Resolved, AnOpeningInItsOwnAirWantsASheetAndAPayloadThatFliesAMass) {
  const auto key_of = [](const std::string& more, const std::string& start = short_case) {
    const Outcome outcome = outcome_of(start + more);
    return outcome.problems.empty() ? "none" : outcome.problems[0].key + ": " + outcome.problems[0].value;
  };
  const std::string coupled = "[inflation]\nair = \"coupled\"\n", flies = "mass = \"payload\"\n";
  EXPECT_EQ(key_of(coupled), "none");
  EXPECT_EQ(key_of(coupled, of_calibrated_cloth(short_case) + "box_m = [8, 8, 10]\n"),
            "inflation.air: \"coupled\"");
  EXPECT_EQ(key_of(coupled + flies), "inflation.mass: \"payload\"");
  EXPECT_EQ(key_of(coupled + flies + "[payload]\nmass_kg = 2\n"), "none");
  EXPECT_EQ(key_of("[inflation]\n" + flies + "[payload]\nmass_kg = 2\n"), "inflation.mass: \"payload\"");
  EXPECT_EQ(
      key_of(coupled + flies + "[payload]\nmass_kg = 2\n[flow.tunnel]\nkind = \"open-jet\"\nwidth_m = 3\n"),
      "inflation.mass: \"payload\"");
}

TEST(Resolved, AnUnsteadyFlowWantsAnEngineThatHasTimeAndAWatchThatCanBe) {
  EXPECT_TRUE(outcome_of(short_case + "unsteady = true\n").valid);
  const Outcome engine = outcome_of(of_calibrated_cloth(short_case) +
                                    "box_m = [8, 8, 10]\nengine = \"openfoam\"\nunsteady = true\n");
  ASSERT_EQ(engine.problems.size(), 1u) << engine.message;
  EXPECT_EQ(engine.problems[0].key, "flow.unsteady");
  const Outcome payload = outcome_of(short_case + "unsteady = true\n[payload]\nmass_kg = 2\n");
  ASSERT_EQ(payload.problems.size(), 1u) << payload.message;
  EXPECT_EQ(payload.problems[0].key, "flow.unsteady");
  const Outcome watch = outcome_of(short_case + "[flow.watch]\nshortest = 60\nlongest = 100\n");
  ASSERT_EQ(watch.problems.size(), 1u) << watch.message;
  EXPECT_EQ(watch.problems[0].key, "flow.watch.longest");
  EXPECT_EQ(outcome_of(short_case + "[flow.watch]\ncourant = 1.5\n").problems.at(0).key,
            "flow.watch.courant");
}

TEST(Resolved, TheBoxHoldsEveryFamilyOfTheExamples) {
  for (const char* name : {"flat-circular", "conical", "hemispherical", "quarter-spherical", "extended-skirt",
                           "ringslot", "cross", "elliptical"}) {
    const Case given =
        read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples" / name / "case.toml");  // checks the box
    EXPECT_EQ(resolve(given).flow().porosity_model, PorosityModel::sheet) << name;
    EXPECT_EQ(resolve(given).flow().cells[0], 80) << name;
  }
}

TEST(Resolved, TheCellsOfTheBoxAreThoseOfItsAxes) {
  FlowSettings flow;
  flow.box_m = {2, 3, 4};
  flow.cells = {20, 33, 44};
  const FlowGrid grid = flow_grid(flow);
  EXPECT_EQ((std::array{grid.nx, grid.ny, grid.nz}), (std::array{20, 33, 44}));
  EXPECT_EQ(grid.origin, (Vec3{-1, -1.5, 0}));
}

}  // namespace
}  // namespace ripstop
