// How far a canopy is from being the same after a turn about its axis, and in the mirror.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ripstop/mesh/mesh.h"

namespace ripstop {

/// Largest distance [m] between a node of a periodic patch and its image, where `turns` turns make a whole one
/// and column 0 lies in the mirror's plane, y = 0.
inline double departure_from_symmetry(const Mesh& mesh, const std::vector<Vec3>& x, int turns) {
  const double turn = 2 * std::numbers::pi / turns, c = std::cos(turn), s = std::sin(turn);
  double worst = 0;
  for (const Patch& patch : mesh.patches) {
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 0; column < patch.columns; ++column) {
        const Vec3 p = x[patch.node(row, column)];
        const Vec3 turned = x[patch.node(row, (column + patch.columns / turns) % patch.columns)];
        const Vec3 mirrored = x[patch.node(row, (patch.columns - column) % patch.columns)];
        worst = std::max(worst, norm(turned - Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z}));
        worst = std::max(worst, norm(mirrored - Vec3{p.x, -p.y, p.z}));
      }
    }
  }
  return worst;
}

}  // namespace ripstop
