// Suspension lines and riser that would pass through rigid bodies of the flow.
#pragma once

#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline fsi {

/// Throws Error(usage) where a line or the riser at `positions` passes through one of the rigid bodies, which are all
/// but the first. The end of the riser may lie in the body that hangs from it, by 5 % of the distance to the skirt: the
/// default position of a body is approximate.
void require_lines_apart(const CanopyMesh& mesh, const std::vector<Vec3>& positions,
                         const std::vector<FlowBody>& bodies);

}  // namespace ripstop::inline fsi
