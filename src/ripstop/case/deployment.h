// The deployment of a case: the input of flight/ and of the coupled opening from [deployment].
#pragma once

#include "ripstop/case/settings.h"
#include "ripstop/flight/deployment.h"

namespace ripstop::inline cases {

/// The parts that stretch between canopy and payload, from the skirt on: lines, riser, and hardware with a stiffness.
std::vector<SnatchPart> stretching_parts(const Settings& resolved);

/// The packed parachute at the speed and in the air of the case. `resolved` has [deployment]. Throws Error(usage) for a
/// container longer than lines and riser together, and for a payload of payload.mass_kg that is missing.
PackedParachute packed_parachute(const Settings& resolved);

/// The deployment of the case in one dimension; nothing where it has no [deployment], or no coupled air. Throws
/// Error(usage) as packed_parachute() and deploy_parachute().
std::optional<Deployment> deployment_of(const Settings& resolved);

/// Folds and radius of the folded skirt where the case gives no radius: a closed mouth, with a radius of 4 %
/// of the nominal diameter and the smallest multiple of the lines that allows it.
void close_mouth(const Design& design, InflationSettings& inflation);

}  // namespace ripstop::inline cases
