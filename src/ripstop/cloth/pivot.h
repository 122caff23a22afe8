// A cloth that is held at one point only can turn about it, and nothing but the loads can balance a moment
// there. Internal to cloth/.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/cloth/layout.h"

namespace ripstop {

/// The point, when all fixed nodes coincide.
std::optional<Vec3> pivot_of(const Cloth& cloth, const ClothState& state);

/// Takes the turning about the pivot out of the velocities: v -= w x r with w = I^-1 sum m r x v.
void stop_turning(const Cloth& cloth, ClothState& state, const std::vector<double>& mass, Vec3 pivot);

/// Sum of squares of the node forces t x r that best fit a moment: what a force residual keeps, however well
/// the cloth's shape is in balance, when the loads have that moment about the pivot [N2].
double turning_force_squared(const Cloth& cloth, const ClothState& state, Vec3 moment, Vec3 pivot);

}  // namespace ripstop
