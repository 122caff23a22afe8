// The flow about one shape of the canopy: steady, or averaged in time.
#pragma once

#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/fsi/steady_state.h"

namespace ripstop::inline fsi {

/// Advances the flow about the surface as it lies. Until `in_full`, only until the drag has settled: a flow need not be
/// solved to its last digit while the shape still moves.
FlowField steady_flow(Flow& flow, Stopping stopping, bool in_full, const FlowReport& report);

/// Mean over an averaging window of the flow about the surface as it lies; its statistics replace state.window, its
/// steps `record`. Until `in_full`, the window has a third of the length and of the statistical weight.
FlowField averaged_flow(Flow& flow, const FlowProblem& problem, Watch window, bool in_full,
                        SteadyState& state, FlowRecord& record, const WatchReport& report);

}  // namespace ripstop::inline fsi
