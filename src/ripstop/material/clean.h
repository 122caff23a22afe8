// A bench's record made fit for fitting: in order, without slack, up to failure. Whatever is left out is said.
#pragma once

#include <string>
#include <vector>

#include "ripstop/material/record.h"

namespace ripstop {

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
  std::vector<std::string> trimmed;  // what was left out or moved, one sentence each
};

/// Sorts a few points out of order, takes off the load cell's offset and the slack, and leaves out what follows the
/// highest force. The pull starts where nothing, followed by a quartic through zero, fits the points up to
/// 30 % of the peak best: the toe compensation of ASTM D638 annex A1 with a curve in place of its straight
/// line, and the slack as evidence too. Strain is on the stated length. A slip is a fall of the force, clear of
/// noise and
/// above 2 % of the peak, that is taken back by half at least, or a stretch without rise between two that
/// rise. Throws Error(bad_data) with file,
/// line and reason for a record that cannot be one pull: too few points, more than 5 % of them going back,
/// forces that are negative or only fall, a jump by a factor that looks like a change of units, a strain at
/// failure outside 0.25 % to 350 %.
CleanRecord clean_record(const TensileRecord& record, LoadKind kind);

}  // namespace ripstop
