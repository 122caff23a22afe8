// Bodies that a flow cannot have.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/extent.h"

namespace ripstop::inline flow {
namespace {

/// Whether the line from p to q passes through the triangle (Moeller and Trumbore 1997).
bool pierces(Vec3 p, Vec3 q, const Triangle& t) {
  const Vec3 way = q - p, u = t.b - t.a, v = t.c - t.a, across = cross(way, v), from = p - t.a;
  const double scale = dot(u, across);
  if (scale == 0) return false;  // along its plane
  const double first = dot(from, across) / scale;
  const Vec3 up = cross(from, u);
  const double second = dot(way, up) / scale, at = dot(v, up) / scale;
  return first >= 0 && second >= 0 && first + second <= 1 && at >= 0 && at <= 1;
}

bool cut(const Triangle& a, const Triangle& b) {
  return pierces(a.a, a.b, b) || pierces(a.b, a.c, b) || pierces(a.c, a.a, b) || pierces(b.a, b.b, a) ||
         pierces(b.b, b.c, a) || pierces(b.c, b.a, a);
}

/// The triangles of a body that may touch the region `where`, with their extents.
std::vector<std::pair<Triangle, Extent>> near(const FlowBody& body, const Extent& where) {
  std::vector<std::pair<Triangle, Extent>> result;
  for (const Triangle& t : body.surface)
    if (const Extent extent = extent_of(t); extent.meets(where)) result.emplace_back(t, extent);
  return result;
}

bool overlap(const FlowBody& a, const FlowBody& b) {
  const Extent of_a = extent_of(a.surface), of_b = extent_of(b.surface);
  if (!of_a.meets(of_b)) return false;
  const auto some_of_b = near(b, of_a);
  for (const auto& [t, extent] : near(a, of_b))
    for (const auto& [other, other_extent] : some_of_b)
      if (extent.meets(other_extent) && cut(t, other)) return true;
  return false;
}

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
      if (overlap(bodies[m], bodies[n]))
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
