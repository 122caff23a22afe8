// Loops whose turns do not depend on each other, shared by the threads of a team.
#pragma once

#include <cstddef>

#include "ripstop/core/thread_team.h"

namespace ripstop::inline fsi {

/// visit(n) for every n below `count`; on one thread without a team. `visit` must not throw.
template <class Visit>
void each_in_parts(ThreadTeam* team, std::size_t count, const Visit& visit) {
  const auto work = [&](int rank, int parts) {
    const IndexRange part = part_of(static_cast<int>(count), rank, parts);
    for (int n = part.begin; n < part.end; ++n) visit(static_cast<std::size_t>(n));
  };
  if (!team) return work(0, 1);
  team->run([&](int rank) { work(rank, team->size()); });
}

}  // namespace ripstop::inline fsi
