// The runs of a porosity calibration as a sweep: the varied quantity, and the results as calibration points.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/calibration/porosity.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/table/table.h"
#include "ripstop/run/sweep/sweep.h"

namespace ripstop::inline run {

/// The rows of [[measured]] that have a drag, on the case's basis; may be none.
std::vector<MeasuredDrag> measured_drag(const Settings& resolved);

struct MeasuredFile {
  std::vector<MeasuredDrag> points;
  std::vector<std::string> understood;  // how each column was read
};

/// Speed, density and drag of a table: docs/guide/tables.md. Throws Error(bad_data) with file and line, Error(io).
MeasuredFile read_measured_drag(const std::filesystem::path& file,
                                const std::vector<table::ColumnChoice>& columns = {},
                                table::Decimal decimal = table::Decimal::automatic);

struct PorositySweep {
  PorosityKnob knob = PorosityKnob::gamma;
  std::vector<double> values;  // of the knob, rising
  double thickness = 1.2e-4;   // Ergun's t [m]
  int shifts = 3;              // places of the canopy within one cell along the flow
};
std::string knob_name(PorosityKnob knob);  // "gamma"

/// How far the canopy is shifted along the flow: evenly over one of the cells that it lies in [m].
std::vector<double> cell_shifts(const Settings& resolved, int shifts);

/// Throws Error(usage) for fewer than two values of the knob, which are too few for a calibration.
void require_slope(const PorositySweep& sweep);

/// Measured point, value of the knob and shift, the last the fastest. The cells stay where they are when the
/// canopy is shifted.
std::vector<SweepAxis> porosity_axes(const Settings& resolved, const PorositySweep& sweep,
                                     const std::vector<MeasuredDrag>& measured);
std::vector<PorosityTrial> porosity_trials(const Settings& resolved, const PorositySweep& sweep,
                                           const std::vector<SweepRow>& rows);

}  // namespace ripstop::inline run
