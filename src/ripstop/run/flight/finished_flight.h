// A free flight that has ended, read from its folder for further use of its coefficient in descent.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/run/flight/flight.h"

namespace ripstop::inline run {

struct FinishedFlight {
  std::filesystem::path folder;
  Settings resolved;
  FlightResult result;                     // with a coefficient in descent
  std::vector<std::string> warnings = {};  // of the flight, after its folder
};

/// Whether the folder contains the finished run of ripstop fly. Throws as finished_result().
bool holds_flight(const std::filesystem::path& folder);
/// Throws Error(usage) for a folder without one, Error(bad_data) for a flight that failed, is too short for a
/// mean or must not be used.
FinishedFlight finished_flight(const std::filesystem::path& folder);

}  // namespace ripstop::inline run
