// A stopped run, whose files were damaged before it resumes.
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "ripstop/core/error.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/steady/finished_steady.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

/// The process that ends after its first iteration.
struct Stopped : SteadyObserver {
  void iterated(const SteadyRun&, const SteadyState&, const FlowField&) override {
    throw std::runtime_error("stopped");
  }
};

class InterruptedRun : public testing::Test {
 protected:
  TemporaryFolder root{"interrupted"};
  fs::path folder = root.path / "run";

  void SetUp() override {
    Stopped stopped;
    EXPECT_THROW(run_steady_in({{folder}, 1, {}, {}}, resolve(square_law_case()), stopped),
                 std::runtime_error);
  }
};

TEST_F(InterruptedRun, MakesItsCaseAndDescriptionAnew) {
  const std::string given = read_file(folder / "case.toml"), description = read_file(folder / "run.json");
  std::string changed = given;
  changed.replace(changed.find("speed_m_s = "), 13, "speed_m_s = 9");
  write_file(folder / "case.toml", changed);
  write_file(folder / "run.json", description.substr(0, description.size() / 2));
  fly_square_law(folder);
  EXPECT_EQ(read_file(folder / "case.toml"), given);
  EXPECT_EQ(read_file(folder / "run.json"), description);  // `started` too
  EXPECT_TRUE(finished_result(folder));
}

TEST_F(InterruptedRun, MakesTheTableOfItsIterationsAnewFromTheCheckpoint) {
  CsvTable table = read_csv(folder / "iterations.csv");
  table.rows = {table.rows.at(0), table.rows.at(0)};
  table.rows[0][1] = 7;
  write_csv(folder / "iterations.csv", table);
  fly_square_law(folder);
  table = read_csv(folder / "iterations.csv");
  const std::vector<SteadyIteration> all = final_state(folder).iterations;
  EXPECT_EQ(table.columns, columns_of<SteadyIteration>());
  ASSERT_EQ(table.rows.size(), all.size());
  ASSERT_GE(all.size(), 2u);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(table.rows[i], row_of(all[i])) << i;
}

TEST_F(InterruptedRun, DetectsChangesOfEarlierIterations) {
  const fs::path shape = folder / "vtk/canopy_001.vtp";
  const std::string whole = read_file(shape);
  std::string changed = whole;
  changed[changed.size() / 2] ^= 1;
  for (const bool gone : {false, true}) {
    gone ? void(fs::remove(shape)) : write_file(shape, changed);
    try {
      fly_square_law(folder);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(std::string(error.what()).find("vtk/canopy_001.vtp"), std::string::npos) << error.what();
    }
  }
  write_file(shape, whole);
  fly_square_law(folder);
  EXPECT_TRUE(finished_result(folder));
}

TEST(ContinuedRun, HasTheNumbersOfOneThatWasAllowedAllIterations) {
  const TemporaryFolder root("continued");
  const auto with = [](const char* most) { return std::vector<Setting>{{"coupling.max_iterations", most}}; };
  const SteadyResult whole = fly_square_law(root.path / "whole", with("40"));
  ASSERT_TRUE(whole.converged);
  ASSERT_GT(whole.iterations, 1);
  EXPECT_FALSE(fly_square_law(root.path / "part", with("1")).converged);
  EXPECT_THROW(
      fly_square_law(root.path / "part", {{"coupling.max_iterations", "40"}, {"flow.speed_m_s", "21"}}),
      Error);  // another run
  EXPECT_EQ(fly_square_law(root.path / "part", with("1")).iterations, 1);
  const SteadyResult continued = fly_square_law(root.path / "part", with("40"));
  EXPECT_TRUE(continued.converged);
  EXPECT_EQ(continued.drag, whole.drag);
  EXPECT_EQ(continued.iterations, whole.iterations);
  EXPECT_EQ(read_file(root.path / "part/canopy.stl"), read_file(root.path / "whole/canopy.stl"));
  EXPECT_EQ(finished_steady(root.path / "part").result.drag, whole.drag);
  // A run that has converged is complete.
  EXPECT_THROW(fly_square_law(root.path / "part", with("50")), Error);
}

}  // namespace
}  // namespace ripstop
