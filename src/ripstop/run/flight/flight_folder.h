// The folder of one flight: run.json, path.csv, shapes for ParaView, checkpoint, and at the end plots and result.json.
#pragma once

#include <filesystem>
#include <optional>

#include "ripstop/run/flight/flight.h"
#include "ripstop/run/run_folder.h"

namespace ripstop::inline run {

struct FlightFolderSettings {
  RunSettings run;
  int threads = 0;
  double checkpoint_every_s = 30;   // of wall time
  std::filesystem::path from = {};  // folder of a finished inflation from which the flight continues
};

/// Folder of the inflation that comes first, in that of its flight.
inline constexpr const char* opening_name = "opening";

/// run_flight() in a folder, from the start or from where it was killed. Nothing when the folder has the finished
/// flight, whose result.json is finished_result(folder). Throws as holds_run() and run_flight() do.
std::optional<FlightResult> run_flight_in(const FlightFolderSettings& settings, const Settings& resolved,
                                          FlightObserver& observer);

}  // namespace ripstop::inline run
