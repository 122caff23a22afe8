#include "ripstop/flow/apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/extent.h"

namespace ripstop::inline flow {
namespace {

bool cut(const Triangle& a, const Triangle& b) {
  return pierces(a.a, a.b, b) || pierces(a.b, a.c, b) || pierces(a.c, a.a, b) || pierces(b.a, b.b, a) ||
         pierces(b.b, b.c, a) || pierces(b.c, b.a, a);
}

/// The triangles that may touch the region `where`, with their extents.
std::vector<std::pair<Triangle, Extent>> near(const std::vector<Triangle>& surface, const Extent& where) {
  std::vector<std::pair<Triangle, Extent>> result;
  for (const Triangle& t : surface)
    if (const Extent extent = extent_of(t); extent.meets(where)) result.emplace_back(t, extent);
  return result;
}

}  // namespace

bool pierces(Vec3 p, Vec3 q, const Triangle& t) {
  const Vec3 way = q - p, u = t.b - t.a, v = t.c - t.a, across = cross(way, v), from = p - t.a;
  const double scale = dot(u, across);
  if (scale == 0) return false;  // along its plane
  const double first = dot(from, across) / scale;
  const Vec3 up = cross(from, u);
  const double second = dot(way, up) / scale, at = dot(v, up) / scale;
  return first >= 0 && second >= 0 && first + second <= 1 && at >= 0 && at <= 1;
}

bool intersect(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
  const Extent of_a = extent_of(a), of_b = extent_of(b);
  if (!of_a.meets(of_b)) return false;
  const auto some_of_b = near(b, of_a);
  for (const auto& [t, extent] : near(a, of_b))
    for (const auto& [other, other_extent] : some_of_b)
      if (extent.meets(other_extent) && cut(t, other)) return true;
  return false;
}

bool encloses(const std::vector<Triangle>& closed, Vec3 point) {
  double half = 0;  // of the solid angle
  for (const Triangle& t : closed) {
    const Vec3 a = t.a - point, b = t.b - point, c = t.c - point;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    half += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return half > std::numbers::pi;  // inside: 2 pi, outside: 0
}

void require_apart(const std::vector<Triangle>& canopy, const std::vector<FlowBody>& bodies) {
  if (canopy.empty() || bodies.size() < 2) return;
  const Extent of_canopy = extent_of(canopy);
  for (std::size_t n = 1; n < bodies.size(); ++n) {
    const FlowBody& body = bodies[n];
    const Extent extent = extent_of(body.surface);
    if (!extent.meets(of_canopy)) continue;
    const bool inside = std::any_of(canopy.begin(), canopy.end(), [&](const Triangle& t) {
      return extent_of(t).meets(extent) && encloses(body.surface, t.a);
    });
    if (!inside && !intersect(canopy, body.surface)) continue;
    throw QuantityError(
        ExitCode::usage,
        fmt::format(
            "flow: the canopy, which extends from z = {:.4g} to {:.4g} m, touches the body \"{}\" from "
            "z = {:.4g} to {:.4g} m; change the position of the body, such as its trailing distance",
            of_canopy.low[2], of_canopy.high[2], body.name, extent.low[2], extent.high[2]),
        {"the position of the body"});
  }
}

}  // namespace ripstop::inline flow
