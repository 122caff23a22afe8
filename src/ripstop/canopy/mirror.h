// Mirror symmetry of a canopy in the planes x = 0 and y = 0 through its axis.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ripstop/mesh/mesh.h"

namespace ripstop::inline canopy {

/// Of each node, the node at its mirror image: in the plane x = 0, and in the plane y = 0.
using MirrorImages = std::array<std::vector<int>, 2>;

/// Absent unless the mesh as built is its own image in both planes: places and masses of the nodes, the springs outside
/// the lattice, and the laws of crossing lattice springs.
std::optional<MirrorImages> mirror_images(const Mesh& mesh);

/// Largest distance of a node of the cloth from the image of its image [m].
double mirror_gap(const Mesh& mesh, const MirrorImages& images, const std::vector<Vec3>& positions);

}  // namespace ripstop::inline canopy
