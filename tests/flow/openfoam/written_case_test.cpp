// Every file of a case for OpenFOAM has the numbers of its problem, in the keywords of its solvers.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/openfoam/case_reader.h"
#include "ripstop/flow/openfoam/case_writer.h"
#include "ripstop/flow/openfoam/field_file.h"
#include "ripstop/flow/openfoam/programs.h"

namespace ripstop::openfoam {
namespace {

namespace fs = std::filesystem;

struct WrittenFiles : testing::Test {
  TemporaryFolder folder{"written-case"};
  FlowProblem problem;
  OpenFoamSettings settings;

  WrittenFiles() {
    problem.grid = {{-1, -2, -3}, {2, 4, 8}, 4, 5, 16};
    problem.air.velocity = {0, 0, 12}, problem.air.density = 1.1, problem.air.viscosity = 1.7e-5,
    problem.air.temperature = 280;
    problem.air.turbulence_intensity = 0.02, problem.air.viscosity_ratio = 5;
    problem.bodies = {porous_body({{3, 7, 11}, 1.5e6, 250}, "first"), porous_body({{4}, 2e6, 0}, "second")};
  }
  /// Without its header, which names class and file.
  std::string body(const std::string& file, const std::string& kind = "dictionary") const {
    const std::string text = read_file(folder.path / file);
    const std::string head = "FoamFile\n{\n    version 2.0;\n    format ascii;\n    class " + kind +
                             ";\n    object " + fs::path(file).filename().string() + ";\n}\n\n";
    const std::size_t at = text.find(head);
    EXPECT_NE(at, std::string::npos) << text;
    return at == std::string::npos ? text : text.substr(at + head.size());
  }
  static bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
  }
  /// The number after a word.
  static double number(const std::string& text, const std::string& word) {
    std::smatch found;
    const bool is = std::regex_search(text, found, std::regex("\\b" + word + " ([-+0-9.e]+)"));
    EXPECT_TRUE(is) << "no " << word << " in " << text;
    return is ? std::stod(found[1]) : NAN;
  }
};

TEST_F(WrittenFiles, TheAirHasItsDensityAndViscosityInBothSolvers) {
  write_case(folder.path, problem, settings);
  const std::string gas = body("constant/thermophysicalProperties");
  const double gas_constant = 8314.47 / number(gas, "molWeight");
  EXPECT_NEAR(outlet_pressure(problem.air) / (gas_constant * 280), 1.1, 1e-12);
  EXPECT_EQ(number(gas, "mu"), 1.7e-5);
  EXPECT_FALSE(fs::exists(folder.path / "constant/transportProperties"));
  EXPECT_EQ(body("constant/turbulenceProperties"),
            "simulationType RAS;\nRAS { RASModel kOmegaSST; turbulence on; printCoeffs off; }\n");
  settings.incompressible = true;
  write_case(folder.path, problem, settings);
  const std::string fluid = body("constant/transportProperties");
  EXPECT_TRUE(has(fluid, "transportModel Newtonian;")) << fluid;
  EXPECT_DOUBLE_EQ(number(fluid, "nu"), 1.7e-5 / 1.1);
}

TEST_F(WrittenFiles, ConvectionOfTheVelocityIsAsAskedAndOfTheRestUpwind) {
  for (const bool second : {false, true}) {
    settings.second_order = second;
    write_case(folder.path, problem, settings);
    const std::string schemes = body("system/fvSchemes");
    EXPECT_TRUE(has(schemes, second ? "div(phi,U) bounded Gauss linearUpwind grad(U);"
                                    : "div(phi,U) bounded Gauss upwind;"));
    for (const char* name : {"k", "omega", "e"})
      EXPECT_TRUE(has(schemes, std::string("div(phi,") + name + ") bounded Gauss upwind;")) << name;
  }
}

TEST_F(WrittenFiles, UniformFieldsAreThoseOfTheStreamOnAllFaces) {
  const double fluctuation = 0.02 * 12, k = 1.5 * fluctuation * fluctuation, nu = 1.7e-5 / 1.1;
  const auto value = [&](const char* name, int components, int at = 0) {
    const FieldData field = read_field(folder.path / "0" / name, components, 1);
    const bool carried = field.patches.contains("inlet") && field.patches.contains("outlet");
    if (carried) {
      EXPECT_EQ(field.patches.at("inlet"), field.patches.at("outlet")) << name;
    }
    return field.at(field.inner, 0, at);
  };
  for (const bool incompressible : {false, true}) {
    for (const Sides sides : {Sides::slip, Sides::zero_gradient}) {
      fs::remove_all(folder.path / "0");
      problem.sides = sides;
      write_fields(folder.path / "0", problem, incompressible);
      const double pressure = incompressible ? 0 : outlet_pressure(problem.air);
      EXPECT_EQ(value("p", 1), pressure);
      EXPECT_EQ(read_field(folder.path / "0/p", 1, 1).patches.at("outlet"), std::vector<double>{pressure});
      EXPECT_EQ(value("U", 3, 2), 12);
      EXPECT_EQ(value("U", 3, 0), 0);
      EXPECT_DOUBLE_EQ(value("k", 1), k);
      EXPECT_DOUBLE_EQ(value("omega", 1), k / (5 * nu));
      EXPECT_DOUBLE_EQ(value("nut", 1), 5 * nu);
      const char* dimensions = incompressible ? "[0 2 -2 0 0 0 0]" : "[1 -1 -2 0 0 0 0]";
      EXPECT_TRUE(has(body("0/p", "volScalarField"), dimensions));
      EXPECT_TRUE(has(body("0/p", "volScalarField"), "inlet { type zeroGradient; }"));
      EXPECT_TRUE(has(body("0/U", "volVectorField"), "type inletOutlet; inletValue uniform (0 0 0);"));
      EXPECT_TRUE(has(body("0/U", "volVectorField"), "[0 1 -1 0 0 0 0]"));
      EXPECT_TRUE(has(body("0/k", "volScalarField"), "[0 2 -2 0 0 0 0]"));
      EXPECT_TRUE(has(body("0/omega", "volScalarField"), "[0 0 -1 0 0 0 0]"));
      EXPECT_TRUE(has(body("0/nut", "volScalarField"), "[0 2 -1 0 0 0 0]"));
      for (const char* name : {"p", "U", "k", "omega"})
        EXPECT_TRUE(has(read_file(folder.path / "0" / name),
                        sides == Sides::slip ? "sides { type slip; }" : "sides { type zeroGradient; }"));
      EXPECT_EQ(fs::exists(folder.path / "0/T"), !incompressible);
      EXPECT_EQ(fs::exists(folder.path / "0/alphat"), !incompressible);
      if (incompressible) continue;
      EXPECT_EQ(value("T", 1), 280);
      EXPECT_TRUE(has(body("0/T", "volScalarField"), "[0 0 0 1 0 0 0]"));
      EXPECT_EQ(value("alphat", 1), 0);
    }
  }
}

TEST_F(WrittenFiles, AFarFieldIsOpenFoamsFreestreamOnAllSixFaces) {
  problem.air.velocity = {3, 0, 4};
  write_fields(folder.path / "0", problem, true);
  const std::string velocity = read_file(folder.path / "0/U"), pressure = read_file(folder.path / "0/p"),
                    k = read_file(folder.path / "0/k");
  for (const char* face : {"inlet", "outlet", "sides"}) {
    const std::string at = face;
    EXPECT_TRUE(
        has(velocity, (at + " { type freestreamVelocity; freestreamValue uniform (3 0 4); }").c_str()));
    EXPECT_TRUE(has(pressure, (at + " { type freestreamPressure; freestreamValue uniform 0; }").c_str()));
    EXPECT_TRUE(has(k, (at + " { type inletOutlet; inletValue uniform").c_str()));
  }
}

TEST_F(WrittenFiles, ControlHasItsLastIterationAndTheForcesOfPorousCells) {
  write_control(folder.path, problem, false, {120, 30});
  std::string control = body("system/controlDict");
  EXPECT_TRUE(has(control, "application rhoPorousSimpleFoam;"));
  EXPECT_EQ(number(control, "endTime"), 150);
  EXPECT_EQ(number(control, "writeInterval"), 30);
  EXPECT_EQ(number(control, "deltaT"), 1);
  EXPECT_TRUE(has(control, "file \"<case>/stop\";"));
  EXPECT_TRUE(has(control, "porosity true;"));
  EXPECT_TRUE(has(control, "rho rho;"));
  write_control(folder.path, problem, true, {0, 1});
  control = body("system/controlDict");
  EXPECT_TRUE(has(control, "application porousSimpleFoam;"));
  EXPECT_TRUE(has(control, "rho rhoInf;"));
  EXPECT_EQ(number(control, "rhoInf"), 1.1);
  problem.bodies.clear();
  write_control(folder.path, problem, true, {0, 1});
  EXPECT_FALSE(has(body("system/controlDict"), "porousForces"));
  write_solution(folder.path, 3e-5);
  const std::string solution = body("system/fvSolution");
  EXPECT_EQ(number(solution, "residualControl \\{ \"[^\"]*\""), 3e-5);
  EXPECT_EQ(number(solution, "pMinFactor"), 0.5);
  EXPECT_EQ(number(solution, "pMaxFactor"), 2);
}

TEST_F(WrittenFiles, EveryZoneHasItsCellsAndItsResistance) {
  write_resistance(folder.path, problem.bodies);
  const std::string resistance = body("constant/porosityProperties");
  std::vector<std::string> zones;
  const std::regex zone(
      R"(porous(\d)\n\{\n    type DarcyForchheimer;\n    active yes;\n    cellZone porous(\d);\n    )"
      R"(DarcyForchheimerCoeffs\n    \{\n        d \(([^)]*)\);\n        f \(([^)]*)\);)");
  for (std::sregex_iterator at(resistance.begin(), resistance.end(), zone); at != std::sregex_iterator();
       ++at)
    zones.push_back((*at)[1].str() + "/" + (*at)[2].str() + "/" + (*at)[3].str() + "/" + (*at)[4].str());
  EXPECT_EQ(zones, (std::vector<std::string>{"0/0/1500000 1500000 1500000/250 250 250",
                                             "1/1/2000000 2000000 2000000/0 0 0"}));
  write_zones(folder.path / "constant", {problem.bodies[0].porous().cells, problem.bodies[1].porous().cells});
  EXPECT_EQ(body("constant/cellZones", "regIOobject"),
            "2\n(\nporous0\n{\n    type cellZone;\n    cellLabels List<label> 3(3\n7\n11\n);\n}\n"
            "porous1\n{\n    type cellZone;\n    cellLabels List<label> 1(4\n);\n}\n)\n");
}

/// The numbers between a word's brackets.
std::vector<double> list_after(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  if (at == std::string::npos) return {};
  std::string part = text.substr(at + word.size());
  for (char& c : part)
    if (c == '(' || c == ')') c = ' ';
  std::istringstream in(part);
  std::vector<double> values;
  for (double value; in >> value;) values.push_back(value);
  return values;
}

// blockMesh's words: of a part its length, its cells and its last width over its first.
TEST_F(WrittenFiles, TheMeshHasTheCornersTheCellsAndTheWidthsOfTheGrid) {
  write_case(folder.path, problem, settings);
  std::string mesh = body("system/blockMeshDict");
  EXPECT_EQ(list_after(mesh, "vertices\n"), (std::vector<double>{-1, -2, -3, 1, -2, -3, 1, 2, -3, -1, 2, -3,
                                                                 -1, -2, 5,  1, -2, 5,  1, 2, 5,  -1, 2, 5}));
  EXPECT_TRUE(has(mesh, "hex (0 1 2 3 4 5 6 7) (4 5 16) simpleGrading (1 1 1)")) << mesh;

  problem.grid = graded(problem.grid, {-1, -2, 0}, {1, 2, 1.5}, 1.3);
  const FlowGrid& grid = problem.grid;
  const Grading& along = grid.grading[2];
  ASSERT_TRUE(along.before > 1 && along.after > 1 && along.before + along.after < 15);
  write_case(folder.path, problem, settings);
  mesh = body("system/blockMeshDict");
  const std::vector<double> parts = list_after(mesh, "simpleGrading (1 1 ");
  ASSERT_EQ(parts.size(), 9u) << mesh;
  EXPECT_EQ(parts[1], along.before);
  EXPECT_EQ(parts[7], along.after);
  int cell = 0;
  for (int part = 0; part < 3; ++part) {
    const double length = parts[3 * part], expansion = parts[3 * part + 2];
    const int cells = static_cast<int>(parts[3 * part + 1]);
    const double ratio = std::pow(expansion, 1.0 / (cells - 1));
    double whole = 0;
    for (int i = 0; i < cells; ++i) whole += std::pow(ratio, i);
    for (int i = 0; i < cells; ++i, ++cell)
      EXPECT_NEAR(grid.edge(2, cell + 1) - grid.edge(2, cell), length * std::pow(ratio, i) / whole, 1e-9)
          << cell;
  }
  EXPECT_EQ(cell, 16);
  EXPECT_EQ(grid.edge(2, 16), 5);
}

TEST_F(WrittenFiles, AQuarterHasPlanesOfSymmetryInItsMeshAndInEveryField) {
  problem.grid = {{-1, -2, -3}, {2, 4, 8}, 8, 10, 16};
  problem.bodies = {porous_body({{0, 7, 72, 79}, 1.5e6, 250})};  // the corners of the first layer
  problem.quarter = true;
  const FlowProblem quarter = solved_part(problem);
  EXPECT_EQ(quarter.bodies[0].porous().cells, std::vector<int>{19});
  write_case(folder.path, quarter, settings);
  const std::string mesh = body("system/blockMeshDict");
  EXPECT_TRUE(has(mesh, "hex (0 1 2 3 4 5 6 7) (4 5 16) simpleGrading (1 1 1)")) << mesh;
  EXPECT_EQ(list_after(mesh, "vertices\n"), (std::vector<double>{0, 0, -3, 1, 0, -3, 1, 2, -3, 0, 2, -3,
                                                                 0, 0, 5,  1, 0, 5,  1, 2, 5,  0, 2, 5}));
  EXPECT_TRUE(has(mesh, "symmetryX { type symmetryPlane; faces ( (0 4 7 3) ); }")) << mesh;
  EXPECT_TRUE(has(mesh, "symmetryY { type symmetryPlane; faces ( (0 1 5 4) ); }")) << mesh;
  EXPECT_TRUE(has(mesh, "sides { type patch; faces (  (1 2 6 5) (3 7 6 2) ); }")) << mesh;
  for (const bool incompressible : {false, true}) {
    const std::string start = incompressible ? "1" : "0";
    write_fields(folder.path / start, quarter, incompressible);
    for (const auto& file : fs::directory_iterator(folder.path / start))
      for (const char* plane : symmetry_planes)
        EXPECT_TRUE(has(read_file(file.path()), std::string(plane) + " { type symmetryPlane; }")) << file;
  }
  EXPECT_TRUE(has(read_file(folder.path / "README.txt"), "a quarter of the drag"));
  problem.quarter = false;
  write_case(folder.path, problem, settings);
  write_fields(folder.path / "0", problem, true);
  for (const char* file : {"system/blockMeshDict", "0/U", "README.txt"})
    EXPECT_FALSE(has(read_file(folder.path / file), "symmetry")) << file;
}

TEST_F(WrittenFiles, TheReadmeDescribesTheCaseAndHowToRunIt) {
  problem.sides = Sides::slip;
  write_case(folder.path, problem, settings);
  std::string readme = read_file(folder.path / "README.txt");
  EXPECT_TRUE(has(readme, "4 x 5 x 16 cells, air of 1.1 kg/m3 at 12 m/s, slip sides.")) << readme;
  EXPECT_TRUE(has(readme,
                  "    rm -f stop\n    blockMesh\n    cp constant/cellZones constant/polyMesh/\n    "
                  "rhoPorousSimpleFoam\n"))
      << readme;
  settings.ranks = 4, settings.incompressible = true;
  problem.sides = Sides::zero_gradient;
  write_case(folder.path, problem, settings);
  readme = read_file(folder.path / "README.txt");
  EXPECT_TRUE(has(readme, "open sides")) << readme;
  EXPECT_TRUE(
      has(readme,
          "    decomposePar\n    mpirun -np 4 porousSimpleFoam -parallel\n    reconstructPar -latestTime\n"))
      << readme;
}

TEST_F(WrittenFiles, OfACaseThatFailedHalfWayTheFolderIsKnownAsOurs) {
  for (const char* in_the_way : {"system", "constant"}) {
    std::ofstream(folder.path / in_the_way) << "a file";
    EXPECT_ANY_THROW(write_case(folder.path, problem, settings));
    EXPECT_TRUE(fs::exists(folder.path / kReadme)) << in_the_way;
    for (const char* name : {"system", "constant", kReadme}) remove_path(folder.path / name);
  }
}

TEST(ClearCase, RemovesOnlyFilesOfOpenFoam) {
  const TemporaryFolder folder("clear-case");
  const auto content = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder.path)) names.insert(entry.path().filename());
    return names;
  };
  for (const char* part : {"0", "100", "0.5", "constant", "system", "postProcessing", "processor0", "notes"})
    fs::create_directories(folder.path / part);
  for (const char* file : {"constant/a", "100/U", "notes/mine", "thesis.txt", "log.simpleFoam", "logbook",
                           openfoam::kStopFile, "case.foam"})
    write_file(folder.path / file, "x");
  openfoam::clear_case(folder.path);
  EXPECT_EQ(content(), (std::set<std::string>{"notes", "thesis.txt", "logbook", "case.foam"}));
  EXPECT_TRUE(fs::exists(folder.path / "notes/mine"));
}

TEST_F(WrittenFiles, AFullDiskIsDetectedWhenAFileIsClosed) {
  const fs::path full = "/dev/full";
  if (!fs::exists(full)) GTEST_SKIP() << "no device that is always full";
  std::ofstream out(full);
  out << "a few bytes, which stay in the buffer";
  try {
    close_written(out, "case/0/U");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    EXPECT_STREQ(error.what(), "cannot write case/0/U: is the disk full?");
  }
}

TEST_F(WrittenFiles, ANumberOutOfItsRangeIsNamedWithTheRange) {
  const FlowProblem sound = problem;
  const auto refusal = [](const FlowProblem& asked) -> std::string {
    try {
      check(asked);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(sound), "accepted");
  const struct {
    std::function<void(FlowProblem&)> change;
    const char* says;
  } wrong[] = {
      {[](FlowProblem& p) { p.grid.ny = 4001; },
       "flow: number of cells along an axis is 4001 ; it must be in [1, 4000]"},
      {[](FlowProblem& p) { p.grid.nx = p.grid.ny = p.grid.nz = 600; },
       "flow: number of cells is 2.16e+08 ; it must be in [1, 2e+08]"},
      {[](FlowProblem& p) { p.grid.size.y = 2e6; },
       "flow: size of the domain is 2e+06 m; it must be in [1e-06, 1e+06]"},
      {[](FlowProblem& p) { p.grid.origin.z = -2e6; },
       "flow: corner of the domain is -2e+06 m; it must be in [-1e+06, 1e+06]"},
      {[](FlowProblem& p) {
         p.air.velocity = {0, 0, 151};
       },
       "speed of the free stream = 151 m/s: must be above 0 and at most 100.6 m/s, Mach 0.3 at 280 K; change "
       "it or the temperature of the air"},
      {[](FlowProblem& p) { p.air.density = 101; },
       "flow: air density is 101 kg/m3; it must be in [0.0001, 100]"},
      {[](FlowProblem& p) { p.air.viscosity = 2; }, "flow: viscosity is 2 Pa s; it must be in [1e-07, 1]"},
      {[](FlowProblem& p) { p.air.temperature = 99; },
       "flow: air temperature is 99 K; it must be in [100, 2000]"},
      {[](FlowProblem& p) { p.air.turbulence_intensity = 2; },
       "flow: turbulence intensity is 2 ; it must be in [1e-06, 1]"},
      {[](FlowProblem& p) { p.air.viscosity_ratio = 0; },
       "flow: viscosity ratio is 0 ; it must be in [1e-06, 1e+06]"},
      {[](FlowProblem& p) { p.bodies[0].porous().darcy = -1; },
       "flow: Darcy coefficient is -1 1/m2; it must be in [0, 1e+15]"},
      {[](FlowProblem& p) { p.bodies[1].porous().forchheimer = 2e12; },
       "flow: Forchheimer coefficient is 2e+12 1/m; it must be in [0, 1e+12]"},
      {[](FlowProblem& p) { p.bodies[0].porous().cells[1] = 320; },
       "flow: index of a porous cell is 320 ; it must be in [0, 319]"},
      {[](FlowProblem& p) { p.bodies[1].porous().cells[0] = 7; },
       "flow: cell 7 is porous twice; a cell has one resistance"},
      {[](FlowProblem& p) { p.sides = Sides::entraining; },
       "sides = \"entraining\" needs the built-in engine"},
      {[](FlowProblem& p) { p.outlet = Outlet::still_air; },
       "outlet = \"still-air\" needs the built-in engine"},
      {[](FlowProblem& p) { p.jet.emplace(); }, "open jet needs the built-in engine"},
      {[](FlowProblem& p) { p.body_force.resize(320); }, "a force on the air needs the built-in engine"},
  };
  for (const auto& one : wrong) {
    FlowProblem asked = sound;
    one.change(asked);
    EXPECT_EQ(refusal(asked), one.says);
  }
  EXPECT_NO_THROW(check_run(1, 1e-14));
  EXPECT_THROW(check_run(0, 1e-3), Error);
  EXPECT_THROW(check_run(10, 2), Error);
}

}  // namespace
}  // namespace ripstop::openfoam
