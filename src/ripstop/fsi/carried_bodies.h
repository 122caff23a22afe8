// Rigid bodies that move with the payload of a flight, such as the rocket below its drogue.
//
// They have no masses of their own: the payload, a point mass, carries them. They turn with the line from the payload to
// the centre of the skirt, by the shortest way, and do not spin about it.
#pragma once

#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/flow/extent.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline fsi {

/// One body in one step of the flow. In files vectors and places are over the ground, z up.
struct FlightBodyRow {
  double time = 0;            // end of the step [s]
  double body = 0;            // from 1, in the order of their names
  double drag = 0, side = 0;  // along the relative stream and across it [N]
  double drag_area = 0;       // drag over the dynamic pressure of the relative stream [m2]
  double incidence = 0;       // between the axis of the body and the relative stream [deg]
  Vec3 force;                 // of the air [N]
  Vec3 moment;                // about the middle of its aft end [N m]
  Vec3 aft;                   // that point [m]
  double resolved = 0;        // 1: all of it is in the fine cells
};
template <Of<FlightBodyRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("time_s", row.time);
  visit("body", row.body);
  visit("drag_n", row.drag);
  visit("side_force_n", row.side);
  visit("drag_area_m2", row.drag_area);
  visit("incidence_deg", row.incidence);
  visit("force_x_n", row.force.x), visit("force_y_n", row.force.y), visit("force_z_n", row.force.z);
  visit("moment_x_n_m", row.moment.x), visit("moment_y_n_m", row.moment.y);
  visit("moment_z_n_m", row.moment.z);
  visit("aft_x_m", row.aft.x), visit("aft_y_m", row.aft.y), visit("aft_z_m", row.aft.z);
  visit("in_fine_cells", row.resolved);
}

/// The air about the bodies in one step of the flow.
struct BodiesInStep {
  std::vector<BodyLoad>
      loads;           // on all bodies of the flow, about the points that the bodies had at the start
  Vec3 stream;         // relative to the payload [m/s]
  double density = 0;  // [kg/m3]
  /// Of the stream in the box and of the payload in it [m/s2]: the faces of the flow carry the air inside a body too.
  Vec3 stream_gains, payload_gains;
  Extent fine;  // cells
};

class CarriedBodies {
 public:
  /// Where the payload is, and the unit vector from it to the centre of the skirt.
  struct Pose {
    Vec3 payload, line;
  };

  CarriedBodies() = default;
  /// All bodies of the flow but the first, the canopy, as they are placed at `start`.
  CarriedBodies(const std::vector<FlowBody>& bodies, Pose start);

  bool empty() const { return bodies_.empty(); }
  /// At `now`, moving to `next` within `length` [s].
  std::vector<Placement> placed(const Pose& now, const Pose& next, double length) const;
  /// In a step that begins at `now`, with vectors and places in the box. The surfaces are those of a placement at `now`.
  std::vector<FlightBodyRow> rows(const Pose& now, const std::vector<Placement>& placed,
                                  const BodiesInStep& step) const;

 private:
  Vec3 first_line_;                // Pose::line at the start
  std::vector<Vec3> first_about_;  // FlowBody::moment_about at the start
  std::vector<FlowBody> bodies_;   // about the payload at the start
};

}  // namespace ripstop::inline fsi
