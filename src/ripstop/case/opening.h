// The opening of a case: its mesh, its pressure, and the problem that the solver takes.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "ripstop/case/payload.h"
#include "ripstop/case/settings.h"
#include "ripstop/fsi/opening.h"

namespace ripstop::inline cases {

/// The air at line stretch, or at the start of an inflation.
struct OpeningAir {
  double height = 0, density = 0;  // above sea level [m], [kg/m3]
  std::string from;
};
/// The one rule for all commands: the air of the case (flow.density_kg_m3, flow.height_m or the row of [[measured]]),
/// with the standard height of a density without a height; or the standard atmosphere at a `height` in its place, and
/// at the `ground` where flow.height_m is below it.
OpeningAir opening_air(const Settings& resolved, std::optional<double> height = {},
                       std::optional<double> ground = {});

/// Where the pressure came from.
struct LoadSource {
  std::string text;                        // for people: "steady run runs/a: 396.1 N"
  std::optional<double> steady_drag;       // that the pressure is chosen for [N]
  std::vector<std::string> warnings = {};  // of the steady run
};

/// The case on a mesh that can be folded, with the line segments and the compression that [inflation] gives.
Case foldable_case(const Case& given);

/// That of an opening: flow.speed_m_s is payload.deployment_speed_m_s, unless an option, or a key set in Python, has
/// replaced flow.speed_m_s. Then both are that speed, and the tape remains that of the case. Throws Error(usage) if the
/// case gives neither, or a speed above fastest_stream.
Case opening_case(const Case& given);

/// The airspeed at which the opening begins, with its source. For settings from opening_case().
DeploymentSpeed opening_speed(const Settings& opening);

/// Load model of [inflation]. Throws Error(usage) unless it gives either a pressure or a drag coefficient.
LoadSource load_source(const Settings& opening);

/// For settings returned by opening_case(); dp follows from the equilibrium of a coarse mesh when a steady drag is
/// given. `alive` is called at intervals; its exceptions are passed to the caller.
InflationProblem opening_problem(const Settings& opening, const LoadSource& source, int threads,
                                 const std::function<void()>& alive = {});

}  // namespace ripstop::inline cases
