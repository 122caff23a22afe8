// A cloth that is held at one point only can turn about it, and nothing but the loads can balance a moment
// there. Internal to cloth/.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/cloth/stability_limit.h"

namespace ripstop::inline cloth {

/// The point, when all fixed nodes coincide.
std::optional<Vec3> pivot_of(const Cloth& cloth, const ClothState& state);

/// Takes the turning about the pivot out of the velocities: v -= w x r with w = I^-1 sum m r x v.
void stop_turning(const Cloth& cloth, ClothState& state, const std::vector<Symmetric>& mass, Vec3 pivot);

/// Adds the smallest forces (root sum of squares) on the free nodes that cancel a moment about the pivot:
/// -t x r with t = G^-1 moment, G = sum (r^2 I - r r^T).
void cancel_moment(const Cloth& cloth, const ClothState& state, Vec3 moment, Vec3 pivot,
                   std::vector<Vec3>& force);

}  // namespace ripstop::inline cloth
