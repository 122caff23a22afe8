// The JSON Schema agrees with the reader, tested with an independent validator, and the reference page agrees
// with the tables.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "fixture.h"
#include "ripstop/core/file.h"
#include "ripstop/core/process.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

// Changes of valid_case, harmful or harmless.
const std::vector<std::pair<std::string, std::string>> changes = {
    {"gores = 6", "gores = 6.5"},
    {"gores = 6", "gores = 6.0"},  // valid: JSON does not distinguish 6.0 and 6
    {"gores = 6", "gores = 2"},
    {"gores = 6", "gores = 501"},
    {"gores = 6", "gores = 500"},  // the schema has no words for columns: see below
    {"gores = 6", "gores = true"},
    {"gores = 6\n", ""},
    {"gores = 6", "gores = 6\ngoers = 6"},
    {"= 0.09", "= \"0.09\""},
    {"= 0.09", "= [0.09]"},
    {"= 0.07", "= -0.07"},
    {"= 0.3", "= 0"},
    {"\"disk-gap-band\"", "\"disk\""},
    {"type = \"disk-gap-band\"\n", ""},
    {"\"small\"", "\"a\\nb\""},
    {"\"small\"", "\"a\\n\""},
    {"\"small\"", "\"" + std::string(201, 'a') + "\""},
    {"\"small\"", "\"" + std::string(200, 'a') + "\""},
    {"\"small\"", "3"},
    {"speed_m_s = 20\nbox", "speed_m_s = 0\nbox"},
    {"speed_m_s = 20\nbox", "speed_m_s = 100\ndensity_kg_m3 = 1.2\nbox"},
    {"speed_m_s = 20\nbox", "speed_m_s = 100.5\ndensity_kg_m3 = 1.2\nbox"},
    {"speed_m_s = 20\nbox", "speed_m_s = 20\nspeed_basis = \"mesured\"\nbox"},
    {"speed_m_s = 20\nbox", "speed_m_s = 20\nspeed_basis = \"measured\"\nbox"},
    {"[20, 20, 30]", "[20, 20]"},
    {"[20, 20, 30]", "[20, 20, 30, 40]"},
    {"[20, 20, 30]", "[20, 20, 3]"},
    {"[20, 20, 30]", "[20, 20, 30.5]"},
    {"[2, 2, 4]", "[2, 2, 0]"},
    {"= 2000", "= 499"},
    {"= 2000", "= 500"},
    {"count = 18\n", ""},
    {"length_m = 1.5", "length_m = 1.5\nmaterial = \"../f-111\""},
    {"length_m = 1.5", "length_m = 1.5\nmaterial = \"twaron-line\\n\""},
    {"length_m = 1.5", "length_m = 1.5\nmaterial = \"twaron-line\""},
    {"length_m = 1.5", "length_m = 1.5\n[parachute.tape]\nseams = 1"},
    {"length_m = 1.5", "length_m = 1.5\n[parachute.tape]\nseams = false"},
    {"length_m = 1.5", "length_m = 1.5\n[parachute.tape]\nmaterial = \"none\""},
    {"length_m = 1.5", "length_m = 1.5\n[parachute.tape]\nmaterial = \"a b\""},
    {"length_m = 1.5", "length_m = 1.5\n[parachute.tape]\nmaterial = 3"},
    {"[[measured]]", "[measured]"},
    {"density_kg_m3 = 1.199", "density_kg_m3 = 1.199\ndrag_n = 0"},
    {"density_kg_m3 = 1.199", "density_kg_m3 = 1.199\ndrag_n = 100"},
    {"density_kg_m3 = 1.199", "density_kg_m3 = 1.199\n[materials]\ncord = 3"},
    {"density_kg_m3 = 1.199", "density_kg_m3 = 1.199\n[materials.cord]\nkind = \"line\""},
    {"density_kg_m3 = 1.199", "density_kg_m3 = 1.199\n[materials.cord]\nbase = \"spectra-line\""},
    {"density_kg_m3 = 1.199", "density_kg_m3 = 1.199\n[materials.\"a b\"]\nbase = \"spectra-line\""},
    {"density_kg_m3 = 1.199",
     "density_kg_m3 = 1.199\n[materials.cord]\nkind = \"line\"\ncoefficients_n = [5.0]\n"
     "linear_density_kg_m = 0.002"},
    {"density_kg_m3 = 1.199",
     "density_kg_m3 = 1.199\n[materials.cord]\nkind = \"line\"\ncoefficients_n = []\n"
     "linear_density_kg_m = 0.002"},
    {"density_kg_m3 = 1.199",
     "density_kg_m3 = 1.199\n[materials.cord]\nkind = \"line\"\ncoefficients_n = [5.0]\n"
     "linear_density_kg_m = 0.002\nthickness_m = 0.001"},
    {"density_kg_m3 = 1.199", "density_kg_m3 = 1.199\n[coupling]\nacceleration = \"aitken\"\nrelaxation = 1"},
    {"density_kg_m3 = 1.199", "density_kg_m3 = 1.199\n[coupling]\nrelaxation = 1.1"},
};

class Schema : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("ripstop-schema-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    std::ofstream(folder_ / "schema.json") << case_schema();
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& text) {
    const fs::path file = folder_ / (std::to_string(files_++) + ".toml");
    std::ofstream(file) << text;
    return file;
  }

  /// Results of python3-jsonschema for each file.
  std::vector<std::string> judge(const std::vector<fs::path>& files) const {
    ProcessRequest request;
    request.arguments = {"/usr/bin/python3", RIPSTOP_SOURCE_DIR "/tests/case/validate_cases.py",
                         (folder_ / "schema.json").string()};
    for (const fs::path& file : files) request.arguments.push_back(file.string());
    request.time_limit_s = 60;
    std::vector<std::string> verdicts;
    request.on_line = [&](const std::string& line) {
      verdicts.push_back(line);
      return true;
    };
    EXPECT_TRUE(run_process(request).succeeded());
    return verdicts;
  }

 private:
  fs::path folder_;
  int files_ = 0;
};

TEST(ShippedSchema, IsTheOutputOfTheProgram) {
  EXPECT_EQ(read_file(fs::path(RIPSTOP_SOURCE_DIR) / "examples/case.schema.json"), case_schema())
      << "ripstop schema > examples/case.schema.json";
}

TEST_F(Schema, AcceptsEveryExampleAndEveryResolvedCase) {
  std::vector<fs::path> files{write(valid_case),
                              write(case_toml(resolve(parse_case(valid_case, "case.toml"))))};
  for (const auto& entry : fs::directory_iterator(fs::path(RIPSTOP_SOURCE_DIR) / "examples")) {
    if (!exists(entry.path() / "case.toml")) continue;
    files.push_back(entry.path() / "case.toml");
    files.push_back(write(case_toml(resolve(read_case(files.back())))));
  }
  EXPECT_GE(files.size(), 6u);
  EXPECT_EQ(judge(files), std::vector<std::string>(files.size(), "valid"));
}

TEST_F(Schema, AndReaderAgreeOnEveryMistakeInASingleKey) {
  std::vector<fs::path> files;
  std::vector<std::string> expected;
  int invalid = 0;
  for (const auto& [from, to] : changes) {
    const std::string text = replaced(valid_case, from, to);
    const bool needs_two_keys = to == "gores = 500";
    files.push_back(write(text));
    expected.push_back(needs_two_keys || outcome_of(text).valid ? "valid" : "invalid");
    invalid += expected.back() == "invalid";
  }
  EXPECT_GT(invalid, 25);
  EXPECT_LT(invalid, static_cast<int>(changes.size()) - 8);
  const std::vector<std::string> verdicts = judge(files);
  ASSERT_EQ(verdicts.size(), changes.size());
  for (std::size_t i = 0; i < changes.size(); ++i)
    EXPECT_EQ(verdicts[i], expected[i])
        << changes[i].second << "\n"
        << outcome_of(replaced(valid_case, changes[i].first, changes[i].second)).message;
}

TEST(CaseReference, IsThePageOfTheDocumentation) {
  EXPECT_EQ(read_file(fs::path(RIPSTOP_SOURCE_DIR) / "docs/reference/case-keys.md"), case_reference())
      << "run: make reference";
}

}  // namespace
}  // namespace ripstop
