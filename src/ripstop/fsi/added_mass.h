// The air that goes with a canopy when its speed changes.
#pragma once

#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline fsi {

/// Added mass along z of an impermeable rigid surface [kg]: force over acceleration at the start of its motion in
/// still air. A separate flow, on cells fitted to the surface. Throws Error(usage) if the engine does not support
/// unsteady flow.
double added_mass(FlowEngine& engine, const std::vector<Triangle>& surface, double density);

}  // namespace ripstop::inline fsi
