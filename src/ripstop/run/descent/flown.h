// Drag coefficients in descent, of free flights by Ripstop: examples/flown.json.
#pragma once

#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/run/opening/load.h"

namespace ripstop::inline run {

/// A row of that file.
struct FlownDrag {
  std::string family, type, cloth;  // folder of the example, word in [parachute], canopy material
  double drag_coefficient = 0, standard_error = 0;  // in descent, on S0
  double axial_coefficient = 0;                     // of the steady flow in which the flight began
  int half_swings = 0;
  std::string made;  // command and machine
};
/// Throws Error(io) when the file is missing, Error(bad_data) when it is broken.
const std::vector<FlownDrag>& flown_drags();

/// In words: a drogue with more drag area than the main [m2].
std::vector<std::string> exchanged_parachutes(double drogue_area, double main_area);

/// Smallest and largest coefficient in descent on S0.
struct DescentDrag {
  double low = 0, high = 0;
  std::string from;
};
/// Of a parachute with a known coefficient: within its uncertainty. An axial coefficient does not contain the motion of
/// the canopy. It is in addition multiplied by the ratio of both coefficients of the flights with this type and cloth,
/// where there is none, of all flights with this type, and otherwise of all flights.
DescentDrag descent_drag(const Settings& resolved, const DragCoefficient& drag);

}  // namespace ripstop::inline run
