// What hangs below a parachute, and what it weighs.
#pragma once

#include "ripstop/case/settings.h"

namespace ripstop {

/// Of cloth, tape, lines and riser as meshed [kg].
double parachute_mass(const Settings& resolved);
/// Speed at which the usual drag of the canopy's family holds payload.mass_kg; where
/// a search for the speed begins [m/s].
double payload_first_speed(const Case& given, double density);
/// The middle of the family's range on the nominal area.
double usual_drag_coefficient(const Design& parachute);
/// Three times the descent rate, at least 20 m/s (assumed).
double usual_deployment_speed(double descent_rate);
/// Of `payload` [kg] and the parachute that carries it; the canopy's drag holds both [N].
double suspended_weight(const Settings& resolved, double payload);

}  // namespace ripstop
