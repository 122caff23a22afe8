// A sweep whose runs are done one by one, as by the jobs of a cluster.
#include <gtest/gtest.h>

#include <filesystem>

#include "finished_run.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/run/sweep.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class SweepElsewhere : public testing::Test {
 protected:
  SweepElsewhere() {
    square_law_case();
    Overrides overrides;
    overrides.engine = "square-law";
    overrides.grid = {20, 20, 30};
    overrides.set = {{"parachute.mesh.cloth_nodes", "800"}, {"coupling.threads", "1"}};
    points_ = sweep_points(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml", overrides,
                           {sweep_axis("flow.speed_m_s", {"10", "15", "20", "25"}, "--speeds")});
    settings_.folder = root_.path / "sweep";
    settings_.jobs = 1;
  }
  SteadyResult run(std::size_t point) {
    SteadyObserver nobody;
    return run_sweep_point(points_, settings_, point, nobody);
  }
  std::string iterations(const fs::path& sweep, std::size_t point) const {
    return read_file(sweep / points_[point].folder / "iterations.csv");
  }

  TemporaryFolder root_{"elsewhere"};
  std::vector<SweepPoint> points_;
  SweepSettings settings_;
};

TEST_F(SweepElsewhere, EveryRunStartsFromOneOfAnEarlierWave) {
  using Waves = std::vector<std::vector<std::size_t>>;
  EXPECT_EQ(sweep_waves(points_, true), (Waves{{1}, {0, 2}, {3}}));
  EXPECT_EQ(sweep_waves(points_, false), (Waves{{0, 1, 2, 3}}));
}

TEST_F(SweepElsewhere, WaveByWaveItLeavesTheNumbersOfASweepHere) {
  SweepSettings here = settings_;
  here.folder = root_.path / "here";
  const std::vector<SweepRow> wanted = run_sweep(points_, here);
  prepare_sweep(points_, settings_);
  for (const auto& wave : sweep_waves(points_, true))
    for (const std::size_t i : wave) EXPECT_EQ(run(i).drag, wanted[i].result.drag);
  const std::vector<SweepRow> rows = gather_sweep(points_, settings_);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    EXPECT_TRUE(rows[i].done) << rows[i].error;
    EXPECT_EQ(rows[i].result.drag, wanted[i].result.drag);
    EXPECT_EQ(iterations(settings_.folder, i), iterations(here.folder, i));
    EXPECT_FALSE(fs::exists(settings_.folder / points_[i].folder / "checkpoint/even/flow"));
  }
}

TEST_F(SweepElsewhere, ARunWhoseNeighbourHasNotComeBackIsNotBegun) {
  prepare_sweep(points_, settings_);
  run(1);
  try {
    run(3);
    ADD_FAILURE() << "begun";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    EXPECT_NE(std::string(error.what()).find("speed_m_s=20, which it starts from, has not ended"),
              std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(fs::exists(settings_.folder / points_[3].folder));
}

TEST_F(SweepElsewhere, WhatHasNotComeBackIsToldAndASweepHereGoesOn) {
  SweepSettings here = settings_;
  here.folder = root_.path / "here";
  run_sweep(points_, here);
  prepare_sweep(points_, settings_);
  run(1);
  run(2);
  const std::vector<SweepRow> gathered = gather_sweep(points_, settings_);
  EXPECT_TRUE(gathered[1].done && gathered[2].done);
  for (const std::size_t i : {0u, 3u}) {
    EXPECT_FALSE(gathered[i].done);
    EXPECT_NE(gathered[i].error.find("has not come back"), std::string::npos) << gathered[i].error;
  }
  int computed = 0;
  SweepEvents events;
  std::vector<bool> told(points_.size());
  events.progress = [&](std::size_t i, const SteadyProgress&, const SteadyState&) { told[i] = true; };
  for (const SweepRow& row : run_sweep(points_, settings_, events)) EXPECT_TRUE(row.done) << row.error;
  for (const bool one : told) computed += one;
  EXPECT_EQ(computed, 2);  // those that had not come back
  for (std::size_t i = 0; i < points_.size(); ++i)
    EXPECT_EQ(iterations(settings_.folder, i), iterations(here.folder, i)) << i;
}

TEST_F(SweepElsewhere, ARunThatAnotherProcessIsAtIsLeftToIt) {
  prepare_sweep(points_, settings_);
  run(1);
  const ClaimedFolder busy(settings_.folder / points_[2].folder);
  EXPECT_THROW(run(2), Error);
  EXPECT_THROW(run_sweep(points_, settings_), Error);     // before anything is computed
  EXPECT_TRUE(gather_sweep(points_, settings_)[1].done);  // what is there can be looked at
}

// Between the look at all folders and the run's own turn, as only a job elsewhere can come.
TEST_F(SweepElsewhere, ARunThatIsTakenWhileASweepGoesOnIsNotStartedFromNothing) {
  std::unique_ptr<ClaimedFolder> busy;
  SweepEvents events;
  events.ended = [&](std::size_t i, const std::vector<SweepRow>&) {
    if (i == 1) busy = std::make_unique<ClaimedFolder>(settings_.folder / points_[2].folder);
  };
  const std::vector<SweepRow> rows = run_sweep(points_, settings_, events);
  EXPECT_TRUE(rows[0].done && rows[1].done);
  EXPECT_NE(rows[2].error.find("works in this folder"), std::string::npos) << rows[2].error;
  EXPECT_NE(rows[3].error.find("was not begun"), std::string::npos) << rows[3].error;
}

TEST_F(SweepElsewhere, ARunOfNoSweepIsRefused) {
  EXPECT_THROW(run(1), Error);
  EXPECT_FALSE(fs::exists(settings_.folder));
}

}  // namespace
}  // namespace ripstop
