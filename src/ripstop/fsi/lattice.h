// A lattice of points about the cloth that collects sums of the values near each point and returns their shares.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "ripstop/core/checked_int.h"
#include "ripstop/core/vec3.h"

namespace ripstop::inline fsi {

inline constexpr double most_along = 1e6;  // from each other, in boxes or points of a lattice along an axis
inline constexpr double most_room = 1e8;   // boxes or points

inline std::string cloth_too_far() {
  return "the cloth has no finite position, or is larger than any canopy: its motion has diverged; try a "
         "smaller time step or more damping";
}

inline std::size_t room_of(const std::array<int, 3>& count) {
  return checked_int(double(count[0]) * count[1] * count[2], 0, most_room, cloth_too_far);
}

/// Sums on the points of a lattice about some places, each value shared among the eight points about it and read off in
/// the same shares.
template <class Value>
class Lattice {
 public:
  /// Values are at these places and no others.
  Lattice(const std::vector<Vec3>& places, double spacing) : spacing_(spacing) {
    std::array<int, 3> high;
    first_.fill(std::numeric_limits<int>::max()), high.fill(std::numeric_limits<int>::min());
    for (const Vec3& x : places) {
      const std::array<double, 3> at = scaled(x);
      for (int a = 0; a < 3; ++a) {
        const int lower = checked_int(std::floor(at[a]), -most_along, most_along, cloth_too_far);
        first_[a] = std::min(first_[a], lower), high[a] = std::max(high[a], lower);
      }
    }
    if (places.empty()) return;
    for (int a = 0; a < 3; ++a) count_[a] = high[a] - first_[a] + 2;
    points_.resize(room_of(count_));
  }

  /// visit(value on a point, share) for the eight points.
  template <class Visit>
  void about(Vec3 x, const Visit& visit) {
    const std::array<double, 3> at = scaled(x);
    std::array<int, 3> lower;
    std::array<double, 3> part;
    for (int a = 0; a < 3; ++a) {
      lower[a] = checked_int(std::floor(at[a]), -most_along, most_along, cloth_too_far) - first_[a];
      part[a] = at[a] - std::floor(at[a]);
    }
    for (int n = 0; n < 8; ++n) {
      double share = 1;
      std::size_t point = 0;
      for (int a = 2; a >= 0; --a) point = point * count_[a] + lower[a] + (n >> a & 1);
      for (int a = 0; a < 3; ++a) share *= n >> a & 1 ? part[a] : 1 - part[a];
      visit(points_[point], share);
    }
  }

 private:
  std::array<double, 3> scaled(Vec3 x) const {
    const Vec3 at = x / spacing_;
    return {at.x, at.y, at.z};
  }

  double spacing_;
  std::array<int, 3> first_, count_{};
  std::vector<Value> points_;
};

}  // namespace ripstop::inline fsi
