// The flow about one shape of the canopy: steady, or averaged in time.
#pragma once

#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/fsi/steady_state.h"

namespace ripstop::inline fsi {

/// Mean over an averaging window of the flow about the surface as it lies; its statistics replace state.window, its
/// steps `record`. Until `in_full`, the window has a third of the length and of the statistical weight.
FlowField averaged_flow(Flow& flow, const FlowProblem& problem, Watch window, bool in_full,
                        SteadyState& state, FlowRecord& record, const WatchReport& report);

}  // namespace ripstop::inline fsi
