// Bounds on the cloth's largest frequency, and checks on a state. Internal to cloth/.
#pragma once

#include <vector>

#include "ripstop/cloth/layout.h"

namespace ripstop {

/// lambda_max of the diagonal block of the tangent stiffness, by node [N/m], tied nodes' handed to their
/// masters; likewise of the relative damping [N s/m]. See step_bound.
struct NodeStiffness {
  std::vector<double> stiffness, damping;
  double largest_strain = 0;
  int stretched_node = -1;
};
NodeStiffness node_stiffness(const Cloth& cloth, const ClothState& state);
/// As step_bound(cloth, state), whose node_stiffness() is known.
StepBound step_bound(const Cloth& cloth, const ClothState& state, const NodeStiffness& node);

/// Pressure and point forces over the free nodes, tied nodes' handed on.
struct AppliedLoad {
  double norm = 0;  // root sum of squares [N]
  Vec3 moment;      // about `pivot` [N m]
};
AppliedLoad applied_load(const Cloth& cloth, const ClothState& state, const Loads& loads, Vec3 pivot = {});

/// Throws Error(diverged) for positions that are not finite.
void check_health(const Cloth& cloth, const ClothState& state);

}  // namespace ripstop
