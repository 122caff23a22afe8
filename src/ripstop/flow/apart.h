// Whether surfaces and lines intersect rigid bodies.
#pragma once

#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

/// Whether the line from p to q passes through the triangle (Moeller and Trumbore 1997); one in its plane does not.
bool pierces(Vec3 p, Vec3 q, const Triangle& triangle);

/// Whether the surfaces of two bodies intersect.
bool intersect(const std::vector<Triangle>& a, const std::vector<Triangle>& b);

/// Whether the closed surface has the point inside, by the solid angle that it subtends there (Van Oosterom and Strackee
/// 1983).
bool encloses(const std::vector<Triangle>& closed, Vec3 point);

/// Throws Error(usage) where a surface intersects one of the rigid bodies, which are all but the first, or is in it.
void require_apart(const std::vector<Triangle>& canopy, const std::vector<FlowBody>& bodies);

}  // namespace ripstop::inline flow
