// A report on run folders: sealed with them, made again without covering up damage, never over a file of another kind.
#include "ripstop/run/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/run/report/report_tables.h"
#include "ripstop/run/steady/steady_folder.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class RunReport : public testing::Test {
 protected:
  TemporaryFolder root{"ripstop-run-report"};
  // Of all tests here: two runs, each of which a test copies.
  static inline std::unique_ptr<TemporaryFolder> runs;

  static void SetUpTestSuite() {
    runs = std::make_unique<TemporaryFolder>("ripstop-runs-for-reports");
    SteadyObserver nobody;
    for (const auto& [name, speed] : {std::pair{"a", 10.0}, {"b", 20.0}})
      run_steady_in({{runs->path / name}, 1, {}, {}}, resolve(small(name, speed)), nobody);
  }
  static void TearDownTestSuite() { runs.reset(); }

  static Case small(const std::string& title, double speed) {
    Case given = read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
    given.title = title;
    given.parachute.mesh.cloth_nodes = 600;
    given.parachute.mesh.line_segment_m = 0.3;
    given.flow.cells = std::array{16, 16, 24};
    given.flow.speed_m_s = speed;
    given.coupling.threads = 1;
    given.coupling.shape_tolerance_m = 1e-2;
    given.coupling.drag_tolerance = 0.05;
    return given;
  }
  fs::path run(const char* name) {
    fs::copy(runs->path / name, root.path / name, fs::copy_options::recursive);
    return root.path / name;
  }
};

TEST_F(RunReport, IsSealedWithItsRunAndMadeAgainUnlessTheRunIsDamaged) {
  const fs::path folder = run("a");
  EXPECT_TRUE(is_report(read_file(folder / "report.html")));
  EXPECT_TRUE(finished_result(folder));
  fs::remove(folder / "report.html");
  EXPECT_THROW(finished_result(folder), Error);
  EXPECT_EQ(write_report({folder}), folder / "report.html");
  EXPECT_TRUE(finished_result(folder));

  write_file(folder / "lines.csv", "line\n1\n");
  EXPECT_THROW(write_report({folder}), Error);
  EXPECT_EQ(damaged_files(folder), std::vector<std::string>{"lines.csv"});
}

TEST_F(RunReport, OfADamagedOrUnfinishedRunIsRefusedWhereverItIsToGo) {
  const fs::path a = run("a"), b = run("b"), out = root.path / "both.html";
  std::string text = read_file(b / "result.json");
  text.replace(text.find("\"drag_n\": ") + 10, 1, "9");
  write_file(b / "result.json", text);
  EXPECT_THROW(write_report({a, b}, out), Error);
  EXPECT_THROW(write_report({b}, out), Error);
  fs::remove(a / ".ripstop/seal");
  EXPECT_THROW(write_report({a}, out), Error);
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(RunReport, ThatCannotBeWrittenLeavesTheRunToBeRepeated) {
  const fs::path folder = run("a");
  fs::remove(folder / ".ripstop/seal");
  fs::remove(folder / "report.html");
  fs::create_directories(folder / "report.html");  // no file can take its place
  SteadyObserver nobody;
  EXPECT_THROW(run_steady_in({{folder}, 1, {}, {}}, resolve(small("a", 10)), nobody), Error);
  EXPECT_FALSE(is_sealed(folder));
  fs::remove(folder / "report.html");
  run_steady_in({{folder}, 1, {}, {}}, resolve(small("a", 10)), nobody);
  EXPECT_TRUE(finished_result(folder));
  EXPECT_TRUE(is_report(read_file(folder / "report.html")));
}

TEST_F(RunReport, HasEveryNumberOfItsResult) {
  const fs::path folder = run("a");
  const ReportRun made = report_of(folder);
  const auto result = nlohmann::json::parse(read_file(folder / "result.json"));
  std::size_t plain = 0;
  for (const auto& [key, value] : result.items()) {
    if (value.is_object() || key == "warnings") continue;  // tables; a note at the head of the page
    ++plain;
    if (value.is_number()) {
      EXPECT_EQ(number_of(made, key), value.get<double>()) << key;
    }
  }
  std::vector<std::string> added;  // from the margins, which are a table
  for (const ReportValue& value : made.values)
    if (!result.contains(value.key)) added.push_back(value.key);
  EXPECT_EQ(added, (std::vector<std::string>{"weakest_member", "margin_of_safety"}));
  EXPECT_EQ(made.values.size(), plain + added.size());
  EXPECT_EQ(made.name, "a");
  EXPECT_EQ(made.kind, "steady");
  EXPECT_EQ(made.headline.size(), 8u);
  for (const std::string& key : made.headline) {
    if (key != "weakest_member") {
      EXPECT_FALSE(std::isnan(number_of(made, key))) << key;
    }
  }
  EXPECT_EQ(made.case_file, read_file(folder / "case.toml"));
  std::vector<std::string> tables, plots;
  for (const ReportTable& table : made.tables) tables.push_back(table.id);
  for (const ReportPlot& plot : made.plots) plots.push_back(plot.id);
  for (const char* id : {"bill", "sources", "ledger"})
    EXPECT_EQ(std::count(tables.begin(), tables.end(), id), 1) << id;
  EXPECT_EQ(plots, (std::vector<std::string>{"forces", "changes", "pressure", "profile", "lines"}));
  EXPECT_FALSE(made.warnings.empty());  // so few nodes
  EXPECT_FALSE(made.shape.frames.empty());
  EXPECT_FALSE(made.flow.pressure.empty());
  EXPECT_EQ(made.shape.frames[0].line_values.size(), made.shape.parts.size());
  // A line's axial spring with the bending springs beside it carries what the result calls the line's tension.
  double highest = 0;
  for (std::size_t s = 0; s < made.shape.parts.size(); ++s)
    if (made.shape.part_names.at(made.shape.parts[s]).find("line") != std::string::npos)
      highest = std::max(highest, made.shape.frames[0].line_values[s]);
  EXPECT_NEAR(highest / result.at("max_line_tension_n").get<double>(), 1, 0.02);
}

TEST_F(RunReport, ComparesRunsAndRefusesWhatIsNoRunOrNoReport) {
  const fs::path a = run("a"), b = run("b"), out = root.path / "both.html";
  EXPECT_EQ(write_report({a}, out), out);
  EXPECT_NE(read_file(out).find("<title>a</title>"), std::string::npos);
  EXPECT_EQ(write_report({a, b}, out), out);
  EXPECT_NE(read_file(out).find("<title>2 runs</title>"), std::string::npos);
  const Report report = report_on({report_of(a), report_of(b)}, "both");
  ASSERT_EQ(report.runs.size(), 2u);
  EXPECT_EQ(report.runs[1].name, "b");
  EXPECT_EQ(report.comparison.columns.size(), 4u);
  ASSERT_FALSE(report.plots.empty());
  EXPECT_EQ(report.plots[0].id, "drag-speed");
  EXPECT_EQ(report.plots[0].series[0].x, (std::vector<double>{10, 20}));
  EXPECT_EQ(report.plots[0].series[1].name, "measured");

  write_file(root.path / "notes.html", "mine");
  EXPECT_THROW(write_report({a}, root.path / "notes.html"), Error);
  EXPECT_EQ(read_file(root.path / "notes.html"), "mine");
  EXPECT_THROW(write_report({root.path / "nowhere"}), Error);
  EXPECT_THROW(write_report({root.path}), Error);
  EXPECT_THROW(write_report({}), Error);
}

TEST(ReportTables, ARunThatDidNotConvergeIsOneThatDidNot) {
  for (const bool converged : {true, false}) {
    ReportRun run;
    add_result(run, converged ? R"({"converged": true})" : R"({"converged": false})", "result.json");
    EXPECT_EQ(run.converged, converged);
  }
  ReportRun run;  // what has nothing to converge
  add_result(run, "{}", "result.json");
  EXPECT_TRUE(run.converged);
}

TEST(ReportTables, GroupsAndListsOfAResultAreTables) {
  ReportRun run;
  add_result(
      run,
      R"({"title": "t", "drag_n": 5, "margins": [{"member": "line 1", "margin": 2.5}, {"member": "cloth", "margin": 4, "peak_n_m": 3}],
                      "ledger": {"fluid_force_n": 1, "parts": {"a_n": 2}}})",
      "result.json");
  EXPECT_EQ(run.values.size(), 2u);
  ASSERT_EQ(run.tables.size(), 3u);
  EXPECT_EQ(run.tables[0].columns.size(), 3u);
  EXPECT_EQ(run.tables[0].rows[0], (std::vector<std::string>{"line 1", "2.5", ""}));
  EXPECT_EQ(run.tables[1].rows[0], (std::vector<std::string>{"air load", "1", "N"}));
  ReportRun words;
  add_result(words, R"({"ledger": {"sewn": true, "cut": false, "none": null, "count": 3}})", "result.json");
  std::vector<std::string> values;
  for (const auto& row : words.tables.at(0).rows) values.push_back(row.at(1));
  EXPECT_EQ(values, (std::vector<std::string>{"yes", "no", "", "3"}));
  EXPECT_THROW(add_result(run, "[1]", "result.json"), Error);
}

}  // namespace
}  // namespace ripstop
