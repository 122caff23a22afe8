// --reef SHARE:SECONDS of `ripstop load` and `ripstop export`.
#pragma once

#include <string>

#include "ripstop/run/opening/load.h"

namespace ripstop::cli {

/// Throws Error(usage) for another form; the values are checked where they are used.
ReefedStage parse_reefed_stage(const std::string& text);

}  // namespace ripstop::cli
