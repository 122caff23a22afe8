// The end of a coupled opening with a payload, from which a free flight continues.
#pragma once

#include <vector>

#include "ripstop/fsi/opening.h"

namespace ripstop::inline fsi {

/// Positions and velocities are those in the box of the opening, whose z axis is the path of the payload, upward.
struct OpeningEnd {
  double time = 0;                    // since deployment [s]
  double speed = 0;                   // of the payload [m/s]
  double air_speed = 0;               // of the stream for which the flow was started [m/s]
  double angle = 0;                   // of its path below the horizon [rad]
  double distance = 0, fallen = 0;    // of the payload since deployment, over the ground and down [m]
  std::vector<Vec3> shape, velocity;  // of every node [m], [m/s]
  std::vector<double> pressure;       // AirMemory::pressure [Pa]
  std::vector<Vec3> force;            // AirMemory::force [N]
  std::vector<double> peak_tension;   // StepRecord::peak_tension [N]
  std::vector<Vec3> folded;           // FoldedStart::positions, from which contact measures [m]
  int folds = 0;                      // FoldedStart::folds
  double peak_load = 0, load = 0;     // on the riser: highest, mean of the last row [N]
  double drag = 0;                    // of the air in the last step [N]
  double elastic = 0, kinetic = 0;    // energy of cloth and lines, in the box [J]
  StressPeak highest_stress;
};
template <Of<OpeningEnd> T, class Visit>
void each_member(T& end, Visit&& visit) {
  visit("time", end.time);
  visit("speed", end.speed);
  visit("air_speed", end.air_speed);
  visit("angle", end.angle);
  visit("distance", end.distance);
  visit("fallen", end.fallen);
  visit("shape", end.shape);
  visit("velocity", end.velocity);
  visit("pressure", end.pressure);
  visit("force", end.force);
  visit("peak_tension", end.peak_tension);
  visit("folded", end.folded);
  visit("folds", end.folds);
  visit("peak_load", end.peak_load);
  visit("load", end.load);
  visit("drag", end.drag);
  visit("elastic", end.elastic);
  visit("kinetic", end.kinetic);
  visit("von_mises", end.highest_stress.von_mises);
  visit("strain", end.highest_stress.strain);
  visit("place", end.highest_stress.place);
  visit("patch", end.highest_stress.patch);
  sewing_members(end.highest_stress, visit);
}

/// Of the payload since deployment, for each row of the air [m].
std::vector<double> distances_over_ground(const std::vector<AirRow>& air);

/// Of an opening with a payload and no reefing line left, after its last block. `load`: mean of the last row [N].
/// `air` has all steps of the flow. Throws Error(usage) for another one.
OpeningEnd end_of_opening(const Opening& opening, const InflationState& state, double load,
                          const std::vector<AirRow>& air);

}  // namespace ripstop::inline fsi
