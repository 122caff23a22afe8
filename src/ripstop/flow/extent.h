// The smallest box about a surface, with sides along the axes.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

struct Extent {
  std::array<double, 3> low = {1e300, 1e300, 1e300}, high = {-1e300, -1e300, -1e300};  // [m]

  void add(Vec3 p) {
    const std::array<double, 3> at = {p.x, p.y, p.z};
    for (int a = 0; a < 3; ++a) low[a] = std::min(low[a], at[a]), high[a] = std::max(high[a], at[a]);
  }
  bool meets(const Extent& other) const {
    for (int a = 0; a < 3; ++a)
      if (low[a] > other.high[a] || high[a] < other.low[a]) return false;
    return true;
  }
  Vec3 lower() const { return {low[0], low[1], low[2]}; }
  Vec3 upper() const { return {high[0], high[1], high[2]}; }
};

inline Extent extent_of(const Triangle& t) {
  Extent extent;
  extent.add(t.a), extent.add(t.b), extent.add(t.c);
  return extent;
}

inline Extent extent_of(const std::vector<Triangle>& surface) {
  Extent extent;
  for (const Triangle& t : surface) extent.add(t.a), extent.add(t.b), extent.add(t.c);
  return extent;
}

}  // namespace ripstop::inline flow
