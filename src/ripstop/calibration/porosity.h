// The cloth's porosity from the measured drag of a reference parachute ([NFM] section 4).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/least_squares.h"
#include "ripstop/material/permeability.h"

namespace ripstop::inline calibration {

/// The calibrated quantity.
enum class PorosityKnob {
  gamma,        // Ergun's porosity, [NFM] Eq. 16
  permeability  // CFM/ft2 at half an inch of water, with b = 0: creeping flow
};
/// a and b of the pressure drop for a value of the knob; `thickness` [m] is Ergun's t. Throws
/// Error(bad_data) outside the knob's range.
PressureDrop cloth_of(PorosityKnob knob, double value, double thickness);

/// A measured point of the reference parachute.
struct MeasuredDrag {
  double nominal_speed = 0;  // that names the condition [m/s]
  double speed = 0;          // that the drag area refers to [m/s]
  double density = 0;        // [kg/m3]
  double drag = 0;           // [N]

  double drag_area() const { return drag / (0.5 * density * speed * speed); }
};

/// One run: a value of the knob, a place of the canopy along the flow, a condition.
struct PorosityTrial {
  double knob = 0;
  double shift = 0;           // [m]
  std::size_t condition = 0;  // index into the measured points
  double drag_area = 0;       // [m2]
};

struct PorosityCalibration {
  double knob = 0;
  double error_measured = 0;     // standard error from the scatter of the measured drag areas; 0: one point
  double error_computed = 0;     // standard error from the scatter of the trials about their lines
  double error() const;          // both together
  double interval = 0;           // half width at 95 %, Student's t of the measured points
  LineFit coefficient;           // C_D over the knob, all trials
  std::vector<LineFit> lines;    // drag area over the knob, of each condition [m2]
  std::vector<double> computed;  // drag area of each condition at `knob` [m2]
  double misfit = 0;             // root mean square of computed over measured drag area - 1
  double shift_scatter = 0;      // root mean square of a trial over the mean of its shifts - 1
  bool outside = false;          // `knob` lies outside the trials
};

/// Least squares on the drag areas. For every condition the mean drag area over the shifts is joined by straight
/// pieces between the knob's values, so that no law is assumed; the lines provide the errors and the comparison with
/// the published fit. Outside the computed values the nearest piece is extrapolated. Throws Error(bad_data) with
/// fewer than two values of the knob for a condition, or when drag does not depend on it.
PorosityCalibration calibrate_porosity(const std::vector<MeasuredDrag>& measured,
                                       const std::vector<PorosityTrial>& trials, double reference_area);

}  // namespace ripstop::inline calibration
