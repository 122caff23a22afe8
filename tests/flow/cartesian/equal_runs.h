// Runs of the built-in engine whose results are compared bit by bit.
#pragma once

#include <cstring>

#include "ripstop/flow/cartesian/cartesian.h"

namespace ripstop {

inline CartesianSettings with_threads(int threads, SmallEddies small_eddies = SmallEddies::wale) {
  CartesianSettings settings;
  settings.threads = threads;
  settings.small_eddies = small_eddies;
  return settings;
}

inline bool same_bits(const FlowField& a, const FlowField& b) {
  return a.pressure.size() == b.pressure.size() &&
         std::memcmp(a.pressure.data(), b.pressure.data(), a.pressure.size() * sizeof(double)) == 0 &&
         std::memcmp(a.velocity.data(), b.velocity.data(), a.velocity.size() * sizeof(Vec3)) == 0 &&
         a.porous_force == b.porous_force && a.momentum_deficit.z == b.momentum_deficit.z &&
         a.last.residual_p == b.last.residual_p && a.last.residual_u == b.last.residual_u;
}

}  // namespace ripstop
