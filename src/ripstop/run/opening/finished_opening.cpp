#include "ripstop/run/opening/finished_opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "ripstop/case/opening.h"
#include "ripstop/core/error.h"
#include "ripstop/core/hash.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/steady/steady_folder.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

void require_payload(const fs::path& folder) {
  const auto refuse = [&](const char* why, const char* remedy) {
    throw Error(ExitCode::usage, fmt::format("{}: {}; {}", folder.string(), why, remedy));
  };
  const std::optional<std::string> text = finished_result(folder);
  const auto json = text ? nlohmann::json::parse(*text, nullptr, false) : nlohmann::json();
  if (!json.is_object() || !json.contains("peak_load_n"))
    refuse("contains no finished run of ripstop inflate",
           "compute one with inflation.air = \"coupled\" and inflation.mass = \"payload\"");
  if (!json.contains("speed_at_end_m_s"))
    refuse("is an inflation without a payload, from whose end no flight can continue",
           "set inflation.air = \"coupled\" and inflation.mass = \"payload\"");
  if (!fs::is_directory(folder / end_folder))
    refuse("has no state of the air at its end (it is of an earlier version, or one of several samples)",
           "compute the inflation again with --fresh");
}

InflationState state_of(const fs::path& folder) {
  const std::string bytes = read_sealed(folder / "checkpoint");
  return inflation_state_from_bytes(bytes.substr(std::min(bytes.size(), bytes.find('\n') + 1)));
}

}  // namespace

FinishedOpening finished_opening(const fs::path& folder) {
  require_payload(folder);
  const Settings resolved = settings_of_run(folder);
  const std::unique_ptr<Opening> opening =
      make_opening(with_engine(resolved, opening_problem(resolved, load_source(resolved), 1)));
  const auto air = read_rows<AirRow>(folder / "air.csv");
  const std::vector<double> load = read_csv(folder / "history.csv").column("load_mean_n");
  if (load.empty() || air.empty())
    throw Error(ExitCode::bad_data, fmt::format("{}: history.csv or air.csv has no rows", folder.string()));
  return {resolved, end_of_opening(*opening, state_of(folder), load.back(), air),
          opening->problem().air->flow, folder / end_folder};
}

}  // namespace ripstop::inline run
