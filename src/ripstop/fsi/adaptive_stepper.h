// Steps of the cloth in an opening, as long as its strain allows, and the rows of the load history over them.
#pragma once

#include <functional>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/cloth/step_memory.h"
#include "ripstop/fsi/opening_record.h"

namespace ripstop::inline fsi {

/// Number of steps of at most `step` [s] in each of `rows` rows of `duration` [s], starting at `time` [s].
/// Throws Error(diverged) for more than can be recorded.
int steps_in(double duration, double step, double time, int rows = 1);

/// Rows of the history that are computed in one piece, and computed again where their step was too long.
struct RowSpan {
  long long first = 0;
  int rows = 1;
  int under_one_load = 1;  // so many rows in turn; a divisor of `rows`
};

class AdaptiveStepper {
 public:
  /// When the stability limit, which costs about as much as 40 steps, is evaluated. kept: after a span of many steps;
  /// its step continues and must be stable. renewed: before a span of few steps, too; only the step taken must be
  /// stable.
  enum class Step { kept, renewed };
  /// How often a span is computed, each time with a smaller step, before its divergence is reported.
  static constexpr int most_tries = 4;

  /// Steps are `step_fraction` of the stability limit; a row lasts `row` [s].
  AdaptiveStepper(Step kind, double step_fraction, double row, ThreadTeam& team)
      : kind_(kind), fraction_(step_fraction), row_(row), team_(team) {}

  double row() const { return row_; }  // [s]
  StepMemory& memory() const { return memory_; }
  /// The stability limit at the present strain [s]; evaluated once for the same state. Throws Error(diverged) for one
  /// that is too small for intact cloth.
  double stable_step(const InflationState& state, const Cloth& cloth) const;
  /// `step_fraction` of it [s].
  double allowed_step(const InflationState& state, const Cloth& cloth) const;

  struct Span {
    std::vector<HistoryRow> rows;
    double stable_step = 0;  // at the end [s]
  };
  /// `load_of(row)` is the load from that row on. Where strain has reduced the stable step below the one used, or the
  /// cloth has diverged, the span is computed again with a smaller step. Throws Error(diverged) after the fourth
  /// divergence.
  Span advance(InflationState& state, const Cloth& cloth, const RowSpan& span,
               const std::function<const Loads&(long long)>& load_of) const;

  /// Step::kept: down with the stable step at once, up only when that has risen clearly.
  void follow(double stable_step, InflationState& state) const;

 private:
  std::vector<HistoryRow> compute(InflationState& state, const Cloth& cloth, const RowSpan& span, int steps,
                                  const std::function<const Loads&(long long)>& load_of) const;
  HistoryRow row_of_history(InflationState& state, long long index, int steps, double dt, int from) const;

  /// State of the last evaluation of the stability limit, which depends on positions and velocities only.
  struct Evaluation {
    const Cloth* cloth = nullptr;
    AlignedDoubles x, v;
    double stable_step = 0;  // [s]
  };

  Step kind_;
  double fraction_, row_;
  ThreadTeam& team_;
  mutable StepMemory memory_;
  mutable Evaluation last_;  // the end of a step is the start of the next one
};

}  // namespace ripstop::inline fsi
