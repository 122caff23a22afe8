// How long a flow is watched and what its mean is made of, on a flow whose force is given.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "ripstop/core/error.h"
#include "ripstop/flow/unsteady.h"

namespace ripstop {
namespace {

/// Steps of 0.01 s; the field's pressure and force are those of a function of time.
class Scripted final : public Flow {
 public:
  explicit Scripted(std::function<double(double)> force) : force_(std::move(force)) {}

  FlowStep march(int steps, double, const StepReport& report) override {
    for (int n = 0; n < steps; ++n) {
      now_.length = 0.01, now_.time = 0.01 * ++now_.step;
      now_.force = {0.1 * force_(now_.time), 0, force_(now_.time)};
      if (report && !report(now_)) break;
    }
    return now_;
  }
  FlowField field() const override {
    FlowField field;
    field.grid = {{0, 0, 0}, {1, 1, 1}, 1, 3, 1};
    field.pressure.assign(3, now_.force.z);
    field.velocity.assign(3, {0, 0, now_.time});
    field.porous_force = now_.force;
    return field;
  }
  void place(const std::vector<Triangle>&, const std::vector<Vec3>&) override {}
  FlowAdvance advance(int, double, const FlowReport&) override { return {}; }
  bool untouched() const override { return false; }
  void start_afresh() override {}
  void save(const std::filesystem::path&) const override {}
  void restore(const std::filesystem::path&) override {}

 private:
  std::function<double(double)> force_;
  FlowStep now_;
};

FlowProblem stream() {
  FlowProblem problem;
  problem.air.speed = 2;
  return problem;
}

constexpr Watch half_a_second_a_length{0.7, 0.01, 20, 200, 1};

TEST(Watch, EndsWhenTheMeanIsKnownAndLeavesTheStartUpOut) {
  Scripted flow([](double t) { return 10 + 20 * std::exp(-t / 2) + std::sin(5 * t); });
  FlowRecord record;
  const FlowField mean = watch(flow, stream(), half_a_second_a_length, record);
  EXPECT_TRUE(record.enough);
  EXPECT_TRUE(mean.converged);
  EXPECT_GE(record.watched() - record.start_up, 20 * 0.5);
  EXPECT_LT(record.watched(), 200 * 0.5);
  EXPECT_GT(record.start_up, 4);
  EXPECT_LE(record.drag.standard_error, 0.01 * record.drag.mean);
  EXPECT_NEAR(record.drag.mean, 10, 0.2);
  EXPECT_NEAR(mean.porous_force.z, 10, 0.2);
  EXPECT_NEAR(mean.pressure[1], mean.porous_force.z, 1e-9);
  EXPECT_NEAR(record.side_x.mean, 0.1 * record.drag.mean, 1e-9);
  EXPECT_NEAR(record.swing.frequency, 5 / (2 * 3.14159265), 0.1);
}

TEST(Watch, SaysSoWhenTheLongestWatchIsNotEnough) {
  Scripted flow([](double t) { return 10 + 5 * std::sin(0.4 * t); });
  FlowRecord record;
  const FlowField mean = watch(flow, stream(), half_a_second_a_length, record);
  EXPECT_FALSE(record.enough);
  EXPECT_FALSE(mean.converged);
  EXPECT_NEAR(record.watched(), 200 * 0.5, 2.1);
}

TEST(Watch, AReportMayStopItAndTheSliceIsTheMiddlePlane) {
  Scripted flow([](double) { return 10.0; });
  FlowRecord record;
  int reports = 0;
  watch(flow, stream(), half_a_second_a_length, record,
        [&](const WatchProgress&) { return ++reports < 450; });
  EXPECT_EQ(reports, 450);
  EXPECT_EQ(record.steps.size(), 450U);
  ASSERT_FALSE(record.slices.empty());
  EXPECT_EQ(record.slices[0].field.grid.ny, 1);
  EXPECT_NEAR(record.slices[0].field.grid.origin.y, 1 / 3.0, 1e-12);
  EXPECT_EQ(record.slices[0].field.pressure.size(), 1U);
}

TEST(Watch, RefusesOneThatCannotBe) {
  Scripted flow([](double) { return 10.0; });
  FlowRecord record;
  for (const Watch& wrong :
       {Watch{0.7, 0, 20, 200, 1}, Watch{0.7, 0.01, 20, 30, 1}, Watch{0.7, 0.01, 20, 200, 0}})
    EXPECT_THROW(watch(flow, stream(), wrong, record), Error);
}

}  // namespace
}  // namespace ripstop
