// The commands `check` and `schema` as a user meets them: exit codes, messages, JSON.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class Check : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("ripstop-check-" + std::to_string(getpid()));
    fs::create_directories(folder_ / "materials");
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  fs::path folder_;
};

TEST_F(Check, MassesAndAreasAreThoseOfThePattern) {
  const Finished run = ripstop_with({"check", stratos, "--json"});
  ASSERT_EQ(run.code, 0) << run.output;
  const auto report = nlohmann::json::parse(run.output);
  EXPECT_TRUE(report["valid"]);
  EXPECT_NEAR(report["nominal_area_m2"].get<double>(), 1.7215, 1e-4);
  EXPECT_NEAR(report["meshed_area_m2"].get<double>(), 1.7215, 1e-3);  // a polygon of 2.6 degrees a side
  // As cut: six band panels with seams of 15 mm at both sides and hems of 20 mm above and below.
  const double width = 3.14159265 / 6, bands = 6 * (width + 2 * 0.015) * (0.3 + 2 * 0.02);
  // Six gores of the disk from r = 0.045 to 0.5 m, seams at both sides and hems at both arcs.
  const double disk = 3.14159265 * (0.52 * 0.52 - 0.025 * 0.025) + 6 * 2 * 0.015 * (0.455 + 2 * 0.02);
  EXPECT_NEAR(report["mass_kg"]["cloth"].get<double>(), (bands + disk) * 0.0407, 2e-4);
  // Four hems, and seams along band and disk on six gores, of 6 g/m; each piece overlaps by 50 mm.
  const double hems = 3.14159265 * (3 * 1.0 + 0.09), seams = 6 * (0.3 + 0.455), overlaps = (4 + 2 * 6) * 0.05;
  EXPECT_NEAR(report["mass_kg"]["tape"].get<double>(), 6e-3 * (hems + seams + overlaps), 1e-4);
  // Free line, band, gap, disk and loops at both ends, 2 g/m.
  EXPECT_NEAR(report["mass_kg"]["lines"].get<double>(), 2e-3 * 18 * (1.5 + 0.3 + 0.07 + 0.455 + 2 * 0.1),
              1e-6);
  EXPECT_NEAR(report["cloth_nodes"].get<double>(), 25600, 256);
  EXPECT_GT(report["stable_step_s"].get<double>(), 4e-7);  // reduction allowed by the polar grid of [NFM]
  EXPECT_EQ(report["flow_cells"], 1500000);
  EXPECT_EQ(report["case"]["flow"]["density_kg_m3"], 1.2);
}

TEST_F(Check, ReportsTheTapeForTheLoadAndItsShareOfTheMass) {
  const auto checked_at = [&](const char* speed) {
    return ripstop_with(
        {"check", write("small.toml",
                        "[parachute]\ntype = \"flat-circular\"\nnominal_diameter_m = 0.5\n"
                        "vent_diameter_m = 0.05\ngores = 8\nlines = { count = 8, length_m = 0.5 }\n"
                        "[flow]\ndensity_kg_m3 = 1.2\nspeed_m_s = " +
                            std::string(speed) + "\n")
                      .string()});
  };
  const Finished slow = checked_at("10"), fast = checked_at("100");
  EXPECT_NE(slow.output.find("tape 0.0000 (0 %)"), std::string::npos) << slow.output;
  EXPECT_NE(slow.output.find(
                "parachute.tape.material      none                a hem of 20 mm of the cloth carries"),
            std::string::npos)
      << slow.output;
  EXPECT_NE(fast.output.find(
                "parachute.tape.material      nylon-tape-200-lbf  the lightest tape that carries the "),
            std::string::npos)
      << fast.output;
  EXPECT_NE(fast.output.find("in an opening at 100 m/s"), std::string::npos) << fast.output;
}

TEST_F(Check, AndADryRunEstimateTheTimeOfARun) {
  const Finished table = ripstop_with({"check", stratos}), json = ripstop_with({"check", stratos, "--json"});
  EXPECT_NE(table.output.find("  time               about 3.1 min on one core"), std::string::npos)
      << table.output;
  EXPECT_NEAR(nlohmann::json::parse(json.output)["core_time_s"].get<double>(), 186, 2);
  EXPECT_EQ(table.output.find("not known in advance"), std::string::npos);
  const Finished in_time =
      ripstop_with({"check", examples + "flat-circular/case.toml", "--set", "flow.unsteady=true"});
  EXPECT_NE(in_time.output.find("not known in advance"), std::string::npos) << in_time.output;
  const auto dry = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"steady", stratos, "--dry-run", "--out", (folder_ / "run").string()});
    return ripstop_with(more).output;
  };
  EXPECT_NE(dry({}).find(" GB and 3.1 min on one core; would run in "), std::string::npos) << dry({});
  EXPECT_NE(dry({"--grid", "120,120,180"}).find(" and 5.3 min on one core;"), std::string::npos);
  const std::string watched = dry({"--set", "flow.unsteady=true", "--set", "flow.porosity_model=sheet"});
  EXPECT_NE(watched.find(" GB; would run in "), std::string::npos) << watched;
}

// The list is the one that docs/guide/case-file.md shows.
TEST_F(Check, ListsTheOriginOfEveryDefaultValue) {
  const std::string flat = RIPSTOP_SOURCE_DIR "/examples/flat-circular/case.toml";
  const Finished table = ripstop_with({"check", flat, "--set", "flow.canopy_position_m=2.8"});
  ASSERT_EQ(table.code, 0) << table.output;
  std::istringstream list(table.output.substr(table.output.find("\n\n") + 2));
  // The guide leaves out lines in the middle, from the core to the coupling, whose values its table has.
  std::string line, shown, left_out;
  int lines = 0;
  for (; std::getline(list, line); ++lines) {
    const std::size_t folder = line.find(RIPSTOP_SOURCE_DIR "/");
    if (folder != std::string::npos) line.erase(folder, std::string(RIPSTOP_SOURCE_DIR "/").size());
    const bool in_guide = lines < 11 || lines == 24;
    (in_guide ? shown : left_out) += (lines == 24 ? "      ...\n    " : "    ") + line + "\n";
  }
  EXPECT_EQ(lines, 25);
  EXPECT_NE(read_file(RIPSTOP_SOURCE_DIR "/docs/guide/case-file.md").find(shown), std::string::npos) << shown;
  EXPECT_NE(left_out.find("flow.core.size_m             1.26 x 1.26 x 1.54  1.8 x 1.8 x 2.2 inflated"),
            std::string::npos);
  for (const char* name :
       {"flow.core.growth             1.125", "flow.core.off_axis           0",
        "flow.convection              second-order", "flow.sides                   entraining",
        "flow.outlet                  still-air", "flow.residual                0.0003",
        "flow.max_iterations          300", "flow.average_over            60",
        "coupling.load                of-flow", "coupling.drag_tolerance      0.005"})
    EXPECT_NE(left_out.find(name), std::string::npos) << name;
  const auto report = nlohmann::json::parse(ripstop_with({"check", flat, "--json"}).output);
  for (const auto& source : report["sources"]) {
    if (source["key"] != "flow.cells") continue;
    EXPECT_EQ(source["value"], (nlohmann::json{80, 80, 98}));
    EXPECT_EQ(source["given"], false);
    EXPECT_EQ(source["from"], "default of the sheet model");
  }
}

TEST_F(Check, OptionsChangeTheCaseAndAreNamedWhenTheyAreWrong) {
  const Finished fine = ripstop_with(
      {"check", stratos, "--json", "--speed", "20", "--grid", "50,50,75", "--set", "flow.box_m=[4,4,8]"});
  ASSERT_EQ(fine.code, 0) << fine.output;
  EXPECT_EQ(nlohmann::json::parse(fine.output)["flow_spacing_m"][0], 0.08);
  EXPECT_EQ(nlohmann::json::parse(fine.output)["flow_cells"], 187500);
  EXPECT_EQ(nlohmann::json::parse(fine.output)["density_kg_m3"], 1.199);
  const Finished wrong = ripstop_with({"check", stratos, "--speed", "500"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.output.find("--speed: flow.speed_m_s = 500: must be above 0 and at most 100 m/s"),
            std::string::npos)
      << wrong.output;
}

TEST_F(Check, AMeshTooCoarseForTheCanopysSizeIsReported) {
  std::ifstream stream(RIPSTOP_SOURCE_DIR "/examples/flat-circular/case.toml");
  std::string text((std::istreambuf_iterator<char>(stream)), {});
  const auto at = text.find("cloth_nodes = 12000");
  ASSERT_NE(at, std::string::npos);
  const Finished fine = ripstop_with({"check", write("fine.toml", text).string()});
  EXPECT_EQ(fine.code, 0);
  EXPECT_EQ(fine.output.find("warning"), std::string::npos) << fine.output;
  text.replace(at, 19, "cloth_nodes = 1000");
  const Finished coarse = ripstop_with({"check", write("coarse.toml", text).string()});
  EXPECT_EQ(coarse.code, 0);
  EXPECT_NE(coarse.output.find("warning: parachute.mesh.cloth_nodes = 1000"), std::string::npos)
      << coarse.output;
  // It does not print "none" together with a warning.
  EXPECT_NE(fine.output.find("problems           none\n"), std::string::npos) << fine.output;
  EXPECT_NE(coarse.output.find("problems           no error, 1 warning below\n"), std::string::npos)
      << coarse.output;
  const Finished json = ripstop_with({"check", (folder_ / "coarse.toml").string(), "--json"});
  EXPECT_EQ(nlohmann::json::parse(json.output).at("warnings").size(), 1u);
}

TEST_F(Check, TheProblemsOfACaseComeAsTextAndAsJson) {
  const fs::path file = write("bad.toml", "title = 3\n[flow]\nsped_m_s = 4\n");
  const Finished text = ripstop_with({"check", file.string()});
  EXPECT_EQ(text.code, 2);
  EXPECT_NE(text.output.find(file.string() + ":3:1: flow.sped_m_s: unknown key; did you mean \"speed_m_s\"?"),
            std::string::npos)
      << text.output;
  const Finished json = ripstop_with({"check", file.string(), "--json"});
  EXPECT_EQ(json.code, 2);
  const auto report = nlohmann::json::parse(json.output);
  EXPECT_FALSE(report["valid"]);
  // In the order of the file: [parachute] is missing from all of it, then title, sped_m_s, speed_m_s.
  ASSERT_EQ(report["problems"].size(), 4u) << json.output;
  EXPECT_EQ(report["problems"][1]["key"], "title");
  EXPECT_EQ(report["problems"][1]["line"], 1);
  EXPECT_EQ(report["problems"][1]["column"], 9);
}

TEST_F(Check, ABrokenLibraryAndAMissingFileHaveTheirOwnExitCodes) {
  for (const char* name : {"spectra-line", "twaron-line", "nylon-tape"})
    fs::copy_file(fs::path(RIPSTOP_SOURCE_DIR) / "materials" / (std::string(name) + ".toml"),
                  folder_ / "materials" / (std::string(name) + ".toml"));
  write("materials/f-111.toml",
        "kind = \"fabric\"\ncoefficients_n_m = [1.0]\nareal_density_kg_m2 = 0\nthickness_m = 1e-4\n");
  const Finished broken = ripstop_with({"check", stratos}, folder_);
  EXPECT_EQ(broken.code, 3);
  EXPECT_NE(broken.output.find("f-111.toml:3:23: areal_density_kg_m2 = 0: must be above 0"),
            std::string::npos)
      << broken.output;
  const Finished missing = ripstop_with({"check", (folder_ / "none.toml").string()});
  EXPECT_EQ(missing.code, 7);
  EXPECT_NE(missing.output.find("none.toml: cannot be opened"), std::string::npos) << missing.output;
}

TEST_F(Check, TheResolvedCaseNeedsNoLibraryAndIsTheSameCase) {
  const Finished resolved = ripstop_with({"check", stratos, "--resolved"});
  ASSERT_EQ(resolved.code, 0);
  const fs::path file = write("resolved.toml", resolved.output);
  const Finished again =
      ripstop_with({"check", file.string(), "--resolved"}, folder_);  // materials/ is empty there
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(again.output, resolved.output);
}

TEST(Schema, IsJsonWithAllTables) {
  const Finished run = ripstop_with({"schema"});
  ASSERT_EQ(run.code, 0);
  const auto schema = nlohmann::json::parse(run.output);
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  for (const char* table : {"parachute", "materials", "flow", "coupling", "measured"})
    EXPECT_TRUE(schema["properties"].contains(table)) << table;
}

TEST(Help, OfEveryCommandHasAnExample) {
  for (const char* command : {"check", "schema"}) {
    const Finished run = ripstop_with({command, "--help"});
    EXPECT_EQ(run.code, 0);
    EXPECT_NE(run.output.find(std::string("Example: ripstop ") + command), std::string::npos) << run.output;
  }
  EXPECT_EQ(ripstop_with({"chekc"}).code, 2);
  EXPECT_EQ(ripstop_with({"check"}).code, 2);
}

}  // namespace
}  // namespace ripstop
