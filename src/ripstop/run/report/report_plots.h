// Plots of the report, from the tables in a run folder and over several runs.
#pragma once

#include <filesystem>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/output/csv.h"
#include "ripstop/report/report.h"

namespace ripstop::inline run {

/// As a screen shows it: of every stretch its least and its largest value.
ReportSeries thinned(ReportSeries series);

/// Of the rows of iterations.csv.
std::vector<ReportPlot> iteration_plots(const CsvTable& rows);
/// Of the rows of history.csv, history_low_pass.csv and balance.csv, which may have none.
std::vector<ReportPlot> opening_plots(const ReportRun& run, const CsvTable& history, const CsvTable& smooth,
                                      const CsvTable& balance);
/// Of canopies.csv, a curve for each canopy of a cluster: spread angles, riser loads, areas of the mouths. None without
/// this table.
std::vector<ReportPlot> canopy_plots(const std::filesystem::path& folder);
/// Those whose tables are there. Throws Error(bad_data) for a table without its columns.
std::vector<ReportPlot> plots_of(const ReportRun& run, const std::filesystem::path& folder);

/// Drag over speed if speeds differ, with the measured values of `resolved`, and the plots that all runs
/// have, in common axes.
std::vector<ReportPlot> comparison_plots(const std::vector<ReportRun>& runs, const Settings& resolved);

}  // namespace ripstop::inline run
