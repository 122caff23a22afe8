// A free flight in the report: shapes of the inflation and the descent on one time axis, the path, and plots.
#pragma once

#include <filesystem>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/fsi/flight_record.h"
#include "ripstop/report/report.h"

namespace ripstop::inline run {

/// Whether `run.values` are those of a flight.
bool is_flight(const ReportRun& run);
/// Plots of the rows of path.csv, without an inflation before.
std::vector<ReportPlot> flight_plots(const std::vector<FreeFlightRow>& rows);
/// Plots of the tables of a flight, also of one that has not ended. Throws Error(bad_data), Error(io).
std::vector<ReportPlot> flight_plots(const std::filesystem::path& folder);
/// Fills kind, head, plots and shape of a flight from its folder, and from that of the inflation in it. Throws
/// Error(bad_data) for tables and shapes that do not belong together.
void add_flight(ReportRun& run, const Settings& resolved, const std::filesystem::path& folder);

}  // namespace ripstop::inline run
