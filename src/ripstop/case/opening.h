// The opening of a case: its mesh, its pressure, and the problem that the solver takes.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "ripstop/case/case.h"
#include "ripstop/fsi/inflation.h"

namespace ripstop {

/// Where the pressure came from.
struct LoadSource {
  std::string text;                   // for people: "steady run runs/a: 396.1 N"
  std::optional<double> steady_drag;  // that the pressure is chosen for [N]
};

/// The case on a mesh that can be folded, with the line segments and the compression that [inflation] gives.
Case opening_case(const Case& given);

/// What [inflation] asks for. Throws Error(usage) unless that is a pressure or a drag
/// coefficient, and not both.
LoadSource load_source(const Case& given);

/// Of what opening_case() returns; dp from the equilibrium of a coarse mesh when a steady drag is asked for.
/// `alive` is called now and then on the way; what it throws goes on to the caller.
InflationProblem opening_problem(const Case& opening, const LoadSource& source, int threads,
                                 const std::function<void()>& alive = {});

}  // namespace ripstop
