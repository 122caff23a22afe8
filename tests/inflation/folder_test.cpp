// The run folder of an opening: a killed run goes on, and its tables are the undisturbed run's byte for byte.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/run/inflation_folder.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class InflationFolderTest : public ::testing::Test {
 protected:
  fs::path root = fs::temp_directory_path() / ("ripstop-opening-" + std::to_string(getpid()));
  Case value = read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples" / "stratos-iv" / "case.toml");

  void SetUp() override {
    value.parachute.mesh.cloth_nodes = 1500;
    value.parachute.lines.count = 6;
    value.parachute.mesh.folds = 6;
    value.parachute.mesh.line_segment_m = 0.15;
    value.inflation.initial_radius_m = 0.2;
    value.inflation.duration_s = 8e-3;
    value.inflation.frames = 8;
    value.inflation.sheet_s = {0, 0.004};
  }
  void TearDown() override { fs::remove_all(root); }

  InflationProblem problem() const { return {parachute_mesh(value), value.inflation, 500, false, 2, 6}; }
  InflationFolder open(const char* name, bool fresh = false) const {
    return {{root / name, fresh}, value, "test", 2};
  }
  static void compute(Inflation& solver, InflationFolder& files, InflationState& state, long long until) {
    while (state.blocks < until) {
      files.add_rows(solver.advance(state));
      if (solver.at_frame(state)) files.write_frame(solver, state, solver.frame(state));
    }
  }
};

TEST_F(InflationFolderTest, AKilledRunGoesOnAndItsHistoryIsByteIdentical) {
  Inflation whole(problem());
  InflationFolder undisturbed = open("whole");
  ASSERT_FALSE(undisturbed.go_on(whole));
  InflationState state = whole.start();
  undisturbed.write_start(whole, state);
  compute(whole, undisturbed, state, whole.blocks());
  undisturbed.save(state);
  undisturbed.finish(whole, state, value, {"given", {}});

  {  // Killed after the tables of a later frame were written and before its checkpoint was.
    Inflation solver(problem());
    InflationFolder files = open("killed");
    ASSERT_FALSE(files.go_on(solver));
    InflationState first = solver.start();
    files.write_start(solver, first);
    compute(solver, files, first, solver.blocks() / 2);
    files.save(first);
    const std::string checkpoint = read_file(root / "killed" / "checkpoint");
    compute(solver, files, first, solver.blocks() / 2 + 2);
    files.save(first);
    write_file(root / "killed" / "checkpoint", checkpoint);
    append_to_file(root / "killed" / "history.csv", "0.0123,4");
  }
  Inflation solver(problem());
  InflationFolder files = open("killed");
  auto resumed = files.go_on(solver);
  ASSERT_TRUE(resumed);
  EXPECT_EQ(resumed->blocks, solver.blocks() / 2);
  compute(solver, files, *resumed, solver.blocks());
  files.save(*resumed);
  files.finish(solver, *resumed, value, {"given", {}});
  for (const char* table : {"history.csv", "balance.csv", "lines.csv", "result.json"}) {
    EXPECT_EQ(read_file(root / "killed" / table), read_file(root / "whole" / table)) << table;
  }
}

TEST_F(InflationFolderTest, ADamagedCheckpointIsNoticedAndOtherInputsAreRefused) {
  Inflation solver(problem());
  InflationFolder files = open("run");
  InflationState state = solver.start();
  ASSERT_FALSE(files.go_on(solver));
  files.save(state);
  std::string bytes = read_file(root / "run" / "checkpoint");
  bytes[bytes.size() / 2] ^= 1;
  write_file(root / "run" / "checkpoint", bytes);
  EXPECT_THROW(open("run").go_on(solver), Error);
  value.inflation.damping_n_s_m3 = 9;
  EXPECT_THROW(open("run"), Error);
  EXPECT_NO_THROW(open("run", true));
}

}  // namespace
}  // namespace ripstop
