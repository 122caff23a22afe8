// The content of result.json, case.toml and run.json, as values and tables of the report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/report/report.h"

namespace ripstop::inline run {

/// Plain values of a result.json into `run.values`; every list of rows and every group of values in it, whatever
/// its name, is a table. Throws Error(bad_data) naming `file`.
void add_result(ReportRun& run, const std::string& json, const std::filesystem::path& file);

/// Keys of the values that the page of a run of this kind begins with.
std::vector<std::string> headline_of(const std::string& kind);

ReportTable bill_table(const Settings& resolved);
/// A first warning of a result that must not be used.
void add_unusable(ReportRun& run);
/// Values of the case that may be left out, and where each comes from, by run.json.
ReportTable sources_table(const Settings& resolved, const std::filesystem::path& run_json);
/// Names and values of run.json, but for the case in it.
void add_provenance(ReportRun& run, const std::filesystem::path& run_json);

/// Quantities that are numbers in every run, side by side.
ReportTable comparison_table(const std::vector<ReportRun>& runs);

/// The number under a key of `run.values`; not-a-number where there is none.
double number_of(const ReportRun& run, const std::string& key);

}  // namespace ripstop::inline run
