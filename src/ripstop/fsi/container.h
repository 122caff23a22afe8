// The container of a canopy that opens while it leaves it.
#pragma once

#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop::inline fsi {

/// How a canopy leaves its container from skirt to vent.
struct ContainerPath {
  std::vector<double> time;   // from the start of the opening, increasing [s]
  std::vector<double> share;  // of the canopy's length that is outside by then, from 0 to 1, not decreasing

  /// Linear between the rows; the last share after them.
  double outside(double at) const;
};

/// Cloth in the container stays folded: it moves along the axis only. The container has no mass.
class Container {
 public:
  /// `folded`: positions of the nodes of `mesh` [m], the skirt at the smallest z of the cloth and the vent at the
  /// largest.
  Container(ContainerPath path, const Mesh& mesh, const std::vector<Vec3>& folded);

  /// Loads::guided at a time [s]: the nodes inside.
  std::vector<int> guided(double time) const;

 private:
  ContainerPath path_;
  std::vector<double> from_skirt_;  // share of the canopy's length, by node; below 0 for lines
};

}  // namespace ripstop::inline fsi
