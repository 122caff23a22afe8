// Trajectory of a payload under a variable drag area, with gravity, in the standard atmosphere.
#pragma once

#include <functional>
#include <vector>

namespace ripstop::inline flight {

struct FlightState {
  double time = 0;         // [s]
  double distance = 0;     // through the air [m]
  double range = 0;        // over ground [m]
  double height = 0;       // [m]
  double speed = 0;        // [m/s]
  double path_angle = 90;  // below the horizon [deg]
};

struct FlightRow {
  FlightState state;
  double drag_area = 0;  // [m2]
  double force = 0;      // of the drag [N]
  double density = 0;    // [kg/m3]
};

/// (C_D S) as a function of time [s] and way through the air [m], both since the leg began [m2].
using DragArea = std::function<double(double time, double distance)>;

/// A part of the trajectory under one law of the drag area.
struct Leg {
  DragArea drag_area;
  double duration = 0;  // [s]
  double step = 0;      // of the time, at most [s]
  double ground = 0;    // the leg ends there [m]
  bool until_steady =
      false;  // and where the speed is the terminal one within 0.1 %, straight down within 0.1 deg
  double density_ratio = 1;  // of the air to that of the standard atmosphere at every height
};

/// A mass point under drag and weight, m dv/dt = -D v/|v| + m g, by the classic Runge-Kutta method of fourth order.
/// Returns a row for every step, the first that of `state`, and leaves in `state` the last. Throws Error(usage) for
/// a mass, speed or step that is not above 0, or a height that standard_air() has not.
std::vector<FlightRow> fly(FlightState& state, double mass, const Leg& leg);

/// A drag area that grows from `from` to `to` as (t / t_f)^j, then to `over` times `to`, returns to `to` one
/// t_f later, and remains there.
DragArea filling(double from, double to, double filling_time, double exponent, double over);
/// A drag area from a record over the distance through the air: linear between the rows, constant after the
/// last one. `distance` increases.
DragArea from_record(std::vector<double> distance, std::vector<double> drag_area, double to);

}  // namespace ripstop::inline flight
