// The hems of a surface.
#pragma once

#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

struct Hem {
  Vec3 from, to;
  Vec3 inward;  // in the plane of its triangle, across the edge, unit
};

/// The edges that belong to one triangle only, as the triangle turns, in the triangles' order. Where a coarser part of a
/// mesh meets a finer one, one long edge lies along two short ones: those are no hem.
std::vector<Hem> hems(const std::vector<Triangle>& surface);

}  // namespace ripstop::inline flow
