// Loads and strains of the parts of a canopy.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline canopy {

struct LineTension {
  int number = 0;  // of the line, from 1; of the apex line where `apex`
  bool apex = false;
  double free_tension = 0;     // in the middle of the free part [N]
  double largest_tension = 0;  // anywhere between confluence and its end on the canopy [N]
};
std::vector<LineTension> line_tensions(const CanopyMesh& mesh, const std::vector<double>& spring_tensions);

/// Load of a chain at its axial spring `at` of `count`, whose tension is `axial` [N]. `bending_fraction` of the
/// line's law is in two bending springs that lie over every axial one, but for one over the first and over the last,
/// and none over a single one; where the strain hardly changes along the chain all of them are under the same strain.
double chain_tension(double axial, double bending_fraction, std::size_t at, std::size_t count);

/// Strength is that of a strip so wide (ISO 13934-1) [m].
inline constexpr double strip_width = 0.05;

/// Where the cloth carries most, and how much of it carries. Stresses are means over a square of cloth as wide as
/// such a strip, or as much of it as there is: where a line pulls on a corner, those of cells grow without end as
/// cells shrink. Cloth that is gathered counts with its width as cut.
struct StressPeak {
  double von_mises = 0;  // [N/m]
  double strain = 0;     // largest spring strain of the cloth
  Vec3 place;            // of the cell about which von Mises is highest [m]
  std::string patch;
  double principal = 0;            // highest of the first principal forces [N/m]
  Vec3 principal_direction;        // of that, unit
  double warp = 0, weft = 0;       // highest along either yarn [N/m]
  double wrinkled = 0, slack = 0;  // shares of the cloth's area as cut, see Tautness
};
/// Yarn forces and states for the list of members of a result.
template <class Peak, class Visit>
void sewing_members(Peak& peak, Visit&& visit) {
  visit("max_principal_n_m", peak.principal);
  visit("max_principal_direction", peak.principal_direction);
  visit("max_warp_n_m", peak.warp);
  visit("max_weft_n_m", peak.weft);
  visit("wrinkled_share", peak.wrinkled);
  visit("slack_share", peak.slack);
}
/// Of every cell, the mean over a square of cloth as wide as the strip about it, per width as cut: without the spikes
/// of single cells in crumpled seams. Order and empty cells of `of_cells`.
std::vector<CellStress> strip_stress(const Mesh& mesh, const std::vector<Vec3>& positions,
                                     const std::vector<CellStress>& of_cells);
StressPeak stress_peak(const Mesh& mesh, const std::vector<Vec3>& positions,
                       const std::vector<CellStress>& of_cells);

struct Strains {
  double mean = 0, largest = 0;
};
/// By part: "lines" (between confluence and skirt), "tape", "cloth" (springs along the yarns, weighted by the area
/// that each represents). Parts that the mesh does not have are omitted.
std::map<std::string, Strains> part_strains(const CanopyMesh& mesh, const std::vector<Vec3>& positions);

}  // namespace ripstop::inline canopy
