// The load of the next iteration of the steady loop, from the answers of the flow so far.
#pragma once

#include <vector>

#include "ripstop/fsi/coupling_settings.h"
#include "ripstop/fsi/steady_state.h"

namespace ripstop::inline fsi {

/// Updates pressure and residual traction of `state` with the flow's `answer` to them: accelerated while the answers
/// converge, averaged where they jitter or are means in time. `area` of every cell as cut weighs the pressures [m2].
void update_load(SteadyState& state, const ClothLoad& answer, double drag_change,
                 const std::vector<double>& area, const CouplingSettings& settings);

/// From the next iteration on, the flow is averaged in time.
void begin_windows(SteadyState& state, const CouplingSettings& settings);

}  // namespace ripstop::inline fsi
