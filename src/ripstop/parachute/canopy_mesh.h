// The result of a canopy family for a design: masses and springs, and their parts of a parachute.
#pragma once

#include <cstddef>
#include <vector>

#include "ripstop/mesh/mesh.h"

namespace ripstop::inline parachute {

/// One suspension line from the confluence to its end on the canopy, or one apex line to the edge of the vent.
struct LineRun {
  int radial = 0;                 // 0 .. line_count - 1
  std::vector<int> springs = {};  // axial springs in order from the confluence, indices into Mesh::springs
  int free_springs = 0;           // the first so many lie between confluence and cloth
  double axial_share =
      1;              // of the line's tension that its axial springs carry; bending springs carry the rest
  bool apex = false;  // whether it is an apex line
};

/// Indices into the mesh: of nodes, of Mesh::springs, of Mesh::patches.
struct Rigging {
  std::vector<LineRun> lines;          // suspension lines, then apex lines
  std::vector<int> vent_line_springs;  // axial
  std::vector<int> riser_springs;      // axial, from the fixed end; empty without a riser
  std::vector<int> tape_springs;
  std::vector<int> skirt_nodes;  // round the canopy's mouth, in order
  int confluence = -1;           // node
  int canopies = 1;              // of a cluster: every list here has equal parts, one for each canopy in turn
  /// Of a disk-gap-band, with separate sizes; empty otherwise.
  std::vector<int> disk_patches, band_patches;
};

/// The part of such a list that belongs to canopy `k` of `canopies`.
template <class T>
std::vector<T> of_canopy(const std::vector<T>& all, int k, int canopies) {
  const auto count = static_cast<std::ptrdiff_t>(all.size()) / canopies;
  return {all.begin() + k * count, all.begin() + (k + 1) * count};
}

/// Goes wherever a Mesh does.
struct CanopyMesh : Mesh {
  Rigging rigging;
};

/// Where the suspension lines meet the skirt, nodes in the order of the lines, which is that round the canopy.
inline std::vector<int> line_joints(const CanopyMesh& mesh) {
  std::vector<int> joints;
  for (const LineRun& line : mesh.rigging.lines)
    if (!line.apex) joints.push_back(mesh.springs[line.springs[line.free_springs - 1]].b);
  return joints;
}

/// Mean of the skirt's nodes at the positions `x` [m].
inline Vec3 skirt_centroid(const CanopyMesh& mesh, const std::vector<Vec3>& x) {
  Vec3 sum;
  for (const int node : mesh.rigging.skirt_nodes) sum += x[node];
  return sum / static_cast<double>(mesh.rigging.skirt_nodes.size());
}

}  // namespace ripstop::inline parachute
