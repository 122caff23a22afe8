// The report of `ripstop size`.
#pragma once

#include <filesystem>
#include <vector>

#include "ripstop/report/report.h"
#include "ripstop/run/sizing/size.h"

namespace ripstop::inline run {

/// Its numbers, the opening by every method, bill of materials and case; behind it the runs of --verify, from their
/// folders.
Report size_report(const SizeResult& result, const std::vector<std::filesystem::path>& runs);

}  // namespace ripstop::inline run
