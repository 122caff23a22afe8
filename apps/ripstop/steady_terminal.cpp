#include "steady_terminal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "ripstop/case/resolve.h"
#include "ripstop/flow/flow.h"

namespace ripstop::cli {
namespace {

// Iterations still to come: as many as the drag's change needs at its rate of fall so far, five at the first.
double iterations_left(const SteadyState& state, const CouplingSettings& settings) {
  const auto& all = state.iterations;
  if (all.size() < 3) return 5;
  const double now = all.back().drag_change, before = all[all.size() - 2].drag_change;
  if (now <= settings.drag_tolerance) return 1;
  const double rate = std::min(0.7, now / before);
  return 1 + std::log(settings.drag_tolerance / now) / std::log(rate);
}

std::string progress_text(const SteadyProgress& p, double elapsed, double left) {
  const std::string iteration = fmt::format("{}{}", p.coarse ? "coarse " : "", p.iteration);
  const std::string time =
      left > 0 ? fmt::format("elapsed {}, remaining about {}{}", duration_text(elapsed), duration_text(left),
                             p.stage == SteadyStage::time ? " of this averaging window" : "")
               : fmt::format("elapsed {}", duration_text(elapsed));
  if (p.stage == SteadyStage::time) {
    const FlowStep& step = p.time.step;
    const double drag = step.force.z - force_on_others(step.bodies).z;
    const std::string mean =
        p.time.mean != 0 ? fmt::format("mean {:.1f} +- {:.2g} N, {:.0f} % of the averaging window",
                                       p.time.mean, p.time.standard_error, std::min(99.0, 100 * p.time.share))
                         : std::string("start-up");
    return fmt::format("[{}] time: {:.3f} s, step {} of {:.2g} s, drag {:.1f} N, {} | {}", iteration,
                       step.time, step.step, step.length, drag, mean, time);
  }
  if (p.stage == SteadyStage::cloth) {
    return fmt::format("[{}] cloth: step {}, residual {:.1e} | {}", iteration, p.cloth.steps,
                       p.cloth.residual, time);
  }
  return fmt::format("[{}] flow: iteration {}, residuals U {:.1e} p {:.1e} k {:.1e}, drag {:.1f} N | {}",
                     iteration, p.flow.iteration, p.flow.residual_u, p.flow.residual_p, p.flow.residual_k,
                     p.flow.drag, time);
}

// Largest difference of a first estimate from the result of its run, docs/tables/first-estimates.md.
constexpr double drag_within = 0.18, diameter_within = 0.03;

std::string estimate_text(const FirstEstimate& estimate, double elapsed) {
  return fmt::format(
      "first estimate after {}: drag {:.3g} N at {:.4g} m/s (in the examples within {:.0f} % of the result), "
      "projected diameter {:.3f} m (within {:.0f} %)",
      duration_text(elapsed), estimate.drag, estimate.speed, 100 * drag_within, estimate.projected_diameter,
      100 * diameter_within);
}

/// Headings of the shown members of an iteration, on two lines.
std::string iteration_header() {
  std::string upper, lower;
  const auto add = [&](const Shown& how) {
    const std::string_view text = how.heading;
    const std::size_t bar = text.find('|');
    upper += fmt::format("{:>{}} ", text.substr(0, bar), how.width);
    lower += fmt::format("{:>{}} ", text.substr(bar + 1), how.width);
  };
  const SteadyIteration none;
  each_member(none, [&](const char*, const auto&, auto... how) { (add(how), ...); });
  return upper + "\n" + lower;
}

std::string shown(double value, const Shown& how) {
  if (!std::isfinite(value)) return "-";
  return *how.format ? fmt::format(fmt::runtime(how.format), how.factor * value) : duration_text(value);
}

std::string iteration_text(const SteadyIteration& iteration) {
  std::string text;
  each_member(iteration, [&](const char*, [[maybe_unused]] const auto& member, auto... how) {
    ((text += fmt::format("{:>{}} ", shown(double(member), how), how.width)), ...);
  });
  return text;
}

}  // namespace

void SteadyTerminal::begin(const SteadyRun& run, SteadyState& state) {
  settings_ = run.resolved.coupling();
  estimated_ = state.first_estimate.has_value();
  if (!state.iterations.empty()) {
    progress_.line(
        fmt::format("resuming after coupling iteration {} in {}", state.iterations.size(), folder_.string()));
  }
  progress_.line(fmt::format("{}: {}, {} nodes, {}", run.resolved.title(), run.engine,
                             run.solver.mesh().node_count(), folder_.string()));
  progress_.line(iteration_header());
  for (const SteadyIteration& i : state.iterations) progress_.line(iteration_text(i));
}

void SteadyTerminal::solved_coarse(const SteadyRun& run, const SteadyResult& result) {
  const FlowGrid grid = flow_grid(run.resolved.flow());
  progress_.line(fmt::format(
      "start on {} x {} x {} cells: {} iterations, drag {:.1f} N at {:.4g} m/s, projected diameter {:.3f} m",
      grid.nx, grid.ny, grid.nz, result.iterations, result.drag, result.speed,
      result.size.projected_diameter));
}

void SteadyTerminal::warned(const std::string& text) {
  progress_.line("warning: " + text);
}

void SteadyTerminal::progress(const SteadyProgress& p, const SteadyState& state) {
  if (state.first_estimate && !estimated_ && !p.coarse) {
    estimated_ = true;
    progress_.line(estimate_text(*state.first_estimate, elapsed()));
  }
  double left = 0;
  const double gone = elapsed() - before_, share = std::min(0.99, p.time.share);
  if (p.stage == SteadyStage::time) {
    if (share > 0) left = gone * (1 / share - 1);
  } else if (!state.iterations.empty() && !p.coarse) {
    left = iterations_left(state, settings_) * state.iterations.back().wall_time - gone;
  }
  progress_.show(progress_text(p, elapsed(), left));
}

void SteadyTerminal::iterated(const SteadyRun&, const SteadyState& state, const FlowField&) {
  before_ = elapsed();
  progress_.line(iteration_text(state.iterations.back()));
}

void SteadyTerminal::turned(const SteadyTurn& turn) {
  progress_.line(fmt::format(
      "spread angle {:.4g} deg: forces inclined {} by {:.2g} deg; next angle {:.4g} deg", turn.from.angle,
      turn.from.force_angle > 0 ? "outward" : "inward", std::abs(turn.from.force_angle), turn.to));
}

double SteadyTerminal::elapsed() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

}  // namespace ripstop::cli
