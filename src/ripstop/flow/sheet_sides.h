// Whether the cells of a flow resolve the two sides of a thin sheet.
#pragma once

#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

/// Of all pairs of neighbouring cell centres with the surface between them, the share on different sides of it: the
/// surface crosses the line between them an odd number of times. 0: no cell centre is within a closed surface, and none
/// within the folds of a canopy. 0 also for a surface that no line crosses.
double share_on_different_sides(const FlowGrid& grid, const std::vector<Triangle>& surface);

}  // namespace ripstop::inline flow
