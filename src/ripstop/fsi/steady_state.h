// State of the steady loop between iterations.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/core/vec3.h"
#include "ripstop/fsi/acceleration.h"
#include "ripstop/fsi/sheet_transfer.h"
#include "ripstop/fsi/steady_iteration.h"
#include "ripstop/fsi/transfer.h"

namespace ripstop::inline fsi {

/// Statistics of an unsteady flow over one averaging window.
struct WindowAverage {
  int steps = 0;
  double time = 0, start_up = 0;              // whole window, and the part of it that was discarded [s]
  double drag = 0, error = 0, deviation = 0;  // mean, its standard error, standard deviation [N]
  Vec3 side_force, side_error;                // means across the stream and their standard errors [N]
  double side_deviation = 0;                  // root mean square of the side force about its mean [N]
  double swing = 0, swing_share = 0;  // strongest frequency of the side force [1/s], its part of the power
  bool enough = false;                // the standard error meets the tolerance
  double mass_defect = 0;             // largest of a step after the start-up, FlowStep::mass_defect
};
template <Of<WindowAverage> T, class Visit>
void each_member(T& w, Visit&& visit) {
  visit("steps", w.steps);
  visit("time_s", w.time);
  visit("start_up_s", w.start_up);
  visit("drag_n", w.drag);
  visit("standard_error_n", w.error);
  visit("deviation_n", w.deviation);
  visit("side_force_n", w.side_force);
  visit("side_force_error_n", w.side_error);
  visit("side_force_deviation_n", w.side_deviation);
  visit("swing_hz", w.swing);
  visit("swing_share", w.swing_share);
  visit("enough", w.enough);
  visit("mass_defect", w.mass_defect);
}

/// A steady solution at one spread angle of a cluster.
struct SpreadTrial {
  double angle = 0;  // between the axes of the canopies and of the cluster [deg]
  double force_angle =
      0;  // between the force of a canopy and its axis, positive outward: mean of iterations [deg]
  double deviation = 0;  // standard deviation of that angle over these iterations [deg]
  double drag = 0;       // of all canopies [N]
};
template <Of<SpreadTrial> T, class Visit>
void each_member(T& t, Visit&& visit) {
  visit("spread_angle_deg", t.angle);
  visit("force_angle_deg", t.force_angle);
  visit("force_angle_deviation_deg", t.deviation);
  visit("drag_n", t.drag);
}
/// Search for the spread angle of a cluster.
struct SpreadSearch {
  double angle = 0;                  // of this state [deg]; 0: that of the case
  int before = 0;                    // iterations before the first one at this angle
  std::vector<double> force_angles;  // of the iterations at this angle [deg]
  std::vector<SpreadTrial> trials;   // at the earlier angles, in turn
  double touching = 0;               // largest angle at which canopies touched [deg]; 0: none
};
template <Of<SpreadSearch> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("angle_deg", s.angle);
  visit("iterations_before", s.before);
  visit("force_angles_deg", s.force_angles);
  visit("trials", s.trials);
  visit("touching_deg", s.touching);
}

/// Drag and shape early in the first iteration of one canopy without bodies, whose flow has not settled.
struct FirstEstimate {
  static constexpr int flow_iterations = 30;  // after which it is made
  double speed = 0;                           // of the stream [m/s]
  double drag = 0;                            // [N]
  double projected_diameter = 0;              // of the shape in equilibrium with a uniform pressure [m]
};
template <Of<FirstEstimate> T, class Visit>
void each_member(T& e, Visit&& visit) {
  visit("speed_m_s", e.speed);
  visit("drag_n", e.drag);
  visit("projected_diameter_m", e.projected_diameter);
}

/// Everything on which the next iteration depends, except the memory of the flow engine. Part of a
/// checkpoint.
struct SteadyState {
  std::vector<SteadyIteration> iterations;
  std::vector<Vec3> shape;          // X_k
  std::vector<double> pressure;     // difference applied in the next iteration, on every cell of cloth [Pa]
  RigidTraction residual_traction;  // applied in addition
  SidePressures sides;              // of the last flow [Pa]
  std::vector<double> applied;      // difference that produced `shape` [Pa]
  Accelerator accelerator;
  bool in_time = false;                         // from the next iteration on, the flow is averaged in time
  WindowAverage window;                         // the last one
  std::vector<Vec3> body_forces, body_moments;  // on the bodies other than the canopy [N], [N m]
  std::vector<double> body_errors;  // standard errors of their mean drag; empty for a steady flow [N]
  std::vector<Vec3> canopy_forces,
      canopy_moments;  // of a cluster: on each canopy, about the confluence [N], [N m]
  bool converged = false;
  double speed = 0;     // stream speed of this state, where a run searches for it; 0: that of the case [m/s]
  int speeds = 0;       // tried so far
  SpreadSearch spread;  // of a cluster whose spread angle the run searches for
  std::optional<FirstEstimate> first_estimate;  // of the first iteration, once it is made
};

template <Of<SteadyState> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("iterations", s.iterations);
  visit("shape", s.shape);
  visit("pressure", s.pressure);
  visit("remainder", s.residual_traction.at_centre);
  visit("remainder_twist", s.residual_traction.twist);
  visit("inside", s.sides.inside);
  visit("outside", s.sides.outside);
  visit("applied", s.applied);
  visit("body_forces", s.body_forces);
  visit("body_moments", s.body_moments);
  visit("body_errors", s.body_errors);
  visit("canopy_forces", s.canopy_forces);
  visit("canopy_moments", s.canopy_moments);
  visit("update", s.accelerator.update);
  visit("relaxation", s.accelerator.relaxation);
  visit("memory", s.accelerator.memory);
  visit("guesses", s.accelerator.guesses);
  visit("residuals", s.accelerator.residuals);
  visit("aitken_factor", s.accelerator.aitken_factor);
  visit("in_time", s.in_time);
  visit("watched", s.window);
  visit("converged", s.converged);
  visit("speed", s.speed);
  visit("speeds", s.speeds);
  visit("spread_search", s.spread);
  visit("first_estimate", s.first_estimate);
}

}  // namespace ripstop::inline fsi
