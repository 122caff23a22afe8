// The files of a flow that was watched in time: history.csv and history.png, the wake as a series and a picture.
#pragma once

#include <string>

#include "ripstop/case/settings.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/output/plot.h"

namespace ripstop::inline run {

/// Drag with its mean so far, and the side forces, over time. Of a record with steps.
Plot history_plot(const std::string& title, const FlowRecord& record);

/// history.csv (forces and step by step in time), history.png (drag with its running mean), wake.pvd and wake/
/// (the middle plane at the last times), wake.png (speed in it). Throws Error(io).
void write_watch(ClaimedFolder& folder, const Settings& resolved, const FlowRecord& record);

}  // namespace ripstop::inline run
