// Failures of OpenFOAM: missing, another version, or failing. A shell script replaces its programs.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "ripstop/core/error.h"
#include "ripstop/core/process.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class OpenFoamFailure : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::temp_directory_path() / ("ripstop_" + std::to_string(getpid()) + "_" + info->name());
    fs::create_directories(root_ / "bin");
    settings_.folder = root_ / "case";
    settings_.program_folder = root_ / "bin";
    settings_.time_limit_s = 60;
    problem_.grid = {{0, 0, 0}, {1, 1, 1}, 4, 4, 4};
    problem_.air.velocity = {0, 0, 10};
    problem_.bodies = {porous_body({{21, 22}, 100, 10})};
    problem_.stopping.max_iterations = 3;
  }
  void TearDown() override { fs::remove_all(root_); }

  void script(const std::string& name, const std::string& body) {
    const fs::path path = root_ / "bin" / name;
    std::ofstream(path) << "#!/bin/sh\n" << body << "\n";
    fs::permissions(path, fs::perms::owner_all);
  }
  /// The real mesher, and a solver that reports its version and then executes `body`.
  void solver(const std::string& body) {
    fs::create_symlink(find_program("blockMesh"), root_ / "bin/blockMesh");
    script(
        "rhoPorousSimpleFoam",
        "if [ \"$1\" = -help ]; then echo 'Using: OpenFOAM- (1912) - visit www.openfoam.com'; exit 0; fi\n" +
            body);
  }
  /// The message of the error that making the engine or its solve ends with.
  std::string message(ExitCode code) {
    try {
      solve(*make_openfoam(settings_), problem_);
    } catch (const Error& error) {
      EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
      return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
  }

  fs::path root_;
  OpenFoamSettings settings_;
  FlowProblem problem_;
};

bool says(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

constexpr const char* kOneIteration =
    "echo 'Time = 1'\n"
    "echo 'smoothSolver:  Solving for Ux, Initial residual = 1, Final residual = 0.01, No Iterations 2'\n"
    "echo 'GAMG:  Solving for p, Initial residual = 0.5, Final residual = 0.01, No Iterations 2'\n";

TEST_F(OpenFoamFailure, AMissingProgramNamesThePackage) {
  EXPECT_PRED2(says, message(ExitCode::external), "apt install openfoam");
}

TEST_F(OpenFoamFailure, AnotherLineOfOpenFoamIsNamed) {
  script("blockMesh", "exit 0");
  script("rhoPorousSimpleFoam", "echo 'Using: OpenFOAM-10 (see https://openfoam.org)'");
  const std::string text = message(ExitCode::external);
  EXPECT_PRED2(says, text, "OpenFOAM-10");
  EXPECT_PRED2(says, text, "openfoam.com");
}

TEST_F(OpenFoamFailure, AFolderWithASpaceIsRefusedBeforeAnythingRuns) {
  settings_.folder = root_ / "my case";
  EXPECT_PRED2(says, message(ExitCode::usage), "my case");
  EXPECT_FALSE(fs::exists(settings_.folder));
}

TEST_F(OpenFoamFailure, AFolderWithOtherFilesIsLeftAlone) {
  fs::create_directories(root_ / "case/0");
  std::ofstream(root_ / "case/0/mine") << "precious";
  EXPECT_PRED2(says, message(ExitCode::usage), "not a case of Ripstop");
  EXPECT_TRUE(fs::exists(root_ / "case/0/mine"));
}

TEST_F(OpenFoamFailure, ExitWithoutFieldsIsNoSuccess) {
  solver("exit 0");
  EXPECT_PRED2(says, message(ExitCode::external), "left no fields");
}

TEST_F(OpenFoamFailure, ACutFieldIsNotRead) {
  solver("cp -r 0 3; cp 0/p 3/rho; cp 0/p 3/phi; head -c 300 0/U > 3/U; echo End");
  const std::string text = message(ExitCode::io);
  EXPECT_PRED2(says, text, "3/U");
}

TEST_F(OpenFoamFailure, AKilledSolverPointsToMemory) {
  solver(std::string(kOneIteration) + "kill -9 $$");
  const std::string text = message(ExitCode::external);
  EXPECT_PRED2(says, text, "signal 9");
  EXPECT_PRED2(says, text, "memory");
  EXPECT_PRED2(says, text, "iteration 1, field p");
}

TEST_F(OpenFoamFailure, NotANumberEndsTheSolverAtOnce) {
  solver(std::string(kOneIteration) +
         "echo 'Time = 2'\necho 'smoothSolver:  Solving for omega, Initial residual = -nan, Final residual = "
         "nan, No "
         "Iterations 1000'\nsleep 60");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_PRED2(says, message(ExitCode::diverged), "iteration 2, field omega");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST_F(OpenFoamFailure, AFloatingPointTrapIsADivergence) {
  solver(std::string(kOneIteration) + "exit 136");
  EXPECT_PRED2(says, message(ExitCode::diverged), "iteration 1, field p");
}

TEST_F(OpenFoamFailure, TheTimeLimitIsNamed) {
  solver(std::string(kOneIteration) + "sleep 60");
  settings_.time_limit_s = 3;
  EXPECT_PRED2(says, message(ExitCode::external), "after 3 s");
}

// The text is in two parts, as ctest skips a test that prints it.
TEST_F(OpenFoamFailure, ABuildWithoutFunctionObjectsIsNamedWithTheRemedy) {
  solver(std::string(kOneIteration) +
         "printf '\\n--> FOAM FATAL IO ERROR: \\nerror in IOstream \"sha1\" for operation '\n"
         "printf 'Foam::Ostream& Foam::operator<<(Ostream&, const word&)\\n\\nFOAM exiting\\n\\n'; exit 1");
  const std::string text = message(ExitCode::external);
  EXPECT_TRUE(says(text, std::string("cannot run ") + "function objects"));
  EXPECT_TRUE(says(text, "www.openfoam.com"));
}

TEST_F(OpenFoamFailure, OpenFoamsOwnMessageIsPassedOn) {
  solver("echo '--> FOAM FATAL IO ERROR: '; echo 'keyword div(phi,U) is undefined'; exit 1");
  const std::string text = message(ExitCode::external);
  EXPECT_PRED2(says, text, "keyword div(phi,U) is undefined");
  EXPECT_PRED2(says, text, "exit code 1");
  EXPECT_PRED2(says, text, "log.rhoPorousSimpleFoam");
}

/// A disk on a mesh that follows it, with OpenFOAM's programs but for one.
class FittedMeshFailure : public OpenFoamFailure {
 protected:
  void SetUp() override {
    OpenFoamFailure::SetUp();
    problem_.bodies.clear();
    problem_.grid = {{-1, -1, 0}, {2, 2, 2}, 8, 8, 8};
    problem_.sides = Sides::slip;
    problem_.bodies = {sheet_body(disk(1, {0, 0, 1}), {1e6, 0})};
    settings_.fitted_mesh = true;
    settings_.cloth_levels = 1;
  }
  void all_but(const std::string& one, const std::string& body, int ranks = 1) {
    settings_.ranks = ranks;
    for (const char* name : {"blockMesh", "rhoPorousSimpleFoam", "simpleFoam", "snappyHexMesh",
                             "createBaffles", "checkMesh", "decomposePar", "reconstructPar"}) {
      if (name == one)
        script(one, body);
      else
        fs::create_symlink(find_program(name), root_ / "bin" / name);
    }
  }
};

TEST_F(FittedMeshFailure, AMissingToolIsNamedWithThePackage) {
  all_but("createBaffles", "exit 0");
  fs::remove(root_ / "bin/createBaffles");
  const std::string text = message(ExitCode::external);
  EXPECT_PRED2(says, text, "createBaffles");
  EXPECT_PRED2(says, text, "apt install openfoam");
}

TEST_F(FittedMeshFailure, EachFailedToolIsNamedWithItsMessageAndARemedy) {
  const std::string fails =
      "echo '--> FOAM FATAL ERROR: '\necho 'No faces found'\necho 'FOAM exiting'\nexit 1";
  for (const std::string tool : {"snappyHexMesh", "createBaffles", "decomposePar", "reconstructPar"}) {
    SCOPED_TRACE(tool);
    all_but(tool, fails, tool.ends_with("Par") ? 2 : 1);
    const std::string text = message(ExitCode::external);
    EXPECT_PRED2(says, text, "OpenFOAM's " + tool + " failed: exit code 1");
    EXPECT_PRED2(says, text, "No faces found");
    EXPECT_PRED2(says, text, "log." + tool);
    EXPECT_EQ(says(text, "a different refinement at the cloth"), !tool.ends_with("Par"));
    fs::remove_all(root_ / "bin");
    fs::create_directories(root_ / "bin");
  }
}

TEST_F(FittedMeshFailure, AMeshRejectedByCheckMeshIsNotUsed) {
  all_but("checkMesh",
          "echo ' ***Max skewness = 7, 3 highly skew faces detected'\necho 'Failed 1 mesh checks.'");
  const std::string text = message(ExitCode::external);
  EXPECT_PRED2(says, text, "checkMesh of OpenFOAM rejects");
  EXPECT_PRED2(says, text, "Max skewness = 7, 3 highly skew faces");
  EXPECT_PRED2(says, text, "a different refinement at the cloth");
  EXPECT_FALSE(fs::exists(root_ / "case/log.simpleFoam"));
}

TEST_F(FittedMeshFailure, AMeshThatLeftTheClothOutIsRefused) {
  all_but("snappyHexMesh", "mkdir -p constant/polyMesh");  // the grid as blockMesh made it, without a zone
  EXPECT_PRED2(says, message(ExitCode::external), "OpenFOAM's mesh has 0 m2 of faces");
}

TEST_F(OpenFoamFailure, NumbersOutOfRangeAreNamedAndNothingIsWritten) {
  solver("exit 0");
  problem_.air.velocity = {};
  EXPECT_PRED2(says, message(ExitCode::usage), "speed of the free stream = 0 m/s");
  problem_.air.velocity = {0, 0, NAN};
  message(ExitCode::usage);
  problem_.air.velocity = {0, 0, 10};
  problem_.bodies[0].porous().cells = {64};
  EXPECT_PRED2(says, message(ExitCode::usage), "porous cell is 64");
  problem_.bodies = {porous_body({{3}, 1, 1}, "first"), porous_body({{3}, 1, 1}, "second")};
  EXPECT_PRED2(says, message(ExitCode::usage), "porous twice");
  EXPECT_FALSE(fs::exists(root_ / "case"));
}

TEST_F(OpenFoamFailure, ABlockedDuctThatCannotPassItsFlowDiverges) {
  settings_.program_folder.clear();
  problem_.air.velocity = {0, 0, 100};
  problem_.bodies = {porous_body({{}, 0, 5e5})};
  for (int cell = 16; cell < 32; ++cell) problem_.bodies[0].porous().cells.push_back(cell);
  problem_.sides = Sides::slip;
  problem_.stopping.max_iterations = 60;
  EXPECT_PRED2(says, message(ExitCode::diverged), "reached its limits");
}

}  // namespace
}  // namespace ripstop
