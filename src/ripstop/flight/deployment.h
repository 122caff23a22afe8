// Deployment of a packed parachute in one dimension: from the extraction of the bag until the canopy has left it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/flight/snatch.h"

namespace ripstop::inline flight {

/// Payload and packed parachute on one straight path. The bag is the container or the wrap of the canopy, with the
/// pilot chute.
struct PackedParachute {
  double speed = 0;           // of the payload through the air at the start [m/s]
  double relative_speed = 0;  // at which the bag leaves it then [m/s]
  double density = 0;         // of the air [kg/m3]
  double gravity = 0;         // along the path [m/s2]

  double payload_mass = 0;                    // infinite: it keeps its speed [kg]
  double payload_drag_area = 0;               // [m2]
  double bag_mass = 0, bag_drag_area = 0;     // empty, with the pilot chute [kg], [m2]
  double canopy_mass = 0, canopy_length = 0;  // length from skirt to vent, stretched out [kg], [m]
  double canopy_drag_area = 0;                // of a canopy that trails behind slack lines, canopy first [m2]
  double lines_mass = 0;                      // with the riser [kg]
  std::vector<SnatchPart> lines;              // lines and riser, one behind the other
  double line_force = 0;                      // that pulls the lines out of their stows [N]
  double strip_force = 0;                     // that pulls the canopy out of the bag [N]
  bool lines_first = true;
};

/// One time of a deployment.
struct DeploymentRow {
  double time = 0;                          // [s]
  double path = 0;                          // flown by the payload [m]
  double payload_speed = 0, bag_speed = 0;  // through the air [m/s]
  double separation = 0;                    // of payload and bag; of payload and vent, canopy first [m]
  double emerged = 0;                       // length of the canopy outside the bag [m]
  double tension = 0;                       // at the payload [N]
};

/// The beginning of a phase.
struct DeploymentPhase {
  std::string name;
  double time = 0, path = 0;                // [s], [m]
  double payload_speed = 0, bag_speed = 0;  // [m/s]
};
template <Of<DeploymentPhase> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("phase", p.name);
  visit("time_s", p.time);
  visit("path_m", p.path);
  visit("payload_speed_m_s", p.payload_speed);
  visit("bag_speed_m_s", p.bag_speed);
}

/// Names of the phases.
inline constexpr const char *lines_leave = "lines leave the bag", *lines_stretch = "lines stretch",
                            *canopy_leaves = "canopy leaves the bag", *canopy_out = "canopy is out";

struct Deployment {
  std::vector<DeploymentPhase> phases;  // in order; `canopy_out` only of a deployment that ends
  std::vector<DeploymentRow> rows;
  double snatch_load = 0, snatch_time = 0;  // largest tension at the payload [N], [s]
  double relative_speed = 0;                // of payload and bag when the lines come taut [m/s]
  std::optional<std::string> stopped;       // reason why the canopy does not leave the bag

  /// Null where the deployment does not come so far.
  const DeploymentPhase* phase(const std::string& name) const;
};
template <Of<Deployment> T, class Visit>
void each_member(T& d, Visit&& visit) {
  visit("phases", d.phases);
  visit("snatch_load_n", d.snatch_load);
  visit("snatch_time_s", d.snatch_time);
  visit("relative_speed_at_line_stretch_m_s", d.relative_speed);
  visit("stopped", d.stopped);
}

/// Mass of the first `length` of a flat disk that is gathered along its radius, from its rim (skirt first) or from its
/// middle (vent first); whole canopy: `mass`, `whole` [m]. The area of the ring.
double emerged_mass(double mass, double whole, double length, bool skirt_first);

/// Lines that leave the bag, and a canopy that does, join their new body in a plastic impact: mass per length times the
/// square of the relative speed is added to the force. Taut lines are a massless nonlinear spring between the skirt and
/// the payload, which carries their mass. docs/theory/deployment.md has the equations. Throws Error(usage) for masses
/// and lengths that are not above 0, and where a line breaks.
Deployment deploy_parachute(const PackedParachute& packed);

}  // namespace ripstop::inline flight
