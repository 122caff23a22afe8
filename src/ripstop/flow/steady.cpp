#include "ripstop/flow/steady.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
      advance(stopping_.settled_drag > 0 ? std::min(Stopping::piece, left) : left);
      const bool ended = now_.converged || now_.stopped || now_.last.iteration < 1;  // it does no more
      if (ended || has_settled(drag_, stopping_.settled_drag)) return last();
    }
    return stopping_.average_over > 0 ? average() : last();
  }

 private:
  void advance(int iterations) {
    drag_.clear();
    const int before = done_;
    now_ = flow_.advance(iterations, stopping_.residual, [&](FlowProgress progress) {
      drag_.push_back(progress.drag);
      progress.iteration += before;
      return !report_ || report_(progress);
    });
    done_ += now_.last.iteration;
  }

  // A mean is one over the whole window; a run that settles or is stopped inside it has its last field.
  FlowField average() {
    FieldMean mean;
    std::vector<double> drags;
    for (int n = 0; n < stopping_.average_over; n += stopping_.average_every) {
      advance(stopping_.average_every);
      if (now_.converged || now_.stopped) return last();
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
    field.converged = now_.converged;
    return field;
  }

  Flow& flow_;
  const Stopping& stopping_;
  const FlowReport& report_;
  int done_ = 0;
  std::vector<double> drag_;  // of the last piece [N]
  FlowAdvance now_;
};

}  // namespace

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
