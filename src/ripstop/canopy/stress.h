// What the parts of a canopy carry, and how far they are stretched.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop {

struct LineTension {
  int radial = 0;
  double free_tension = 0;     // in the middle of the free part [N]
  double largest_tension = 0;  // anywhere between confluence and its end on the canopy [N]
};
std::vector<LineTension> line_tensions(const CanopyMesh& mesh, const std::vector<double>& spring_tensions);

/// Where the cloth carries most.
struct StressPeak {
  double von_mises = 0;  // [N/m]
  double strain = 0;     // largest spring strain of the cloth
  Vec3 place;            // of the cell with the highest von Mises value [m]
  std::string patch;
};
StressPeak stress_peak(const Mesh& mesh, const std::vector<Vec3>& positions,
                       const std::vector<CellStress>& stress);

struct Strains {
  double mean = 0, largest = 0;
};
/// By part: "lines" (between confluence and skirt), "tape", "cloth" (springs along the yarns, weighted by the
/// area that each stands for). A part that the mesh has not is left out.
std::map<std::string, Strains> part_strains(const CanopyMesh& mesh, const std::vector<Vec3>& positions);

}  // namespace ripstop
