// Bodies that a flow cannot have.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/apart.h"
#include "ripstop/flow/extent.h"

namespace ripstop::inline flow {
namespace {

/// A screen may reach into the walls of a duct, but nothing may reach out of open faces.
void check_inside(const FlowProblem& problem, const FlowBody& body) {
  if (body.surface.empty()) return;
  const Extent extent = extent_of(body.surface);
  const Vec3 a = problem.grid.origin, b = problem.grid.origin + problem.grid.size;
  const std::array<double, 3> low = {a.x, a.y, a.z}, high = {b.x, b.y, b.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (axis < 2 && problem.sides == Sides::slip) continue;
    if (extent.low[axis] >= low[axis] && extent.high[axis] <= high[axis]) continue;
    throw QuantityError(
        ExitCode::usage,
        fmt::format(
            "flow: body \"{}\" extends from {} = {:.4g} to {:.4g} m, which must lie within {:.4g} to "
            "{:.4g} m, the extent of the domain; change the position of the body or the size of the domain",
            body.name, "xyz"[axis], extent.low[axis], extent.high[axis], low[axis], high[axis]),
        {"the position of the body", "the size of the domain"});
  }
}

}  // namespace

void check_bodies(const FlowProblem& problem) {
  const std::vector<FlowBody>& bodies = problem.bodies;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    check_inside(problem, bodies[n]);
    for (std::size_t m = 0; m < n; ++m) {
      if (bodies[m].name == bodies[n].name)
        throw Error(
            ExitCode::usage,
            fmt::format("flow: bodies {} and {} have the same name \"{}\"; each needs a different name",
                        m + 1, n + 1, bodies[n].name));
      if (intersect(bodies[m].surface, bodies[n].surface))
        throw QuantityError(
            ExitCode::usage,
            fmt::format(
                "flow: the surfaces of the bodies \"{}\" and \"{}\" intersect; they must be apart: change, "
                "for one of them, the position of the body",
                bodies[m].name, bodies[n].name),
            {"the position of the body"});
    }
  }
}

}  // namespace ripstop::inline flow
