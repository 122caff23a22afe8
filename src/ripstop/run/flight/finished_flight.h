// A free flight that has ended, read from its folder for further use of its coefficient in descent.
#pragma once

#include <filesystem>

#include "ripstop/case/settings.h"
#include "ripstop/run/flight/flight.h"

namespace ripstop::inline run {

struct FinishedFlight {
  std::filesystem::path folder;
  Settings resolved;
  FlightResult result;  // with a coefficient in descent
};

/// Whether the folder contains the finished run of ripstop fly. Throws as finished_result().
bool holds_flight(const std::filesystem::path& folder);
/// Throws Error(usage) for a folder without one, Error(bad_data) for a flight that failed or is too short for a mean.
FinishedFlight finished_flight(const std::filesystem::path& folder);

}  // namespace ripstop::inline run
