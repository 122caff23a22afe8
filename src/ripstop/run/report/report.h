// From run folders to the report: reads the files of `steady`, `inflate` and `sweep`, and computes only the
// bill of materials.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/case.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/report/report.h"

namespace ripstop::inline run {

/// Its name in a run folder.
inline constexpr const char* report_name = "report.html";

/// Of a run whose result.json is written, sealed or not. Throws Error(usage) for a folder without one, Error(bad_data)
/// for files that cannot be read.
ReportRun report_of(const std::filesystem::path& folder);
/// The same of all runs of a sweep's folder that have a result, or of the one run of any other; all of them ended
/// and whole, else Error(usage) or Error(bad_data).
std::vector<ReportRun> reports_of(const std::filesystem::path& folder);

/// One page of all these runs, compared if there are several. `resolved`: the case whose measured values are
/// shown with them.
Report report_on(std::vector<ReportRun> runs, const std::string& title);

/// report.html of a run, before its folder is sealed. An error is returned as text, because a finished computation
/// must not fail for its report. Throws Error(io) only.
std::string write_run_report(ClaimedFolder& folder);

/// report.html of a finished run or sweep in its own folder, whose other files are checked first and sealed
/// again; of several, or if `out` is given, at `out`. Returns the path. Throws Error(usage) if `out` is not a report,
/// or a folder contains no finished run, Error(bad_data) for damaged ones, Error(io).
std::filesystem::path write_report(const std::vector<std::filesystem::path>& folders,
                                   const std::filesystem::path& out = {});

}  // namespace ripstop::inline run
