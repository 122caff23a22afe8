// A steady run of a cluster whose spread angle is that of equilibrium: one converged solution at each angle, which
// starts from that at the angle before.
#include "ripstop/run/steady/spread_angle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ripstop/core/error.h"
#include "ripstop/core/words.h"
#include "ripstop/run/steady/cluster_result.h"
#include "ripstop/run/steady/coarse_start.h"
#include "ripstop/run/steady/steady_parts.h"

namespace ripstop::inline run {
namespace {

constexpr double least_step = 1,
                 largest_step = 5;  // of the spread angle where nothing encloses the equilibrium [deg]
constexpr double first_slope =
    -0.5;                        // of the force angle over the spread angle, before two are known (assumed)
constexpr double further = 1.2;  // beyond the extrapolated equilibrium, to enclose it
constexpr double least_share = 0.1;          // of the enclosed angles that the regula falsi leaves off
constexpr double closest_to_touching = 0.5;  // [deg]
// The cloth of the second iteration at an angle is the first one under a load at that angle.
constexpr int fewest_iterations = 2;

const SpreadTrial* enclosing(const std::vector<SpreadTrial>& trials, bool outward) {
  const SpreadTrial* best = nullptr;
  for (const SpreadTrial& t : trials)
    if ((t.force_angle > 0) == outward &&
        (!best || (outward ? t.angle > best->angle : t.angle < best->angle)))
      best = &t;
  return best;
}

std::string inclination(double force_angle) {
  return fmt::format("inclined {} by {} deg", force_angle > 0 ? "outward" : "inward",
                     rounded(std::abs(force_angle), 2));
}

Error no_equilibrium(const SpreadSearch& search, const SpreadRange& range, const Settings& resolved) {
  const SpreadTrial& last = search.trials.back();
  const bool touch = last.force_angle < 0 && search.touching > 0;
  const std::string where =
      touch ? fmt::format("; at {:.4g} deg the canopies touch", search.touching) : std::string();
  const double least = touch ? search.touching : range.least;
  return {ExitCode::not_converged,
          fmt::format(
              "cluster.equilibrium: no equilibrium at spread angles from {:.4g} to {:.4g} deg: at {:.4g} deg "
              "the forces of the canopies are {}{}; {}lengthen the riser (parachute.riser.length_m = {:g}), "
              "or set cluster.equilibrium = false",
              least, range.largest, last.angle, inclination(last.force_angle), where,
              touch ? "" : "change the first angle (cluster.spread_angle_deg), ",
              resolved.parachute().riser.length_m)};
}

/// One run on its way from angle to angle.
class Search {
 public:
  Search(const Settings& resolved, SteadyObserver& observer, const SteadySettings& settings)
      : first_(resolved),
        observer_(observer),
        settings_(settings),
        range_(spread_range(resolved.written())),
        now_(resolved),
        parts_(steady_parts(resolved, settings)) {}

  SteadySolution solve(RunClock clock);

 private:
  SteadyRun run() { return {now_, *parts_.solver, parts_.engine->name()}; }
  void take_angle() {
    now_ = at_spread_angle(now_, state_.spread.angle);
    parts_ = parts_with(std::move(parts_), now_, settings_, true);
  }
  void begin(RunClock& clock);
  int iterations_here() const { return static_cast<int>(state_.iterations.size()) - state_.spread.before; }
  bool ended_here() const {
    const int here = iterations_here();
    return here >= now_.coupling().max_iterations || (state_.converged && here >= fewest_iterations);
  }
  SpreadTrial trial() const;
  void turn_to(double angle);
  void advance();
  void iterate(FlowField& flow);

  const Settings& first_;
  SteadyObserver& observer_;
  const SteadySettings& settings_;
  SpreadRange range_;
  Settings now_;
  SteadyParts parts_;
  SteadyState state_;
};

/// Without the first iteration, whose shape is that of another angle.
SpreadTrial Search::trial() const {
  const std::vector<double>& all = state_.spread.force_angles;
  const auto from = all.begin() + (all.size() > 1 ? 1 : 0);
  const auto count = static_cast<double>(all.end() - from);
  const double mean = std::accumulate(from, all.end(), 0.0) / count;
  double squares = 0;
  for (auto angle = from; angle != all.end(); ++angle) squares += (*angle - mean) * (*angle - mean);
  return {state_.spread.angle, mean, count > 1 ? std::sqrt(squares / (count - 1)) : 0,
          state_.iterations.back().fluid_force};
}

void Search::begin(RunClock& clock) {
  state_ = parts_.solver->start();
  observer_.begin(run(), state_);
  clock.count_earlier(state_);
  const auto start = coarse_start(first_, *parts_.solver, state_, observer_, settings_);
  if (start) start->give(state_);
  if (state_.spread.angle == 0) state_.spread.angle = first_.written().cluster->spread_angle_deg;
  if (state_.spread.angle != first_.written().cluster->spread_angle_deg) take_angle();
  if (start) parts_.solver->flow().continue_from(start->flow.path);
}

/// The shape of each canopy and its pressures remain; the loads of earlier iterations belong to another flow.
void Search::turn_to(double angle) {
  const Cluster before = *parts_.solver->cluster();
  state_.spread.angle = angle;
  state_.spread.before = static_cast<int>(state_.iterations.size());
  state_.spread.force_angles.clear();
  take_angle();
  const Cluster& after = *parts_.solver->cluster();
  const std::vector<Vec3> shape = state_.shape;
  for (int k = 0; k < after.canopies(); ++k) after.put(k, before.own(k, shape), state_.shape);
  state_.converged = false;
  Accelerator& accelerator = state_.accelerator;
  accelerator.guesses.clear(), accelerator.residuals.clear();
  accelerator.relaxation = now_.coupling().relaxation;
  if (!state_.in_time) accelerator.update = now_.coupling().acceleration;
}

/// To the next angle, after the iterations at the present one.
void Search::advance() {
  SpreadSearch& search = state_.spread;
  search.trials.push_back(trial());
  SpreadRange range = range_;
  if (search.touching > 0) range.least = std::max(range.least, search.touching + closest_to_touching);
  const std::optional<double> next = next_spread_angle(search.trials, range);
  if (!next) throw no_equilibrium(search, range_, now_);
  const SpreadTrial last = search.trials.back();
  turn_to(*next);
  observer_.turned({last, *next});
}

void Search::iterate(FlowField& flow) {
  for (;;) {
    try {
      flow = parts_.solver->iterate(
          state_, [&](const SteadyProgress& progress) { observer_.progress(progress, state_); });
      return;
    } catch (const ClusterTouches& error) {
      SpreadSearch& search = state_.spread;
      if (search.trials.empty()) throw;
      // Half as far from the last angle, where the canopies were apart.
      const double apart = search.trials.back().angle;
      search.touching = std::max(search.touching, search.angle);
      if (std::abs(apart - search.angle) < 2 * closest_to_touching)
        throw no_equilibrium(search, range_, now_);
      turn_to(0.5 * (apart + search.angle));
    }
  }
}

SteadySolution Search::solve(RunClock clock) {
  SteadySolution solution;
  begin(clock);
  for (;;) {
    if (ended_here() && iterations_here() > 0) {
      const bool balanced = std::abs(trial().force_angle) <= equilibrium_tolerance;
      if (!state_.converged || balanced || state_.spread.trials.size() + 1 >= most_spread_trials) {
        state_.converged = state_.converged && balanced;
        break;
      }
      advance();
    }
    iterate(solution.flow);
    state_.spread.force_angles.push_back(force_angle(*parts_.solver->cluster(), state_));
    observer_.iterated(run(), state_, solution.flow);
  }
  solution.result = steady_result(*parts_.solver, state_, now_);
  solution.result.cluster->search = state_.spread.trials;
  solution.result.cluster->search->push_back(trial());
  solution.result.cluster->force_angle_deg = trial().force_angle;
  solution.result.wall_time = clock.elapsed();
  observer_.ended(run(), state_, solution.result);
  solution.state = std::move(state_);
  return solution;
}

}  // namespace

std::optional<double> next_spread_angle(const std::vector<SpreadTrial>& trials, const SpreadRange& range) {
  const SpreadTrial *below = enclosing(trials, true), *above = enclosing(trials, false);
  if (below && above) {
    const double share = below->force_angle / (below->force_angle - above->force_angle);
    return below->angle + std::clamp(share, least_share, 1 - least_share) * (above->angle - below->angle);
  }
  const SpreadTrial& last = trials.back();
  const double sign = last.force_angle > 0 ? 1 : -1;
  if (sign > 0 ? last.angle >= range.largest : last.angle <= range.least) return {};
  double step = largest_step;
  if (trials.size() == 1) {
    step = std::abs(last.force_angle / first_slope);
  } else {
    const SpreadTrial& before = trials[trials.size() - 2];
    const double slope = (last.force_angle - before.force_angle) / (last.angle - before.angle);
    if (slope < 0) step = further * std::abs(last.force_angle / slope);
  }
  step = std::clamp(step, least_step, largest_step);
  return std::clamp(last.angle + sign * step, range.least, range.largest);
}

SteadySolution run_to_equilibrium(const Settings& resolved, SteadyObserver& observer,
                                  const SteadySettings& settings, RunClock clock) {
  return Search(resolved, observer, settings).solve(clock);
}

}  // namespace ripstop::inline run
