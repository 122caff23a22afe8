// The drag area of a computed opening over the distance through the air, for openings with another mass.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/run/margins.h"

namespace ripstop::inline run {

/// A canopy fills over about the same distance through the air at any speed. An opening at one speed is
/// therefore transferred by distance and not by time.
struct OpeningRecord {
  std::vector<double> distance, drag_area;  // rising [m], [m2]
  double steady_drag_area = 0;              // of its end [m2]
  MemberShares shares;                      // of its load
  std::string limit;  // why its load does not replace a larger one in a design; empty: it may
};

/// Load over dynamic pressure of the finished `ripstop inflate` in a folder, low-passed where the run was. Throws
/// Error(usage) for a folder without one or one of another parachute, Error(bad_data) for a damaged one.
OpeningRecord opening_record(const std::filesystem::path& folder, const Settings& resolved);

/// Filling of such an opening, see filling_of(): n = v t_f / D0 with the speed v at its start, and j of
/// C_D S = (t / t_f)^j times the drag area when it is full.
struct ComputedFilling {
  double constant = 0, exponent = 0;
};
/// Throws as opening_record(), and Error(usage) for an opening that has not filled.
ComputedFilling computed_filling(const std::filesystem::path& folder, const Settings& resolved);

}  // namespace ripstop::inline run
