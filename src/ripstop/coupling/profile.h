// The computed canopy as a camera sees it from the side, and how far its parts are stretched.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/parachute/mesh.h"

namespace ripstop {

/// One row of nodes round the canopy.
struct ProfileRing {
  int patch = 0, row = 0;
  double z = 0;         // mean, from the skirt's mean plane [m]
  double diameter = 0;  // of the circle with the area that the row encloses, seen along z [m]
  double smallest_radius = 0, largest_radius = 0;  // from the axis [m]
};
/// Row after row of every patch that goes round; in the order of the patches.
std::vector<ProfileRing> canopy_profile(const Mesh& mesh, const std::vector<Vec3>& positions);

/// The lengths of [NFM]'s photogrammetry by their names [m]. D_st, D_mid, D_end: the band at its lower edge,
/// half its height and its upper edge; L_tot: skirt to vent; L_disk, L_band: both along z. Without a band:
/// D_st (skirt), D_mid (the largest row) and L_tot.
std::map<std::string, double> image_sizes(const Mesh& mesh, const std::vector<Vec3>& positions);

struct Strains {
  double mean = 0, largest = 0;
};
/// By part: "lines" (between confluence and skirt), "tape", "cloth" (springs along the yarns, weighted by the
/// area that each stands for). A part that the mesh has not is left out.
std::map<std::string, Strains> part_strains(const Mesh& mesh, const std::vector<Vec3>& positions);

}  // namespace ripstop
