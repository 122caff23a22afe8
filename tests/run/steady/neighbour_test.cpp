// A run that starts from its neighbour: used data, and neighbours that cannot be used.
#include <gtest/gtest.h>

#include "ripstop/case/assemble.h"
#include "ripstop/case/resolve.h"
#include "ripstop/run/steady/steady_parts.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

class Neighbour : public testing::Test {
 protected:
  void SetUp() override {
    SteadyObserver quiet;
    end_ = run_steady(other_, quiet).state;
    end_.residual_traction = {{1, 2, 3}, {4, 5, 6}};
  }
  /// Message of start_from(), and the state that it makes of the cold start of `given`.
  bool starts(const Case& given) {
    const Settings resolved = resolve(given);
    const SteadyParts parts = steady_parts(resolved, {});
    state_ = parts.solver->start();
    cold_ = state_;
    return start_from(resolve(other_), end_, {resolved, *parts.solver, "square law"}, state_);
  }
  Case other_ = square_law_case({{"flow.speed_m_s", "20"}, {"flow.density_kg_m3", "1.2"}});
  SteadyState end_, state_, cold_;
};

TEST_F(Neighbour, GivesShapePressureAndRemainderInTheDynamicPressureOfTheRun) {
  EXPECT_TRUE(starts(square_law_case({{"flow.speed_m_s", "10"}, {"flow.density_kg_m3", "1.1"}})));
  const double ratio = 0.25 * 1.1 / 1.2;
  EXPECT_EQ(state_.shape, end_.shape);
  ASSERT_EQ(state_.pressure.size(), end_.pressure.size());
  double largest = 0;
  for (std::size_t i = 0; i < end_.pressure.size(); ++i) {
    EXPECT_NEAR(state_.pressure[i], ratio * end_.pressure[i], 1e-9 * std::abs(end_.pressure[i])) << i;
    largest = std::max(largest, std::abs(state_.pressure[i]));
  }
  EXPECT_GT(largest, 0);
  EXPECT_NEAR(state_.residual_traction.at_centre.z, 3 * ratio, 1e-9);
  EXPECT_NEAR(state_.residual_traction.twist.y, 5 * ratio, 1e-9);
  EXPECT_TRUE(state_.iterations.empty());
}

TEST_F(Neighbour, ThatFoundItsSpeedCountsAtThatSpeed) {
  end_.speed = 40;
  EXPECT_TRUE(starts(other_));
  for (std::size_t i = 0; i < end_.pressure.size(); ++i)
    ASSERT_NEAR(state_.pressure[i], 0.25 * end_.pressure[i], 1e-9 * std::abs(end_.pressure[i])) << i;
}

TEST_F(Neighbour, OfACanopyElsewhereInTheBoxIsMovedThere) {
  const double place = resolve(other_).flow().canopy_position_m;
  Case moved = other_;
  moved.flow.canopy_position_m = place + 0.125;
  EXPECT_TRUE(starts(moved));
  for (std::size_t i = 0; i < end_.shape.size(); ++i) {
    ASSERT_NEAR(state_.shape[i].z - end_.shape[i].z, 0.125, 1e-12);
    ASSERT_EQ(state_.shape[i].x, end_.shape[i].x);
  }
}

TEST_F(Neighbour, OnOtherCellsGivesItsShapeAndNotItsFlow) {
  Case finer = other_;
  finer.flow.cells = std::array{24, 24, 36};
  EXPECT_FALSE(starts(finer));
  EXPECT_EQ(state_.shape, end_.shape);
}

TEST_F(Neighbour, OfAnotherParachuteGivesNothing) {
  Case longer = other_;
  longer.parachute.lines.length_m *= 1.01;
  EXPECT_FALSE(starts(longer));
  EXPECT_EQ(state_.shape, cold_.shape);
  EXPECT_EQ(state_.pressure, cold_.pressure);
}

// For an engine that cannot scale its field, the flow of another speed is not used.
TEST_F(Neighbour, AnEngineOfOneSpeedTakesTheFlowOfThatSpeedOnly) {
  static const bool added = [] {
    add_engine({"square-law-of-one-speed",
                "a fixed drag area, one speed",
                {},
                [](const EngineOptions&) { return std::string("square law 1"); },
                [](const EngineOptions&) { return std::make_unique<SquareLawEngine>(); }});
    return true;
  }();
  ASSERT_TRUE(added);
  other_.flow.engine = "square-law-of-one-speed";
  EXPECT_TRUE(starts(other_));
  Case slower = other_;
  slower.flow.speed_m_s = 10;
  EXPECT_FALSE(starts(slower));
  EXPECT_EQ(state_.shape, end_.shape);
}

}  // namespace
}  // namespace ripstop
