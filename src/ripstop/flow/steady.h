// From a flow under way to one at rest: pieces, settling, averaging, a second start; the
// same for every engine.
#pragma once

#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

/// Share of the drag by which it will still change if the iterations continue, estimated from the drag of all
/// iterations about one shape; infinite for fewer than 30. Means over the last three equal blocks, of 25 iterations at
/// most, change by a and then b. They approach their limit with the ratio q = b / a, so that b q / (1 - q) is left. At
/// least 0.6 is assumed for q, at most 0.95, and for b at least 0.4 a, because b is small where the drag is at an
/// extremum.
double drag_left(const std::vector<double>& drags);

/// Advances until the residual is reached and the drag has settled as `stopping` requires, until the drag has settled
/// early if `stopping` accepts that, or until the iterations are used up. A flow that diverges from an earlier field or
/// a guess is repeated once from the uniform stream.
/// FlowField::last counts iterations from the beginning of this call (of its last start). Throws the exceptions of
/// Flow::advance(), Error(usage) for an average longer than the run.
FlowField solve_to_rest(Flow& flow, const Stopping& stopping, const FlowReport& report = {});

/// The whole way for one use: start, then to rest by FlowProblem::stopping.
FlowField solve(FlowEngine& engine, const FlowProblem& problem, const FlowReport& report = {});

}  // namespace ripstop::inline flow
