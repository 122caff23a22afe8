#include "ripstop/flow/hems.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace ripstop::inline flow {
namespace {

using Corner = std::tuple<double, double, double>;
using Edge = std::pair<Corner, Corner>;

Corner corner(Vec3 v) {
  return {v.x, v.y, v.z};
}

Vec3 vector_of(const Corner& c) {
  return {std::get<0>(c), std::get<1>(c), std::get<2>(c)};
}

/// Of those that one triangle has alone, the long edges with two short ones along them, and those.
std::set<Edge> joined(const std::map<Edge, int>& uses) {
  std::map<Corner, std::vector<Corner>> single;
  for (const auto& [edge, count] : uses) {
    if (count == 1) single[edge.first].push_back(edge.second), single[edge.second].push_back(edge.first);
  }
  std::set<Edge> joined;
  for (const auto& [p, ends] : single) {
    for (const Corner& q : ends) {
      if (!(p < q)) continue;
      for (const Corner& m : ends) {
        const Vec3 a = vector_of(p), b = vector_of(q), c = vector_of(m);
        const std::vector<Corner>& beyond = single[q];
        if (m == q || norm(c - 0.5 * (a + b)) > 0.3 * norm(b - a) ||
            std::find(beyond.begin(), beyond.end(), m) == beyond.end()) {
          continue;
        }
        joined.insert({p, q});
        joined.insert(std::minmax(p, m));
        joined.insert(std::minmax(m, q));
      }
    }
  }
  return joined;
}

}  // namespace

std::vector<Hem> hems(const std::vector<Triangle>& surface) {
  const auto each_edge = [&](auto&& visit) {
    for (const Triangle& t : surface) {
      const Vec3 v[] = {t.a, t.b, t.c};
      for (int e = 0; e < 3; ++e) {
        const Vec3 p = v[e], q = v[(e + 1) % 3];
        if (corner(p) != corner(q)) visit(p, q, v[(e + 2) % 3], Edge(std::minmax(corner(p), corner(q))));
      }
    }
  };
  std::map<Edge, int> uses;
  each_edge([&](Vec3, Vec3, Vec3, const Edge& edge) { ++uses[edge]; });
  const std::set<Edge> none = joined(uses);
  std::vector<Hem> hems;
  each_edge([&](Vec3 p, Vec3 q, Vec3 third, const Edge& edge) {
    if (uses[edge] != 1 || none.contains(edge)) return;
    const Vec3 inside = third - p, across = inside - dot(inside, q - p) / dot(q - p, q - p) * (q - p);
    hems.push_back({p, q, norm(across) > 0 ? across / norm(across) : Vec3{}});
  });
  return hems;
}

}  // namespace ripstop::inline flow
