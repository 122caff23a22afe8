// The kinds of boundary of a flow domain: one row each. A new kind is a file in cartesian/, like far_field.cpp or
// outlet_still_air.cpp, and its row in cartesian/boundary.cpp.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

namespace cartesian {
class SideBoundary;
class OutletBoundary;
}  // namespace cartesian

struct BoundaryRecord {
  std::string word;     // of flow.sides or flow.outlet
  std::string meaning;  // for the reference, one clause
  /// How the built-in engine makes it; empty: not for this part of the box.
  std::function<std::unique_ptr<cartesian::SideBoundary>()> sides;
  std::function<std::unique_ptr<cartesian::OutletBoundary>()> outlet;
};

/// All kinds. A record stays where it is when others are added.
const std::vector<std::unique_ptr<BoundaryRecord>>& boundaries();
void add_boundary(BoundaryRecord record);

/// The sides that a problem's box has: those it names, or the far field where its stream is not along +z.
Sides sides_of(const FlowProblem& problem);

}  // namespace ripstop::inline flow
