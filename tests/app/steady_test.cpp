// ripstop steady as a user runs it: the real OpenFOAM on a small grid, killed and started again.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "program.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Steady : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::string text = read_file(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
    const std::string nodes = "cloth_nodes = 25600";
    text.replace(text.find(nodes), nodes.size(), "cloth_nodes = 1500");
    write_file(folder_ / "case.toml", text);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> command(const std::string& out, const std::string& engine) const {
    return {"steady",  (folder_ / "case.toml").string(),
            "--flow",  engine,
            "--speed", "10",
            "--grid",  "24,24,36",
            "--out",   (folder_ / out).string(),
            "--set",   "coupling.threads=1"};
  }
  json result(const std::string& out) const { return json::parse(read_file(folder_ / out / "result.json")); }

  fs::path folder_ = fs::temp_directory_path() / ("ripstop_steady_test_" + std::to_string(getpid()));
};

void expect_closed_ledger(const json& r) {
  EXPECT_TRUE(r.at("converged").get<bool>());
  const double fluid = r.at("ledger").at("fluid_force_n");
  EXPECT_GT(fluid, 0);
  for (const char* other : {"nodal_load_n", "line_tension_n", "momentum_deficit_n"}) {
    EXPECT_NEAR(r.at("ledger").at(other).get<double>() / fluid, 1, 0.01) << other;
  }
}

/// The row of the coupling states the changes of the last row of iterations.csv, each with its limit.
void expect_last_changes(const std::string& output, const fs::path& run) {
  const std::regex row(
      "coupling\\s+converged after (\\d+) iterations; last change of the drag (less than )?([0-9.]+) % "
      "\\(limit 0.1 %\\), of the shape (less than )?([0-9.]+) mm \\(limit 1 mm\\)\n");
  std::smatch stated;
  ASSERT_TRUE(std::regex_search(output, stated, row)) << output;
  const CsvTable iterations = read_csv(run / "iterations.csv");
  EXPECT_EQ(std::stoul(stated[1]), iterations.rows.size());
  const double drag = 100 * iterations.column("drag_change").back();
  const double shape = 1000 * iterations.column("shape_change_m").back();
  for (const auto& [value, at] : {std::pair(drag, 2), std::pair(shape, 4)}) {
    const double shown = std::stod(stated[at + 1]);
    if (stated[at].matched)
      EXPECT_LT(value, shown) << stated[0];
    else
      EXPECT_NEAR(value, shown, 0.05 * shown) << stated[0];
  }
}

TEST_F(Steady, WithOpenFoamTheDragIsThatOfTheBuiltInEngineAndAKilledRunEndsWithTheSameNumbers) {
  ASSERT_EQ(wait_for(start(command("whole", "openfoam"))), 0);
  const json whole = result("whole");
  expect_closed_ledger(whole);
  for (const char* file :
       {"run.json", "iterations.csv", "lines.csv", "canopy.pvd", "canopy.stl", "canopy.png", "drag.png",
        "flow.vti", "vtk/canopy_001.vtp", "flow/system/controlDict"}) {
    EXPECT_TRUE(fs::exists(folder_ / "whole" / file)) << file;
  }
  EXPECT_EQ(read_csv(folder_ / "whole" / "lines.csv").rows.size(), 18u);

  ASSERT_EQ(wait_for(start(command("builtin", "builtin"))), 0);
  const json builtin = result("builtin");
  expect_closed_ledger(builtin);
  EXPECT_NEAR(builtin.at("drag_n").get<double>() / whole.at("drag_n").get<double>(), 1, 0.005);

  // Killed as soon as the first coupling iteration is on the disk, in the middle of the second.
  const pid_t child = start(command("killed", "openfoam"));
  while (!fs::exists(folder_ / "killed" / "checkpoint" / "current")) {
    ASSERT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "ended before its first checkpoint";
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  kill(child, SIGKILL);
  wait_for(child);
  EXPECT_FALSE(fs::exists(folder_ / "killed" / "result.json"));
  ASSERT_EQ(wait_for(start(command("killed", "openfoam"))), 0);
  const json resumed = result("killed");
  for (const char* key :
       {"drag_n", "projected_diameter_m", "max_line_tension_n", "max_von_mises_n_m", "coupling_iterations"}) {
    EXPECT_EQ(resumed.at(key), whole.at(key)) << key;
  }
  EXPECT_EQ(read_csv(folder_ / "killed" / "iterations.csv").rows.size(),
            whole.at("coupling_iterations").get<std::size_t>());
}

class SteadyWithSheetsOnOpenFoam : public Steady, public testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Meshes, SteadyWithSheetsOnOpenFoam, testing::Values("grid", "fitted"),
                         [](const auto& of) { return of.param; });

// Two or three coupling iterations on coarse cells, too few to converge, one of them broken off.
TEST_P(SteadyWithSheetsOnOpenFoam, AKilledRunEndsWithTheSameNumbers) {
  const bool fitted = GetParam() == "fitted";
  const std::string levels = fitted ? "1" : "0", iterations = fitted ? "2" : "3";
  const auto run = [&](const std::string& out) {
    return start({"steady", std::string(RIPSTOP_SOURCE_DIR) + "/examples/flat-circular/case.toml",
                  "--flow", "openfoam",
                  "--grid", "20,20,25",
                  "--set",  "flow.mesh=" + GetParam(),
                  "--set",  "flow.cloth_levels=" + levels,
                  "--set",  "parachute.mesh.cloth_nodes=500",
                  "--set",  "coupling.threads=1",
                  "--set",  "coupling.max_iterations=" + iterations,
                  "--set",  "flow.residual=1e-2",
                  "--out",  (folder_ / out).string()});
  };
  constexpr int not_converged = 4;
  ASSERT_EQ(wait_for(run("whole")), not_converged);
  const json whole = result("whole");
  EXPECT_GT(whole.at("drag_n").get<double>(), 50);
  const pid_t child = run("killed");
  while (!fs::exists(folder_ / "killed" / "checkpoint" / "current")) {
    ASSERT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "ended before its first checkpoint";
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  kill(child, SIGKILL);
  wait_for(child);
  ASSERT_EQ(wait_for(run("killed")), not_converged);
  const json resumed = result("killed");
  for (const char* key : {"drag_n", "projected_diameter_m", "max_line_tension_n", "max_von_mises_n_m"})
    EXPECT_EQ(resumed.at(key), whole.at(key)) << key;
  EXPECT_EQ(read_csv(folder_ / "killed" / "iterations.csv").rows.size(), std::stoul(iterations));
}

// The drag alone has settled after three coupling iterations, with the wake still growing: the box then loses
// 7 % less momentum than the canopy takes.
TEST_F(Steady, AFlowThatDoesNotConvergeIsAveragedUntilForcesBalance) {
  const std::string example = std::string(RIPSTOP_SOURCE_DIR) + "/examples/flat-circular/case.toml";
  ASSERT_EQ(wait_for(start({"steady", example, "--grid", "40,40,49", "--set",
                            "parachute.mesh.cloth_nodes=1500", "--set", "flow.max_iterations=60", "--set",
                            "flow.average_over=20", "--set", "flow.residual=1e-7", "--set",
                            "coupling.threads=1", "--out", (folder_ / "run").string()})),
            0);
  EXPECT_EQ(read_csv(folder_ / "run" / "iterations.csv").column("flow_averaged").back(), 20);
  expect_closed_ledger(result("run"));
}

TEST_F(Steady, AFolderOfAnotherRunIsRefusedAndAFinishedOneIsOnlyShown) {
  const fs::path run = folder_ / "run";
  const pid_t first = start(command("run", "builtin"));
  while (!fs::exists(run / "run.json")) usleep(1000);
  EXPECT_EQ(wait_for(start(command("run", "builtin"))), 2);  // the first works there
  ASSERT_EQ(wait_for(first), 0);
  const auto written = fs::last_write_time(run / "result.json");
  const Finished again = ripstop_with(command("run", "builtin"));
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.output.find("  drag computed  "), std::string::npos) << again.output;
  EXPECT_EQ(again.output.find("{\""), std::string::npos) << again.output;
  expect_last_changes(again.output, run);
  std::vector<std::string> as_json = command("run", "builtin");
  as_json.push_back("--json");
  EXPECT_EQ(wait_for(start(as_json, folder_ / "again.json")), 0);
  EXPECT_EQ(json::parse(read_file(folder_ / "again.json")), result("run"));
  EXPECT_EQ(fs::last_write_time(run / "result.json"), written);
  // Other commands leave it alone.
  const std::string look = (folder_ / "case.toml").string();
  EXPECT_EQ(wait_for(start({"fabric", look, "--out", run.string()})), 2);
  EXPECT_EQ(wait_for(start({"pattern", look, "--out", run.string()})), 2);
  EXPECT_EQ(fs::last_write_time(run / "result.json"), written);
  std::vector<std::string> other = command("run", "builtin");
  other[5] = "12";
  EXPECT_EQ(wait_for(start(other)), 2);
  EXPECT_EQ(fs::last_write_time(run / "result.json"), written);

  // Whatever was lost or changed since is noticed; put back, the run is whole again.
  for (const char* name :
       {"result.json", "iterations.csv", "case.toml", "canopy.png", "vtk/canopy_001.vtp"}) {
    const std::string whole = read_file(run / name);
    write_file(run / name, whole.substr(0, whole.size() / 2));
    EXPECT_EQ(wait_for(start(command("run", "builtin"))), 3) << name;
    fs::remove(run / name);
    EXPECT_EQ(wait_for(start(command("run", "builtin"))), 3) << name;
    write_file(run / name, whole);
  }
  EXPECT_EQ(wait_for(start(command("run", "builtin"))), 0);
}

TEST_F(Steady, OnlyFilesOfRipstopAreRemoved) {
  // A start with a wrong key, killed before anything was computed, is in nobody's way.
  std::vector<std::string> wrong = command("run", "builtin");
  wrong.insert(wrong.end(), {"--set", "parachute.mesh.cloth_nodes=20000"});
  const pid_t first = start(wrong);
  while (!fs::exists(folder_ / "run" / "case.toml")) usleep(1000);
  kill(first, SIGKILL);
  wait_for(first);
  write_file(folder_ / "run" / "thesis.txt", "mine");
  EXPECT_EQ(wait_for(start(command("run", "builtin"))), 0);
  std::vector<std::string> other = command("run", "builtin");
  other.insert(other.end(), {"--set", "coupling.max_iterations=1", "--fresh"});
  EXPECT_NE(wait_for(start(other)), 2);
  EXPECT_EQ(read_file(folder_ / "run" / "thesis.txt"), "mine");

  // A folder of other runs, and one of somebody else's, whatever it calls its files.
  EXPECT_EQ(wait_for(start(command(".", "builtin"))), 2);
  fs::create_directories(folder_ / "notes");
  write_file(folder_ / "notes" / "run.json", "{\"my\": \"notes\"}");
  std::vector<std::string> notes = command("notes", "builtin");
  notes.push_back("--fresh");
  EXPECT_EQ(wait_for(start(notes)), 2);
  EXPECT_EQ(read_file(folder_ / "notes" / "run.json"), "{\"my\": \"notes\"}");
  EXPECT_FALSE(fs::exists(folder_ / "notes" / ".ripstop"));
}

}  // namespace
}  // namespace ripstop
