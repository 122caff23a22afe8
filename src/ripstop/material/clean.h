// Preparation of a record of a testing machine for the fit: sorted, without slack, up to failure. All removed
// points are reported.
#pragma once

#include <string>
#include <vector>

#include "ripstop/material/record.h"

namespace ripstop::inline material {

enum class LoadKind { per_width, whole };  // cloth and tape [N/m], line [N]

struct CleanRecord {
  std::string name;              // the file's name
  double orientation = 0;        // [deg]
  double length = 0, width = 0;  // [m]
  std::vector<double> strain;    // rising, from 0 to the failure peak
  std::vector<double> load;      // [N/m] or [N]
  double failure_strain = 0;
  double failure_load = 0;
  double slack = 0;                  // [m] taken off the displacement
  double force_offset = 0;           // [N] taken off the force
  double noise = 0;                  // standard deviation of the load about its neighbours, as `load`
  bool breaks = true;                // the force falls after its highest value
  std::string slip;                  // where a grip seems to have slipped; empty: nowhere
  std::string late;                  // that much of the record follows its highest force; empty: it does not
  std::vector<std::string> trimmed;  // removed or moved points, one sentence each
};

/// Sorts a few points out of order, subtracts the offset of the load cell and the slack, and removes the points after
/// the maximum force. The test starts where zero force, followed by a quartic through zero, fits the points up to 30
/// % of the peak best: the toe compensation of ASTM D638 annex A1 with a curve instead of its straight line, which
/// also uses the points in the slack. Strain is on the stated length. A slip is a drop of the force above the noise
/// and above 2 % of the peak that recovers by half at least, or a plateau between two rises. Throws Error(bad_data)
/// with file, line and reason for a record that is not a single test: too few points, more than 5 % of them
/// decreasing, forces that are negative or only decrease, a jump by a factor that looks like a change of units, a
/// strain at failure outside 0.25 % to 350 %.
CleanRecord clean_record(const TensileRecord& record, LoadKind kind);

}  // namespace ripstop::inline material
