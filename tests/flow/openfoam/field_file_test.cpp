#include "ripstop/flow/openfoam/field_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "ripstop/core/error.h"
#include "ripstop/flow/openfoam/solver_log.h"

namespace ripstop::openfoam {
namespace {

namespace fs = std::filesystem;

class FieldFile : public testing::Test {
 protected:
  void SetUp() override { path_ = fs::temp_directory_path() / ("ripstop_field_" + std::to_string(getpid())); }
  void TearDown() override { fs::remove(path_); }
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

  fs::path path_;
};

std::string header(const std::string& format) {
  return "/*--- OpenFOAM ---*/\nFoamFile\n{\n version 2.0;\n format " + format +
         ";\n class volVectorField;\n arch \"LSB;label=32;scalar=64\";\n object U;\n}\n// * * *\n";
}

std::string bytes(const std::vector<double>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

TEST_F(FieldFile, BinaryAndTextHoldTheSameField) {
  // Bytes that look like OpenFOAM's punctuation must not end a list.
  double tricky;
  std::memcpy(&tricky, ");})\n;(\x40", sizeof tricky);
  const std::vector<double> inner = {1, 2, 3, tricky, -5, 6e-300};
  const std::string rest = "  \n}\n";
  write(header("binary") + "dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform List<vector> \n2\n(" +
        bytes(inner) +
        ");\nboundaryField\n{\n inlet { type fixedValue; value uniform (0 0 7); }\n sides { type "
        "zeroGradient; }\n outlet "
        "{ type inletOutlet; inletValue uniform (0 0 0); value nonuniform List<vector> 1(" +
        bytes({7, 8, 9}) + ");\n }\n none { type processor; value nonuniform List<vector> 0(); }" + rest);
  const FieldData field = read_field(path_, 3, 2);
  EXPECT_EQ(field.inner, inner);
  EXPECT_EQ(field.patches.at("outlet"), (std::vector<double>{7, 8, 9}));
  EXPECT_EQ(field.at(field.patches.at("inlet"), 12, 2), 7);
  EXPECT_EQ(field.patches.count("sides"), 0u);
  EXPECT_TRUE(field.patches.at("none").empty());

  write(header("ascii") +
        "dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform List<vector> 2((1 2 3)(4 -5 6e-300));"
        "boundaryField { outlet { value nonuniform List<vector> 1((7 8 9)); } }");
  const FieldData text = read_field(path_, 3, 2);
  EXPECT_EQ(text.inner, (std::vector<double>{1, 2, 3, 4, -5, 6e-300}));
  EXPECT_EQ(text.patches.at("outlet"), (std::vector<double>{7, 8, 9}));
}

TEST_F(FieldFile, EveryCutOfAFileIsNoticed) {
  const std::string whole = header("binary") + "internalField nonuniform List<scalar> 3(" + bytes({1, 2, 3}) +
                            ");\nboundaryField { a { type b; value nonuniform List<scalar> 1(" + bytes({4}) +
                            "); } }";
  write(whole);
  EXPECT_EQ(read_field(path_, 1, 3).inner, (std::vector<double>{1, 2, 3}));
  EXPECT_THROW(read_field(path_, 1, 4), Error);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write(whole.substr(0, length));
    EXPECT_THROW(read_field(path_, 1, 3), Error) << length << " of " << whole.size() << " bytes";
  }
  fs::remove(path_);
  EXPECT_THROW(read_field(path_, 1, 3), Error);
}

// Before so much is allocated.
TEST_F(FieldFile, AListLongerThanItsFileIsRefused) {
  for (const char* format : {"binary", "ascii"}) {
    write(header(format) + "internalField nonuniform List<vector> 3999999999((1 2 3)(4 5 6));");
    EXPECT_THROW(read_field(path_, 3, 3999999999), Error) << format;
    write(header(format) + "3999999999(1 2 3)");
    EXPECT_THROW(read_labels(path_), Error) << format;
  }
  write(header("ascii") + "2(1 1e300)");
  EXPECT_THROW(read_labels(path_), Error);
}

TEST_F(FieldFile, OtherNumberFormatsAreRefused) {
  write(
      "FoamFile { version 2.0; format binary; class labelList; arch \"LSB;label=64;scalar=64\"; object "
      "owner; }\n0()");
  EXPECT_THROW(read_labels(path_), Error);
}

TEST_F(FieldFile, BoundaryListsItsFaces) {
  write(
      "FoamFile { version 2.0; format ascii; class polyBoundaryMesh; object boundary; }\n"
      "2 ( inlet { type patch; nFaces 16; startFace 100; } side { type patch; inGroups 1(wall); nFaces 0; "
      "startFace "
      "116; } )");
  const std::vector<Patch> patches = read_boundary(path_);
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_EQ(patches[0].name, "inlet");
  EXPECT_EQ(patches[0].faces, 16);
  EXPECT_EQ(patches[1].start, 116);
}

TEST_F(FieldFile, ADictionaryWithinAPatchIsNotThePatchsOwn) {
  write(
      "FoamFile { version 2.0; format ascii; class polyBoundaryMesh; object boundary; }\n"
      "2 ( inlet { inner { nFaces 99; startFace 98; } nFaces 16; startFace 100; } side { nFaces 3; startFace "
      "116; } )");
  const std::vector<Patch> patches = read_boundary(path_);
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_EQ(patches[0].faces, 16);
  EXPECT_EQ(patches[0].start, 100);
  EXPECT_EQ(patches[1].name, "side");
  EXPECT_EQ(patches[1].faces, 3);
}

TEST_F(FieldFile, AMistakeIsReportedWithFileAndPlace) {
  const auto refusal = [&](const std::string& text) -> std::string {
    write(text);
    try {
      read_field(path_, 1, 2);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::io);
      return error.what();
    }
    return "read";
  };
  const auto told = [&](const std::string& text, const std::string& what, std::size_t near) {
    return "OpenFOAM's file " + path_.string() + ": " + what + " (near byte " + std::to_string(near) +
           " of " + std::to_string(text.size()) + "); a full disk or a killed solver leaves such files";
  };
  // The list would be as long as the rest of the file, were it not for its bracket.
  const std::string list = "internalField nonuniform List<scalar> 2(";
  std::string text = header("binary") + list + bytes({1, 2}).substr(0, 15);
  EXPECT_EQ(refusal(text), told(text, "1 bytes of data are missing", header("binary").size() + list.size()));
  text = header("ascii") + "internalField uniform x;";
  EXPECT_EQ(refusal(text), told(text, "'x' is not a number", text.size() - 1));
  text = header("ascii") + "internalField constant 3;";
  EXPECT_EQ(refusal(text), told(text, "'constant' is neither uniform nor nonuniform", text.size() - 3));
  text = header("ascii") + "internalField nonuniform List<scalar> -1();";
  EXPECT_EQ(refusal(text), told(text, "a list has no valid length", text.size() - 3));
  text = header("ascii") + "internalField nonuniform List<scalar> 3(1 2 3);boundaryField { }";
  EXPECT_EQ(refusal(text), told(text, "contains 3 values, but the mesh has 2", text.size()));
  text = header("ascii") + "internalField uniform 3;";
  EXPECT_EQ(refusal(text), told(text, "has no internalField or no boundaryField", text.size()));
  text = "internalField uniform 3;";
  EXPECT_EQ(refusal(text), told(text, "has no OpenFOAM header", 13));
  fs::remove(path_);
  try {
    read_labels(path_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "OpenFOAM's file " + path_.string() + " is missing");
  }
}

TEST_F(FieldFile, LabelsAreWholeNumbersOf32Bits) {
  write(header("ascii") + "// a comment ) 7\n4(0 /* not 5 */ -1 2147483647 12)");
  EXPECT_EQ(read_labels(path_), (std::vector<int>{0, -1, 2147483647, 12}));
  for (const char* list : {"1(1.5)", "1(2147483648)", "1(nan)", "2(1)", "1(1", "1(1 2)"}) {
    write(header("ascii") + list);
    EXPECT_THROW(read_labels(path_), Error) << list;
  }
  const std::vector<int> labels = {7, -8, 9};
  write(header("binary") + "3(" + std::string(reinterpret_cast<const char*>(labels.data()), 12) + ")");
  EXPECT_EQ(read_labels(path_), labels);
  write(header("binary") + "0()");
  EXPECT_TRUE(read_labels(path_).empty());
}

TEST_F(FieldFile, FacesHaveTheCornersOfTheirList) {
  const auto faces = [&](const std::string& begins, const std::string& corners) {
    write(header("ascii") + begins + "\n" + corners + "\n");
    return read_faces(path_);
  };
  const FaceList two = faces("3(0 3 7)", "7(0 1 2 0 2 3 4)");
  EXPECT_EQ(two.begins, (std::vector<int>{0, 3, 7}));
  EXPECT_EQ(two.corners, (std::vector<int>{0, 1, 2, 0, 2, 3, 4}));
  EXPECT_THROW(faces("3(0 3 6)", "7(0 1 2 0 2 3 4)"), Error);  // other corners than stated
  EXPECT_THROW(faces("3(0 2 7)", "7(0 1 2 0 2 3 4)"), Error);  // a face of two corners
  EXPECT_THROW(faces("3(1 4 7)", "7(0 1 2 0 2 3 4)"), Error);
  EXPECT_THROW(faces("3(0 2147483647 7)", "7(0 1 2 0 2 3 4)"), Error);
  EXPECT_THROW(faces("0()", "0()"), Error);
}

TEST_F(FieldFile, ZonesHaveTheirFaces) {
  write(header("ascii") +
        "2(cloth { type faceZone; faceLabels List<label> 2(5 6); flipMap List<bool> 2{0}; }\n"
        "band { type faceZone; faceLabels List<label> 1(9); flipMap List<bool> 1(1); })\n");
  const std::vector<FaceZone> zones = read_face_zones(path_);
  ASSERT_EQ(zones.size(), 2u);
  EXPECT_EQ(zones[0].name, "cloth");
  EXPECT_EQ(zones[0].faces, (std::vector<int>{5, 6}));
  EXPECT_EQ(zones[1].name, "band");
  EXPECT_EQ(zones[1].faces, std::vector<int>{9});
  write(header("ascii") + "1(cloth { type faceZone; faceLabels List<label> 2(5 6);");
  EXPECT_THROW(read_face_zones(path_), Error);
}

TEST(SolverLog, AnIterationEndsWithItsForces) {
  SolverLog log(SolverLog::Forces::porous);
  const std::vector<std::string> lines = {
      "trapFpe: Floating point exception trapping enabled (FOAM_SIGFPE).",
      "Time = 41",
      "smoothSolver:  Solving for Ux, Initial residual = 0.1, Final residual = 0.001, No Iterations 2",
      "smoothSolver:  Solving for Uy, Initial residual = 0.3, Final residual = 0.001, No Iterations 2",
      "smoothSolver:  Solving for Uz, Initial residual = 0.2, Final residual = 0.001, No Iterations 2",
      "smoothSolver:  Solving for e, Initial residual = 0.4, Final residual = 0.001, No Iterations 2",
      "GAMG:  Solving for p, Initial residual = 0.5, Final residual = 0.001, No Iterations 2",
      "smoothSolver:  Solving for omega, Initial residual = 0.6, Final residual = 0.001, No Iterations 2",
      "smoothSolver:  Solving for k, Initial residual = 0.7, Final residual = 0.001, No Iterations 2",
      "SIMPLE solution converged in 41 iterations",
      "    Sum of forces",
      "        Total    : (9 9 9)",
  };
  for (const std::string& line : lines) EXPECT_FALSE(log.feed(line));
  EXPECT_TRUE(log.feed("        Porous   : (1 -2 3.5e+2)"));
  EXPECT_FALSE(log.feed("    Sum of moments"));
  EXPECT_FALSE(log.feed("        Porous   : (7 7 7)"));
  const FlowProgress& now = log.progress();
  EXPECT_EQ(now.iteration, 1);
  EXPECT_EQ(now.residual_u, 0.3);
  EXPECT_EQ(now.residual_p, 0.5);
  EXPECT_EQ(now.residual_omega, 0.6);
  EXPECT_EQ(now.residual_k, 0.7);
  EXPECT_EQ(now.residual_e, 0.4);
  EXPECT_EQ(now.drag, 350);
  EXPECT_TRUE(log.converged());
  EXPECT_FALSE(log.floating_point_trap());
}

TEST(SolverLog, FindsTheCauseOfAFailureInTheOutput) {
  struct Words {
    const char* line;
    bool converged, not_a_number, trap, memory, fatal;
  };
  for (const Words& words : {
           Words{"SIMPLE solution converged in 41 iterations", true, false, false, false, false},
           Words{"Solving for p, Initial residual = nan, Final", false, true, false, false, false},
           Words{"#1  Foam::sigFpe::sigHandler(int)", false, false, true, false, false},
           Words{"terminate called after throwing an instance of 'std::bad_alloc'", false, false, false, true,
                 false},
           Words{"fork: Cannot allocate memory", false, false, false, true, false},
           Words{"--> FOAM FATAL ERROR: ", false, false, false, false, true},
           Words{"ExecutionTime = 1 s", false, false, false, false, false},
       }) {
    SolverLog log(SolverLog::Forces::none);
    for (const char* line : {"Time = 1", words.line, "said next", "Time = 2"}) log.feed(line);
    EXPECT_EQ(log.converged(), words.converged) << words.line;
    EXPECT_EQ(log.not_a_number(), words.not_a_number) << words.line;
    EXPECT_EQ(log.floating_point_trap(), words.trap) << words.line;
    EXPECT_EQ(log.out_of_memory(), words.memory) << words.line;
    EXPECT_EQ(log.fatal(), words.fatal ? "said next | Time = 2" : "") << words.line;
    EXPECT_EQ(log.iteration(), 2) << words.line;
  }
}

TEST(SolverLog, TheNextIterationHasItsOwnResiduals) {
  SolverLog log(SolverLog::Forces::none);
  const auto iteration = [&](const char* time, double x, double y) {
    log.feed(std::string("Time = ") + time);
    for (const auto& [field, value] : {std::pair{"Ux", x}, {"Uy", y}, {"Uz", 0.5 * y}, {"p", 2 * x}})
      log.feed(fmt::format("smoothSolver:  Solving for {}, Initial residual = {}, Final", field, value));
    EXPECT_TRUE(log.feed("ExecutionTime = 1 s"));
  };
  iteration("1", 0.4, 0.3);
  EXPECT_EQ(log.progress().residual_u, 0.4);
  iteration("2", 0.1, 0.2);
  EXPECT_EQ(log.progress().iteration, 2);
  EXPECT_EQ(log.progress().residual_u, 0.2);
  EXPECT_EQ(log.progress().residual_p, 0.2);
}

}  // namespace
}  // namespace ripstop::openfoam
