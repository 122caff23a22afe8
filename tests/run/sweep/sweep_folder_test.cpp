// Many runs in one folder: what each leaves, and what one that fails does to the others.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ripstop/core/build_info.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/run/sweep/sweep.h"
#include "ripstop/run/sweep/sweep_files.h"
#include "tests/run/steady/finished_run.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

/// 20 m/s from nothing, 15 and 25 m/s from it.
std::vector<SweepPoint> three_speeds() {
  std::vector<SweepPoint> points;
  for (const char* speed : {"20", "15", "25"})
    points.push_back({{speed},
                      resolve(square_law_case({{"flow.speed_m_s", speed}})),
                      std::string("v") + speed,
                      points.empty() ? -1 : 0});
  return points;
}

bool has_flow(const fs::path& run) {
  return fs::exists(run / "checkpoint/even/flow") || fs::exists(run / "checkpoint/odd/flow");
}

TEST(SweepFolder, AFlowFieldStaysUntilNobodyStartsFromIt) {
  const TemporaryFolder root("sweep");
  const std::vector<SweepPoint> points = three_speeds();
  SweepSettings settings;
  settings.folder = root.path / "sweep";
  settings.jobs = 1;
  std::vector<std::size_t> order;
  SweepEvents events;
  events.ended = [&](std::size_t point, const std::vector<SweepRow>& rows) {
    order.push_back(point);
    EXPECT_TRUE(rows[point].done) << rows[point].error;
    EXPECT_EQ(has_flow(settings.folder / points[0].folder), order.size() < points.size());
    for (std::size_t leaf = 1; leaf < points.size(); ++leaf)
      EXPECT_FALSE(has_flow(settings.folder / points[leaf].folder)) << leaf;
  };
  const std::vector<SweepRow> rows = run_sweep(points, settings, events);
  for (const SweepRow& row : rows) {
    EXPECT_TRUE(row.done);
    EXPECT_NEAR(row.result.drag_area, SquareLawEngine::area, 1e-2);
  }
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2}));
  const auto described = nlohmann::json::parse(read_file(settings.folder / "sweep.json"));
  EXPECT_EQ(described.at("program"), "ripstop");
  EXPECT_EQ(described.at("version"), version());
  ASSERT_EQ(described.at("runs").size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(described["runs"][i]["folder"], points[i].folder);
    EXPECT_EQ(described["runs"][i]["values"], points[i].values);
    EXPECT_EQ(described["runs"][i]["starts_from"], i == 0 ? nlohmann::json() : nlohmann::json("v20"));
  }

  // What is not on the list stays for ever, also when the sweep is made anew.
  write_sweep_plots(settings.folder, "", {sweep_axis("flow.speed_m_s", {"20", "15", "25"}, "--speeds")},
                    points, rows);
  EXPECT_TRUE(fs::exists(settings.folder / "drag.svg") && fs::exists(settings.folder / "wall_time.png"));
  for (const std::string& file : foreign_files(settings.folder))
    EXPECT_NE(file.find('/'), std::string::npos) << file;

  settings.folder = root.path / "with-fields";
  settings.fields = true;
  run_sweep({points[0]}, settings);
  EXPECT_TRUE(has_flow(settings.folder / points[0].folder));
}

struct NoWind : FlowEngine {
  std::string name() const override { return "no wind"; }
  std::unique_ptr<Flow> start(const FlowProblem&) override {
    throw Error(ExitCode::diverged, "there is no wind today");
  }
};

TEST(SweepFolder, ARunThatFailsIsToldInItsRowAndTheOthersGoOn) {
  static const bool added = [] {
    add_engine({"no-wind",
                "fails",
                {},
                [](const EngineOptions&) { return std::string("no wind 1"); },
                [](const EngineOptions&) { return std::make_unique<NoWind>(); }});
    return true;
  }();
  ASSERT_TRUE(added);
  std::vector<SweepPoint> points = three_speeds();
  points[1].resolved = edited(points[1].resolved, [](Case& c) { c.flow.engine = "no-wind"; });
  SweepSettings settings;
  settings.jobs = 1;
  const std::vector<SweepRow> rows = run_sweep(points, settings);
  EXPECT_TRUE(rows[0].done && rows[2].done);
  EXPECT_FALSE(rows[1].done);
  EXPECT_EQ(rows[1].error, "there is no wind today");
  EXPECT_EQ(rows[1].code, ExitCode::diverged);
}

TEST(SweepFolder, ARunThatFailedAtItsSealIsRepeatedFromItsOwnFlow) {
  const TemporaryFolder root("sweep");
  const std::vector<SweepPoint> points = {three_speeds()[0]};
  SweepSettings settings;
  settings.folder = root.path / "sweep";
  settings.jobs = 1;
  const fs::path run = settings.folder / points[0].folder, seal = run / ".ripstop/seal";
  SweepEvents in_the_way;
  in_the_way.progress = [&](std::size_t, const SteadyProgress&, const SteadyState&) {
    fs::create_directories(seal / "in the way");
  };
  const SweepRow failed = run_sweep(points, settings, in_the_way)[0];
  EXPECT_FALSE(failed.done);
  EXPECT_EQ(failed.code, ExitCode::io) << failed.error;
  EXPECT_TRUE(fs::exists(run / "result.json"));
  EXPECT_TRUE(has_flow(run));
  fs::remove_all(seal);
  const SweepRow again = run_sweep(points, settings)[0];
  EXPECT_TRUE(again.done) << again.error;
}

struct NoDisk : FlowEngine {
  std::string name() const override { return "no disk"; }
  std::unique_ptr<Flow> start(const FlowProblem&) override {
    throw Error(ExitCode::io, "the disk is full today");
  }
};

TEST(SweepFolder, ARunWhoseNeighbourFailedByTheDiskWaitsForTheNextCall) {
  static const bool added = [] {
    add_engine({"no-disk",
                "fails",
                {},
                [](const EngineOptions&) { return std::string("no disk 1"); },
                [](const EngineOptions&) { return std::make_unique<NoDisk>(); }});
    return true;
  }();
  ASSERT_TRUE(added);
  const TemporaryFolder root("sweep");
  std::vector<SweepPoint> points = three_speeds();
  points[0].resolved = edited(points[0].resolved, [](Case& c) { c.flow.engine = "no-disk"; });
  SweepSettings settings;
  settings.folder = root.path / "sweep";
  settings.jobs = 1;
  const std::vector<SweepRow> rows = run_sweep(points, settings);
  EXPECT_EQ(rows[0].error, "the disk is full today");
  for (const std::size_t leaf : {1, 2}) {
    EXPECT_FALSE(rows[leaf].done);
    EXPECT_EQ(rows[leaf].code, ExitCode::io);
    EXPECT_NE(rows[leaf].error.find("v20"), std::string::npos) << rows[leaf].error;
    EXPECT_FALSE(fs::exists(settings.folder / points[leaf].folder));
  }
  settings.warm = false;  // nobody starts from anybody
  points.pop_back();
  EXPECT_TRUE(run_sweep(points, settings)[1].done);
}

TEST(SweepFolder, ARunWhoseNeighbourIsDamagedIsNotStartedFromNothing) {
  const TemporaryFolder root("sweep");
  const std::vector<SweepPoint> points = three_speeds();
  SweepSettings settings;
  settings.folder = root.path / "sweep";
  settings.jobs = 1;
  settings.fields = true;
  ASSERT_TRUE(run_sweep(points, settings)[0].done);
  const fs::path middle = settings.folder / points[0].folder, checkpoint = middle / "checkpoint";
  const auto without_leaves = [&] {
    for (const std::size_t leaf : {1, 2}) fs::remove_all(settings.folder / points[leaf].folder);
    return run_sweep(points, settings);
  };

  const std::string current = read_file(checkpoint / "current");
  fs::remove(checkpoint / "current");  // of a finished run
  for (const std::size_t leaf : {1, 2}) {
    const SweepRow row = without_leaves()[leaf];
    EXPECT_FALSE(row.done);
    EXPECT_EQ(row.code, ExitCode::bad_data);
    EXPECT_NE(row.error.find("v20/checkpoint/current"), std::string::npos) << row.error;
  }

  write_file(checkpoint / "current", current);
  fs::remove(middle / ".ripstop/seal");  // of one that had not ended
  for (const char* name : {"even", "odd"}) fs::remove(checkpoint / name / "state");
  const std::vector<SweepRow> rows = without_leaves();
  EXPECT_EQ(rows[0].code, ExitCode::bad_data) << rows[0].error;
  for (const std::size_t leaf : {1, 2}) {
    EXPECT_FALSE(rows[leaf].done);
    EXPECT_NE(rows[leaf].error.find("was not started, because v20"), std::string::npos) << rows[leaf].error;
    EXPECT_FALSE(fs::exists(settings.folder / points[leaf].folder));
  }
}

}  // namespace
}  // namespace ripstop
