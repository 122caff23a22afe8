// Reefing lines in an opening: what they hold, when they go, and what is left the same.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../printed_materials.h"
#include "ripstop/core/error.h"
#include "ripstop/fsi/summary.h"
#include "ripstop/fsi/uniform_pressure_opening.h"
#include "ripstop/parachute/build.h"
#include "ripstop/parachute/disk_gap_band.h"
#include "ripstop/run/opening/inflation_folder.h"

namespace ripstop {
namespace {

const SpringLaw nylon_cord{{8155}, 0};

InflationProblem opening_with(std::vector<ReefingLine> lines, double duration = 0.03, int threads = 2) {
  Design design = printed_stratos(1200);
  design.canopy = DiskGapBand{1.0, 0.2, 0.07, 0.3};
  design.lines.count = 6;
  design.mesh.line_segment_m = 0.15;
  design.mesh.folds = 6;
  InflationProblem problem{build_mesh(design, printed_materials()), {}, 500, false, threads};
  problem.settings.initial_radius_m = 0.14;
  problem.settings.duration_s = duration;
  problem.settings.frames = 10;
  problem.symmetry = 6;
  problem.reefing = std::move(lines);
  return problem;
}

struct Opened {
  InflationState state;
  std::vector<HistoryRow> rows;
  InflationFrame last;
  double worst_residual = 0, stable_step = 1;
};

double way_round(const CanopyMesh& mesh, const std::vector<Vec3>& x) {
  const std::vector<int> joints = line_joints(mesh);
  double way = 0;
  for (std::size_t i = 0; i < joints.size(); ++i)
    way += norm(x[joints[(i + 1) % joints.size()]] - x[joints[i]]);
  return way;
}

Opened open(InflationProblem problem) {
  UniformPressureOpening solver(std::move(problem));
  Opened opened;
  opened.state = solver.start();
  while (opened.state.blocks < solver.blocks()) {
    const auto block = solver.advance(opened.state);
    opened.rows.insert(opened.rows.end(), block.begin(), block.end());
    if (!solver.at_frame(opened.state)) continue;
    opened.last = solver.frame(opened.state);
    opened.stable_step = std::min(opened.stable_step, opened.last.stable_step);
    if (opened.last.time > 0.5 * solver.problem().settings.duration_s)
      opened.worst_residual = std::max(opened.worst_residual, std::abs(opened.last.residual));
  }
  return opened;
}

TEST(Reefing, TheLineHoldsTheSkirtAtItsLength) {
  for (const double length : {1.0, 1.5, 2.0}) {
    InflationProblem problem = opening_with({{length, 1, nylon_cord}});
    problem.settings.sheet_s = {0.01, 0.015, 0.02, 0.025, 0.029};
    const Opened reefed = open(problem);
    double way = 0;
    for (const Snapshot& shot : reefed.state.snapshots)
      way = std::max(way, way_round(problem.mesh, shot.positions));
    EXPECT_GT(way, length);
    EXPECT_LT(way, 1.05 * length);
    double pulled = 0;
    for (const HistoryRow& row : reefed.rows) pulled = std::max(pulled, row.reefing_largest);
    EXPECT_GT(pulled, 5);
    EXPECT_EQ(reefed.state.cuts.size(), 0u);
  }
}

TEST(Reefing, ALineThatNeverComesTautChangesNothingToTheLastBit) {
  const Opened open_at_once = open(opening_with({})), slack = open(opening_with({{50, 0.01, nylon_cord}}));
  EXPECT_EQ(slack.state.cloth.x, open_at_once.state.cloth.x);
  EXPECT_EQ(slack.state.cloth.v, open_at_once.state.cloth.v);
  EXPECT_EQ(slack.state.record.damped, open_at_once.state.record.damped);
  EXPECT_EQ(slack.state.peak_load, open_at_once.state.peak_load);
  ASSERT_EQ(slack.rows.size(), open_at_once.rows.size());
  for (std::size_t i = 0; i < slack.rows.size(); ++i)
    EXPECT_EQ(slack.rows[i].mean, open_at_once.rows[i].mean);
}

TEST(Reefing, TheEnergyOfACutLineIsInTheBalance) {
  InflationProblem problem = opening_with({{1.0, 0.02, nylon_cord}, {1.8, 0.04, nylon_cord}}, 0.06);
  problem.settings.frames = 30;
  const Opened reefed = open(problem);
  ASSERT_EQ(reefed.state.cuts.size(), 2u);
  EXPECT_NEAR(reefed.state.cuts[0], 0.02, 0.002);
  EXPECT_NEAR(reefed.state.cuts[1], 0.04, 0.002);
  EXPECT_GE(reefed.state.cuts[0], 0.02 * (1 - 1e-9));
  EXPECT_GT(reefed.last.cut, 1e-4);
  EXPECT_LT(reefed.worst_residual, 0.01);
  const auto stages = summarise_stages(reefed.rows, {}, {1.0, 1.8}, reefed.state.cuts, 0);
  ASSERT_EQ(stages.size(), 3u);
  EXPECT_EQ(stages[0].end, reefed.state.cuts[0]);
  EXPECT_EQ(stages[2].line, std::nullopt);
  EXPECT_GT(*stages[0].line_peak, *stages[1].line_peak * 0.2);
  double highest = 0;
  for (const StageSummary& stage : stages) highest = std::max(highest, stage.peak_load);
  EXPECT_EQ(highest, reefed.state.peak_load);
  for (const HistoryRow& row : reefed.rows)
    EXPECT_TRUE(row.time <= reefed.state.cuts[1] * (1 + 1e-9) || row.reefing_largest == 0) << row.time;
}

// Loads at rest: the first pull of the lines is as high reefed as not, under a pressure that knows of no mouth.
TEST(Reefing, EachStageHoldsItsLoad) {
  InflationProblem problem = opening_with({{1.0, 0.15, nylon_cord}, {1.8, 0.3, nylon_cord}}, 0.45);
  problem.settings.damping_n_s_m3 = 30;  // to rest soon
  problem.settings.cloth_damping_s = 1e-5;
  const Opened reefed = open(problem);
  const auto stages = summarise_stages(reefed.rows, {}, {1.0, 1.8}, reefed.state.cuts, 0);
  ASSERT_EQ(stages.size(), 3u);
  EXPECT_GT(stages[0].last_load, 10);
  EXPECT_LT(stages[0].last_load, 0.9 * stages[1].last_load);
  EXPECT_LT(stages[1].last_load, 0.9 * stages[2].last_load);
}

TEST(Reefing, AfterTheCutTheCanopyStandsAsOneThatWasNeverReefed) {
  InflationProblem reefed = opening_with({{1.0, 0.02, nylon_cord}}, 0.4), plain = opening_with({}, 0.4);
  for (InflationProblem* problem : {&reefed, &plain}) {
    problem->settings.damping_n_s_m3 = 30;  // to rest soon
    problem->settings.cloth_damping_s = 1e-5;
  }
  const Opened a = open(reefed), b = open(plain);
  EXPECT_NEAR(a.last.size.projected_area, b.last.size.projected_area, 0.01 * b.last.size.projected_area);
  EXPECT_NEAR(a.last.size.skirt_diameter, b.last.size.skirt_diameter, 0.01 * b.last.size.skirt_diameter);
  EXPECT_NEAR(a.rows.back().mean, b.rows.back().mean, 0.01 * b.rows.back().mean);
}

TEST(Reefing, AStoppedRunGoesOnToTheLastBitAcrossACut) {
  const InflationProblem problem = opening_with({{1.0, 6e-3, nylon_cord}, {1.8, 9e-3, nylon_cord}}, 0.012);
  UniformPressureOpening whole(problem), first(problem), second(problem);
  InflationState undisturbed = whole.start(), stopped = first.start();
  while (undisturbed.blocks < whole.blocks()) whole.advance(undisturbed);
  while (stopped.blocks < first.blocks() * 2 / 3) first.advance(stopped);
  EXPECT_EQ(stopped.cuts.size(), 1u);
  InflationState resumed = inflation_state_from_bytes(to_bytes(stopped));
  while (resumed.blocks < second.blocks()) second.advance(resumed);
  EXPECT_EQ(to_bytes(resumed), to_bytes(undisturbed));
  EXPECT_EQ(resumed.cuts.size(), 2u);
}

TEST(Reefing, AnyNumberOfThreadsOpensItAlike) {
  const std::vector<ReefingLine> lines{{1.0, 0.008, nylon_cord}};
  const Opened one = open(opening_with(lines, 0.012, 1)), three = open(opening_with(lines, 0.012, 3));
  EXPECT_EQ(to_bytes(one.state), to_bytes(three.state));
}

TEST(Reefing, ALineShorterThanTheFoldedSkirtIsRefused) {
  InflationProblem problem = opening_with({{0.5, 0.01, nylon_cord}});
  problem.settings.initial_radius_m = 0.3;
  try {
    UniformPressureOpening{problem};
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("exceeds the reefing line"), std::string::npos);
  }
}

}  // namespace
}  // namespace ripstop
