// Loops whose turns do not depend on each other, shared by the threads of a team.
#pragma once

#include <algorithm>
#include <cstddef>

#include "ripstop/core/thread_team.h"

namespace ripstop::inline fsi {

/// visit(n) for every n below `count`; on one thread without a team. `visit` must not throw. The threads take short runs
/// of n in turn: neighbours, for example the cells of one fold, often need a long time together.
template <class Visit>
void each_in_parts(ThreadTeam* team, std::size_t count, const Visit& visit) {
  constexpr std::size_t run = 64;
  const auto work = [&](int rank, int parts) {
    for (std::size_t first = run * rank; first < count; first += run * parts)
      for (std::size_t n = first; n < std::min(first + run, count); ++n) visit(n);
  };
  if (!team) return work(0, 1);
  team->run([&](int rank) { work(rank, team->size()); });
}

}  // namespace ripstop::inline fsi
