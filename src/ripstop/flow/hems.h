// The hems of a surface.
#pragma once

#include <utility>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow.h"

namespace ripstop {

/// The edges that belong to one triangle only, as the triangle turns, in the triangles' order. Where a coarser part of a
/// mesh meets a finer one, one long edge lies along two short ones: those are no hem.
std::vector<std::pair<Vec3, Vec3>> hems(const std::vector<Triangle>& surface);

}  // namespace ripstop
