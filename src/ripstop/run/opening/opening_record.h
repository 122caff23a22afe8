// The drag area of a computed opening over the way through the air, for openings behind another mass.
#pragma once

#include <filesystem>
#include <vector>

#include "ripstop/case/settings.h"

namespace ripstop {

/// A canopy fills over about the same way through the air whatever the speed: what an opening at one speed says, is
/// carried over by the way and not by the time.
struct OpeningRecord {
  std::vector<double> distance, drag_area;  // rising [m], [m2]
  double steady_drag_area = 0;              // of its end [m2]
};

/// Load over dynamic pressure of the finished `ripstop inflate` in a folder, low-passed where the run was. Throws
/// Error(usage) for a folder without one or one of another parachute, Error(bad_data) for a damaged one.
OpeningRecord opening_record(const std::filesystem::path& folder, const Settings& resolved);

/// How such an opening fills: n and j of C_D S = (s / (n D0))^j times the drag area of its end, s the way through the air.
struct FittedFilling {
  double constant = 0, exponent = 0;
};
/// n is where the drag area first reaches that of the end, j a least squares fit of its logarithm until then. Throws
/// Error(usage) where the drag area is that of the end from the first row on.
FittedFilling fit_filling(const OpeningRecord& record, double nominal_diameter);

}  // namespace ripstop
