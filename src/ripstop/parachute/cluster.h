// Two to four canopies, each on its riser, whose risers end at one confluence.
#pragma once

#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline parachute {

inline constexpr int fewest_in_cluster = 2, most_in_cluster = 4;

/// Where the canopies are: at equal angles about the axis of the cluster, each axis inclined to it by `spread` [rad].
struct ClusterLayout {
  int canopies = fewest_in_cluster;
  double spread = 0;

  /// Of canopy `k` about z, from x [rad]. Two lie along x, three have one on y, four lie on the diagonals: the planes
  /// x = 0 and y = 0 are planes of symmetry of two and four.
  double azimuth(int k) const;
  /// Largest distances along x and y between the axes of two canopies, at a distance of 1 m from the confluence.
  Vec3 width() const;
};

/// The meshes of a cluster. Nodes, springs, patches and cells are those of the first canopy, then those of the second
/// one. In its own frame a canopy is on the axis x = y = 0, with the end of its riser where that of its own mesh is.
class Cluster {
 public:
  /// Of equal canopies: `one` is on the axis and has one fixed node, which becomes the confluence. The centre of the
  /// skirts has the height of that of `one`. Throws Error(usage) for a mesh without cloth, skirt or such a node.
  Cluster(CanopyMesh one, ClusterLayout layout);
  /// Of canopies of several sizes, one mesh for each, all with the same topology. The skirt of the longest one has the
  /// height that it has in its own mesh. Throws Error(usage) as above, and for meshes of other topology.
  Cluster(std::vector<CanopyMesh> canopies, ClusterLayout layout);

  /// The mesh of canopy `k` on the axis. Numbers of nodes, springs and patches are the same for all of them.
  const CanopyMesh& one(int k = 0) const { return each_[equal() ? 0 : static_cast<std::size_t>(k)]; }
  bool equal() const { return each_.size() == 1; }
  const ClusterLayout& layout() const { return layout_; }
  int canopies() const { return layout_.canopies; }
  Vec3 confluence() const { return confluence_; }
  /// Of all canopies.
  CanopyMesh mesh() const;

  /// Unit vectors of the frame of canopy `k`: x points away from the axis of the cluster, z along that of the canopy.
  struct Frame {
    Vec3 x, y, z;
    Vec3 out(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
    Vec3 in(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  };
  Frame frame(int k) const;

  /// Positions of the nodes of canopy `k` in its own frame, from those of all canopies.
  std::vector<Vec3> own(int k, const std::vector<Vec3>& all) const;
  /// The converse.
  void put(int k, const std::vector<Vec3>& own, std::vector<Vec3>& all) const;
  /// Positions of all nodes, each in the frame of its own canopy; canopies of another size as large as the first one.
  std::vector<Vec3> overlaid(const std::vector<Vec3>& all) const;
  /// Positions of canopy `k` in its own frame, turned about the end of the riser until the centroid of the skirt is on
  /// the axis.
  std::vector<Vec3> upright(int k, std::vector<Vec3> own) const;

  /// Smallest distance between the cloth of two canopies, at least: twice that of a node of the cloth from the planes
  /// midway between neighbours. Negative where cloth has crossed such a plane [m].
  double gap(const std::vector<Vec3>& all) const;

  /// The part of an array over all canopies that belongs to canopy `k`.
  template <class T>
  std::vector<T> part(int k, const std::vector<T>& all) const {
    return of_canopy(all, k, layout_.canopies);
  }

 private:
  /// End of the riser of canopy `k` in its own frame.
  Vec3 end_of_riser(int k) const { return one(k).start[one(k).fixed.front()]; }
  /// From the end of the riser to the skirt of canopy `k` [m].
  double length(int k) const;

  std::vector<CanopyMesh> each_;  // one of equal canopies
  ClusterLayout layout_;
  Vec3 confluence_;
};

/// A cluster whose risers end at one node.
struct JoinedCluster {
  CanopyMesh mesh;        // with that node as its only fixed one
  std::vector<int> node;  // of this mesh, for every node of Cluster::mesh()

  /// Positions of the nodes of this mesh, from those of Cluster::mesh().
  std::vector<Vec3> joined(const std::vector<Vec3>& all) const;
};
/// Of a Cluster::mesh(), whose fixed nodes become the first of them, with the mass of all.
JoinedCluster join_risers(const CanopyMesh& cluster);

}  // namespace ripstop::inline parachute
