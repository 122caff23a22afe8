// The air that goes with a canopy when its speed changes.
#pragma once

#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow.h"

namespace ripstop {

/// Of a surface as it stands, taken for tight and rigid, along z [kg]: what it feels over its acceleration when it sets
/// out in still air. A flow of its own, on cells fitted to the surface. Throws Error(usage) where the engine has no time.
double added_mass(FlowEngine& engine, const std::vector<Triangle>& surface, double density);

}  // namespace ripstop
