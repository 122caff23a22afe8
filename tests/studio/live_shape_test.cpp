#include "ripstop/studio/live_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "../small_case.h"
#include "ripstop/case/case.h"
#include "ripstop/core/error.h"
#include "ripstop/run/sizing/fabric.h"

namespace ripstop {
namespace {

using Json = nlohmann::json;

constexpr double long_enough = 100;  // [s]

Settings canopy(double diameter, double speed, int nodes) {
  Case given = flat_circular_case(diameter, nodes, speed);
  given.parachute.canopy_material = "f-111";
  given.coupling.threads = 1;
  apply({}, given);
  return resolve(given);
}

Json finished(LiveShape& shape, const Settings& given) {
  return Json::parse(shape.answer(shape.begin({given}, {}), long_enough));
}

/// Every number that `ripstop fabric` prints, its hash of the inputs included.
void expect_that_of_the_command_line(Json live, const Settings& given) {
  Json printed = Json::parse(to_json(run_fabric(given, {}).result));
  for (Json* one : {&live.at("result"), &printed}) one->erase("wall_time_s");
  EXPECT_EQ(live.at("result"), printed);
  EXPECT_EQ(live.at("shape").at("frames").at(0).at("points").at("n"), 3 * printed.at("nodes").get<int>());
}

TEST(LiveShape, IsThatOfTheCommandLineAfterAnyChanges) {
  LiveShape shape;
  for (const Settings& given : {canopy(1, 20, 500), canopy(1.1, 24, 500), canopy(1, 20, 500)}) {
    const Json live = finished(shape, given);
    EXPECT_TRUE(live.at("done"));
    expect_that_of_the_command_line(live, given);
  }
}

TEST(LiveShape, IsRefinedToThatOfTheCommandLine) {
  LiveShape shape(0);
  const Settings coarse = canopy(1, 20, 500), whole = canopy(1, 20, 800);
  const unsigned number = shape.begin({coarse, whole}, {});
  const Json first = Json::parse(shape.answer(number, long_enough));
  EXPECT_FALSE(first.at("done"));
  expect_that_of_the_command_line(first, coarse);
  const Json last = Json::parse(shape.answer(number, long_enough));
  EXPECT_TRUE(last.at("done"));
  expect_that_of_the_command_line(last, whole);
}

TEST(LiveShape, WaitsForAnIdleTimeBeforeItRefines) {
  LiveShape shape(long_enough);
  const unsigned number = shape.begin({canopy(1, 20, 500), canopy(1, 20, 800)}, {});
  EXPECT_TRUE(Json::parse(shape.answer(number, long_enough)).at("result").at("converged"));
  for (int i = 0; i < 2; ++i) {
    const Json later = Json::parse(shape.answer(number, 0));
    EXPECT_EQ(later.at("refining"), 800);
    EXPECT_FALSE(later.at("done"));
  }
  EXPECT_TRUE(finished(shape, canopy(1, 24, 500)).at("done"));  // a new change does not wait
}

TEST(LiveShape, ShowsTheShapeOfTheMomentAndEndsForTheNextDesign) {
  LiveShape shape;
  const unsigned first = shape.begin({canopy(1, 20, 3000)}, {});
  const Json passing = Json::parse(shape.answer(first, 0));
  const double diameter = passing.at("result").at("projected_diameter_m");
  EXPECT_GT(diameter, 0.1);
  EXPECT_LT(diameter, 2);
  const unsigned second = shape.begin({canopy(1, 20, 1000)}, {});
  EXPECT_EQ(Json::parse(shape.answer(first, long_enough)), Json({{"superseded", true}}));
  EXPECT_TRUE(Json::parse(shape.answer(second, long_enough)).at("done"));
}

TEST(LiveShape, ReportsWhyThereIsNoShape) {
  LiveShape shape;
  const Settings given = canopy(1, 20, 1000);
  EXPECT_THROW(shape.answer(shape.begin({given}, -1.0), long_enough), Error);
  EXPECT_TRUE(finished(shape, given).at("result").at("converged"));
}

TEST(LiveShapes, OfManyViewsTheLeastRecentEnds) {
  LiveShapes shapes;
  const std::weak_ptr<LiveShape> first = shapes.of("a");
  const std::shared_ptr<LiveShape> second = shapes.of("b");
  EXPECT_EQ(shapes.of("b"), second);
  for (const char* view : {"c", "d", "e"}) shapes.of(view);
  EXPECT_TRUE(first.expired());
  EXPECT_EQ(shapes.of("b"), second);
}

}  // namespace
}  // namespace ripstop
