#include "ripstop/run/flight/finished_flight.h"

#include <fmt/format.h>

#include "ripstop/case/cluster.h"
#include "ripstop/core/error.h"
#include "ripstop/run/json.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {

bool holds_flight(const std::filesystem::path& folder) {
  const std::optional<std::string> text = finished_result(folder);
  const auto json = text ? nlohmann::json::parse(*text, nullptr, false) : nlohmann::json();
  return json.is_object() && json.contains("descent_drag_coefficient");
}

FinishedFlight finished_flight(const std::filesystem::path& folder) {
  if (!holds_flight(folder)) refuse_unfinished(folder, "fly");
  FinishedFlight flight{folder, settings_of_run(folder),
                        from_json_text<FlightResult>(*finished_result(folder), "the result of a flight")};
  require_one_canopy(flight.resolved, "a descent, an export, a recovery or an opening load");
  if (!flight.result.coefficient || !flight.result.descent)
    throw Error(ExitCode::bad_data,
                fmt::format("{}: the flight has no coefficient in descent: {}; fly again with another start "
                            "or parachute",
                            folder.string(), flight.result.ended_by));
  flight.warnings = warnings_of_used({folder});
  return flight;
}

}  // namespace ripstop::inline run
