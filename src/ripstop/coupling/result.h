// The numbers a user asks of a converged canopy.
#pragma once

#include <string>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/parachute/mesh.h"

namespace ripstop {

/// Diameters of circles with the same area as the outline of the whole cloth and of the skirt, seen along z
/// [m].
struct CanopySize {
  double projected_diameter = 0, projected_area = 0;
  double skirt_diameter = 0;
  double length = 0;  // from the skirt's mean plane to the farthest cloth downstream [m]
};
CanopySize canopy_size(const Mesh& mesh, const std::vector<Vec3>& positions);

struct LineTension {
  int radial = 0;
  double free_tension = 0;     // in the middle of the free part [N]
  double largest_tension = 0;  // anywhere between confluence and its end on the canopy [N]
};
std::vector<LineTension> line_tensions(const Mesh& mesh, const std::vector<double>& spring_tensions);

/// Where the cloth carries most.
struct StressPeak {
  double von_mises = 0;  // [N/m]
  double strain = 0;     // largest spring strain of the cloth
  Vec3 place;            // of the cell with the highest von Mises value [m]
  std::string patch;
};
StressPeak stress_peak(const Mesh& mesh, const std::vector<Vec3>& positions,
                       const std::vector<CellStress>& stress);

}  // namespace ripstop
