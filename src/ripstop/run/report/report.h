// From run folders to the report: reads what `steady`, `inflate` and `sweep` left there, computes nothing anew but
// the bill of materials.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/case.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/report/report.h"

namespace ripstop {

/// Its name in a run folder.
inline constexpr const char* report_name = "report.html";

/// Of a run whose result.json is written, sealed or not. Throws Error(usage) for a folder without one, Error(bad_data)
/// for files that cannot be read.
ReportRun report_of(const std::filesystem::path& folder);
/// The same of all runs of a sweep's folder that have a result, or of the one run of any other; all of them ended
/// and whole, else Error(usage) or Error(bad_data).
std::vector<ReportRun> reports_of(const std::filesystem::path& folder);

/// One page of all these runs, compared where there are several. `resolved`:
/// the case whose measured values stand beside them.
Report report_on(std::vector<ReportRun> runs, const std::string& title);

/// report.html of a run under way, before its folder is sealed. What went wrong is returned as text: a finished
/// computation is worth more than its picture. Throws Error(io) only.
std::string write_run_report(ClaimedFolder& folder);

/// report.html of a finished run or sweep in its own folder, of which everything else is checked first and sealed
/// again; of several, or where `out` is given, at `out`. Returns the path. Throws Error(usage) where `out` is
/// something else than a report, or a folder holds no finished run, Error(bad_data) for damaged ones, Error(io).
std::filesystem::path write_report(const std::vector<std::filesystem::path>& folders,
                                   const std::filesystem::path& out = {});

}  // namespace ripstop
