// Suspension lines, their sewn part on the canopy, vent lines and the riser: the same for every family.
#pragma once

#include <vector>

#include "ripstop/parachute/build.h"
#include "ripstop/parachute/builder.h"

namespace ripstop {

/// Chooses the nodes of `path` (a smooth run of cloth nodes) that become nodes of a line, at least `segment`
/// [m] apart: a short segment of so stiff a line would set the time step. The nodes between are tied to the
/// straight segment, or left free beside it when not `straight`.
/// Goes no farther than `length` [m] along the path. The chosen nodes, with the lengths between.
Path sew(MeshBuilder& builder, const Path& path, double length, double segment, bool straight);

/// Straight lines from the confluence on the axis to the first node of every path, which they follow from
/// there; and the riser. All lines are `design.lines.length_m` long; the confluence lies where the longest is
/// taut. Call once.
void add_lines(MeshBuilder& builder, const Design& design, const PartMaterials& materials,
               const std::vector<Path>& sewn);

/// Every line goes on across the vent to the end of the opposite one: an even number of paths. A vent line is
/// as long as the distance that it spans in the start shape.
void add_vent_lines(MeshBuilder& builder, const PartMaterials& materials, const std::vector<Path>& sewn);

}  // namespace ripstop
