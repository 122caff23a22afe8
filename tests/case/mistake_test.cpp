// Every kind of mistake is told with its file, line, column, key, value and what is allowed.
#include <gtest/gtest.h>

#include <fstream>

#include "fixture.h"

namespace ripstop {
namespace {

struct Mistake {
  std::string name;
  std::string from, to;                // what is spoilt in valid_case
  std::string place;                   // "case.toml:5:19"
  std::string key;                     // full name
  std::string value;                   // as shown; empty: there is none
  std::vector<std::string> must_hold;  // further parts of the message
};

void PrintTo(const Mistake& mistake, std::ostream* stream) {
  *stream << mistake.name;
}

const std::string materials_end = "density_kg_m3 = 1.199\n";

const std::vector<Mistake> mistakes = {
    // Words and types.
    {"UnknownKey",
     "gores = 6",
     "gores = 6\ngoers = 6",
     "case.toml:9:1",
     "parachute.goers",
     "",
     {"unknown key", "did you mean \"gores\"?"}},
    {"UnknownKeyFarFromAll",
     "gores = 6",
     "gores = 6\nzebra = 6",
     "case.toml:9:1",
     "parachute.zebra",
     "",
     {"unknown key", "known here: ", "gap_height_m"}},
    {"KeyWithoutItsUnit",
     "speed_m_s = 20\nbox",
     "speed_m_s = 20\nviscosity = 1e-5\nbox",
     "case.toml:16:1",
     "flow.viscosity",
     "",
     {"did you mean \"viscosity_pa_s\"?"}},
    {"UnknownTable",
     "[parachute.mesh]",
     "[parachute.mash]",
     "case.toml:12:",
     "parachute.mash",
     "",
     {"unknown table", "did you mean \"mesh\"?"}},
    {"MissingKey",
     "gores = 6\n",
     "",
     "case.toml:2:1",
     "parachute.gores",
     "",
     {"is missing", "at least 3 and at most 500"}},
    {"MissingKind",
     "type = \"disk-gap-band\"\n",
     "",
     "case.toml:2:1",
     "parachute.type",
     "",
     {"is missing", "\"disk-gap-band\""}},
    {"MissingTable",
     "[parachute.lines]\ncount = 18\nlength_m = 1.5\n",
     "",
     "case.toml:2:1",
     "parachute.lines",
     "",
     {"[parachute.lines]", "missing"}},
    {"TextForNumber",
     "= 0.09",
     "= \"0.09\"",
     "case.toml:5:19",
     "parachute.vent_diameter_m",
     "\"0.09\"",
     {"must be a number, not text"}},
    {"NumberForTable",
     "gores = 6",
     "gores = 6\nriser = 3",
     "case.toml:9:9",
     "parachute.riser",
     "3",
     {"must be a table, not an integer"}},
    {"FractionForInteger",
     "gores = 6",
     "gores = 6.5",
     "case.toml:8:9",
     "parachute.gores",
     "6.5",
     {"must be a whole number"}},
    {"DateForNumber",
     "= 0.09",
     "= 1979-05-27",
     "case.toml:5:19",
     "parachute.vent_diameter_m",
     "",
     {"must be a number, not a date"}},
    {"NotANumber",
     "= 0.09",
     "= nan",
     "case.toml:5:19",
     "parachute.vent_diameter_m",
     "nan",
     {"must be a finite number"}},
    {"Infinity",
     "speed_m_s = 20\nbox",
     "speed_m_s = inf\nbox",
     "case.toml:15:13",
     "flow.speed_m_s",
     "inf",
     {"must be a finite number"}},
    {"WordNotInList",
     "\"disk-gap-band\"",
     "\"disk-gap-bend\"",
     "case.toml:3:8",
     "parachute.type",
     "\"disk-gap-bend\"",
     {"one of \"disk-gap-band\", ", "did you mean \"disk-gap-band\"?"}},
    {"WordNotInLongerList",
     "speed_m_s = 20\nbox",
     "speed_m_s = 20\nspeed_basis = \"mesured\"\nbox",
     "case.toml:16:15",
     "flow.speed_basis",
     "\"mesured\"",
     {"one of \"nominal\", \"measured\"", "did you mean \"measured\"?"}},
    {"ListTooShort",
     "[20, 20, 30]",
     "[20, 20]",
     "case.toml:17:9",
     "flow.cells",
     "[20, 20]",
     {"must have 3 numbers, not 2"}},
    {"TextInList",
     "[20, 20, 30]",
     "[20, 20, \"many\"]",
     "case.toml:17:18",
     "flow.cells[2]",
     "\"many\"",
     {"must be an integer, not text"}},
    {"LineBreakInTitle",
     "\"small\"",
     "\"a\\nb\"",
     "case.toml:1:9",
     "title",
     "\"a\\x0ab\"",
     {"control characters"}},
    {"PathAsMaterial",
     "length_m = 1.5",
     "length_m = 1.5\nmaterial = \"../../etc/passwd\"",
     "case.toml:12:12",
     "parachute.lines.material",
     "\"../../etc/passwd\"",
     {"must be a name"}},
    // Ranges.
    {"NegativeGap",
     "= 0.07",
     "= -0.07",
     "case.toml:6:16",
     "parachute.gap_height_m",
     "-0.07",
     {"at least 0.001 and at most 100"}},
    {"BandWithoutHeight",
     "= 0.3",
     "= 0",
     "case.toml:7:17",
     "parachute.band_height_m",
     "0",
     {"at least 0.001"}},
    {"TwoGores",
     "gores = 6",
     "gores = 2",
     "case.toml:8:9",
     "parachute.gores",
     "2",
     {"at least 3 and at most 500"}},
    {"NoLines", "count = 18", "count = 0", "case.toml:10:9", "parachute.lines.count", "0", {"at least 3"}},
    {"IntegerBeyondInt",
     "count = 18",
     "count = 9999999999",
     "case.toml:10:9",
     "parachute.lines.count",
     "2147483647",
     {"at most 500"}},
    {"NoSpeed",
     "speed_m_s = 20\nbox",
     "speed_m_s = 0\nbox",
     "case.toml:15:13",
     "flow.speed_m_s",
     "0",
     {"above 0 and at most 100"}},
    {"NoAir",
     "= 1.199",
     "= 0",
     "case.toml:21:17",
     "measured[0].density_kg_m3",
     "0",
     {"above 0 and at most 20"}},
    {"MeshTooCoarse",
     "= 2000",
     "= 100",
     "case.toml:13:15",
     "parachute.mesh.cloth_nodes",
     "100",
     {"at least 500 and at most 2000000"}},
    {"MeshTooFine",
     "= 2000",
     "= 3_000_000",
     "case.toml:13:15",
     "parachute.mesh.cloth_nodes",
     "3000000",
     {"at most 2000000"}},
    {"OneSideWithoutLength",
     "[2, 2, 4]",
     "[2, 0.0, 4]",
     "case.toml:16:13",
     "flow.box_m[1]",
     "0",
     {"above 0"}},
    {"ThreeCells",
     "[20, 20, 30]",
     "[20, 20, 3]",
     "case.toml:17:18",
     "flow.cells[2]",
     "3",
     {"at least 4 and at most 2000"}},
    // Impossible together.
    {"VentWiderThanDisk",
     "= 0.09",
     "= 1.0",
     "case.toml:5:19",
     "parachute.vent_diameter_m",
     "1",
     {"smaller than the disk", "parachute.disk_diameter_m = 1"}},
    {"LinesShorterThanRadius",
     "length_m = 1.5",
     "length_m = 0.5",
     "case.toml:11:12",
     "parachute.lines.length_m",
     "0.5",
     {"longer than the radius of the skirt, 0.5 m"}},
    {"LinesPastTheVent",
     "length_m = 1.5",
     "length_m = 1.5\nonto_disk_m = 0.46",
     "case.toml:12:15",
     "parachute.lines.onto_disk_m",
     "0.46",
     {"past the vent's edge", "0.455 m"}},
    {"SegmentLongerThanHalfALine",
     "= 2000",
     "= 2000\nline_segment_m = 0.8",
     "case.toml:14:18",
     "parachute.mesh.line_segment_m",
     "0.8",
     {"a line of 1.5 m needs at least two springs"}},
    {"LinesAndGoresWithoutACommonColumn",
     "count = 18\nlength_m",
     "count = 89\nlength_m",
     "case.toml:10:9",
     "parachute.lines.count",
     "89",
     {"89 lines on 6 gores", "multiple of 534 columns", "cloth_nodes = 2000"}},
    {"CanopyWiderThanBox",
     "[2, 2, 4]",
     "[2, 0.9, 4]",
     "case.toml:16:13",
     "flow.box_m[1]",
     "0.9",
     {"a canopy of 1 m diameter does not fit into the box"}},
    {"CanopyPastTheOutlet",
     "box_m",
     "canopy_position_m = 3.5\nbox_m",
     "case.toml:16:21",
     "flow.canopy_position_m",
     "3.5",
     {"past the end of the box at 4 m", "to 4.37 m"}},
    {"BoxShorterThanCanopy",
     "[2, 2, 4]",
     "[2, 2, 1.5]",
     "case.toml:16:16",
     "flow.box_m[2]",
     "1.5",
     {"past the end of the box at 1.5 m"}},
    {"TooFewCellsAcrossTheCanopy",
     "[2, 2, 4]",
     "[8, 2, 4]",
     "case.toml:17:10",
     "flow.cells[0]",
     "20",
     {"only 2.5 cells lie across the canopy's diameter"}},
    {"CoreSmallerThanTheCanopy",
     "[20, 20, 30]",
     "[20, 20, 30]\ncore = { size_m = [0.2, 1.5, 1.5] }",
     "case.toml:18:20",
     "flow.core.size_m[0]",
     "0.2",
     {"does not fit into the fine core"}},
    {"CoreBehindTheSkirt",
     "[20, 20, 30]",
     "[20, 20, 30]\ncore = { size_m = [1.5, 1.5, 1.5], start_m = 2.4 }",
     "case.toml:18:46",
     "flow.core.start_m",
     "2.4",
     {"the skirt, at 2 m, lies before the fine core"}},
    {"CoreLongerThanTheBox",
     "[20, 20, 30]",
     "[20, 20, 30]\ncore = { size_m = [1.5, 1.5, 5], start_m = 0.5 }",
     "case.toml:18:8",
     "flow.core",
     "",
     {"core"}},
    {"AverageOverMoreIterationsThanThereAre",
     "[20, 20, 30]",
     "[20, 20, 30]\naverage_over = 200\nmax_iterations = 100",
     "case.toml:18:16",
     "flow.average_over",
     "200",
     {"a flow solution has no more iterations than that"}},
    {"TooManyCells",
     "[20, 20, 30]",
     "[2000, 2000, 2000]",
     "case.toml:17:9",
     "flow.cells",
     "[2000, 2000, 2000]",
     {"8e+09 cells are more than 2e+08"}},
    {"NoRowToTakeTheDensityFrom",
     "speed_m_s = 20\nbox",
     "speed_m_s = 22\nbox",
     "case.toml:14:1",
     "flow.density_kg_m3",
     "",
     {"is missing", "nominal speed 22", "[[measured]] has rows for 20"}},
    {"NoRowToTakeTheSpeedFrom",
     "speed_m_s = 20\nbox",
     "speed_m_s = 22\nspeed_basis = \"measured\"\ndensity_kg_m3 = 1.2\nbox",
     "case.toml:15:13",
     "flow.speed_m_s",
     "22",
     {"needs a row of [[measured]]", "has rows for 20"}},
    {"TwoRowsOfOneSpeed",
     "density_kg_m3 = 1.199\n",
     "density_kg_m3 = 1.199\n[[measured]]\nnominal_speed_m_s = 20\nmeasured_speed_m_s = 21\ndensity_kg_m3 = "
     "1.2\n",
     "case.toml:23:21",
     "measured[1].nominal_speed_m_s",
     "20",
     {"already a row"}},
    // Materials.
    {"UnknownMaterial",
     "gores = 6",
     "gores = 6\ncanopy_material = \"f-11\"",
     "case.toml:9:19",
     "parachute.canopy_material",
     "\"f-11\"",
     {"did you mean \"f-111\"?", "[materials.f-11]"}},
    {"MaterialOfTheWrongKind",
     "length_m = 1.5",
     "length_m = 1.5\nmaterial = \"f-111\"",
     "case.toml:12:12",
     "parachute.lines.material",
     "\"f-111\"",
     {"is a fabric; a line is needed here"}},
    {"MaterialWithoutStiffness",
     materials_end,
     materials_end +
         "[materials.cord]\nkind = \"line\"\ncoefficients_n = [0.0, 5.0]\nlinear_density_kg_m = 0.002\n",
     "case.toml:24:19",
     "materials.cord.coefficients_n[0]",
     "0",
     {"must be above 0"}},
    {"CurveThatFallsWithinTheTestedStrain",
     materials_end,
     materials_end + "[materials.soft]\nbase = \"f-111\"\ntested_strain = 0.8\n",
     "case.toml:22:",
     "materials.soft.coefficients_n_m",
     "[30006, -18936]",
     {"falls with growing strain beyond 0.79", "tested_strain = 0.8"}},
    {"NothingLeftForAxialSprings",
     materials_end,
     materials_end + "[materials.soft]\nbase = \"f-111\"\nshear_fraction = 0.7\nbending_fraction = 0.4\n",
     "case.toml:24:18",
     "materials.soft.shear_fraction",
     "0.7",
     {"bending_fraction = 0.4", "below 1"}},
    {"KeyOfAnotherKind",
     materials_end,
     materials_end + "[materials.cord]\nbase = \"spectra-line\"\nthickness_m = 0.002\n",
     "case.toml:24:1",
     "materials.cord.thickness_m",
     "",
     {"unknown key"}},
    {"KindThatTheBaseHasNot",
     materials_end,
     materials_end + "[materials.cord]\nbase = \"spectra-line\"\nkind = \"tape\"\n",
     "case.toml:24:8",
     "materials.cord.kind",
     "\"tape\"",
     {"differs from the kind of `base`, \"line\""}},
    {"UnknownBase",
     materials_end,
     materials_end + "[materials.cord]\nbase = \"spectra\"\n",
     "case.toml:23:8",
     "materials.cord.base",
     "\"spectra\"",
     {"did you mean \"spectra-line\"?"}},
    // Syntax.
    {"DoubleKey", "gores = 6", "gores = 6\ngores = 7", "case.toml:9:", "", "", {"not valid TOML", "gores"}},
    {"OpenQuote", "\"small\"", "\"small", "case.toml:1:", "", "", {"not valid TOML"}},
};

class EveryMistake : public testing::TestWithParam<Mistake> {};

TEST_P(EveryMistake, IsToldWithPlaceKeyValueAndWhatIsAllowed) {
  const Mistake& mistake = GetParam();
  const Outcome outcome = outcome_of(replaced(valid_case, mistake.from, mistake.to));
  ASSERT_FALSE(outcome.valid);
  EXPECT_EQ(outcome.code, ExitCode::usage);
  bool found = false;
  for (const Problem& problem : outcome.problems) {
    if (problem.key != mistake.key) continue;
    found = true;
    const std::string text = to_text(problem);
    EXPECT_TRUE(text.starts_with(mistake.place)) << text;
    EXPECT_EQ(problem.value, mistake.value);
    if (!mistake.value.empty()) {
      const std::string shown = mistake.key + " = " + mistake.value + ": ";
      EXPECT_NE(text.find(shown), std::string::npos) << text;
    }
    for (const std::string& part : mistake.must_hold) EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(outcome.message.find(text), std::string::npos) << outcome.message;
  }
  EXPECT_TRUE(found) << outcome.message;
}

INSTANTIATE_TEST_SUITE_P(Case, EveryMistake, testing::ValuesIn(mistakes),
                         [](const auto& row) { return row.param.name; });

TEST(Mistakes, OneMistakeIsOneProblem) {
  for (const Mistake& mistake : mistakes) {
    EXPECT_EQ(outcome_of(replaced(valid_case, mistake.from, mistake.to)).problems.size(), 1u)
        << outcome_of(replaced(valid_case, mistake.from, mistake.to)).message;
  }
}

TEST(Mistakes, AllOfThemAreToldAtOnceInTheOrderOfTheFile) {
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

TEST(Mistakes, AnEmptyFileMissesItsTables) {
  const Outcome outcome = outcome_of("");
  ASSERT_EQ(outcome.problems.size(), 2u) << outcome.message;
  EXPECT_NE(outcome.message.find("[parachute]"), std::string::npos);
  EXPECT_NE(outcome.message.find("[flow]"), std::string::npos);
}

TEST(Mistakes, AnOptionIsNamedInsteadOfALine) {
  const Outcome outcome = outcome_of(valid_case, {.speed = 500, .grid = std::array{20, 2, 30}, .ranks = 0});
  ASSERT_EQ(outcome.problems.size(), 3u) << outcome.message;
  EXPECT_NE(outcome.message.find("--speed: flow.speed_m_s = 500: must be above 0 and at most 100"),
            std::string::npos)
      << outcome.message;
  EXPECT_NE(outcome.message.find("--grid: flow.cells[1] = 2: must be at least 4"), std::string::npos);
  EXPECT_NE(outcome.message.find("--ranks: flow.ranks = 0: must be at least 1"), std::string::npos);
}

TEST(Mistakes, AnOptionReplacesAMistakeInTheFile) {
  EXPECT_TRUE(
      outcome_of(replaced(valid_case, "speed_m_s = 20\nbox", "speed_m_s = 2000\nbox"), {.speed = 20}).valid);
  EXPECT_TRUE(outcome_of(replaced(valid_case, "speed_m_s = 20\nbox", "box"), {.speed = 20}).valid);
}

TEST(Mistakes, ARefusedOptionLeavesTheCaseAsItWas) {
  Case value = parse_case(valid_case, "case.toml");
  EXPECT_THROW(apply({.speed = -1}, value), InputError);
  EXPECT_EQ(value.flow.speed_m_s, 20);
  EXPECT_THROW(apply({.speed = std::nan("")}, value), InputError);
  apply({.grid = std::array{30, 30, 40}, .linear = true}, value);
  EXPECT_EQ(value.flow.cells, (std::array{30, 30, 40}));
  EXPECT_TRUE(value.coupling.linear);
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
              file.string() + ":3:23: linear_density_kg_m = -1: must be above 0 and at most 100");
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
