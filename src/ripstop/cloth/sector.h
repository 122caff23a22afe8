// The part of a canopy between two planes of symmetry, from which all of it follows by mirroring. Under a load that is
// alike in every gore it finds its equilibrium with a small share of the nodes. Internal to cloth/.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/cloth/stability_limit.h"

namespace ripstop::inline cloth {

struct Sector {
  Mesh mesh;  // starts where the canopy does
  Loads loads;
  int images = 1;                  // that make up the canopy
  std::vector<Symmetric> freedom;  // by node: projection on the directions that the planes leave it
  /// Of every node of the canopy: the sector's node that it is an image of, and the map of x and y.
  struct Image {
    int node = -1;
    double xx = 1, xy = 0, yx = 0, yy = 1;
  };
  std::vector<Image> image;

  std::vector<Vec3> whole(const std::vector<Vec3>& positions) const;
};

/// Absent for a cloth that has no such planes through the z axis, one of them at column 0, at the positions `start`;
/// with patches that do not close about the axis, a drawstring or forces on nodes. Pressures are taken in the mean over
/// the images of a cell. Springs of the lattice that cross a plane between nodes (those to the next node but one) are
/// left out.
std::optional<Sector> sector_of(const Mesh& mesh, const std::vector<Vec3>& start, const Loads& loads);

}  // namespace ripstop::inline cloth
