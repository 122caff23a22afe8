// How fine a mesh has to be for the size of the inflated canopy.
#pragma once

#include "ripstop/parachute/design.h"

namespace ripstop {

/// Cloth nodes from which on the projected diameter under uniform pressure changes by less than 1 % when the
/// mesh is made finer. Measured on the examples with up to 100,000 nodes (docs/guide/canopies.md, How fine a
/// mesh), 12 gores or as they are; the diameter is too large below. What counts is the spacing over the
/// canopy's size, so the number holds for other sizes; 8 and 24 gores need about as many.
int resolved_cloth_nodes(const Design& design);

}  // namespace ripstop
