// Suspension lines of a folded canopy: where a piece of cloth may hang, and how its lines run to it.
#pragma once

#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline parachute {

/// A part of a line between two nodes of the cloth, or the confluence and one.
struct LineLink {
  int from, to;
  std::vector<int> nodes;       // all of them, ends included
  std::vector<double> lengths;  // rest lengths between them [m]
  double length() const;
};
/// Links between different pieces, and from the confluence; `piece` of every node, -1 for one
/// that lies on no cloth.
std::vector<LineLink> line_links(const CanopyMesh& mesh, const std::vector<int>& piece);

/// A link allows its far end to lie downstream of its near end by sqrt(length^2 - lateral^2): how far [m] the
/// far end may be moved along z. A link from the confluence is taken shorter by `slack` [m]. Throws
/// Error(usage) when it does not reach.
double free_way(const LineLink& link, const CanopyMesh& mesh, const std::vector<Vec3>& x, double slack);

/// Places a link's inner nodes: on the straight way when it is taut, else on the arc of a circle that bulges
/// away from the axis, every segment a chord of its rest length.
void hang(const LineLink& link, std::vector<Vec3>& x);

}  // namespace ripstop::inline parachute
