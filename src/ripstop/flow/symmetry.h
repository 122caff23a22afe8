// Mirror symmetry of a flow about two planes through the axis of its box.
#pragma once

#include <string>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

/// Why cells, boundaries and stream of a problem are not their own mirror images in the planes x = 0 and y = 0, as a
/// clause; empty: they are. The bodies are left to the caller.
std::string why_not_mirrored(const FlowProblem& problem);

/// Throws Error(usage) with that reason where a quarter is to be solved.
void check_quarter(const FlowProblem& problem);

}  // namespace ripstop::inline flow
