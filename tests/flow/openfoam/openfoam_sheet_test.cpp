// Sheets on OpenFOAM compared with known results.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/process.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/openfoam/baffles.h"
#include "ripstop/flow/openfoam/fitted_mesh.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"

namespace ripstop {
namespace {

/// A rectangle by its corner and two sides.
std::vector<Triangle> rectangle(Vec3 corner, Vec3 u, Vec3 v) {
  return {{corner, corner + u, corner + u + v}, {corner, corner + u + v, corner + v}};
}

/// A sheet across a whole duct of 4 x 4 x 20 cells.
FlowProblem screen_in_duct(double linear, double quadratic) {
  FlowProblem problem;
  problem.grid = {{0, 0, 0}, {0.4, 0.4, 2.0}, 4, 4, 20};
  problem.air.velocity = {0, 0, 10};
  problem.sides = Sides::slip;
  problem.bodies = {sheet_body(rectangle({-1, -1, 1.03}, {3, 0, 0}, {0, 3, 0}), {linear, quadratic})};
  problem.stopping.max_iterations = 300;
  return problem;
}

/// A plate of 1 m in a box of 4 m, four cells across.
FlowProblem plate_in_box(double linear, double quadratic) {
  FlowProblem problem;
  problem.grid = {{-2, -2, 0}, {4, 4, 5}, 16, 16, 20};
  problem.air.velocity = {0, 0, 10};
  problem.sides = Sides::slip;
  problem.bodies = {sheet_body(square_plate(1, {0, 0, 2.02}), {linear, quadratic})};
  problem.stopping.max_iterations = 300;
  return problem;
}

class OpenFoamSheet : public testing::Test {
 protected:
  OpenFoamSettings settings(const std::string& name, int ranks = 1) const {
    OpenFoamSettings settings;
    settings.folder = folder_.path / name;
    settings.ranks = ranks;
    settings.second_order = true;
    return settings;
  }
  std::unique_ptr<FlowEngine> sheets_on_openfoam(const std::string& name, int ranks = 1) const {
    return make_openfoam(settings(name, ranks));
  }
  FlowField solved(const FlowProblem& problem, int ranks = 1) const {
    return solve(*sheets_on_openfoam("case", ranks), problem);
  }
  std::unique_ptr<FlowEngine> fitted(const std::string& name, int levels, int ranks = 1) const {
    OpenFoamSettings with = settings(name, ranks);
    with.fitted_mesh = true;
    with.cloth_levels = levels;
    return make_openfoam(with);
  }
  FlowField solved_fitted(const FlowProblem& problem, int levels, int ranks = 1) const {
    return solve(*fitted("case", levels, ranks), problem);
  }
  TemporaryFolder folder_{"openfoam-sheet"};
};

TEST_F(OpenFoamSheet, AScreenAcrossADuctTakesThePressureOfItsLaw) {
  const FlowField field = solved(screen_in_duct(3, 0.5));
  const double drop = 3 * 10 + 0.5 * 100;
  EXPECT_NEAR(field.pressure[0], drop, 5e-3 * drop);
  EXPECT_NEAR(field.porous_force.z, drop * 0.16, 1e-6 * drop);
  EXPECT_NEAR(field.momentum_deficit.z, drop * 0.16, 5e-3 * drop * 0.16);
}

// The momentum deficit is the force on the sheet, whether the pressure jumps across it or the velocity
// through it is given.
TEST_F(OpenFoamSheet, TheBoxLosesTheMomentumThatThePlateTakes) {
  const FlowField loose = solved(plate_in_box(2, 0.1));
  EXPECT_NEAR(loose.momentum_deficit.z, loose.porous_force.z, 0.02 * loose.porous_force.z);
  const FlowField tight = solved(plate_in_box(30, 0));
  EXPECT_NEAR(tight.momentum_deficit.z, tight.porous_force.z, 0.01 * tight.porous_force.z);
  const FlowField shut = solved(plate_in_box(1e6, 0));
  EXPECT_NEAR(shut.momentum_deficit.z, shut.porous_force.z, 0.01 * shut.porous_force.z);
  EXPECT_LT(loose.porous_force.z, tight.porous_force.z);
  EXPECT_LT(tight.porous_force.z, shut.porous_force.z);
}

TEST_F(OpenFoamSheet, AirLeavesThePlateByItsPressureAndElseReturns) {
  const auto behind = [](const FlowField& field) { return field.velocity[field.grid.index(8, 8, 8)].z; };
  const FlowField field = solved(plate_in_box(30, 0));
  ASSERT_EQ(field.sheet_loads.size(), 16u);
  for (const SheetLoad& load : field.sheet_loads) {
    EXPECT_GT(load.outward.z * load.drop, 0);
    EXPECT_NEAR(load.area, 0.0625, 1e-12);
  }
  const double passes = std::abs(field.sheet_loads[10].drop) / 30;
  EXPECT_GT(behind(field), 0.25 * passes);
  EXPECT_LT(behind(field), passes);
  EXPECT_LT(behind(solved(plate_in_box(1e6, 0))), 0);
}

TEST_F(OpenFoamSheet, TwoRanksGiveTheDragOfOne) {
  const double one = solved(plate_in_box(30, 0)).porous_force.z;
  EXPECT_NEAR(solved(plate_in_box(30, 0), 2).porous_force.z, one, 2e-3 * one);
}

TEST_F(OpenFoamSheet, ARestoredFlowContinuesByteForByteWhenTheClothIsPlaced) {
  const FlowProblem problem = plate_in_box(30, 0);
  const std::vector<Triangle> moved = square_plate(1, {0, 0, 2.3});
  const auto goes_on = [&](Flow& flow) {
    flow.place(0, moved);
    flow.advance(30, 1e-9);
    return flow.field();
  };
  FlowField whole;
  {
    const auto engine = sheets_on_openfoam("whole");
    const auto flow = engine->start(problem);
    EXPECT_TRUE(flow->untouched());
    flow->advance(40, 1e-9);
    EXPECT_FALSE(flow->untouched());
    flow->save(folder_.path / "saved");
    whole = goes_on(*flow);
  }
  const auto engine = sheets_on_openfoam("resumed");
  const auto flow = engine->start(problem);
  flow->restore(folder_.path / "saved");
  const FlowField resumed = goes_on(*flow);
  EXPECT_EQ(whole.pressure, resumed.pressure);
  EXPECT_EQ(whole.porous_force.z, resumed.porous_force.z);
  EXPECT_NE(whole.porous_force.z, 0);
}

TEST_F(OpenFoamSheet, AreTheFacesThatASlantedSheetParts) {
  FlowProblem problem = plate_in_box(1e4, 0);
  // At 45 degrees to y and z, from side to side of the box.
  problem.bodies[0].surface = rectangle({-3, -1.53, 1.02}, {6, 0, 0}, {0, 3, 3});
  double passes = 0;
  int slanted = 0;
  for (const openfoam::BafflePatch& patch : openfoam::baffles_of(problem)) {
    EXPECT_FALSE(patch.loose);
    for (const openfoam::Baffle& baffle : patch.baffles) {
      ASSERT_EQ(baffle.layers.size(), 1u);
      EXPECT_EQ(baffle.high - baffle.low, baffle.area.x > 0 ? 1 : baffle.area.y > 0 ? 16 : 256);
      passes += baffle.layers[0].slant * norm(baffle.area);
      slanted += baffle.area.y > 0;
      // a v of the law, with the face's own velocity v: the sheet's times the slant
      EXPECT_NEAR(openfoam::passing(baffle, problem.bodies, 50), 50 / 1e4 * baffle.layers[0].slant, 1e-12);
    }
  }
  EXPECT_GT(slanted, 0);
  EXPECT_NEAR(passes, 4 * 3 * std::sqrt(2.0),
              0.05 * 4 * 3 * std::sqrt(2.0));  // of its edge half a cell is left out
}

TEST_F(OpenFoamSheet, LayersInOneFaceAreInSeries) {
  FlowProblem problem = plate_in_box(1e3, 0);
  problem.bodies.push_back(sheet_body(square_plate(1, {0, 0, 2.03}), {0, 200}, "second"));
  const std::vector<openfoam::BafflePatch> patches = openfoam::baffles_of(problem);
  ASSERT_EQ(patches.size(), 1u);
  ASSERT_EQ(patches[0].baffles.size(), 16u);
  const openfoam::Baffle& baffle = patches[0].baffles[5];
  ASSERT_EQ(baffle.layers.size(), 2u);
  const double v = openfoam::passing(baffle, problem.bodies, -60);
  EXPECT_LT(v, 0);
  EXPECT_NEAR(1e3 * v - 200 * v * v, -60, 1e-9);
}

TEST_F(OpenFoamSheet, TightClothIsOnePatchAndLooseClothOneForEveryLaw) {
  const auto patches = [](std::vector<double> linear) {
    FlowProblem problem = plate_in_box(linear[0], 0);
    for (std::size_t n = 1; n < linear.size(); ++n)
      problem.bodies.push_back(sheet_body(square_plate(1, {0, 0, 2.03 + 0.5 * double(n)}), {linear[n], 0},
                                          "more " + std::to_string(n)));
    std::vector<std::string> names;
    for (const openfoam::BafflePatch& patch : openfoam::baffles_of(problem)) {
      EXPECT_EQ(patch.loose, patch.name != "cloth") << patch.name;
      EXPECT_FALSE(patch.baffles.empty()) << patch.name;
      names.push_back(patch.name);
    }
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(patches({1e6}), (Names{"cloth"}));
  EXPECT_EQ(patches({2}), (Names{"cloth0"}));
  EXPECT_EQ(patches({2, 5, 2}), (Names{"cloth0", "cloth1"}));
  EXPECT_EQ(patches({1e6, 2, 5}), (Names{"cloth", "cloth1", "cloth2"}));
}

void expect_sound_mesh(const FlowProblem& problem, FlowEngine& engine, const std::filesystem::path& folder) {
  const auto flow = engine.start(problem);
  flow->advance(1, 1e-9);
  const openfoam::Installation installation = openfoam::find_installation({}, false);
  ProcessRequest request;
  request.arguments = {openfoam::program(installation, "checkMesh").string()};
  request.working_folder = folder;
  request.environment = openfoam::environment(installation);
  bool sound = false;
  int patches = 0;
  request.on_line = [&](const std::string& line) {
    sound |= line == "Mesh OK.";
    patches += line.find("cloth") != std::string::npos && line.find("ok (") != std::string::npos;
    return true;
  };
  EXPECT_TRUE(run_process(request).succeeded());
  EXPECT_TRUE(sound);
  EXPECT_GE(patches, 4);
}

TEST_F(OpenFoamSheet, TheMeshIsOneThatOpenFoamFindsSound) {
  FlowProblem problem = plate_in_box(30, 0);
  problem.bodies.push_back(sheet_body(rectangle({-1, -1, 3.1}, {2, 0, 0.4}, {0, 2, 0}), {2, 0}, "second"));
  for (const bool quarter : {false, true}) {
    problem.quarter = quarter;
    expect_sound_mesh(problem, *sheets_on_openfoam("case"), folder_.path / "case");
  }
}

/// A cup whose axis is that of the box, so that it crosses both planes of symmetry.
FlowProblem cup_on_axis(double linear) {
  FlowProblem problem = plate_in_box(linear, 0);
  problem.bodies[0].surface = hemispherical_cup(1.5, {0, 0, 2.02});
  problem.bodies[0].moment_about = {0.1, 0, 0};
  return problem;
}

FlowProblem in_a_quarter(FlowProblem problem) {
  problem.quarter = true;
  return problem;
}

void expect_loads_of_the_whole(const FlowField& quarter, const FlowField& whole, const FlowProblem& problem) {
  ASSERT_EQ(quarter.grid, whole.grid);
  EXPECT_NEAR(quarter.porous_force.z / whole.porous_force.z, 1, 5e-3);
  EXPECT_NEAR(quarter.last.drag / whole.last.drag, 1, 5e-3);
  EXPECT_NEAR(quarter.momentum_deficit.z / whole.momentum_deficit.z, 1, 5e-3);
  EXPECT_LT(std::hypot(quarter.porous_force.x, quarter.porous_force.y), 1e-9);
  const Vec3 about = problem.bodies[0].moment_about, force = quarter.porous_force;
  EXPECT_LT(norm(quarter.bodies[0].moment - cross(-1.0 * about, force)), 1e-9 * force.z);
  ASSERT_EQ(quarter.sheet_loads.size(), whole.sheet_loads.size());
  for (const SheetLoad& load : quarter.sheet_loads) {  // each on a triangle at its own place
    const Triangle& t = problem.bodies[0].surface.at(static_cast<std::size_t>(load.triangle));
    EXPECT_LT(norm((t.a + t.b + t.c) / 3 - load.point), 0.5);
    EXPECT_GT(dot(load.outward, cross(t.b - t.a, t.c - t.a)), 0);
  }
}

TEST_F(OpenFoamSheet, AQuarterOfTheBoxHasTheDragOfTheWholeAboutTightCloth) {
  const FlowProblem problem = cup_on_axis(200);
  expect_loads_of_the_whole(solved(in_a_quarter(problem)), solved(problem), problem);
}

// The ranks part the box where the cup lies: with the two sides of a face on different ranks, the drag is 40 % smaller.
TEST_F(OpenFoamSheet, AQuarterOfTheBoxOnTwoRanksHasTheDragOfTheWholeThroughLooseCloth) {
  FlowProblem problem = cup_on_axis(2);
  problem.stopping.max_iterations = 100;
  expect_loads_of_the_whole(solved(in_a_quarter(problem), 2), solved(problem), problem);
}

TEST_F(OpenFoamSheet, AQuarterContinuesFromItsFilesAndNotFromThoseOfTheWhole) {
  const FlowProblem problem = in_a_quarter(cup_on_axis(200));
  const auto own = sheets_on_openfoam("quarter"), other = sheets_on_openfoam("resumed"),
             full = sheets_on_openfoam("whole");
  const auto flow = own->start(problem), resumed = other->start(problem),
             whole = full->start(cup_on_axis(200));
  const auto goes_on = [&](Flow& of) {
    of.place(0, hemispherical_cup(1.4, {0, 0, 2.1}));
    of.advance(30, 1e-9);
    return of.field();
  };
  flow->advance(40, 1e-9);
  flow->save(folder_.path / "saved");
  resumed->restore(folder_.path / "saved");
  const FlowField one = goes_on(*flow), two = goes_on(*resumed);
  EXPECT_EQ(one.pressure, two.pressure);
  EXPECT_EQ(one.porous_force.z, two.porous_force.z);
  EXPECT_THROW(whole->restore(folder_.path / "saved"), Error);
}

TEST_F(OpenFoamSheet, AQuarterIsRefusedForCellsFittedToTheClothAndForABoxThatIsNotMirrored) {
  const auto refusal = [](FlowEngine& engine, const FlowProblem& problem) -> std::string {
    try {
      engine.start(problem);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return error.what();
    }
    return {};
  };
  FlowProblem problem = in_a_quarter(cup_on_axis(200));
  EXPECT_NE(refusal(*fitted("fitted", 0), problem).find("cannot be fitted to cloth"), std::string::npos);
  problem.grid.origin.x += 0.1;
  EXPECT_NE(refusal(*sheets_on_openfoam("case"), problem).find("not symmetric about the canopy axis"),
            std::string::npos);
}

TEST_F(OpenFoamSheet, AScreenThatCellsAreMovedOntoTakesThePressureOfItsLaw) {
  FlowProblem problem = screen_in_duct(3, 0.5);
  problem.bodies[0].surface = rectangle({0, 0, 1.03}, {0.4, 0, 0}, {0, 0.4, 0});
  const FlowField field = solved_fitted(problem, 0);
  const double drop = 3 * 10 + 0.5 * 100;
  EXPECT_NEAR(field.pressure[0], drop, 5e-3 * drop);
  EXPECT_NEAR(field.porous_force.z, drop * 0.16, 1e-4 * drop);
  for (const SheetLoad& load : field.sheet_loads) EXPECT_NEAR(load.point.z, 1.03, 1e-12);
}

TEST_F(OpenFoamSheet, ForcesOfMovedCellsActAtTheirFaces) {
  FlowProblem problem = screen_in_duct(3, 0.5);
  problem.bodies[0].surface = rectangle({0.4, 0.4, 1.03}, {-0.4, 0, 0}, {0, -0.4, 0});
  problem.stopping.max_iterations = 1;
  const FlowField field = solved_fitted(problem, 0);
  ASSERT_EQ(field.sheet_loads.size(), 16u);
  std::set<std::pair<int, int>> cells;
  for (const SheetLoad& load : field.sheet_loads) {
    const double i = load.point.x / 0.1 - 0.5, j = load.point.y / 0.1 - 0.5;
    EXPECT_NEAR(i, std::round(i), 0.01);
    EXPECT_NEAR(j, std::round(j), 0.01);
    EXPECT_NEAR(load.point.z, 1.03, 1e-12);
    cells.insert({static_cast<int>(std::round(i)), static_cast<int>(std::round(j))});
  }
  EXPECT_EQ(cells.size(), 16u);
}

/// A cup of 1 m, whose mouth faces the stream, in a box of 4 m.
FlowProblem cup_in_box() {
  FlowProblem problem = plate_in_box(1e6, 0);
  problem.bodies[0].surface = hemispherical_cup(1, {0.03, -0.02, 2.02});
  return problem;
}

TEST_F(OpenFoamSheet, CellsMovedOntoACupHaveItsFrontAndTakeTheMomentumThatTheBoxLoses) {
  const FlowField field = solved_fitted(cup_in_box(), 2);
  double front = 0, area = 0;
  for (const SheetLoad& load : field.sheet_loads) {
    front += std::abs(load.force.z / load.drop);
    area += load.area;
    const Vec3 out = load.point - Vec3{0.03, -0.02, 2.02};  // of the sphere
    EXPECT_NEAR(norm(out), 0.5, 0.01);
    EXPECT_GT(dot(load.outward, out) / norm(out), 0.8);  // faces at the rim lean
  }
  EXPECT_NEAR(front, 0.25 * M_PI, 0.01 * 0.25 * M_PI);
  // The faces have a smaller area than the cloth they represent; each has its share of it.
  const double cloth = surface_area(cup_in_box().bodies[0].surface);
  EXPECT_NEAR(area, cloth, 5e-4 * cloth);  // but for faces that are not plane
  EXPECT_NEAR(cloth, 0.5 * M_PI, 0.01 * 0.5 * M_PI);
  double of_faces = 0, slanted = 0;
  for (const openfoam::BafflePatch& patch :
       openfoam::read_fitted_mesh(folder_.path / "case", cup_in_box()).patches)
    for (const openfoam::Baffle& baffle : patch.baffles)
      of_faces += norm(baffle.area), slanted += baffle.layers.at(0).slant * norm(baffle.area);
  EXPECT_NEAR(slanted, cloth, 5e-4 * cloth);
  EXPECT_LT(of_faces, 0.998 * cloth);
  EXPECT_NEAR(field.momentum_deficit.z, field.porous_force.z, 0.01 * field.porous_force.z);

  const std::string log = read_file(folder_.path / "case" / "log.checkMesh"), word = "    cells:";
  const double cells = std::stod(log.substr(log.find(word) + word.size()));
  EXPECT_NEAR(fitted_cells(cup_in_box().grid, area, 2), cells, 0.15 * cells);
}

TEST_F(OpenFoamSheet, TwoRanksGiveTheDragOfOneOnCellsMovedOntoAPlate) {
  FlowProblem problem = plate_in_box(30, 0);
  problem.stopping.max_iterations = 100;
  const double one = solved_fitted(problem, 0).porous_force.z;
  EXPECT_NEAR(solved_fitted(problem, 0, 2).porous_force.z, one, 2e-3 * one);
}

TEST_F(OpenFoamSheet, ARestoredFlowContinuesByteForByteWhenCellsAreFittedToTheClothAgain) {
  const FlowProblem problem = cup_in_box();
  const auto goes_on = [&](Flow& flow) {
    flow.place(0, hemispherical_cup(0.9, {0, 0, 2.1}));
    flow.advance(10, 1e-9);
    return flow.field();
  };
  FlowField whole, before;
  {
    const auto engine = fitted("whole", 1);
    const auto flow = engine->start(problem);
    flow->advance(40, 1e-9);
    flow->save(folder_.path / "saved");
    before = flow->field();
    whole = goes_on(*flow);
  }
  const auto engine = fitted("resumed", 1);
  FlowProblem bare = problem;
  bare.bodies[0].surface.clear();  // where the cloth lay is in the saved mesh
  const auto flow = engine->start(bare);
  flow->restore(folder_.path / "saved");
  EXPECT_EQ(flow->field().pressure, before.pressure);
  const FlowField resumed = goes_on(*flow);
  EXPECT_EQ(whole.pressure, resumed.pressure);
  EXPECT_EQ(whole.porous_force.z, resumed.porous_force.z);
  EXPECT_GT(whole.porous_force.z, 0.5 * before.porous_force.z);
}

// A closed box of little more than a cell, next to a plate: without an opening its cell would have no
// pressure.
TEST_F(OpenFoamSheet, ACellThatClothShutsInIsOpened) {
  FlowProblem problem = plate_in_box(1e6, 0);
  std::vector<Triangle>& cloth = problem.bodies[0].surface;
  cloth = square_plate(1.5, {0, 0, 2.02});
  const Vec3 low{-0.02, -0.02, 3.23}, x{0.29, 0, 0}, y{0, 0.29, 0}, z{0, 0, 0.29};
  for (const auto& [corner, u, v] :
       {std::tuple{low, y, x}, {low, x, z}, {low, z, y}, {low + z, x, y}, {low + y, z, x}, {low + x, y, z}})
    for (const Triangle& t : rectangle(corner, u, v)) cloth.push_back(t);
  const auto engine = fitted("case", 0);
  const auto flow = engine->start(problem);
  flow->advance(25, 1e-9);
  int of_box = 0;
  for (const SheetLoad& load : flow->sheet_loads()) of_box += load.point.z > 3;
  EXPECT_EQ(of_box, 5);
}

TEST_F(OpenFoamSheet, CellsTooCoarseForTheClothAreRefused) {
  FlowProblem problem = plate_in_box(1e6, 0);
  problem.bodies[0].surface = hemispherical_cup(0.4, {0.03, -0.02, 2.02});
  try {
    fitted("case", 0)->start(problem);
    FAIL() << "no Error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::external);
    EXPECT_NE(std::string(error.what()).find("too coarse for gaps or folds of the cloth"), std::string::npos)
        << error.what();
  }
}

TEST_F(OpenFoamSheet, FeaturesOfTheBuiltInEngineAreRefused) {
  FlowProblem problem = plate_in_box(30, 0);
  problem.sides = Sides::entraining;
  try {
    sheets_on_openfoam("case")->start(problem);
    FAIL() << "no Error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_STREQ(error.what(), "sides = \"entraining\" needs the built-in engine");
  }
}

}  // namespace
}  // namespace ripstop
