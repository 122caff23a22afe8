// A coupled inflation with a payload that has ended, read from its folder so that a flight continues from it.
#pragma once

#include <filesystem>

#include "ripstop/case/settings.h"
#include "ripstop/fsi/opening_end.h"

namespace ripstop::inline run {

struct FinishedOpening {
  Settings resolved;
  OpeningEnd end;
  FlowProblem flow;              // in which the air was computed
  std::filesystem::path at_end;  // folder with the state of the air
};

/// Folder of the state of the air in that of an inflation with a payload.
inline constexpr const char* end_folder = "end";

/// Throws Error(usage) for a folder without a finished coupled inflation with a payload, and for one whose air was not
/// kept; Error(bad_data) for damaged files.
FinishedOpening finished_opening(const std::filesystem::path& folder);

}  // namespace ripstop::inline run
