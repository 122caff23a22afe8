// --batch as a user types it; the scripts are run by bash, without Slurm.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "program.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class Batch : public testing::Test {
 protected:
  std::vector<std::string> command(const std::string& name, const std::string& out,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {
        name,     stratos,    "--set", "parachute.mesh.cloth_nodes=1500", "--set", "coupling.threads=1",
        "--grid", "24,24,36", "--out", (root_.path / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Finished bash(std::vector<std::string> arguments, const std::string& element = "0") const {
    Finished run;
    ProcessRequest request;
    request.arguments = std::move(arguments);
    request.arguments.insert(request.arguments.begin(), "/bin/bash");
    request.environment = {{"RIPSTOP_DATA", RIPSTOP_SOURCE_DIR}, {"SLURM_ARRAY_TASK_ID", element}};
    request.time_limit_s = 300;
    request.on_line = [&](const std::string& line) {
      run.output += line + "\n";
      return true;
    };
    run.code = run_process(request).exit_code;
    return run;
  }
  std::string drag(const std::string& run) const {
    const std::string text = read_file(root_.path / run / "result.json");
    std::smatch found;
    EXPECT_TRUE(std::regex_search(text, found, std::regex("\"drag_n\": ([^,]*)"))) << text;
    return found[1];
  }

  TemporaryFolder root_{"batch"};
};

TEST_F(Batch, AScriptIsWrittenInPlaceOfTheRunAndDoesWhatTheCommandDoes) {
  const Finished written =
      ripstop_with(command("steady", "a $(touch harm) b", {"--speed=10", "--batch", "slurm", "--hours=3"}));
  ASSERT_EQ(written.code, 0) << written.output;
  const fs::path script = root_.path / "a $(touch harm) b.slurm/run.sbatch";
  EXPECT_NE(written.output.find("Submit: sbatch '" + script.string() + "'"), std::string::npos)
      << written.output;
  EXPECT_FALSE(fs::exists(root_.path / "a $(touch harm) b"));
  const std::string text = read_file(script);
  EXPECT_NE(text.find("#SBATCH --time=180\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("'--batch'"), std::string::npos) << text;
  EXPECT_EQ(text.find("--hours=3"), std::string::npos) << text;
  const Finished done = bash({script.string()});
  EXPECT_EQ(done.code, 0) << done.output;
  const Finished here = ripstop_with(command("steady", "here", {"--speed=10"}));
  ASSERT_EQ(here.code, 0) << here.output;
  EXPECT_EQ(drag("a $(touch harm) b"), drag("here"));
  EXPECT_EQ(bash({script.string()}).code, 0);  // again: it holds the finished run
}

TEST_F(Batch, ASweepsElementsLeaveWhatTheSweepGoesOnFrom) {
  const std::vector<std::string> sweep = command("sweep", "sweep", {"--speeds", "10,15,20"});
  std::vector<std::string> batch = sweep;
  batch.insert(batch.end(), {"--batch=slurm", "--jobs", "2"});
  const Finished written = ripstop_with(batch);
  ASSERT_EQ(written.code, 0) << written.output;
  const fs::path scripts = root_.path / "sweep.slurm";
  EXPECT_NE(written.output.find("Submit: bash " + (scripts / "submit").string()), std::string::npos)
      << written.output;
  EXPECT_NE(written.output.find("3 runs in 2 arrays"), std::string::npos) << written.output;
  EXPECT_NE(read_file(scripts / "submit").find("%2"), std::string::npos);

  EXPECT_EQ(bash({(scripts / "run.sbatch").string(), "1"}).code, 7);  // its neighbour is not there
  EXPECT_EQ(bash({(scripts / "run.sbatch").string(), "0"}).code, 0);
  EXPECT_EQ(bash({(scripts / "run.sbatch").string(), "1"}, "1").code, 0);
  const Finished gathered = bash({(scripts / "gather.sbatch").string()});
  EXPECT_EQ(gathered.code, 7) << gathered.output;
  EXPECT_NE(gathered.output.find("speed_m_s=10: is not finished"), std::string::npos) << gathered.output;
  const std::string table = read_file(root_.path / "sweep/sweep.csv");
  EXPECT_NE(table.find("is not finished"), std::string::npos) << table;
  const Finished rest = ripstop_with(sweep);
  EXPECT_EQ(rest.code, 0) << rest.output;
  EXPECT_EQ(bash({(scripts / "gather.sbatch").string()}).code, 0);
}

TEST_F(Batch, WhatAScriptCannotDoIsRefused) {
  const auto refused = [&](const std::vector<std::string>& more, const std::string& words) {
    const Finished run = ripstop_with(command("steady", "none", more));
    EXPECT_EQ(run.code, 2) << run.output;
    EXPECT_NE(run.output.find(words), std::string::npos) << run.output;
    EXPECT_FALSE(fs::exists(root_.path / "none.slurm"));
  };
  refused({"--batch", "pbs"}, "slurm");
  refused({"--batch", "slurm", "--fresh"}, "--fresh");  // would begin anew whenever its job goes on
  refused({"--batch", "slurm", "--dry-run"}, "--dry-run");
  refused({"--hours", "2"}, "--batch");
  refused({"--batch", "slurm", "--speed", "-1"}, "--speed");
  const Finished line =
      ripstop_with({"steady", stratos, "--out", (root_.path / "a\nb").string(), "--batch", "slurm"});
  EXPECT_EQ(line.code, 2) << line.output;
  EXPECT_NE(line.output.find("choose another --out"), std::string::npos) << line.output;
  const Finished only =
      ripstop_with(command("sweep", "none", {"--speeds", "10,15", "--only", "speed_m_s=11"}));
  EXPECT_EQ(only.code, 2) << only.output;
  EXPECT_NE(only.output.find("did you mean speed_m_s=10?"), std::string::npos) << only.output;
}

TEST_F(Batch, AHostfileIsLookedAtBeforeAnythingIsComputed) {
  const std::string hosts = (root_.path / "hosts").string();
  const auto refused = [&](const std::vector<std::string>& more, const std::string& words) {
    std::vector<std::string> all = command("steady", "none", {"--hostfile", hosts, "--dry-run"});
    all.insert(all.end(), more.begin(), more.end());
    const Finished run = ripstop_with(all);
    EXPECT_EQ(run.code, 2) << run.output;
    EXPECT_NE(run.output.find(words), std::string::npos) << run.output;
    EXPECT_FALSE(fs::exists(root_.path / "none"));
  };
  refused({"--flow", "openfoam", "--ranks", "2"}, "does not exist");
  write_file(hosts, "here slots=1\nthere slots=x\n");
  refused({"--flow", "openfoam", "--ranks", "2"}, "hosts:2:7: slots = x: must be a whole number");
  write_file(hosts, "here slots=1\nthere slots=1\n");
  refused({"--flow", "openfoam", "--ranks", "3"}, "2 slots for 3 ranks");
  refused({}, "requires --flow openfoam and --ranks");
  refused({"--flow", "openfoam"}, "requires --flow openfoam and --ranks");
}

}  // namespace
}  // namespace ripstop
