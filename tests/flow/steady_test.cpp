// Stopping, apart from every engine: a flow whose drag is a list of numbers.
#include "ripstop/flow/steady.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

/// Iteration n since the start has drag(n) and residual(n). Counts its calls.
class Scripted : public Flow {
 public:
  std::function<double(int)> drag = [](int) { return 100.0; };
  std::function<double(int)> residual = [](int) { return 1.0; };
  std::function<double(int)> deficit = [](int) { return 100.0; };
  int diverges_at = 0;  // 0: never
  bool has_guess = false;
  int iteration = 0, starts = 1;
  std::vector<int> calls;  // iterations of every advance()

  void place(std::size_t, const std::vector<Triangle>&, const SheetMotion&) override {}
  FlowAdvance advance(int iterations, double wanted, const FlowReport& report) override {
    calls.push_back(iterations);
    guessed_ = false;
    FlowAdvance now;
    for (int n = 1; n <= iterations && !now.stopped && !now.converged; ++n) {
      if (++iteration == diverges_at) throw Error(ExitCode::diverged, "diverged");
      now.last = {n, residual(iteration), 0, 0, 0, 0, drag(iteration)};
      now.converged = now.last.residual_u <= wanted;
      now.stopped = report && !report(now.last);
    }
    return now;
  }
  FlowField field() const override {
    FlowField field;
    field.porous_force = {0, 0, drag(iteration)};
    field.momentum_deficit = {0, 0, deficit(iteration)};
    return field;
  }
  bool untouched() const override { return iteration == 0 && !guessed_; }
  void guess() override { guessed_ = has_guess; }
  void start_afresh() override { iteration = 0, diverges_at = 0, ++starts; }
  void save(const std::filesystem::path&) const override {}
  void restore(const std::filesystem::path&) override {}

 private:
  bool guessed_ = false;
};

TEST(SolveToRest, EndsWithTheIterationThatReachesTheResidual) {
  Scripted flow;
  flow.residual = [](int n) { return std::pow(0.5, n); };
  const FlowField field = solve_to_rest(flow, {.residual = 1e-3});
  EXPECT_TRUE(field.converged);
  EXPECT_EQ(field.last.iteration, 10);  // 2^-10 < 1e-3 < 2^-9
  EXPECT_EQ(flow.calls, std::vector<int>{1000});
}

TEST(SolveToRest, EndsUnconvergedWhenTheIterationsAreUsedUp) {
  Scripted flow;
  const FlowField field = solve_to_rest(flow, {.max_iterations = 40});
  EXPECT_FALSE(field.converged);
  EXPECT_EQ(field.last.iteration, 40);
}

TEST(SolveToRest, ADragThatHasSettledEndsAtTheEndOfAPiece) {
  Scripted flow;
  flow.drag = [](int n) { return 100 + 50 * std::exp(-n / 10.0); };  // moves by 0.26 in the third piece
  const FlowField field = solve_to_rest(flow, {.settled_drag = 5e-3});
  EXPECT_EQ(field.last.iteration, 75);
  EXPECT_FALSE(field.converged);
  EXPECT_EQ(flow.calls, (std::vector<int>{25, 25, 25}));
}

TEST(DragLeft, IsTheRemainderOfAGeometricSeries) {
  std::vector<double> drags;
  for (int n = 0; n < 150; ++n) drags.push_back(100 + 20 * std::pow(0.99, n));
  const double last_block = 20 * std::pow(0.99, 125) * (1 - std::pow(0.99, 25)) / (25 * 0.01);
  EXPECT_NEAR(drag_left(drags), last_block / (100 + last_block), 1e-12);
}

TEST(DragLeft, AnExtremeOfTheDragIsNotItsLimit) {
  std::vector<double> drags;
  for (int n = 0; n < 75; ++n) drags.push_back(100 - 1e-3 * (n - 62) * (n - 62));  // flat in the last 25
  EXPECT_LT(std::abs(drags[74] - drags[50]), 1e-3 * drags.back());
  EXPECT_GT(drag_left(drags), 0.01);
}

TEST(DragLeft, IsUnknownAfterFewIterationsAndZeroForAConstant) {
  EXPECT_TRUE(std::isinf(drag_left(std::vector<double>(29, 100.0))));
  EXPECT_EQ(drag_left(std::vector<double>(30, 100.0)), 0);
}

// The residual is reached in iteration 31, the drag changes until later.
TEST(SolveToRest, AResidualIsNotEnoughWhileMuchOfTheDragIsLeft) {
  Scripted flow;
  flow.residual = [](int n) { return std::pow(0.8, n); };
  flow.drag = [](int n) { return 100 + 20 * std::exp(-n / 30.0); };
  const FlowField field = solve_to_rest(flow, {.residual = 1e-3, .most_drag_left = 2e-3});
  EXPECT_TRUE(field.converged);
  EXPECT_LT(field.drag_left, 2e-3);
  EXPECT_NEAR(field.porous_force.z, 100, 0.2);
  EXPECT_EQ(field.last.iteration % Stopping::piece, 31 % Stopping::piece);
  EXPECT_GT(solve_to_rest(flow, {.residual = 1e-3}).drag_left, field.drag_left);
}

TEST(SolveToRest, NearItsReferenceADragThatHasSettledIsNotEnough) {
  Scripted flow;
  flow.residual = [](int n) { return n < 90 ? 1 : 1e-9; };
  const Stopping stopping{.settled_drag = 5e-3, .reference_drag = 100.4, .near = 5e-3};
  EXPECT_EQ(solve_to_rest(flow, stopping).last.iteration, 90);
  Scripted away;
  away.drag = [](int) { return 101.0; };
  EXPECT_EQ(solve_to_rest(away, stopping).last.iteration, 25);
}

TEST(SolveToRest, TheResidualIsNotEnoughWhileTheWakeGrows) {
  Scripted flow;
  flow.residual = [](int) { return 1e-9; };
  flow.deficit = [](int n) { return 100 * (1 - std::exp(-n / 50.0)); };  // 4 % are left after 161 iterations
  EXPECT_EQ(solve_to_rest(flow, {.momentum_gap = 0.04}).last.iteration, 176);
  Scripted unknown;
  unknown.residual = flow.residual;
  unknown.deficit = [](int) { return std::nan(""); };
  EXPECT_EQ(solve_to_rest(unknown, {.momentum_gap = 0.04}).last.iteration, 1);
}

TEST(SolveToRest, ADragThatHasSettledIsEnoughWhileTheWakeGrows) {
  Scripted flow;
  flow.deficit = [](int n) { return 100 * (1 - std::exp(-n / 50.0)); };
  EXPECT_EQ(solve_to_rest(flow, {.settled_drag = 5e-3, .momentum_gap = 0.04}).last.iteration, 25);
}

TEST(SolveToRest, ADragThatSwingsIsAveragedOverTheLastIterations) {
  Scripted flow;
  flow.drag = [](int n) { return n % 2 ? 90.0 : 110.0; };
  int last = 0;
  const FlowField field =
      solve_to_rest(flow, {.max_iterations = 100, .average_over = 40, .settled_drag = 1e-3},
                    [&](const FlowProgress& p) { return last = p.iteration, true; });
  EXPECT_EQ(field.average.iterations, 40);
  EXPECT_NEAR(field.porous_force.z, 100, 1e-12);
  EXPECT_NEAR(field.average.drag_deviation, 10 * std::sqrt(40.0 / 39), 1e-12);
  EXPECT_EQ(last, 100);
}

// Across the stream the force swings, along it the drag that the flow reports is constant.
TEST(SolveToRest, DeviationOfTheDragIsThatAlongTheStream) {
  class Oblique : public Scripted {
    FlowField field() const override {
      FlowField field;
      const double across = iteration % 2 ? 30 : -30;
      field.porous_force = {60 + 0.8 * across, 0, 80 - 0.6 * across};  // stream along (0.6, 0, 0.8)
      return field;
    }
  } flow;
  const FlowField field = solve_to_rest(flow, {.max_iterations = 100, .average_over = 40});
  EXPECT_NEAR(field.porous_force.z, 80, 1e-12);
  EXPECT_NEAR(field.average.drag_deviation, 0, 1e-12);
}

TEST(SolveToRest, AFlowThatSettlesInsideTheWindowHasItsLastField) {
  Scripted flow;
  flow.residual = [](int n) { return n < 80 ? 1 : 1e-9; };
  flow.drag = [](int n) { return double(n); };
  const FlowField field = solve_to_rest(flow, {.max_iterations = 100, .average_over = 40});
  EXPECT_TRUE(field.converged);
  EXPECT_EQ(field.average.iterations, 0);
  EXPECT_EQ(field.porous_force.z, 80);
}

TEST(SolveToRest, AReportThatReturnsFalseEndsTheRun) {
  Scripted flow;
  const FlowField field = solve_to_rest(flow, {}, [](const FlowProgress& p) { return p.iteration < 3; });
  EXPECT_EQ(field.last.iteration, 3);
  EXPECT_FALSE(field.converged);
}

TEST(SolveToRest, ADivergedStartFromAGuessOrAnEarlierFieldIsRepeatedFromTheStream) {
  for (const bool guess : {false, true}) {
    Scripted flow;
    flow.has_guess = guess;
    if (!guess) flow.iteration = 5;  // an earlier field
    flow.diverges_at = 12;
    const FlowField field = solve_to_rest(flow, {.max_iterations = 20});
    EXPECT_EQ(flow.starts, 2);
    EXPECT_EQ(field.last.iteration, 20);
  }
}

TEST(SolveToRest, DivergenceFromTheStreamIsAnError) {
  Scripted flow;
  flow.diverges_at = 3;
  EXPECT_THROW(solve_to_rest(flow, {}), Error);
  EXPECT_EQ(flow.starts, 1);
}

TEST(SolveToRest, AWindowLongerThanTheRunIsRefused) {
  Scripted flow;
  EXPECT_THROW(solve_to_rest(flow, {.max_iterations = 10, .average_over = 11}), Error);
  EXPECT_THROW(solve_to_rest(flow, {.max_iterations = 10, .average_over = -1}), Error);
  EXPECT_THROW(solve_to_rest(flow, {.residual = 0}), Error);
}

}  // namespace
}  // namespace ripstop
