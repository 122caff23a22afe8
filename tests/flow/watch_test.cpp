// Length of an averaging window and its mean, for a flow with a given force.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "ripstop/core/error.h"
#include "ripstop/flow/average.h"
#include "ripstop/flow/unsteady.h"

namespace ripstop {
namespace {

/// Steps of 0.01 s; the field's pressure and force are those of a function of time.
class ForceOverTime final : public Flow {
 public:
  explicit ForceOverTime(std::function<double(double)> force) : force_(std::move(force)) {}

  FlowStep march(int steps, double, const StepReport& report) override {
    for (int n = 0; n < steps; ++n) {
      now_.length = 0.01, now_.time = 0.01 * ++now_.step;
      now_.force = {0.1 * force_(now_.time), 0, force_(now_.time)};
      now_.momentum_gap = {0, 0, 0.25};
      now_.mass_defect = 0.1 / now_.step;
      if (of_body) {
        const Vec3 more{0, 0, of_body(now_.time)};
        now_.bodies = {{now_.force, {}}, {more, {}}};
        now_.force += more;
      }
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
  void place(std::size_t, const std::vector<Triangle>&, const SheetMotion&) override {}
  FlowAdvance advance(int, double, const FlowReport&) override { return {}; }
  bool untouched() const override { return false; }
  void start_afresh() override {}
  void save(const std::filesystem::path&) const override {}
  void restore(const std::filesystem::path&) override {}

  std::function<double(double)> of_body;  // along the stream, in addition to that on the canopy [N]

 private:
  std::function<double(double)> force_;
  FlowStep now_;
};

FlowProblem stream() {
  FlowProblem problem;
  problem.air.velocity = {0, 0, 2};
  return problem;
}

constexpr Watch half_a_second_a_length{0.7, 0.01, 20, 200, 1};

TEST(Watch, EndsWhenTheMeanIsKnownAndLeavesTheStartUpOut) {
  ForceOverTime flow([](double t) { return 10 + 20 * std::exp(-t / 2) + std::sin(5 * t); });
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
  EXPECT_NEAR(mean.momentum_deficit.z, mean.porous_force.z - 0.25, 1e-9);
  EXPECT_NEAR(record.side_x.mean, 0.1 * record.drag.mean, 1e-9);
  EXPECT_NEAR(record.swing.frequency, 5 / (2 * 3.14159265), 0.1);
  // Of the first step after the start-up, which is the largest: the steps before are left out.
  EXPECT_NEAR(record.largest_mass_defect() * record.start_up, 0.1 * 0.01, 0.01 * 0.1 * 0.01);
}

TEST(Watch, TheStreamHasBeenThroughTheBoxBeforeTheMeanBegins) {
  ForceOverTime flow(
      [](double t) { return 10 + 0.1 * std::sin(5 * t); });  // nothing that a start-up would show by
  FlowProblem problem = stream();
  problem.grid.size.z = 12;
  FlowRecord record;
  watch(flow, problem, half_a_second_a_length, record);
  EXPECT_GE(record.start_up, 12 / 2.0);
  EXPECT_GE(record.watched(), 12 / 2.0 + 20 * 0.5);
}

TEST(Watch, ADevelopedWakeIsWatchedFromWhereItsRecordHasSettled) {
  const auto of = [](const std::function<double(double)>& force) {
    ForceOverTime flow(force);
    FlowProblem problem = stream();
    problem.grid.size.z = 12;
    Watch how = half_a_second_a_length;
    how.developed = true;
    FlowRecord record;
    watch(flow, problem, how, record);
    EXPECT_GE(record.watched() - record.start_up, 20 * 0.5);
    EXPECT_NEAR(record.drag.mean, 10, 0.2);
    return record;
  };
  const FlowRecord settled = of([](double t) { return 10 + 0.1 * std::sin(5 * t); });
  EXPECT_LT(settled.start_up, 12 / 2.0 / 2);
  EXPECT_LT(settled.watched(), 12 / 2.0 + 20 * 0.5);
  const FlowRecord changes = of([](double t) { return 10 + 20 * std::exp(-t / 2) + std::sin(5 * t); });
  EXPECT_GT(changes.start_up, 4) << "a change after the last window is left out all the same";
}

TEST(Watch, HasTheMeanDragOfRigidBodiesApartFromThatOfTheCanopy) {
  const auto canopy = [](double t) { return 10 + 20 * std::exp(-t / 2) + std::sin(5 * t); };
  ForceOverTime flow(canopy), alone(canopy);
  flow.of_body = [](double t) { return 4 + 8 * std::exp(-t / 2) + 0.5 * std::sin(7 * t); };
  FlowProblem problem = stream();
  problem.bodies = {sheet_body({}, {0, 1}), sheet_body({}, impermeable, "rocket")};
  FlowRecord record, of_alone;
  watch(flow, problem, half_a_second_a_length, record);
  watch(alone, stream(), half_a_second_a_length, of_alone);
  ASSERT_EQ(record.body_drag.size(), 1u);
  EXPECT_TRUE(of_alone.body_drag.empty());
  EXPECT_NEAR(record.body_drag[0].mean, 4, 0.1) << "without the start-up";
  EXPECT_GT(record.body_drag[0].standard_error, 1e-4);
  EXPECT_LT(record.body_drag[0].standard_error, 0.1);
  EXPECT_NEAR(record.drag.mean, of_alone.drag.mean, 1e-9);
  EXPECT_EQ(record.steps.size(), of_alone.steps.size());
}

// The velocity of this flow is the time; parts are a quarter of the shortest watch, here half a second.
TEST(Watch, TheMeanFieldLeavesTheStartUpOutToAPart) {
  ForceOverTime flow([](double t) { return 10 + 0.1 * std::sin(20 * t); });
  FlowProblem problem = stream();
  problem.grid.size.z = 4;
  FlowRecord record;
  const FlowField mean = watch(flow, problem, {0.7, 0.01, 20, 200, 0.2}, record);
  EXPECT_GE(record.start_up, 4 / 2.0);
  EXPECT_LE(record.watched(), 8 * 0.5);  // as many parts as are kept, none of them joined yet
  EXPECT_NEAR(mean.velocity[1].z, 0.5 * (record.start_up + record.watched()), 0.5 * 0.5);
}

TEST(FieldMean, OfNothingAndAMeanIsThatMean) {
  FieldMean some, none;
  for (const double drag : {3.0, 5.0, 10.0}) {
    FlowField field;
    field.porous_force = {0, 0, drag};
    some.add(field);
  }
  none.add(FieldMean());
  EXPECT_EQ(none.count(), 0);
  none.add(some);
  EXPECT_EQ(none.count(), 3);
  EXPECT_NEAR(none.mean().porous_force.z, 6, 1e-12);
}

TEST(FieldMean, OfTwoMeansIsThatOfAllTheirFields) {
  FieldMean all, first, second;
  const double drags[] = {3, 5, 4, 9, 2, 7, 1};
  for (int n = 0; n < 7; ++n) {
    FlowField field;
    field.pressure = {drags[n], -2 * drags[n]};
    field.velocity = {{drags[n], 0, 0}, {}};
    field.porous_force = {0, 0, drags[n]};
    field.sheet_loads.resize(2);
    for (SheetLoad& load : field.sheet_loads) load.drop = 3 * drags[n], load.force = {0, drags[n], 0};
    all.add(field);
    (n < 3 ? first : second).add(field);
  }
  first.add(second);
  const FlowField a = all.mean(), b = first.mean();
  EXPECT_EQ(b.average.iterations, 7);
  EXPECT_NEAR(a.porous_force.z, 31.0 / 7, 1e-12);
  EXPECT_NEAR(b.porous_force.z, 31.0 / 7, 1e-12);
  EXPECT_NEAR(b.pressure[1], -62.0 / 7, 1e-12);
  EXPECT_NEAR(b.velocity[0].x, 31.0 / 7, 1e-12);
  for (const SheetLoad& load : b.sheet_loads) {
    EXPECT_NEAR(load.drop, 3 * 31.0 / 7, 1e-12);
    EXPECT_NEAR(load.force.y, 31.0 / 7, 1e-12);
  }
}

TEST(Watch, ReportsWhenTheLongestWindowIsNotEnough) {
  ForceOverTime flow([](double t) { return 10 + 5 * std::sin(0.4 * t); });
  FlowRecord record;
  const FlowField mean = watch(flow, stream(), half_a_second_a_length, record);
  EXPECT_FALSE(record.enough);
  EXPECT_FALSE(mean.converged);
  EXPECT_NEAR(record.watched(), 200 * 0.5, 2.1);
}

TEST(Watch, AReportMayStopItAndTheSliceIsTheMiddlePlane) {
  ForceOverTime flow([](double) { return 10.0; });
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
  ForceOverTime flow([](double) { return 10.0; });
  FlowRecord record;
  for (const Watch& wrong :
       {Watch{0.7, 0, 20, 200, 1}, Watch{0.7, 0.01, 20, 30, 1}, Watch{0.7, 0.01, 20, 200, 0}})
    EXPECT_THROW(watch(flow, stream(), wrong, record), Error);
}

}  // namespace
}  // namespace ripstop
