// A cold run is first solved on cells twice as wide, and starts from that shape, load and flow.
#pragma once

#include <memory>

#include "ripstop/core/file.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop::inline run {

/// End of the run on the coarser cells.
struct CoarseStart {
  SteadyState state;
  TemporaryFolder flow{"coarse"};

  /// Into a run before its first iteration: all but the flow.
  void give(SteadyState& to) const;
};

/// Null for a case whose coarser cells would not resolve its canopy, without coupling.coarse_start, and for a state
/// that is not cold. A failure of the run on the coarser cells is reported to the observer, and gives null too.
std::unique_ptr<CoarseStart> coarse_start(const Settings& resolved, const SteadySolver& solver,
                                          const SteadyState& state, SteadyObserver& observer,
                                          const SteadySettings& settings);

}  // namespace ripstop::inline run
