// What a sweep leaves beside its runs: one table and plots over the first axis with numbers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/output/csv.h"
#include "ripstop/run/sweep.h"

namespace ripstop {

/// A row a run in the order of the points, those without a result too: varied keys, air, drag, sizes, loads,
/// iterations, wall time, folder, status ("converged", "not converged", "failed: ...", "waiting").
TextTable sweep_table(const std::vector<SweepAxis>& axes, const std::vector<SweepPoint>& points,
                      const std::vector<SweepRow>& rows);

/// drag, drag_area, drag_coefficient, diameters, iterations and wall_time as .svg and .png over the first
/// axis whose values are numbers, a line for every combination of the other axes. Nothing is drawn without
/// such an axis or without a result.
void write_sweep_plots(const std::filesystem::path& folder, const std::string& title,
                       const std::vector<SweepAxis>& axes, const std::vector<SweepPoint>& points,
                       const std::vector<SweepRow>& rows);

}  // namespace ripstop
