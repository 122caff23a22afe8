// The air upstream of a canopy: the reading of a tunnel probe in front of it.
#pragma once

#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline fsi {

/// Mean of the velocity along z over a disk across the axis, in equal parts of its area [m/s].
double mean_speed_over_disk(const FlowField& field, Vec3 centre, double diameter);

/// Over a disk as large as the canopy's projected area, one of its diameters before the cloth; at the inlet
/// where that lies before it [m/s].
double approach_speed(const FlowField& field, const CanopyMesh& mesh, const std::vector<Vec3>& shape);

}  // namespace ripstop::inline fsi
