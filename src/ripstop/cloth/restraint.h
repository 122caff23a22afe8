// The forces that keep a cloth with one held point from turning about it.
#pragma once

#include <vector>

#include "ripstop/cloth/cloth.h"

namespace ripstop::inline cloth {

/// The moment of the loads about the only held point is cancelled by relax() with the smallest node forces: these, by
/// node [N]. Empty for a cloth that is held at several points.
std::vector<Vec3> pivot_restraint(const Cloth& cloth, const ClothState& state, const Loads& loads);

}  // namespace ripstop::inline cloth
