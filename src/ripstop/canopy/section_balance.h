// Sections across the canopy axis: the force of cloth and lines through a section must equal the air load on the part
// beyond it. Stress and load are computed independently, so this is a check of both.
#pragma once

#include <vector>

#include "ripstop/cloth/cloth.h"

namespace ripstop::inline canopy {

/// Means over the sections z = constant near a height: forces along z on the part below by the part above,
/// moments about the axis x = y = 0. Near a height is within `reach` of it, nearer ones with more weight (a
/// raised cosine): one section falls between the rows of one cell and on the nodes of the next.
struct SectionBalance {
  double cloth_force = 0;  // of the stress field [N]
  double cord_force = 0;   // of lines, tapes and other springs outside the lattices [N]
  double seam_force = 0;   // of cloth on the cords that it is tied to, handed on within a cord's segment [N]
  double air_force = 0;    // of the load on the nodes above [N]
  double moment = 0;       // of cloth, cords and seams [N m]
  double air_moment = 0;   // [N m]

  double gap() const { return cloth_force + cord_force + seam_force - air_force; }  // [N]
};

/// At equilibrium the gap is nothing and moment = air_moment, up to the square of the cells' size over the
/// reach. `cloth` is made of `mesh`; `load` is the force on every node; height and reach > 0 in m.
SectionBalance section_balance(const Mesh& mesh, const Cloth& cloth, const ClothState& state,
                               const std::vector<Vec3>& load, double height, double reach);

/// The largest |gap| over the air's force among sections from a fifth to four fifths of the cloth's height.
double largest_section_gap(const Mesh& mesh, const Cloth& cloth, const ClothState& state,
                           const std::vector<Vec3>& load);

}  // namespace ripstop::inline canopy
