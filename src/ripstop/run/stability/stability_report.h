// The report of a curve over the angle of attack.
#pragma once

#include <filesystem>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/run/stability/stability.h"

namespace ripstop::inline run {

/// report.html: the coefficients, the trim angles, and the shape of the steady run in the folder `axis`. A failure is
/// returned as text, because a finished computation must not fail for its report. Throws Error(io) only.
std::string write_stability_report(ClaimedFolder& folder, const StabilityResult& result,
                                   const std::filesystem::path& axis);

}  // namespace ripstop::inline run
