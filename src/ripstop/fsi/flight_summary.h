// Statistics of a free flight: rate of descent, glide and oscillation with their standard errors.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/fsi/flight_record.h"

namespace ripstop::inline fsi {

/// A mean and its standard error. Absent where the flight is too short to have one.
struct MeanWithError {
  double mean = 0;
  std::optional<double> standard_error;
};

struct FlightSummary {
  double start_up = 0;                       // end of it, from which all means are taken [s]
  MeanWithError descent;                     // mean vertical speed of the payload, positive down [m/s]
  MeanWithError glide;                       // mean horizontal over mean vertical speed, relative to the air
  std::optional<MeanWithError> oscillation;  // mean of the peaks of the angle from the vertical [deg]
  std::optional<MeanWithError> largest_oscillation;  // the largest peak; its error is that of one peak [deg]
  std::optional<MeanWithError> period;               // [s]
  double mean_angle = 0;            // of the line from payload to canopy with the vertical, in the mean [deg]
  std::optional<double> roundness;  // of the path of the tilt, smaller over larger axis: 0 plane, 1 cone
  int peaks = 0;
  double largest_attack = 0, mean_attack = 0;  // [deg]
  double largest_load = 0;                     // of the lines on the payload [N]
};

/// Throws Error(usage) for fewer than two rows.
FlightSummary summarise_flight(const std::vector<FreeFlightRow>& rows);

}  // namespace ripstop::inline fsi
