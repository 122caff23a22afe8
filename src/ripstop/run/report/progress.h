// Tables and shapes of a run folder while the run is on.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "ripstop/report/report.h"

namespace ripstop::inline run {

struct RunProgress {
  std::vector<ReportPlot> plots;
  std::optional<ShapeFiles> shape;  // the last one
};

/// Of a run, or of the part of a sweep, a curve or a flight that has written last. Files that are being replaced are
/// left out.
RunProgress progress_in(const std::filesystem::path& folder);

}  // namespace ripstop::inline run
