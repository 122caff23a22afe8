// What is read off a load history.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/inflation/inflation.h"

namespace ripstop {

struct InflationSummary {
  double steady_load = 0;                // mean over the last fifth of the run [N]
  double unsteadiness = 0;               // standard deviation of the rows there, over steady_load
  std::optional<double> inflation_time;  // absent: still outside the band at the end [s]
  /// Of the low-passed load, absent without one; they hardly depend on single swings, as inflation_time does.
  std::optional<double> filling_time;  // first at the steady load [s]
  std::optional<double>
      settling_time;            // from then on within 10 % in the mean square over two cutoff periods [s]
  double smooth_peak = 0;       // of the low-passed history; 0: none asked for [N]
  double smooth_peak_time = 0;  // [s]
};

/// Until the row's mean stays within 10 % of the steady load: [NFM]. With a low-pass, of
/// the low-passed history.
InflationSummary summarise(const std::vector<HistoryRow>& rows, double low_pass_hz);

/// Whether the steady load may be called one: the load has stayed within 10 % of it for the last tenth of the
/// opening's `duration` [s] at least, half of what it is the mean of.
bool settled(const InflationSummary& summary, double duration);

/// Two passes, forth and back, of a second-order Butterworth filter: no delay, half the power twice
/// (-6 dB) at `cutoff_hz`. `interval` [s] between equally spaced values. Throws Error(usage) at or
/// above half their rate.
std::vector<double> low_pass(const std::vector<double>& values, double interval, double cutoff_hz);

}  // namespace ripstop
