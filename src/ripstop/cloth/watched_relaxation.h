// relax() with the shape of the moment, for a view that cannot wait for the equilibrium.
#pragma once

#include <functional>
#include <vector>

#include "ripstop/cloth/cloth.h"

namespace ripstop::inline cloth {

/// Called during a relaxation, outside of its threads; an exception ends the relaxation. `positions` returns those of
/// all nodes, also while a sector of the canopy is solved; it is valid during the call only.
using RelaxWatch =
    std::function<void(const RelaxProgress& progress, const std::function<std::vector<Vec3>()>& positions)>;

RelaxResult watched_relax(ClothState& state, const Cloth& cloth, const Loads& loads,
                          const RelaxOptions& options, ThreadTeam& team, const RelaxWatch& watch);

}  // namespace ripstop::inline cloth
