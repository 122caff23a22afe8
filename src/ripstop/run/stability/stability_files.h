// Tables and plots of a curve over the angle of attack.
#pragma once

#include <string>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/stability/stability.h"

namespace ripstop::inline run {

/// Coefficients with bars of one standard error over the angle of attack.
Plot stability_plot(const StabilityResult& result);

/// stability.csv, six_dof.csv (docs/guide/stability.md), result.json, and stability.svg and .png once there is a row. Throws Error(io).
void write_stability_files(ClaimedFolder& folder, const StabilityResult& result);

/// history.csv: force and moment about the confluence, step by step. Throws Error(io).
void write_angle_history(ClaimedFolder& folder, const FlowRecord& record);

}  // namespace ripstop::inline run
