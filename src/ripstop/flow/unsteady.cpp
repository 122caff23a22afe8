#include "ripstop/flow/unsteady.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/flow/average.h"
#include "ripstop/flow/projections.h"

namespace ripstop::inline flow {
namespace {

constexpr int steps_a_field = 8;       // between fields that the mean is made of
constexpr int steps_a_look = 200;      // between looks at whether it is enough
constexpr std::size_t most_parts = 8;  // of the mean: the discarded part consists of whole ones
constexpr std::size_t most_slices = 24;
constexpr double slice_every = 0.5;  // times that the stream takes for the length

/// The mean of fields in parts of equal length, so that the start-up can be left out later. When there are too
/// many parts, neighbours become one.
class MeanInParts {
 public:
  explicit MeanInParts(double length) : length_(length) {}

  void add(const Flow& flow, double time) {
    if (parts_.empty() || time >= parts_.back().begin + length_) {
      if (parts_.size() == most_parts) join();
      if (parts_.empty() || time >= parts_.back().begin + length_) parts_.push_back({time, {}});
    }
    flow.add_to(parts_.back().mean);
  }

  /// Of the parts that begin no earlier than `from`, the last one at least.
  FlowField since(double from) const {
    FieldMean mean;
    for (std::size_t n = 0; n < parts_.size(); ++n)
      if (parts_[n].begin >= from || n + 1 == parts_.size()) mean.add(parts_[n].mean);
    return mean.mean();
  }

 private:
  struct Part {
    double begin;
    FieldMean mean;
  };

  void join() {
    std::vector<Part> joined;
    for (std::size_t n = 0; n + 1 < parts_.size(); n += 2) {
      parts_[n].mean.add(parts_[n + 1].mean);
      joined.push_back(std::move(parts_[n]));
    }
    parts_ = std::move(joined);
    length_ *= 2;
  }

  double length_;
  std::vector<Part> parts_;
};

/// A force along one axis.
template <class Force>
Record record_of(const std::vector<FlowStep>& steps, Vec3 axis, const Force& force) {
  Record record;
  record.begin = steps.front().time - steps.front().length;
  for (const FlowStep& step : steps) {
    record.until.push_back(step.time);
    record.values.push_back(dot(force(step), axis));
  }
  return record;
}

/// The force on the canopy along one axis.
Record record_of(const std::vector<FlowStep>& steps, Vec3 axis) {
  return record_of(steps, axis,
                   [](const FlowStep& step) { return step.force - force_on_others(step.bodies); });
}

void check(const Watch& how) {
  if (how.length > 0 && how.standard_error > 0 && how.shortest > 0 && how.longest >= 2 * how.shortest) return;
  throw Error(
      ExitCode::usage,
      fmt::format(
          "flow: an averaging window of {} to {} times for {} m to a standard error of {}; all must be "
          "positive, and the longest at least twice the shortest",
          how.shortest, how.longest, how.length, how.standard_error));
}

}  // namespace

FlowField middle_plane(const FlowField& field) {
  const FlowGrid& grid = field.grid;
  FlowField slice;
  slice.grid = grid;
  const int j = grid.cell_at(1, 0.5 * (grid.edge(1, 0) + grid.edge(1, grid.ny)));
  slice.grid.origin.y = grid.edge(1, j), slice.grid.size.y = grid.width(1, j);
  slice.grid.ny = 1, slice.grid.grading[1] = {};
  for (int k = 0; k < grid.nz; ++k) {
    for (int i = 0; i < grid.nx; ++i) {
      slice.pressure.push_back(field.pressure[grid.index(i, j, k)]);
      slice.velocity.push_back(field.velocity[grid.index(i, j, k)]);
    }
  }
  return slice;
}

double FlowRecord::watched() const {
  return steps.empty() ? 0 : steps.back().time - steps.front().time + steps.front().length;
}

double FlowRecord::largest_mass_defect() const {
  double largest = 0;
  for (const FlowStep& step : steps)
    if (step.time - steps.front().time + steps.front().length > start_up)
      largest = std::max(largest, step.mass_defect);
  return largest;
}

namespace {

/// Whether the record is enough, or as long as it may become. Sets its means so far, and the progress.
bool look_at(FlowRecord& record, const FlowProblem& problem, const Watch& how, WatchProgress& progress) {
  const double unit = how.length / problem.air.speed();  // [s]
  const Record drag = record_of(record.steps, problem.air.direction());
  // At least until the stream has been through the box, unless the wake is that of an earlier window.
  const Vec3 size = problem.grid.size, stream = problem.air.velocity;
  const auto along = [](double length, double speed) {
    return speed == 0 ? std::numeric_limits<double>::infinity() : length / std::abs(speed);
  };
  const double passage =
      std::min({along(size.x, stream.x), along(size.y, stream.y), along(size.z, stream.z)});
  const double through = std::min(passage, 0.5 * record.watched());
  record.start_up = std::max(end_of_start_up(drag) - drag.begin, how.developed ? 0 : through);
  record.drag = mean_over_time(drag, drag.begin + record.start_up);
  progress.mean = record.drag.mean, progress.standard_error = record.drag.standard_error;
  const double relative = record.drag.standard_error / std::abs(record.drag.mean);
  record.enough = relative <= how.standard_error && record.watched() - record.start_up >= how.shortest * unit;
  // The error falls with the root of the time.
  const double wanted = std::pow(relative / how.standard_error, 2) * (record.watched() - record.start_up);
  progress.share =
      record.watched() / std::clamp(record.start_up + wanted, how.shortest * unit, how.longest * unit);
  return record.enough || record.watched() >= how.longest * unit;
}

/// `stepped` after every step that is recorded, `looked` after every look.
void march_window(Flow& flow, const FlowProblem& problem, const Watch& how, FlowRecord& record,
                  const WatchReport& report, const std::function<void(const FlowStep&)>& stepped,
                  const std::function<void()>& looked) {
  check(how);
  WatchProgress progress;
  bool stopped = false;
  if (!record.steps.empty() && look_at(record, problem, how, progress)) return;
  while (!stopped) {
    flow.march(steps_a_look, how.courant, [&](const FlowStep& step) {
      record.steps.push_back(step);
      if (stepped) stepped(step);
      progress.step = step;
      stopped = report && !report(progress);
      return !stopped;
    });
    if (stopped || look_at(record, problem, how, progress)) return;
    if (looked) looked();
  }
}

}  // namespace

void watch_forces(Flow& flow, const FlowProblem& problem, const Watch& how, FlowRecord& record,
                  const WatchReport& report, const std::function<void()>& looked) {
  march_window(flow, problem, how, record, report, {}, looked);
}

FlowField watch(Flow& flow, const FlowProblem& problem, const Watch& how, FlowRecord& record,
                const WatchReport& report) {
  check(how);
  record = {};
  const double unit = how.length / problem.air.speed();  // [s]
  MeanInParts mean(how.shortest * unit / 4);
  double next_slice = 0;
  const auto keep_field = [&](const FlowStep& step) {
    if (record.steps.size() % steps_a_field != 0) return;
    const double time = record.watched();
    if (time >= next_slice) {
      next_slice = time + slice_every * unit;
      record.slices.push_back({step.time, middle_plane(flow.field())});
      if (record.slices.size() > most_slices) record.slices.erase(record.slices.begin());
    }
    mean.add(flow, time);
  };
  march_window(flow, problem, how, record, report, keep_field, {});
  if (record.steps.size() < steps_a_field) return flow.field();
  const Vec3 stream = problem.air.direction();
  const Record x = record_of(record.steps, turned(Vec3{1, 0, 0}, stream)),
               y = record_of(record.steps, turned(Vec3{0, 1, 0}, stream));
  const double from = x.begin + record.start_up;
  record.side_x = mean_over_time(x, from), record.side_y = mean_over_time(y, from);
  record.swing = strongest_frequency({x, y}, from);
  for (std::size_t n = 1; n < problem.bodies.size(); ++n) {
    const Record of_body =
        record_of(record.steps, stream, [&](const FlowStep& step) { return step.bodies.at(n).force; });
    record.body_drag.push_back(mean_over_time(of_body, from));
  }
  FlowField field = mean.since(record.start_up);
  // Fluxes through the faces of the box minus the growth of its momentum: force and gap of every step.
  Vec3 gap;
  for (const FlowStep& step : record.steps) {
    const auto share = [&](double along) { return step.length * along / record.watched(); };
    gap += {share(step.momentum_gap.x), share(step.momentum_gap.y), share(step.momentum_gap.z)};
  }
  field.momentum_deficit = field.porous_force - gap;
  field.converged = record.enough;
  return field;
}

}  // namespace ripstop::inline flow
