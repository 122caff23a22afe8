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

Case canopy(double diameter, double speed, int nodes) {
  Case given = flat_circular_case(diameter, nodes, speed);
  given.parachute.canopy_material = "f-111";
  given.coupling.threads = 1;
  apply({}, given);
  return given;
}

Json finished(LiveShape& shape, const Case& given) {
  return Json::parse(shape.answer(shape.begin(resolve(given), {}), long_enough));
}

TEST(LiveShape, IsThatOfTheCommandLine) {
  const Case given = canopy(1, 20, 1000);
  LiveShape shape;
  const Json live = finished(shape, given);
  EXPECT_TRUE(live.at("done"));
  const FabricResult printed = run_fabric(resolve(given), {}).result;
  Json result = live.at("result"), expected = Json::parse(to_json(printed));
  for (Json* one : {&result, &expected}) one->erase("wall_time_s");
  EXPECT_EQ(result, expected);
  EXPECT_EQ(live.at("shape").at("frames").at(0).at("points").at("n"), 3 * printed.nodes);
}

TEST(LiveShape, FindsTheSameEquilibriumFromTheLastShape) {
  LiveShape shape;
  finished(shape, canopy(1, 20, 1000));
  for (const Case& changed : {canopy(1, 24, 1000), canopy(1.1, 24, 1000)}) {
    const Json warm = finished(shape, changed).at("result");
    const FabricResult cold = run_fabric(resolve(changed), {}).result;
    EXPECT_TRUE(warm.at("converged"));
    EXPECT_NEAR(warm.at("projected_diameter_m").get<double>() / cold.size.projected_diameter, 1, 5e-3);
    EXPECT_NEAR(warm.at("pressure_load_n").get<double>() / cold.pressure_load, 1, 1e-2);
  }
}

TEST(LiveShape, ShowsTheShapeOfTheMomentAndEndsForTheNextDesign) {
  LiveShape shape;
  const unsigned first = shape.begin(resolve(canopy(1, 20, 3000)), {});
  const Json passing = Json::parse(shape.answer(first, 0));
  const double diameter = passing.at("result").at("projected_diameter_m");
  EXPECT_GT(diameter, 0.1);
  EXPECT_LT(diameter, 2);
  const unsigned second = shape.begin(resolve(canopy(1, 20, 1000)), {});
  EXPECT_EQ(Json::parse(shape.answer(first, long_enough)), Json({{"superseded", true}}));
  EXPECT_TRUE(Json::parse(shape.answer(second, long_enough)).at("done"));
}

TEST(LiveShape, ReportsWhyThereIsNoShape) {
  LiveShape shape;
  const Case given = canopy(1, 20, 1000);
  EXPECT_THROW(shape.answer(shape.begin(resolve(given), -1.0), long_enough), Error);
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
