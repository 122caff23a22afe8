// Records of a free flight: a row for each step of the flow, and the state of a checkpoint.
#pragma once

#include <vector>

#include "ripstop/fsi/carried_bodies.h"
#include "ripstop/fsi/opening_record.h"

namespace ripstop::inline fsi {

/// At the end of one step of the flow. Places and velocities are over the ground, z up.
struct FreeFlightRow {
  double time = 0;         // [s]
  Vec3 payload, velocity;  // of the payload [m], [m/s]
  Vec3 canopy;             // mean of the canopy's nodes [m]
  double angle = 0;  // oscillation: between the vertical and the line from payload to skirt centroid [deg]
  double tilt_x = 0, tilt_y = 0;  // its components: inclination of that line towards x and y [deg]
  double attack = 0;              // angle of attack: between that line and the relative wind [deg]
  Vec3 air_force;                 // of the air on the canopy, without rigid bodies [N]
  Vec3 line_force;                // of lines and riser on the payload [N]
  double payload_drag = 0;        // [N]
  double mouth_area = 0;          // magnitude of the canopy's area vector [m2]
  Vec3 wind;                      // at the height of the canopy [m/s]
  Vec3 stream;                    // of the undisturbed air in the box [m/s]
  double step = 0, courant = 0;   // of the flow [s], [-]
  double residual_traction = 0;
  double momentum_gap = 0;                 // of the air in this step, magnitude [N]
  double mass_defect = 0;                  // FlowStep::mass_defect
  std::vector<FlightBodyRow> bodies = {};  // no columns
};

template <class T, class Visit>
void visit_components(const char* x, const char* y, const char* z, T& v, Visit&& visit) {
  visit(x, v.x), visit(y, v.y), visit(z, v.z);
}

template <Of<FreeFlightRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("time_s", row.time);
  visit_components("payload_x_m", "payload_y_m", "payload_z_m", row.payload, visit);
  visit_components("velocity_x_m_s", "velocity_y_m_s", "velocity_z_m_s", row.velocity, visit);
  visit_components("canopy_x_m", "canopy_y_m", "canopy_z_m", row.canopy, visit);
  visit("oscillation_deg", row.angle);
  visit("tilt_x_deg", row.tilt_x);
  visit("tilt_y_deg", row.tilt_y);
  visit("angle_of_attack_deg", row.attack);
  visit_components("air_force_x_n", "air_force_y_n", "air_force_z_n", row.air_force, visit);
  visit_components("line_force_x_n", "line_force_y_n", "line_force_z_n", row.line_force, visit);
  visit("payload_drag_n", row.payload_drag);
  visit("mouth_area_m2", row.mouth_area);
  visit_components("wind_x_m_s", "wind_y_m_s", "wind_z_m_s", row.wind, visit);
  visit_components("stream_x_m_s", "stream_y_m_s", "stream_z_m_s", row.stream, visit);
  visit("step_s", row.step);
  visit("courant", row.courant);
  visit("load_remainder", row.residual_traction);
  visit("momentum_gap_n", row.momentum_gap);
  visit("mass_defect", row.mass_defect);
}

/// Everything that the next step depends on, to the last bit.
struct FreeFlightState {
  InflationState coupled;  // cloth, record, steps and air; positions and velocities in the box
  long long rows = 0;      // of the cloth's history so far
  Vec3 box, box_velocity;  // the box over the ground [m], [m/s]
  Vec3 stream;             // of the undisturbed air in the box [m/s]
  double kinetic_at_start = 0, elastic_at_start = 0;  // in the box [J]
  Vec3 momentum_at_start;                             // over the ground [kg m/s]
  Vec3 impulse;                 // of air, weight and the payload's drag since the start [N s]
  double mouth_at_start = 0;    // FreeFlightRow::mouth_area [m2]
  double collapsed_since = -1;  // [s]; negative: the canopy is open
  bool upright = false;         // the canopy has been above its payload since the start
  double pierced = 0;           // of a cluster the largest pierced_share() of all shapes
};

template <Of<FreeFlightState> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("coupled", s.coupled);
  visit("rows", s.rows);
  visit("box", s.box);
  visit("box_velocity", s.box_velocity);
  visit("stream", s.stream);
  visit("kinetic_at_start", s.kinetic_at_start);
  visit("elastic_at_start", s.elastic_at_start);
  visit("momentum_at_start", s.momentum_at_start);
  visit("impulse", s.impulse);
  visit("mouth_at_start", s.mouth_at_start);
  visit("collapsed_since", s.collapsed_since);
  visit("upright", s.upright);
  visit("pierced", s.pierced);
}

}  // namespace ripstop::inline fsi
