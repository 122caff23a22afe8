#include "ripstop/flow/openfoam/openfoam.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numeric>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/process.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/openfoam/case_reader.h"
#include "ripstop/flow/openfoam/case_writer.h"
#include "ripstop/flow/steady.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

/// A separate folder for each test, removed afterwards.
class OpenFoam : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::temp_directory_path() / ("ripstop_" + std::to_string(getpid()) + "_" + info->name());
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  std::unique_ptr<FlowEngine> engine(const std::string& name = "case", int ranks = 1,
                                     bool incompressible = false) const {
    OpenFoamSettings settings;
    settings.incompressible = incompressible;
    settings.folder = root_ / name;
    settings.ranks = ranks;
    settings.time_limit_s = 120;
    return make_openfoam(settings);
  }

  fs::path root_;
};

/// Uniform slab of `layers` cells across a duct of 4 x 4 x 40 cells of 5 cm.
FlowProblem slab_in_duct(int layers, double darcy, double forchheimer) {
  FlowProblem problem;
  problem.grid = {{0, 0, 0}, {0.2, 0.2, 2.0}, 4, 4, 40};
  problem.air.velocity = {0, 0, 20};
  problem.sides = Sides::slip;
  PorousCells slab{{}, darcy, forchheimer};
  const int first = problem.grid.index(0, 0, 20), layer = problem.grid.nx * problem.grid.ny;
  for (int cell = first; cell < first + layers * layer; ++cell) slab.cells.push_back(cell);
  problem.bodies = {porous_body(slab)};
  problem.stopping.max_iterations = 400;
  return problem;
}

/// A disc of porous cells in an open box: 16 x 16 x 24 cells of 12.5 cm.
FlowProblem disc_in_box() {
  FlowProblem problem;
  problem.grid = {{-1, -1, 0}, {2, 2, 3}, 16, 16, 24};
  problem.air.velocity = {0, 0, 20};
  PorousCells disc{{}, 600, 30};
  for (int j = 0; j < 16; ++j) {
    for (int i = 0; i < 16; ++i) {
      if (std::hypot(i - 7.5, j - 7.5) < 4) disc.cells.push_back(problem.grid.index(i, j, 10));
    }
  }
  problem.bodies = {porous_body(disc)};
  problem.stopping.max_iterations = 400;
  return problem;
}

/// A disc as large at another place along the stream.
std::vector<Triangle> disc_at(double z) {
  return disk(1, {0, 0, z});
}

/// Mean gauge pressure of layer k.
double layer_pressure(const FlowField& field, int k) {
  const FlowGrid& grid = field.grid;
  const auto first = field.pressure.begin() + grid.index(0, 0, k);
  return std::accumulate(first, first + grid.nx * grid.ny, 0.0) / (grid.nx * grid.ny);
}

/// Pressure before the slab for isothermal gas (rho = p / c, c = R T) of mass flux G = p1 U / c through a
/// length L: dp (1 - G^2 c / p^2) = -(mu d + G f / 2) (G c / p) dz, so that
/// (p1^2 - p2^2) / 2 - G^2 c ln(p1 / p2) = (mu d + G f / 2) G c L. Gauge, over p2.
double exact_drop(const FlowProblem& problem, double length) {
  const double c = gas_constant_of_air * problem.air.temperature, p2 = openfoam::outlet_pressure(problem.air);
  double p1 = p2;
  for (int i = 0; i < 100; ++i) {
    const double flux = p1 * problem.air.speed() / c;
    const double drag = problem.air.viscosity * problem.bodies[0].porous().darcy +
                        0.5 * flux * problem.bodies[0].porous().forchheimer;
    p1 = std::sqrt(p2 * p2 + 2 * (drag * flux * c * length + flux * flux * c * std::log(p1 / p2)));
  }
  return p1 - p2;
}

TEST_F(OpenFoam, ASlabAcrossADuctDropsThePressureByDarcyAndForchheimer) {
  for (const auto& [darcy, forchheimer] : {std::pair{0.0, 1.2}, std::pair{8e5, 0.0}, std::pair{4e5, 0.6}}) {
    const FlowProblem problem = slab_in_duct(10, darcy, forchheimer);
    const FlowField field = solve(*engine(), problem);
    ASSERT_TRUE(field.converged);
    const double drop = layer_pressure(field, 0) - layer_pressure(field, 39);
    EXPECT_NEAR(drop / exact_drop(problem, 0.5), 1, 0.005) << "d " << darcy << " f " << forchheimer;
    // Momentum of the duct: the force on the slab is the drop minus the gain of the expanding gas.
    const double density = problem.air.density + layer_pressure(field, 0) / (gas_constant_of_air * 293.15);
    const double gain = density * 20 * (field.velocity.back().z - 20);
    EXPECT_NEAR(field.porous_force.z / ((drop - gain) * 0.04), 1, 1e-3);
    EXPECT_NEAR(field.momentum_deficit.z / field.porous_force.z, 1, 1e-4);
  }
}

TEST_F(OpenFoam, AirOfConstantDensityHasExactlyTheDarcyForchheimerLoss) {
  FlowProblem problem = slab_in_duct(10, 4e5, 0.6);
  problem.air.density = 0.9;
  const FlowField field = solve(*engine("case", 1, true), problem);
  ASSERT_TRUE(field.converged);
  const double drop = layer_pressure(field, 0) - layer_pressure(field, 39), u = problem.air.speed();
  EXPECT_NEAR(drop / ((problem.air.viscosity * 4e5 + 0.5 * 0.9 * u * 0.6) * u * 0.5), 1, 0.005);
  EXPECT_NEAR(field.porous_force.z / (drop * 0.04), 1, 1e-4);  // outflow is as fast as inflow
  // The output of both programs is kept.
  EXPECT_NE(read_file(root_ / "case/log.blockMesh").find("nCells: 640"), std::string::npos);
  EXPECT_NE(read_file(root_ / "case/log.porousSimpleFoam").find("Time = 2"), std::string::npos);
}

TEST_F(OpenFoam, TheBoxLosesTheMomentumThatThePorousCellsTake) {
  FlowProblem problem = disc_in_box();
  problem.air.density = 0.9;
  for (const bool incompressible : {false, true}) {
    const FlowField field = solve(*engine("case", 1, incompressible), problem);
    ASSERT_TRUE(field.converged);
    EXPECT_GT(field.porous_force.z, 50);
    EXPECT_NEAR(field.momentum_deficit.z / field.porous_force.z, 1, 5e-4);
    // The sums of OpenFOAM's `forces` and our own sums over the fields that we read back.
    EXPECT_NEAR(field.last.drag / field.porous_force.z, 1, 1e-4);
    EXPECT_LT(std::hypot(field.porous_force.x, field.porous_force.y), 1e-4 * field.porous_force.z);
  }
}

/// Bodies, forces and fields of a quarter are those of the whole box.
void expect_mirrored(const FlowField& quarter, const FlowField& whole, const FlowProblem& problem) {
  ASSERT_EQ(quarter.grid, whole.grid);
  EXPECT_NEAR(quarter.porous_force.z / whole.porous_force.z, 1, 1e-3);
  EXPECT_NEAR(quarter.last.drag / quarter.porous_force.z, 1, 1e-3);
  EXPECT_NEAR(quarter.momentum_deficit.z / whole.momentum_deficit.z, 1, 1e-3);
  const BodyLoad &own = quarter.bodies.at(0), &other = whole.bodies.at(0);
  EXPECT_NEAR(own.force.z / other.force.z, 1, 1e-3);
  EXPECT_GT(norm(other.moment), 0.05 * other.force.z);
  EXPECT_LT(norm(own.moment - other.moment), 2e-3 * norm(other.moment));
  const double speed = problem.air.speed(), scale = 0.5 * problem.air.density * speed * speed;
  for (int cell = 0; cell < problem.grid.cells(); ++cell) {
    ASSERT_NEAR(quarter.pressure[cell], whole.pressure[cell], 2e-3 * scale) << cell;
    ASSERT_LT(norm(quarter.velocity[cell] - whole.velocity[cell]), 2e-3 * speed) << cell;
  }
}

TEST_F(OpenFoam, AQuarterOfTheBoxHasTheFlowOfTheWholeThroughPorousCellsOnOneRankAndOnTwo) {
  FlowProblem problem = disc_in_box();
  problem.sides = Sides::slip;
  problem.bodies[0].moment_about = {0.1, 0, 0};
  const FlowField whole = solve(*engine("whole"), problem);
  problem.quarter = true;
  for (const int ranks : {1, 2}) {
    const auto own = engine("quarter" + std::to_string(ranks), ranks);
    const auto flow = own->start(problem);
    const FlowField quarter = solve_to_rest(*flow, problem.stopping);
    ASSERT_TRUE(quarter.converged);
    expect_mirrored(quarter, whole, problem);
    flow->place(0, disc_at(1.7));
    const FlowField moved = solve_to_rest(*flow, problem.stopping);
    EXPECT_NE(moved.porous_force.z, quarter.porous_force.z);
    EXPECT_LT(moved.last.iteration, quarter.last.iteration);
  }
}

TEST_F(OpenFoam, AContinuedFlowNeedsFewIterationsAndIsIndependentOfTheFormerCloth) {
  FlowProblem problem = disc_in_box();
  const auto own = engine(), others = engine("other");
  const auto flow = own->start(problem), fresh = others->start(problem);
  const FlowField cold = solve_to_rest(*flow, problem.stopping);
  const FlowField on = solve_to_rest(*flow, problem.stopping);
  EXPECT_LT(on.last.iteration, 0.25 * cold.last.iteration);
  EXPECT_NEAR(on.porous_force.z / cold.porous_force.z, 1, 1e-3);
  flow->place(0, disc_at(1.7)), fresh->place(0, disc_at(1.7));
  const FlowField moved = solve_to_rest(*flow, problem.stopping),
                  began = solve_to_rest(*fresh, problem.stopping);
  EXPECT_NEAR(moved.porous_force.z / began.porous_force.z, 1, 1e-3);
}

TEST_F(OpenFoam, AStopRequestEndsEarlyWithFieldsForTheNextSolution) {
  FlowProblem problem = disc_in_box();
  problem.stopping.residual = 1e-12;
  const auto own = engine();
  const auto flow = own->start(problem);
  const FlowField stopped =
      solve_to_rest(*flow, problem.stopping, [](const FlowProgress& now) { return now.iteration < 10; });
  EXPECT_FALSE(stopped.converged);
  EXPECT_GE(stopped.last.iteration, 10);
  EXPECT_LT(stopped.last.iteration, 200);
  EXPECT_EQ(stopped.pressure.size(), 16u * 16 * 24);
  problem.stopping.max_iterations = 5;
  const FlowField more = solve_to_rest(*flow, problem.stopping);
  EXPECT_EQ(more.last.iteration, 5);
  EXPECT_LT(more.last.residual_p, 0.5);  // 1 from a uniform start
}

TEST_F(OpenFoam, TwoRanksGiveTheAnswerOfOneAlsoFromAWarmStartWithOtherPorousCells) {
  FlowProblem problem = disc_in_box();
  const auto with_one = engine("one"), with_two = engine("two", 2);
  const auto one = with_one->start(problem), two = with_two->start(problem);
  for (const double z : {1.44, 1.69}) {
    one->place(0, disc_at(z)), two->place(0, disc_at(z));
    const FlowField a = solve_to_rest(*one, problem.stopping), b = solve_to_rest(*two, problem.stopping);
    ASSERT_TRUE(a.converged);
    ASSERT_TRUE(b.converged);
    EXPECT_NEAR(b.porous_force.z / a.porous_force.z, 1, 1e-4);
    EXPECT_NEAR(b.momentum_deficit.z / b.porous_force.z, 1, 5e-4);
    const double scale = 0.5 * problem.air.density * problem.air.speed() * problem.air.speed();
    for (int cell = 0; cell < problem.grid.cells(); ++cell) {
      ASSERT_NEAR(a.pressure[cell], b.pressure[cell], 1e-3 * scale);
    }
  }
}

/// Bit for bit.
void expect_identical(const FlowField& a, const FlowField& b) {
  EXPECT_EQ(a.pressure, b.pressure);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.porous_force, b.porous_force);
  EXPECT_EQ(a.momentum_deficit.z, b.momentum_deficit.z);
  EXPECT_EQ(a.last.iteration, b.last.iteration);
  EXPECT_EQ(a.last.drag, b.last.drag);
}

TEST_F(OpenFoam, ARestoredFlowContinuesByteForByte) {
  for (const int ranks : {1, 2}) {
    FlowProblem problem = disc_in_box();
    problem.stopping.max_iterations = 8;
    const std::string suffix = std::to_string(ranks);
    const auto engines = std::pair(engine("first" + suffix, ranks), engine("second" + suffix, ranks));
    const auto first = engines.first->start(problem), second = engines.second->start(problem);
    solve_to_rest(*first, problem.stopping);
    first->save(root_ / ("saved" + suffix));
    const auto moved_on = [&](Flow& flow) {
      flow.place(0, disc_at(1.57));
      return solve_to_rest(flow, problem.stopping);
    };
    const FlowField gone_on = moved_on(*first);
    second->restore(root_ / ("saved" + suffix));
    expect_identical(moved_on(*second), gone_on);
    second->restore(root_ / ("saved" + suffix));  // and again, into a flow that has continued
    expect_identical(moved_on(*second), gone_on);
  }
}

TEST_F(OpenFoam, ARestoredCaseIsTheSavedOneAlsoForARunByHand) {
  for (const int ranks : {1, 2}) {
    FlowProblem problem = disc_in_box();
    problem.stopping.max_iterations = 3;
    const std::string suffix = std::to_string(ranks), first = "first" + suffix, second = "second" + suffix;
    const auto own = engine(first, ranks), others = engine(second, ranks);
    const auto flow = own->start(problem);
    solve_to_rest(*flow, problem.stopping);
    flow->save(root_ / ("saved" + suffix));
    others->start(problem)->restore(root_ / ("saved" + suffix));
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root_ / first)) {
      const std::string name = fs::relative(entry.path(), root_ / first);
      if (!entry.is_regular_file() || name.starts_with("log.") || name.starts_with("postProcessing"))
        continue;
      ASSERT_TRUE(fs::exists(root_ / second / name)) << name;
      EXPECT_TRUE(read_file(entry.path()) == read_file(root_ / second / name)) << name;
      ++files;
    }
    EXPECT_GT(files, 20);
  }
}

TEST_F(OpenFoam, AHalfWrittenStateIsRefused) {
  FlowProblem problem = disc_in_box();
  problem.stopping.max_iterations = 2;
  const auto own = engine();
  const auto flow = own->start(problem);
  solve_to_rest(*flow, problem.stopping);
  const auto refused = [&](const fs::path& folder, const std::string& word) {
    try {
      flow->restore(folder);
      FAIL() << "restored from " << folder;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  flow->save(root_ / "cut");
  fs::resize_file(root_ / "cut/part0/U", 1000);
  refused(root_ / "cut", "part0/U");
  flow->save(root_ / "flipped");
  std::string field = read_file(root_ / "flipped/part0/p");
  field[field.size() / 2] ^= 1;
  write_file(root_ / "flipped/part0/p", field);
  refused(root_ / "flipped", "part0/p");
  flow->save(root_ / "no_seal");
  fs::remove(root_ / "no_seal/contents.seal");
  refused(root_ / "no_seal", "contents.seal");
  flow->save(root_ / "no_marker");
  fs::remove(root_ / "no_marker/saved.json");
  refused(root_ / "no_marker", "saved.json");
  flow->save(root_ / "bad_marker");
  fs::resize_file(root_ / "bad_marker/saved.json", 50);
  refused(root_ / "bad_marker", "saved.json");
  flow->save(root_ / "two_ranks");
  EXPECT_THROW(engine("other", 2)->start(problem)->restore(root_ / "two_ranks"), Error);
}

TEST_F(OpenFoam, AStateOfOneSolverIsNotForTheOther) {
  FlowProblem problem = disc_in_box();
  problem.stopping.max_iterations = 2;
  for (const bool incompressible : {false, true}) {
    const auto own = engine("case", 1, incompressible);
    const auto flow = own->start(problem);
    solve_to_rest(*flow, problem.stopping);
    flow->save(root_ / "saved");
    try {
      engine("other", 1, !incompressible)->start(problem)->restore(root_ / "saved");
      FAIL() << "restored";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what())
                    .find(incompressible ? "made with porousSimpleFoam" : "made with rhoPorousSimpleFoam"),
                std::string::npos)
          << error.what();
    }
    const FlowField on = solve_to_rest(*flow, problem.stopping);
    const auto others = engine("other", 1, incompressible);
    const auto same = others->start(problem);
    same->restore(root_ / "saved");
    expect_identical(solve_to_rest(*same, problem.stopping), on);
  }
}

TEST_F(OpenFoam, TheInletHasTheStatedDensity) {
  FlowProblem problem = disc_in_box();
  problem.air.density = 1.199;
  problem.stopping.max_iterations = 60;
  solve(*engine(), problem);
  const openfoam::FieldData rho =
      openfoam::read_field(root_ / "case" / openfoam::latest_time(root_ / "case") / "rho", 1,
                           static_cast<std::size_t>(problem.grid.cells()));
  // The stagnation pressure before the disc, 240 Pa at most, is a fifth of a percent of the static one.
  for (int cell = 0; cell < 16 * 16; ++cell) EXPECT_NEAR(rho.inner[cell] / 1.199, 1, 1e-3);
}

TEST_F(OpenFoam, AFlowOfOtherAirOrAnotherGridIsRefused) {
  FlowProblem problem = disc_in_box();
  problem.stopping.max_iterations = 2;
  const auto own = engine(), others = engine("other");
  const auto flow = own->start(problem);
  solve_to_rest(*flow, problem.stopping);
  flow->save(root_ / "saved");
  FlowProblem faster = problem, longer = problem;
  faster.air.velocity = {0, 0, 10};
  longer.grid.size.z = 4;
  EXPECT_THROW(others->start(faster)->restore(root_ / "saved"), Error);
  EXPECT_THROW(others->start(longer)->restore(root_ / "saved"), Error);
  const auto same = others->start(problem);
  same->restore(root_ / "saved");
  EXPECT_FALSE(same->untouched());
  same->start_afresh();
  EXPECT_TRUE(same->untouched());
}

TEST_F(OpenFoam, WithoutPorousCellsTheAirPassesUndisturbed) {
  FlowProblem problem = disc_in_box();
  problem.bodies.clear();
  problem.grid = {{-1, -1, 0}, {2, 2, 3}, 6, 6, 9};
  int reports = 0;
  const FlowField field = solve(*engine(), problem, [&](const FlowProgress&) { return ++reports < 3; });
  EXPECT_EQ(reports, 3);
  for (int cell = 0; cell < problem.grid.cells(); ++cell) {
    ASSERT_NEAR(field.pressure[cell], 0, 1e-3);
    ASSERT_NEAR(norm(field.velocity[cell] - Vec3{0, 0, 20}), 0, 1e-4);
  }
  EXPECT_EQ(field.porous_force, Vec3{});
}

TEST_F(OpenFoam, AStreamOfAnyDirectionPassesTheFarFieldUndisturbed) {
  FlowProblem problem = disc_in_box();
  problem.bodies.clear();
  problem.grid = {{-1, -1, 0}, {2, 2, 3}, 6, 6, 9};
  problem.air.velocity = {8, -12, 11};
  int reports = 0;
  const FlowField field = solve(*engine(), problem, [&](const FlowProgress&) { return ++reports < 3; });
  for (int cell = 0; cell < problem.grid.cells(); ++cell) {
    ASSERT_NEAR(field.pressure[cell], 0, 1e-3);
    ASSERT_NEAR(norm(field.velocity[cell] - problem.air.velocity), 0, 1e-4);
  }
}

// The disc is turned by 90 degrees with the stream: along x it lies on cells of the same size.
TEST_F(OpenFoam, ADiscAcrossAStreamAlongXHasTheForceOfOneAcrossAStreamAlongZ) {
  FlowProblem along_z = disc_in_box();
  along_z.grid = {{-1, -1, -1}, {2, 2, 2}, 16, 16, 16};
  along_z.sides = Sides::far_field;
  FlowProblem along_x = along_z;
  along_x.air.velocity = {20, 0, 0};
  PorousCells z{{}, 600, 30}, x = z;
  for (int j = 0; j < 16; ++j) {
    for (int i = 0; i < 16; ++i) {
      if (std::hypot(i - 7.5, j - 7.5) >= 4) continue;
      z.cells.push_back(along_z.grid.index(i, j, 7)), x.cells.push_back(along_z.grid.index(7, i, j));
    }
  }
  along_z.bodies = {porous_body(z)}, along_x.bodies = {porous_body(x)};
  const FlowField a = solve(*engine(), along_z), b = solve(*engine(), along_x);
  ASSERT_TRUE(a.converged && b.converged);
  EXPECT_NEAR(b.porous_force.x / a.porous_force.z, 1, 1e-3);
  EXPECT_NEAR(norm(b.bodies.at(0).force - b.porous_force), 0, 1e-9 * b.porous_force.x);
}

TEST_F(OpenFoam, SecondOrderConvectionGivesAnotherFieldWithTheSameBalance) {
  OpenFoamSettings settings;
  settings.folder = root_ / "second";
  settings.second_order = true;
  const FlowProblem problem = disc_in_box();
  const FlowField sharp = solve(*make_openfoam(settings), problem), upwind = solve(*engine(), problem);
  ASSERT_TRUE(sharp.converged);
  EXPECT_NEAR(sharp.momentum_deficit.z / sharp.porous_force.z, 1, 5e-4);
  EXPECT_GT(std::abs(sharp.porous_force.z / upwind.porous_force.z - 1), 1e-3);
}

TEST_F(OpenFoam, TheCaseRunsByHandAsItsReadmeDescribes) {
  FlowProblem problem = disc_in_box();
  problem.stopping.max_iterations = 3;
  solve(*engine(), problem);
  ProcessRequest request;
  request.arguments = {
      "/bin/sh", "-ec",
      "export WM_PROJECT_DIR=/usr/share/openfoam; rm -rf 3; blockMesh; cp constant/cellZones "
      "constant/polyMesh/; rhoPorousSimpleFoam"};
  request.working_folder = root_ / "case";
  EXPECT_TRUE(run_process(request).succeeded());
  EXPECT_EQ(openfoam::latest_time(root_ / "case"), "3");
}

}  // namespace
}  // namespace ripstop
