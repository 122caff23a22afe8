// A sweep whose runs are done one by one, as by the jobs of a cluster.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/run/sweep/sweep.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class SweepElsewhere : public testing::Test {
 protected:
  SweepElsewhere() { vary({"10", "15", "20"}); }
  void vary(const std::vector<std::string>& speeds) {
    add_square_law();
    Overrides overrides;
    overrides.engine = "square-law";
    overrides.grid = {20, 20, 30};
    overrides.set = {{"parachute.mesh.cloth_nodes", "500"},
                     {"coupling.cloth_tolerance", "0.01"},
                     {"coupling.threads", "1"}};
    points_ = sweep_points(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml", overrides,
                           {sweep_axis("flow.speed_m_s", speeds, "--speeds")});
    settings_.folder = root_.path / "sweep";
    settings_.jobs = 1;
  }
  SteadyResult run(std::size_t point) {
    SteadyObserver nobody;
    return run_sweep_point(points_, settings_, point, nobody);
  }
  /// Its iterations, but for their last column, the wall time.
  std::string iterations(const fs::path& sweep, std::size_t point) const {
    std::istringstream lines(read_file(sweep / points_[point].folder / "iterations.csv"));
    std::string kept;
    for (std::string line; std::getline(lines, line);) kept += line.substr(0, line.rfind(',')) + "\n";
    return kept;
  }

  TemporaryFolder root_{"elsewhere"};
  std::vector<SweepPoint> points_;
  SweepSettings settings_;
};

TEST_F(SweepElsewhere, EveryRunStartsFromOneOfAnEarlierWave) {
  vary({"10", "15", "20", "25"});
  using Waves = std::vector<std::vector<std::size_t>>;
  EXPECT_EQ(sweep_waves(points_, true), (Waves{{1}, {0, 2}, {3}}));
  EXPECT_EQ(sweep_waves(points_, false), (Waves{{0, 1, 2, 3}}));
}

TEST_F(SweepElsewhere, LeavesTheNumbersOfASweepHereWhichGoesOnWithWhatHasNotComeBack) {
  SweepSettings here = settings_;
  here.folder = root_.path / "here";
  const std::vector<SweepRow> wanted = run_sweep(points_, here);
  prepare_sweep(points_, settings_);
  run(1);
  EXPECT_EQ(run(2).drag, wanted[2].result.drag);
  const std::vector<SweepRow> gathered = gather_sweep(points_, settings_);
  EXPECT_TRUE(gathered[1].done && gathered[2].done);
  EXPECT_FALSE(gathered[0].done);
  EXPECT_NE(gathered[0].error.find("is not finished"), std::string::npos) << gathered[0].error;

  std::vector<bool> computed(points_.size());
  SweepEvents events;
  events.progress = [&](std::size_t i, const SteadyProgress&, const SteadyState&) { computed[i] = true; };
  for (const SweepRow& row : run_sweep(points_, settings_, events)) EXPECT_TRUE(row.done) << row.error;
  EXPECT_EQ(computed, (std::vector<bool>{true, false, false}));
  for (std::size_t i = 0; i < points_.size(); ++i)
    EXPECT_EQ(iterations(settings_.folder, i), iterations(here.folder, i)) << i;
}

TEST_F(SweepElsewhere, ARunThatCameBackDamagedIsTold) {
  prepare_sweep(points_, settings_);
  run(1);
  const fs::path damaged = settings_.folder / points_[1].folder / "lines.csv";
  write_file(damaged, "line\n1\n");
  const SweepRow row = gather_sweep(points_, settings_)[1];
  EXPECT_FALSE(row.done);
  EXPECT_EQ(row.code, ExitCode::bad_data);
  EXPECT_NE(row.error.find("lines.csv"), std::string::npos) << row.error;
}

TEST_F(SweepElsewhere, AllOfWhichCameBackNeedsNoFlowFieldAnyMore) {
  prepare_sweep(points_, settings_);
  for (const auto& wave : sweep_waves(points_, true))
    for (const std::size_t i : wave) run(i);
  const auto has_flow = [&](std::size_t i) {
    const fs::path checkpoint = settings_.folder / points_[i].folder / "checkpoint";
    return fs::exists(checkpoint / "even/flow") || fs::exists(checkpoint / "odd/flow");
  };
  EXPECT_TRUE(has_flow(1));
  for (const SweepRow& row : gather_sweep(points_, settings_)) EXPECT_TRUE(row.done) << row.error;
  for (std::size_t i = 0; i < points_.size(); ++i) EXPECT_FALSE(has_flow(i)) << i;
}

TEST_F(SweepElsewhere, ARunWhoseNeighbourHasNotComeBackIsNotBegun) {
  prepare_sweep(points_, settings_);
  try {
    run(2);
    ADD_FAILURE() << "begun";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    EXPECT_NE(std::string(error.what()).find("speed_m_s=15, from which it starts, is not finished"),
              std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(fs::exists(settings_.folder / points_[2].folder));
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
  vary({"10", "15", "20", "25"});
  std::unique_ptr<ClaimedFolder> busy;
  SweepEvents events;
  events.ended = [&](std::size_t i, const std::vector<SweepRow>&) {
    if (i == 1) busy = std::make_unique<ClaimedFolder>(settings_.folder / points_[2].folder);
  };
  const std::vector<SweepRow> rows = run_sweep(points_, settings_, events);
  EXPECT_TRUE(rows[0].done && rows[1].done);
  EXPECT_NE(rows[2].error.find("is using this folder"), std::string::npos) << rows[2].error;
  EXPECT_NE(rows[3].error.find("was not started"), std::string::npos) << rows[3].error;
}

TEST_F(SweepElsewhere, ARunOfNoSweepIsRefused) {
  EXPECT_THROW(run(1), Error);
  EXPECT_FALSE(fs::exists(settings_.folder));
}

}  // namespace
}  // namespace ripstop
