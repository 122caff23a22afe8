// The opening of a case: its mesh, its pressure, and the problem that the solver takes.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "ripstop/case/settings.h"
#include "ripstop/fsi/opening.h"

namespace ripstop::inline cases {

/// Where the pressure came from.
struct LoadSource {
  std::string text;                        // for people: "steady run runs/a: 396.1 N"
  std::optional<double> steady_drag;       // that the pressure is chosen for [N]
  std::vector<std::string> warnings = {};  // of the steady run
};

/// The case on a mesh that can be folded, with the line segments and the compression that [inflation] gives.
Case opening_case(const Case& given);

/// Load model of [inflation]. Throws Error(usage) unless it gives either a pressure or a drag coefficient.
LoadSource load_source(const Settings& opening);

/// For settings returned by opening_case(); dp follows from the equilibrium of a coarse mesh when a steady drag is
/// given. `alive` is called at intervals; its exceptions are passed to the caller.
InflationProblem opening_problem(const Settings& opening, const LoadSource& source, int threads,
                                 const std::function<void()>& alive = {});

}  // namespace ripstop::inline cases
