#include "ripstop/fsi/flow_sampling.h"

#include <algorithm>
#include <cmath>

namespace ripstop::inline fsi {
namespace {

// Of a whole averaging window, as long as the shape still moves.
constexpr double short_window = 1.0 / 3;

// Standard deviation of the means of all windows but the first, whose wake was still developing; 0 for fewer than three.
// In a flow that drifts more slowly than one window lasts, the standard error of each window is too small.
double scatter_of_means(const std::vector<SteadyIteration>& iterations, double now) {
  std::vector<double> means;
  for (const SteadyIteration& i : iterations)
    if (i.in_time) means.push_back(i.fluid_force);
  if (means.size() < 3) return 0;
  means.front() = now;
  double mean = 0, squares = 0;
  for (const double drag : means) mean += drag / double(means.size());
  for (const double drag : means) squares += (drag - mean) * (drag - mean);
  return std::sqrt(squares / double(means.size() - 1));
}

}  // namespace

FlowField averaged_flow(Flow& flow, const FlowProblem& problem, Watch window, bool in_full,
                        SteadyState& state, FlowRecord& record, const WatchReport& report) {
  window.developed = std::any_of(state.iterations.begin(), state.iterations.end(),
                                 [](const SteadyIteration& i) { return i.in_time; });
  if (!in_full)
    window.standard_error /= short_window, window.shortest *= short_window, window.longest *= short_window;
  FlowField field = watch(flow, problem, window, record, report);
  const auto& [steps, start_up, drag, side_x, side_y, swing, body_drag, enough, slices] = record;
  const double error = std::max(drag.standard_error, scatter_of_means(state.iterations, drag.mean));
  state.window = {.steps = static_cast<int>(steps.size()),
                  .time = record.watched(),
                  .start_up = start_up,
                  .drag = drag.mean,
                  .error = error,
                  .deviation = drag.deviation,
                  .side_force = {side_x.mean, side_y.mean, 0},
                  .side_error = {side_x.standard_error, side_y.standard_error, 0},
                  .side_deviation = std::hypot(side_x.deviation, side_y.deviation),
                  .swing = swing.frequency,
                  .swing_share = swing.share,
                  .enough = enough && error <= window.standard_error * std::abs(drag.mean),
                  .mass_defect = record.largest_mass_defect()};
  state.body_errors.clear();
  for (const MeanOverTime& of_body : body_drag) state.body_errors.push_back(of_body.standard_error);
  field.last.iteration = state.window.steps;
  field.average.drag_deviation = drag.deviation;
  return field;
}

}  // namespace ripstop::inline fsi
