// Rigid bodies in a coupled inflation: their loads, files and results, and the positions that are refused.
#include "ripstop/run/opening/opening_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "ripstop/case/opening.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/stl.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "tests/refusal.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

/// Behind a block that is as wide as the folded canopy.
Case behind_a_block(double trailing_distance_m = 1.45) {
  Case given = small_opening_in_air();
  BodyKeys& block = given.bodies["block"];
  block.shape = BoxKeys{{0.4, 0.4, 0.3}};
  block.trailing_distance_m = trailing_distance_m;
  return given;
}

InflationSolution solution_of(const Case& given) {
  const Settings opening = resolve(opening_case(given));
  const LoadSource source = load_source(opening);
  InflationObserver silent;
  return run_inflation(opening, source, opening_problem(opening, source, 1), silent);
}

TEST(OpeningBodies, HaveLoadsOfTheirOwnInEveryStep) {
  const InflationSolution with = solution_of(behind_a_block());
  const std::vector<OpeningBodyRow>& rows = with.history.bodies;
  ASSERT_EQ(rows.size(), with.history.air.size());
  EXPECT_EQ(rows.back().time, with.history.air.back().time);
  EXPECT_NEAR(rows.back().drag_area, rows.back().drag / with.history.air.back().dynamic_pressure, 1e-12);
  ASSERT_TRUE(with.result.bodies);
  const OpeningBody& block = with.result.bodies->front();
  EXPECT_EQ(block.name, "block");
  EXPECT_NEAR(block.reference_area, 0.16, 1e-12);
  EXPECT_GT(block.drag_coefficient, 0.5);
  EXPECT_LT(block.drag_coefficient, 3);
  EXPECT_NEAR(block.drag_coefficient, block.drag_area / 0.16, 1e-12);
  const std::vector<std::string>& warnings = with.result.warnings.value();
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& text) {
    return text.find("body.block: rigid bodies are experimental") == 0;
  }));
}

/// Without its bodies, on the same cells.
Case without_bodies(const Case& behind) {
  const Settings resolved = resolve(behind);
  const FlowSettings& flow = resolved.flow();
  Case alone = behind;
  alone.flow.box_m = flow.box_m, alone.flow.canopy_position_m = flow.canopy_position_m;
  alone.flow.core = {.size_m = flow.core.size_m,
                     .start_m = flow.core.start_m,
                     .growth = flow.core.growth,
                     .off_axis = flow.core.off_axis};
  alone.bodies.clear();
  return alone;
}

// It increases the speed of the air about it by some per cent.
TEST(OpeningBodies, OneFarFromTheCanopyChangesItsLoadsLittle) {
  Case given = behind_a_block();
  BodyKeys& block = given.bodies["block"];
  block.shape = BoxKeys{{0.2, 0.2, 0.2}};
  block.x_m = 0.8;
  const InflationSolution with = solution_of(given), alone = solution_of(without_bodies(given));
  EXPECT_TRUE(alone.history.bodies.empty());
  EXPECT_FALSE(alone.result.bodies);
  const AirRow &row = with.history.air.back(), &of_alone = alone.history.air.back();
  EXPECT_GT(with.history.bodies.back().drag, 0.04 * of_alone.drag);
  EXPECT_NEAR(row.drag, of_alone.drag, 0.08 * of_alone.drag);
  EXPECT_NEAR(with.history.rows.back().mean, alone.history.rows.back().mean,
              0.08 * alone.history.rows.back().mean);
}

struct KilledHalfway : InflationObserver {
  void advanced(const Opening& solver, const InflationState& state, const InflationHistory&,
                const InflationFrame*) override {
    if (state.blocks == solver.blocks() / 2 + 1) throw std::runtime_error("killed");
  }
};

TEST(OpeningBodies, AreInTheRunFolderAndAKilledRunResumesWithThemByteForByte) {
  const TemporaryFolder folder("opening-bodies");
  const Settings opening = resolve(opening_case(behind_a_block()));
  const LoadSource source = load_source(opening);
  const auto open = [&](const char* name, InflationObserver& observer) {
    run_inflation_in(
        {{folder.path / name}, 1, 0}, opening, source, [&] { return opening_problem(opening, source, 1); },
        observer);
  };
  InflationObserver silent;
  open("whole", silent);
  KilledHalfway killed;
  EXPECT_THROW(open("killed", killed), std::runtime_error);
  open("killed", silent);
  for (const char* file : {"bodies.csv", "air.csv", "result.json"})
    EXPECT_EQ(read_file(folder.path / "killed" / file), read_file(folder.path / "whole" / file)) << file;
  EXPECT_EQ(read_csv(folder.path / "whole/bodies.csv").column("body")[0], 1);
  EXPECT_EQ(read_stl(folder.path / "whole/body-block.stl").size(), 12u);
}

TEST(OpeningBodies, ThatTouchTheFoldedCanopyOrItsLinesAreRefused) {
  const auto why = [](double trailing_distance) {
    return refusal_of([&] { solution_of(behind_a_block(trailing_distance)); }, ExitCode::usage);
  };
  EXPECT_NE(why(0.3).find("lines or the riser pass through the body \"block\""), std::string::npos);
  EXPECT_NE(why(0.01).find("body \"block\""), std::string::npos);
}

TEST(OpeningBodies, ResultsAreThePeakAfterTheStartUpAndTheMeanAtTheEnd) {
  const Settings opening = resolve(opening_case(behind_a_block()));
  std::vector<AirRow> air(10);
  for (int n = 0; n < 10; ++n) {
    air[n].time = 0.1 * (n + 1), air[n].dynamic_pressure = 200;
    air[n].bodies = {{{1, 2, n == 0 ? 1000 : n == 4 ? 90 : 40.0 + n}, {3, 4, 5}}};
  }
  std::vector<OpeningBodyRow> rows;
  add_body_rows(air, 0, rows);
  EXPECT_EQ(rows.size(), 10u);
  EXPECT_EQ(rows[4].side_y, 2);
  EXPECT_EQ(rows[4].moment_z, 5);
  const FlowBody body = sheet_body(block({0.4, 0.4, 0.3}, {}), impermeable, "block");
  const OpeningBody result = opening_bodies(opening, {body}, rows, 0.15).value().front();
  EXPECT_EQ(result.peak_drag, 90);
  EXPECT_NEAR(result.peak_time, 0.5, 1e-12);
  EXPECT_NEAR(result.drag_area, 48.5 / 200, 1e-12);
  EXPECT_FALSE(opening_bodies(opening, {}, rows, 0.15));
}

TEST(OpeningBodies, APayloadWithoutADragAreaCausesAWarning) {
  Case given = behind_a_block();
  given.payload.mass_kg = 5;
  OpeningBody body;
  body.drag_area = 0.021;
  const auto warnings = [&] { return payload_drag_warnings(resolve(given), std::vector<OpeningBody>{body}); };
  ASSERT_EQ(warnings().size(), 1u);
  EXPECT_NE(warnings().front().find("0.021 m2"), std::string::npos);
  given.payload.drag_area_m2 = 0.02;
  EXPECT_TRUE(warnings().empty());
}

}  // namespace
}  // namespace ripstop
