// Reports of several mistakes, of options, and of files that cannot be read.
#include <gtest/gtest.h>

#include <fstream>

#include "fixture.h"

namespace ripstop {
namespace {

TEST(Mistakes, AllOfThemAreReportedTogetherInTheOrderOfTheFile) {
  std::string text = replaced(valid_case, "= 2000", "= 3");
  text = replaced(text, "\"small\"", "7");
  text = replaced(text, "cells =", "cels =");
  text = replaced(text, "length_m = 1.5", "length_m = 0.2");
  const Outcome outcome = outcome_of(text);
  std::vector<std::string> keys;
  for (const Problem& problem : outcome.problems) keys.push_back(problem.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"title", "parachute.lines.length_m", "parachute.mesh.cloth_nodes",
                                            "flow.cels"}));
  EXPECT_TRUE(outcome.message.starts_with("4 problems:\n")) << outcome.message;
}

TEST(Mistakes, TheFlowsOwnLoadIsOfASheetOnly) {
  const auto with = [](const std::string& model) {
    return outcome_of(
        replaced(valid_case, "[[measured]]",
                 "porosity_model = \"" + model + "\"\n[coupling]\nload = \"of-flow\"\n[[measured]]"));
  };
  EXPECT_TRUE(with("sheet").problems.empty()) << with("sheet").message;
  const Outcome paper = with("paper");
  ASSERT_EQ(paper.problems.size(), 1u) << paper.message;
  EXPECT_EQ(paper.problems[0].key, "coupling.load");
  EXPECT_NE(paper.message.find("only in the sheet model"), std::string::npos);
  const Outcome misspelt = with("papr");
  ASSERT_EQ(misspelt.problems.size(), 1u) << misspelt.message;
  EXPECT_EQ(misspelt.problems[0].key, "flow.porosity_model");
  // Consequences of the misspelt word are no separate mistakes.
  const Outcome calibrated = outcome_of(
      replaced(replaced(valid_case, "gores = 6", "gores = 6\ncanopy_material = \"f-111\""), "[[measured]]",
               "porosity_model = \"papr\"\n[coupling]\nload = \"of-flow\"\n[[measured]]"));
  ASSERT_EQ(calibrated.problems.size(), 1u) << calibrated.message;
  EXPECT_EQ(calibrated.problems[0].key, "flow.porosity_model");
}

TEST(Mistakes, AnEmptyFileMissesItsTables) {
  const Outcome outcome = outcome_of("");
  ASSERT_EQ(outcome.problems.size(), 2u) << outcome.message;
  EXPECT_NE(outcome.message.find("[parachute]"), std::string::npos);
  EXPECT_NE(outcome.message.find("[flow]"), std::string::npos);
}

TEST(Mistakes, AnOptionIsNamedInsteadOfALine) {
  const Outcome outcome = outcome_of(valid_case, {.speed = 500, .grid = std::array{20, 2, 30}, .ranks = 0});
  ASSERT_EQ(outcome.problems.size(), 3u) << outcome.message;
  EXPECT_NE(outcome.message.find("--speed: flow.speed_m_s = 500: must be above 0 and at most 100 m/s"),
            std::string::npos)
      << outcome.message;
  EXPECT_NE(outcome.message.find("--grid: flow.cells[1] = 2: must be at least 4"), std::string::npos);
  EXPECT_NE(outcome.message.find("--ranks: flow.ranks = 0: must be at least 1"), std::string::npos);
}

TEST(Mistakes, AnOptionReplacesAMistakeInTheFile) {
  EXPECT_TRUE(
      outcome_of(replaced(valid_case, "speed_m_s = 20\nbox", "speed_m_s = 2000\nbox"), {.speed = 20}).valid);
  EXPECT_TRUE(outcome_of(replaced(valid_case, "speed_m_s = 20\nbox", "box"), {.speed = 20}).valid);
  EXPECT_TRUE(
      outcome_of(replaced(valid_case, "speed_m_s = 20\nbox", "speed_m_s = \"fast\"\nbox"), {.speed = 20})
          .valid);
}

TEST(Mistakes, ARefusedOptionLeavesTheCaseAsItWas) {
  Case given = parse_case(valid_case, "case.toml");
  EXPECT_THROW(apply({.speed = -1}, given), InputError);
  EXPECT_EQ(given.flow.speed_m_s, 20);
  EXPECT_THROW(apply({.speed = std::nan("")}, given), InputError);
  apply({.grid = std::array{30, 30, 40}, .linear = true}, given);
  EXPECT_EQ(given.flow.cells, (std::array{30, 30, 40}));
  EXPECT_TRUE(given.coupling.linear);
}

TEST(Mistakes, AFileThatCannotBeReadHasItsOwnExitCode) {
  for (const std::string path : {"/no/such/case.toml", "/tmp"}) {
    try {
      read_case(path);
      ADD_FAILURE() << path << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::io);
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
    }
  }
}

TEST(Mistakes, ABrokenMaterialFileIsBadDataAndNamesTheFile) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "ripstop-broken-material.toml";
  std::ofstream(file) << "kind = \"line\"\ncoefficients_n = [1000.0]\nlinear_density_kg_m = -1\n";
  try {
    read_material(file);
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_EQ(error.what(),
              file.string() + ":3:23: linear_density_kg_m = -1: must be above 0 and at most 100 kg/m");
  }
  std::filesystem::remove(file);
}

TEST(Nearest, FindsTheWordThatWasMeantAndNoOther) {
  const std::vector<std::string> keys = {"speed_m_s", "speed_basis", "cells", "box_m"};
  EXPECT_EQ(nearest("sped_m_s", keys), "speed_m_s");
  EXPECT_EQ(nearest("Cells", keys), "cells");
  EXPECT_EQ(nearest("speed-basis", keys), "speed_basis");
  EXPECT_EQ(nearest("box", keys), "box_m");
  EXPECT_EQ(nearest("temperature", keys), "");
  EXPECT_EQ(nearest("x", keys), "");
}

}  // namespace
}  // namespace ripstop
