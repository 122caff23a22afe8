// Steady runs of a canopy behind a rigid body.
#include <gtest/gtest.h>

#include <filesystem>

#include "../../refusal.h"
#include "../../small_case.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/stl.h"
#include "ripstop/run/steady/steady_folder.h"

namespace ripstop {
namespace {

Case small_drogue() {
  Case given = flat_circular_case(0.6, 500, 20);
  given.parachute.mesh.line_segment_m = 0.2;
  given.flow.box_m = Vec3{2.4, 2.4, 3.6};
  given.flow.cells = {20, 20, 40};
  given.flow.canopy_position_m = 1.8;
  given.flow.core = {.size_m = Vec3{0.8, 0.8, 2.2}, .start_m = 0.3, .growth = {}, .off_axis = {}};
  given.flow.max_iterations = 150;
  given.flow.average_over = 30;
  given.coupling.load = CanopyLoad::uniform;
  given.coupling.max_iterations = 3;
  given.coupling.threads = 1;
  return given;
}

TEST(SteadyBodies, TakeDragFromTheCanopyBehindThemAndAreFoundInTheRunFolder) {
  const TemporaryFolder folder("bodies");
  SteadyObserver silent;
  Case given = small_drogue();
  const SteadyResult alone = run_steady(checked(given), silent).result;
  EXPECT_FALSE(alone.bodies);
  BodyKeys& block = given.bodies["block"];
  block.shape = BoxKeys{{0.2, 0.2, 0.4}};
  block.trailing_distance_m = 0.6;
  const SteadyFolderSettings settings{{folder.path / "run", false}, 1, {}, {}, false};
  const SteadyResult behind = run_steady_in(settings, resolve(checked(given)), silent).result;
  ASSERT_TRUE(behind.bodies);
  ASSERT_EQ(behind.bodies->size(), 1u);
  const BodyResult& body = behind.bodies->front();
  EXPECT_EQ(body.name, "block");
  EXPECT_NEAR(body.reference_area, 0.04, 1e-12);
  EXPECT_GT(body.drag_coefficient, 0.6);
  EXPECT_LT(body.drag_coefficient, 1.8);
  // The canopy loses no more than the momentum that its wake lacks can explain, and more than nothing.
  EXPECT_LT(behind.drag, alone.drag - 0.3 * body.drag);
  EXPECT_GT(behind.drag, alone.drag - 3 * body.drag);
  EXPECT_NEAR(behind.ledger.momentum_deficit / behind.drag, 1, 0.02);
  EXPECT_EQ(read_stl(folder.path / "run" / "body-block.stl").size(), 12u);
  // The finished run is read back with its bodies.
  const SteadyResult again = run_steady_in(settings, resolve(checked(given)), silent).result;
  EXPECT_EQ(again.bodies.value().front().drag, body.drag);
}

TEST(SteadyBodies, OfAnUnsteadyRunHaveAMeanDragWithItsStandardError) {
  SteadyObserver silent;
  Case given = small_drogue();
  BodyKeys& block = given.bodies["block"];
  block.shape = BoxKeys{{0.2, 0.2, 0.4}};
  block.trailing_distance_m = 0.6;
  given.flow.unsteady = true;
  given.flow.watch.shortest = 15, given.flow.watch.longest = 45;
  given.coupling.max_iterations = 4;
  const SteadyResult result = run_steady(checked(given), silent).result;
  ASSERT_TRUE(result.bodies && result.unsteady);
  const BodyResult& body = result.bodies->front();
  ASSERT_TRUE(body.standard_error);
  EXPECT_GT(*body.standard_error, 0);
  EXPECT_LT(*body.standard_error, 0.2 * body.drag);
  EXPECT_GT(body.drag_coefficient, 0.6);
  EXPECT_LT(body.drag_coefficient, 1.8);
  const SteadyResult again = steady_result_from_json(to_json(result));
  EXPECT_EQ(again.bodies.value().front().standard_error, body.standard_error);
}

TEST(SteadyBodies, ThatTouchTheLinesOrLeaveTheDomainAreRefused) {
  SteadyObserver silent;
  const auto why = [&](double trailing_distance) {
    Case given = small_drogue();
    BodyKeys& block = given.bodies["block"];
    block.shape = BoxKeys{{0.1, 0.1, 0.2}};
    block.trailing_distance_m = trailing_distance;
    return refusal_of([&] { run_steady(checked(given), silent); }, ExitCode::usage);
  };
  EXPECT_NE(why(0.3).find("lines or the riser pass through the body \"block\""), std::string::npos);
  EXPECT_NE(why(1.75).find("must lie within"), std::string::npos) << "out of the box";
}

}  // namespace
}  // namespace ripstop
