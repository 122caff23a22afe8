// From a flow under way to one at rest: pieces, settling, averaging, a second start; the
// same for every engine.
#pragma once

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

/// Advances until the residual is reached, the drag has settled if `stopping` accepts that, or the iterations are
/// used up. A flow that diverges from an earlier field or a guess is repeated once from the uniform stream.
/// FlowField::last counts iterations from the beginning of this call (of its last start). Throws the exceptions of
/// Flow::advance(), Error(usage) for an average longer than the run.
FlowField solve_to_rest(Flow& flow, const Stopping& stopping, const FlowReport& report = {});

/// The whole way for one use: start, then to rest by FlowProblem::stopping.
FlowField solve(FlowEngine& engine, const FlowProblem& problem, const FlowReport& report = {});

}  // namespace ripstop::inline flow
