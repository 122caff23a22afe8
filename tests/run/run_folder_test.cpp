// The folder of a run, refused folders, and those of other versions.
#include "ripstop/run/run_folder.h"

#include <gtest/gtest.h>

#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../refusal.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/run/report/compare_runs.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/steady/finished_steady.h"
#include "ripstop/run/steady/steady_folder.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, IsNamedAfterTheCase) {
  EXPECT_EQ(default_run_folder("hemi.toml"), "runs/hemi");
  EXPECT_EQ(default_run_folder("designs/hemi.toml", "sweep"), "runs/hemi-sweep");
  EXPECT_EQ(default_run_folder("examples/stratos-iv/case.toml"), "runs/stratos-iv");
  EXPECT_EQ(default_run_folder("/somewhere/main/case.toml", "inflation"), "runs/main-inflation");
  EXPECT_EQ(default_run_folder("case.toml"), "runs" / fs::current_path().filename());
}

Case stratos() {
  return read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
}

TEST(RunFolder, AStartWithoutResultsIsReplacedByTheCorrectedCase) {
  const TemporaryFolder root("run-folder");
  const fs::path folder = root.path / "run";
  Case given = stratos();
  open_run_folder({folder}, resolve(given), "engine", 1);
  given.flow.speed_m_s = 20;
  EXPECT_FALSE(holds_run({folder}, resolve(given), "engine"));
  open_run_folder({folder}, resolve(given), "engine", 1);
  EXPECT_TRUE(holds_run({folder}, resolve(given), "engine"));
  fs::create_directories(folder / "checkpoint");  // now it has
  given.flow.speed_m_s = 30;
  EXPECT_THROW(holds_run({folder}, resolve(given), "engine"), Error);
  EXPECT_FALSE(holds_run({folder, true}, resolve(given), "engine"));
}

TEST(RunFolder, AnOpeningTakesTheDragOfItsOwnParachuteOnly) {
  const TemporaryFolder root("run-folder");
  Case given = stratos();
  {
    const auto folder = open_run_folder({root.path / "run"}, resolve(given), "engine", 1);
    SteadyResult result;
    const Air stream = air(given);
    result.speed = stream.speed, result.density = stream.density;
    result.drag = 396.8, result.converged = true;
    write_file(folder->own("result.json"), to_json(result));
    EXPECT_THROW(drag_for_opening(root.path / "run", resolve(given)), Error);  // has not ended
    folder->seal();
  }
  const fs::path run = root.path / "run";
  EXPECT_EQ(drag_for_opening(run, resolve(given)), 396.8);
  given.parachute.mesh.cloth_nodes = 3000;
  EXPECT_EQ(drag_for_opening(run, resolve(given)), 396.8);
  const auto refusal = [&](const Case& other) -> std::string {
    try {
      drag_for_opening(run, resolve(other));
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  Case other = given;
  other.flow.speed_m_s = 20;
  EXPECT_NE(refusal(other).find("a different speed"), std::string::npos) << refusal(other);
  other = given;
  other.parachute.gores = 8;
  EXPECT_NE(refusal(other).find("parachute.gores is 6 in that run and 8 in this case"), std::string::npos)
      << refusal(other);
  std::string text = read_file(run / "result.json");
  text.replace(text.find("396.8"), 5, "496.8");
  write_file(run / "result.json", text);
  EXPECT_NE(refusal(given).find("result.json"), std::string::npos) << refusal(given);
}

// A payload descends at 7 m/s; its opening begins at the speed of the case.
TEST(RunFolder, AnOpeningTakesTheDragAreaOfARunThatFoundItsSpeed) {
  const Settings resolved = resolve(stratos());
  SteadyResult result;
  result.speed = 7, result.drag_area = 2, result.drag = 60, result.converged = true;
  EXPECT_THROW(steady_load(resolved, result, "run", resolved), Error);  // without a payload: another speed
  result.payload = HeldPayload{};
  const LoadSource load = steady_load(resolved, result, "run", resolved);
  const double speed = resolved.flow().speed_m_s;
  EXPECT_NEAR(load.steady_drag.value(), resolved.flow().density_kg_m3 * speed * speed, 1e-9);
  EXPECT_EQ(load.text.find("run: drag area of 2 m2 at 7 m/s, "), 0u) << load.text;
  result.converged = false;
  EXPECT_THROW(steady_load(resolved, result, "run", resolved), Error);
}

TEST(RunFolder, ItsInputsAreProgramEngineAndCase) {
  const TemporaryFolder root("run-folder");
  const Case given = stratos();
  open_run_folder({root.path / "run"}, resolve(given), "engine", 1);
  EXPECT_EQ(inputs_of_run(root.path / "run"),
            hash_bytes(version() + std::string("\nengine\n") + case_json(resolve(given))));
}

TEST(RunFolder, ItsDescriptionHasProgramAndInputs) {
  const TemporaryFolder root("run-folder");
  Case given = stratos();
  given.flow.ranks = 3;
  open_run_folder({root.path / "run"}, resolve(given), "an engine 7", 2);
  const auto run = nlohmann::ordered_json::parse(read_file(root.path / "run/run.json"));
  std::vector<std::string> keys;
  for (const auto& [key, value] : run.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"program", "version", "compiler", "processor", "threads", "ranks",
                                            "flow_engine", "started", "case_file", "inputs_hash", "case",
                                            "sources"}));
  EXPECT_EQ(run["program"], "ripstop");
  EXPECT_EQ(run["version"], version());
  EXPECT_EQ(run["threads"], 2);
  EXPECT_EQ(run["ranks"], 3);
  EXPECT_EQ(run["flow_engine"], "an engine 7");
  const std::tm now = [] {
    const std::time_t t = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&t, &utc);
    return utc;
  }();
  std::tm begun{};
  ASSERT_TRUE(strptime(run["started"].get<std::string>().c_str(), "%Y-%m-%dT%H:%M:%SZ", &begun));
  std::tm later = now;
  EXPECT_NEAR(std::difftime(timegm(&later), timegm(&begun)), 0, 60);
  EXPECT_EQ(run["case_file"], given.file.string());
  EXPECT_EQ(run["inputs_hash"], inputs_of_run(root.path / "run").value());
  EXPECT_EQ(run["case"], nlohmann::ordered_json::parse(case_json(resolve(given))));
  const std::vector<Source> sources = resolve(given).sources();
  ASSERT_EQ(run["sources"].size(), sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    EXPECT_EQ(run["sources"][i]["key"], sources[i].key);
    EXPECT_EQ(run["sources"][i]["given"], sources[i].given) << sources[i].key;
    EXPECT_EQ(run["sources"][i]["from"], sources[i].from) << sources[i].key;
  }
  EXPECT_EQ(read_file(root.path / "run/case.toml"), case_toml(resolve(given)));
}

TEST(RunFolder, AResultOfOtherInputsIsNotBelieved) {
  const TemporaryFolder root("run-folder");
  const Case given = stratos();
  const auto folder = open_run_folder({root.path / "run"}, resolve(given), "engine", 1);
  const std::string own = inputs_of_run(root.path / "run").value();
  SteadyResult result;
  result.inputs_hash = own;
  write_file(folder->own("result.json"), to_json(result));
  folder->seal();
  EXPECT_EQ(steady_result_from_json(finished_result(root.path / "run").value()).inputs_hash, own);
  result.inputs_hash = std::string(32, '0');
  write_file(folder->own("result.json"), to_json(result));
  folder->seal();
  EXPECT_THROW(finished_result(root.path / "run"), Error);
}

TEST(RunFolder, ACheckRefusesTheSameAsTheRunAndChangesNothing) {
  const TemporaryFolder root("run-folder");
  Case given = stratos();
  const SteadyFolderSettings settings{{root.path / "run"}, 1, {}, {}};
  check_steady_in(settings, resolve(given));
  EXPECT_FALSE(fs::exists(root.path / "run"));
  const ClaimedFolder held(root.path / "run");
  EXPECT_THROW(check_steady_in(settings, resolve(given)), Error);  // somebody works there
}

std::map<std::string, std::string> content_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().lexically_relative(folder)] = read_file(entry.path());
  return files;
}

/// tests/run/run-0.1.0 has the text files of a steady run that version 0.1.0 computed.
TEST(EarlierVersion, AFolderWithoutRecordsIsRefusedAndUnchanged) {
  const TemporaryFolder root("run-0.1.0");
  const fs::path folder = root.path / "run";
  fs::copy(fs::path(RIPSTOP_SOURCE_DIR) / "tests/run/run-0.1.0", folder, fs::copy_options::recursive);
  const auto before = content_of(folder);
  ASSERT_TRUE(before.contains("result.json"));
  const Settings resolved = resolve(read_case(folder / "case.toml"));  // its case is one of this version
  EXPECT_EQ(resolved.parachute().gores, 6);
  const std::vector<std::function<void()>> uses = {[&] { open_run_folder({folder}, resolved, "engine", 1); },
                                                   [&] {
                                                     open_run_folder({folder, true}, resolved, "engine", 1);
                                                   },
                                                   [&] { write_report({folder}); },
                                                   [&] { finished_steady(folder); },
                                                   [&] {
                                                     compare_runs({folder, folder});
                                                   }};
  for (const auto& use : uses) {
    const std::string message = refusal_of(use, ExitCode::usage);
    EXPECT_NE(message.find("is a run of Ripstop 0.1.0 without the records"), std::string::npos) << message;
    EXPECT_NE(message.find("version " + std::string(version()) + " needs"), std::string::npos) << message;
    EXPECT_EQ(content_of(folder), before);
  }
}

TEST(EarlierVersion, ARunOfAnotherVersionIsReadButNotContinued) {
  const TemporaryFolder root("other-version");
  const fs::path folder = root.path / "run";
  const Settings resolved =
      resolve(read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml"));
  {
    const auto run = open_run_folder({folder, false, false, false}, resolved, "engine", 1);
    auto description = nlohmann::ordered_json::parse(read_file(folder / "run.json"));
    description["version"] = "0.9.0";
    run->write("run.json", description.dump(2));
    run->note("inputs", "the hash of version 0.9.0");
    SteadyResult result;
    result.drag = 396.8, result.converged = true;
    EXPECT_EQ(run->end(result), "");
  }
  const std::string message =
      refusal_of([&] { open_run_folder({folder}, resolved, "engine", 1); }, ExitCode::usage);
  EXPECT_NE(message.find("contains a run of Ripstop 0.9.0, which version " + std::string(version()) +
                         " does not continue"),
            std::string::npos)
      << message;
  EXPECT_NE(finished_result(folder).value().find("396.8"), std::string::npos);
  EXPECT_TRUE(open_run_folder({folder, true}, resolved, "engine", 1) != nullptr);  // --fresh replaces it
}

}  // namespace
}  // namespace ripstop
