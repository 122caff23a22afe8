// C_a from the measured opening of a reference parachute.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "ripstop/fsi/opening.h"
#include "ripstop/fsi/summary.h"

namespace ripstop::inline calibration {

struct DampingTarget {
  double peak = 0;                       // measured [N]
  std::optional<double> inflation_time;  // measured [s]
};

/// One opening with one C_a.
struct DampingTrial {
  double damping = 0;          // C_a [N s/m3]
  double peak = 0;             // low-passed if the case requests it, else over every step [N]
  double peak_time = 0;        // of the same [s]
  double every_step_peak = 0;  // [N]
  double steady_load = 0;      // [N]
  std::optional<double> inflation_time;
  double misfit = 0;  // see misfit_of()
};

struct DampingSearch {
  double from = 4, to = 16;  // C_a [N s/m3]
  int points = 7;            // first, at equal ratios
  int refinements = 4;       // then, by the golden section about the best of them
};

struct DampingCalibration {
  std::vector<DampingTrial> trials;  // by damping
  DampingTrial best;
  bool at_edge = false;  // the best lies at an end of the range: it is none
};

/// Root mean square of the relative errors of peak and, where it was measured and the trial settled,
/// inflation time; a trial that did not settle where a time was measured counts as 100 % wrong in it.
double misfit_of(const DampingTrial& trial, const DampingTarget& target);

/// The whole opening. Deterministic. Throws the exceptions of Opening, and those of `alive`, which is called
/// at intervals.
DampingTrial open_with(double damping, const InflationProblem& problem,
                       const std::function<void()>& alive = {});

/// Throws Error(usage) for an empty range or too few points, before any opening is run.
void check_search(const DampingSearch& search);

/// Smallest misfit over C_a. Throws Error(usage) for an empty range.
DampingCalibration calibrate_damping(const DampingTarget& target, const DampingSearch& search,
                                     const std::function<DampingTrial(double damping)>& open,
                                     const std::function<void(const DampingTrial&)>& report = {});

}  // namespace ripstop::inline calibration
