#include "ripstop/run/report/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/core/file.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

TEST(RunProgress, HasThePlotsOfTheTableThatARunExtends) {
  const TemporaryFolder folder("progress");
  EXPECT_TRUE(progress_in(folder.path).plots.empty());
  write_file(folder.path / "iterations.csv", "iteration,drag_n,omega\n1,10,0.5\n2,11,0.25\n");
  const RunProgress progress = progress_in(folder.path);
  ASSERT_EQ(progress.plots.size(), 2U);
  EXPECT_EQ(progress.plots[0].id, "forces");
  EXPECT_EQ(progress.plots[0].series[0].y, (std::vector<double>{10, 11}));
  EXPECT_EQ(progress.plots[1].id, "changes");
  EXPECT_FALSE(progress.shape);
}

TEST(RunProgress, HasThePlotsOfATrajectory) {
  const TemporaryFolder folder("progress");
  write_file(folder.path / "trajectory.csv", "time_s,height_m,speed_m_s,force_n\n0,500,20,0\n1,490,15,80\n");
  const RunProgress progress = progress_in(folder.path);
  ASSERT_EQ(progress.plots.size(), 3U);
  EXPECT_EQ(progress.plots[0].id, "load");
  EXPECT_EQ(progress.plots[0].series[0].y, (std::vector<double>{0, 80}));
  EXPECT_EQ(progress.plots[2].id, "height");
  EXPECT_EQ(progress.plots[2].series[0].y, (std::vector<double>{500, 490}));
}

TEST(RunProgress, LeavesOutATableThatIsBeingWritten) {
  const TemporaryFolder folder("progress");
  write_file(folder.path / "iterations.csv", "iteration,drag_n,omega\n1,10,0.5\n2,1");
  EXPECT_TRUE(progress_in(folder.path).plots.empty());
}

TEST(RunProgress, OfASweepIsThatOfTheRunThatHasWrittenLast) {
  const TemporaryFolder folder("progress");
  for (const char* run : {"10", "20"}) {
    fs::create_directory(folder.path / run);
    write_file(folder.path / run / "iterations.csv", std::string("iteration,drag_n\n1,") + run + "\n");
  }
  fs::last_write_time(folder.path / "20/iterations.csv",
                      fs::last_write_time(folder.path / "10/iterations.csv") - std::chrono::hours(1));
  const RunProgress progress = progress_in(folder.path);
  ASSERT_EQ(progress.plots.size(), 1U);
  EXPECT_EQ(progress.plots[0].series[0].y, std::vector<double>{10});
}

TEST(RunProgress, DoesNotFollowLinks) {
  const TemporaryFolder folder("progress"), other("progress");
  write_file(other.path / "iterations.csv", "iteration,drag_n\n1,10\n");
  fs::create_directory_symlink(other.path, folder.path / "10");
  EXPECT_TRUE(progress_in(folder.path).plots.empty());
}

}  // namespace
}  // namespace ripstop
