// Files of a sweep in addition to its runs: one table, the same as result.json, and plots over the first axis
// with numbers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/output/csv.h"
#include "ripstop/run/sweep/sweep.h"

namespace ripstop::inline run {

/// A row a run in the order of the points, those without a result too: varied keys, the members of
/// SteadyResult that are columns, status ("converged", "not converged", "failed: ...", "waiting"), folder.
TextTable sweep_table(const std::vector<SweepAxis>& axes, const std::vector<SweepPoint>& points,
                      const std::vector<SweepRow>& rows);

/// The same with all of every run's result: result.json.
std::string sweep_json(const std::string& title, const std::vector<SweepAxis>& axes,
                       const std::vector<SweepPoint>& points, const std::vector<SweepRow>& rows);

/// drag, drag_area, drag_coefficient, diameters, iterations and wall_time as .svg and .png over the first
/// axis whose values are numbers, a line for every combination of the other axes. Nothing is drawn without
/// such an axis or without a result.
void write_sweep_plots(const std::filesystem::path& folder, const std::string& title,
                       const std::vector<SweepAxis>& axes, const std::vector<SweepPoint>& points,
                       const std::vector<SweepRow>& rows);

/// sweep.csv, result.json and the plots of a sweep whose runs have ended, its seal, and report.html where there is a
/// result. Returns the text of result.json.
std::string finish_sweep(const std::filesystem::path& folder, const std::vector<SweepAxis>& axes,
                         const std::vector<SweepPoint>& points, const std::vector<SweepRow>& rows);

}  // namespace ripstop::inline run
