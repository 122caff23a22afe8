#include "ripstop/flow/steady.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/average.h"

namespace ripstop::inline flow {
namespace {

void check(const Stopping& s) {
  if (!(s.residual > 0) || s.max_iterations < 1)
    throw Error(ExitCode::usage, fmt::format("flow: residual = {} and max_iterations = {} must be positive",
                                             s.residual, s.max_iterations));
  if (s.average_over < 0 || s.average_over > s.max_iterations)
    throw Error(ExitCode::usage, fmt::format("flow: average_over = {} must lie in 0 to max_iterations = {}",
                                             s.average_over, s.max_iterations));
  if (s.average_every < 1)
    throw Error(ExitCode::usage, fmt::format("flow: average_every = {} must be at least 1", s.average_every));
}

bool has_settled(const std::vector<double>& drag, double share) {
  if (!(share > 0) || drag.empty()) return false;
  const auto [low, high] = std::minmax_element(drag.begin(), drag.end());
  return *high - *low < share * std::abs(drag.back());
}

/// Standard deviation of a sample; 0: it has one value.
double deviation(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  if (count < 2) return 0;
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / (count - 1));
}

/// The iterations of one start.
class Run {
 public:
  Run(Flow& flow, const Stopping& stopping, const FlowReport& report)
      : flow_(flow), stopping_(stopping), report_(report) {}

  FlowField to_rest() {
    const int before_average = stopping_.max_iterations - stopping_.average_over;
    while (done_ < before_average) {
      const int left = before_average - done_;
      // Pieces of a fixed length, so that a run that was killed repeats the very same iterations.
      advance(stopping_.settled_drag > 0 || at_residual_ ? std::min(Stopping::piece, left) : left);
      const bool ended = now_.stopped || now_.last.iteration < 1;  // it does no more
      if (ended || converged() || settled_early()) return last();
    }
    return stopping_.average_over > 0 ? average() : last();
  }

 private:
  // Once the residual has been reached, only the drag is waited for.
  void advance(int iterations) {
    drag_.clear();
    const int before = done_;
    now_ = flow_.advance(iterations, at_residual_ ? 0 : stopping_.residual, [&](FlowProgress progress) {
      drag_.push_back(progress.drag);
      progress.iteration += before;
      return !report_ || report_(progress);
    });
    done_ += now_.last.iteration;
    at_residual_ = (at_residual_ || now_.converged) && !now_.stopped;
    all_drag_.insert(all_drag_.end(), drag_.begin(), drag_.end());
  }

  bool settled_early() const {
    const bool near =
        std::abs(now_.last.drag - stopping_.reference_drag) < stopping_.near * std::abs(now_.last.drag);
    return !near && has_settled(drag_, stopping_.settled_drag);
  }

  bool wake_has_settled() const {
    if (!(stopping_.momentum_gap > 0)) return true;
    const FlowField field = flow_.field();
    const double force = dot(field.porous_force, field.porous_force),
                 gap = std::abs(dot(field.momentum_deficit, field.porous_force) / force - 1);
    return !(gap > stopping_.momentum_gap);  // NaN of an engine that does not compute it: settled
  }

  // A flow that reaches its residual in so few iterations that the estimate is not known has hardly changed.
  bool converged() const {
    const double left = drag_left(all_drag_);
    const bool settled =
        !(stopping_.most_drag_left > 0) || std::isinf(left) || left < stopping_.most_drag_left;
    return at_residual_ && settled && wake_has_settled();
  }

  // A mean is one over the whole window; a run that settles or is stopped inside it has its last field.
  FlowField average() {
    FieldMean mean;
    std::vector<double> drags;
    for (int n = 0; n < stopping_.average_over; n += stopping_.average_every) {
      advance(stopping_.average_every);
      if (converged() || now_.stopped) return last();
      flow_.add_to(mean);
      drags.insert(drags.end(), drag_.begin(), drag_.end());
    }
    FlowField field = told(mean.mean());
    field.average.drag_deviation = deviation(drags);
    return field;
  }

  FlowField last() const { return told(flow_.field()); }

  FlowField told(FlowField field) const {
    field.last = now_.last;
    field.last.iteration = done_;
    field.converged = converged();
    field.drag_left = drag_left(all_drag_);
    return field;
  }

  Flow& flow_;
  const Stopping& stopping_;
  const FlowReport& report_;
  int done_ = 0;
  bool at_residual_ = false;             // in the last piece or before it
  std::vector<double> drag_, all_drag_;  // of the last piece, and of all iterations [N]
  FlowAdvance now_;
};

}  // namespace

double drag_left(const std::vector<double>& drags) {
  // About canopies the ratio is 0.78 for blocks of 25 (docs/theory/flow-cartesian.md, When a flow has settled).
  constexpr double least_ratio = 0.6, largest_ratio = 0.95, least_share = 0.4;
  constexpr int shortest_block = 10;
  const int block = std::min(Stopping::piece, static_cast<int>(drags.size()) / 3);
  if (block < shortest_block) return std::numeric_limits<double>::infinity();
  const auto mean = [&](int blocks_from_end) {
    const auto end = drags.end() - blocks_from_end * block;
    return std::accumulate(end - block, end, 0.0) / block;
  };
  const double now = mean(0), a = std::abs(mean(1) - mean(2)), b = std::abs(now - mean(1));
  const double ratio = a > 0 ? std::clamp(b / a, least_ratio, largest_ratio) : least_ratio;
  return std::max(b, least_share * a) * ratio / (1 - ratio) / std::abs(now);
}

FlowField solve_to_rest(Flow& flow, const Stopping& stopping, const FlowReport& report) {
  check(stopping);
  if (flow.untouched()) flow.guess();
  const bool from_stream = flow.untouched();
  try {
    return Run(flow, stopping, report).to_rest();
  } catch (const Error& error) {
    // Another canopy's wake, or a coarser grid's, can throw a flow off: then once from the stream.
    if (from_stream || error.code() != ExitCode::diverged) throw;
  }
  flow.start_afresh();
  try {
    return Run(flow, stopping, report).to_rest();
  } catch (const Error& again) {
    throw restated(again,
                   fmt::format("{} (from an earlier field and from the uniform stream)", again.what()));
  }
}

FlowField solve(FlowEngine& engine, const FlowProblem& problem, const FlowReport& report) {
  return solve_to_rest(*engine.start(problem), problem.stopping, report);
}

}  // namespace ripstop::inline flow
