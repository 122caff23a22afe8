// Sizes of a canopy shape: as a user requests them, and as a camera sees them from the side.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline canopy {

/// Diameters of circles with the same area as the outline of the whole cloth and of the
/// skirt, seen along z [m].
struct CanopySize {
  double projected_diameter = 0, projected_area = 0;
  double skirt_diameter = 0;
  double length = 0;  // from the skirt's mean plane to the farthest cloth downstream [m]
};
CanopySize canopy_size(const CanopyMesh& mesh, const std::vector<Vec3>& positions);
/// Mean over the canopies of a cluster, each with its own axis along z, of the mesh of one.
CanopySize mean_size(const CanopyMesh& one, const std::vector<std::vector<Vec3>>& canopies);

/// Of the canopy's mouth, seen along z [m2].
double skirt_area(const CanopyMesh& mesh, const std::vector<Vec3>& positions);

/// Largest distance of a node from where a turn by 2 pi / symmetry puts its like [m].
double asymmetry(const Mesh& mesh, const std::vector<Vec3>& positions, int symmetry);

/// One row of nodes round the canopy.
struct ProfileRing {
  int patch = 0, row = 0;
  double z = 0;         // mean, from the skirt's mean plane [m]
  double diameter = 0;  // of the circle with the area that the row encloses, seen along z [m]
  double smallest_radius = 0, largest_radius = 0;  // from the axis [m]
};
/// Row after row of every patch that goes round; in the order of the patches.
std::vector<ProfileRing> canopy_profile(const CanopyMesh& mesh, const std::vector<Vec3>& positions);

/// The lengths of [NFM]'s photogrammetry by their names [m]. D_st, D_mid, D_end: the band at its lower edge,
/// half its height and its upper edge; L_tot: skirt to vent; L_disk, L_band: both along z. Without a band:
/// D_st (skirt), D_mid (the largest row) and L_tot.
std::map<std::string, double> image_sizes(const CanopyMesh& mesh, const std::vector<Vec3>& positions);

}  // namespace ripstop::inline canopy
