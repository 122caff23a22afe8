// A flow watched in time until its mean drag is known well enough.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/flow/statistics.h"

namespace ripstop::inline flow {

/// The plane y = 0 of a field, as one with ny = 1.
FlowField middle_plane(const FlowField& field);

/// How long to watch. Lengths are in times that the stream takes for one `length`.
struct Watch {
  double courant = 0.7;
  double standard_error = 0.01;         // of the mean drag, relative, at which it ends
  double shortest = 25, longest = 300;  // after the start-up, and in all
  double length = 0;                    // [m], such as the canopy's inflated diameter
  bool developed = false;               // the wake is that of an earlier window about nearly the same bodies
};

/// The plane y = 0 at one time: fields with ny = 1.
struct FlowSlice {
  double time = 0;  // [s]
  FlowField field;
};

/// Record of the averaging window.
struct FlowRecord {
  std::vector<FlowStep> steps;
  double start_up =
      0;  // discarded, from the beginning of the watch: until the record has settled, and unless
          // the wake is developed at least until the stream has been through the box [s]
  MeanOverTime drag, side_x, side_y;  // of the rest, along the stream and along x and y turned with it [N]
  Peak swing;                         // of the side force
  std::vector<MeanOverTime>
      body_drag;        // the same along the stream of each rigid body, the bodies after the canopy [N]
  bool enough = false;  // the standard error reached the required value
  std::vector<FlowSlice> slices;  // the last ones, evenly in time

  double watched() const;              // [s]
  double largest_mass_defect() const;  // FlowStep::mass_defect of the steps after the start-up
};

struct WatchProgress {
  FlowStep step;
  double mean = 0, standard_error = 0;  // of the drag so far [N]; 0: not yet known
  double share = 0;                     // of the averaging window, as far as can be estimated
};
using WatchReport = std::function<bool(const WatchProgress&)>;

/// The record alone, without mean fields and slices. It may have the steps of an earlier call, from whose end the flow
/// continues: the result is then that of one call. `looked` is called after every look at the record.
void watch_forces(Flow& flow, const FlowProblem& problem, const Watch& how, FlowRecord& record,
                  const WatchReport& report = {}, const std::function<void()>& looked = {});

/// Marches on from the present state of the flow. Returns the mean over the record without the start-up, with the
/// mean loads, and in `record` the history. FlowField::average contains the number of averaged fields. Throws the
/// exceptions of Flow::march(), Error(usage) for an impossible averaging window.
FlowField watch(Flow& flow, const FlowProblem& problem, const Watch& how, FlowRecord& record,
                const WatchReport& report = {});

}  // namespace ripstop::inline flow
