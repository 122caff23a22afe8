#include "ripstop/run/opening/opening_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "ripstop/core/error.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/steady/steady_folder.h"

namespace ripstop {

namespace fs = std::filesystem;

OpeningRecord opening_record(const fs::path& folder, const Settings& resolved) {
  const std::optional<std::string> text = finished_result(folder);
  const auto result = text ? nlohmann::json::parse(*text, nullptr, false) : nlohmann::json();
  if (!result.is_object() || !result.contains("steady_load_n"))
    throw Error(ExitCode::usage,
                fmt::format("{}: holds no finished run of ripstop inflate", folder.string()));
  const Settings run = settings_of_run(folder);
  const double here = nominal_area(resolved.parachute()), there = nominal_area(run.parachute());
  if (std::abs(here - there) > 1e-6 * here)
    throw Error(ExitCode::usage,
                fmt::format("{}: is an opening of another parachute: S0 is {:g} m2 there and {:g} m2 "
                            "here",
                            folder.string(), there, here));
  if (!run.inflation().reefing.empty())
    throw Error(
        ExitCode::usage,
        fmt::format("{}: is a reefed opening, whose lines were cut at times: its drag area is none over the "
                    "way through the air",
                    folder.string()));
  const double speed = run.flow().speed_m_s;
  const double q = 0.5 * run.flow().density_kg_m3 * speed * speed;
  const fs::path smooth = folder / "history_low_pass.csv";
  const CsvTable table = read_csv(fs::exists(smooth) ? smooth : folder / "history.csv");
  const std::vector<double> time = table.column("time_s");
  const std::vector<double> load = table.column(fs::exists(smooth) ? "load_n" : "load_mean_n");
  OpeningRecord record;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double distance = speed * time[i];
    if (!record.distance.empty() && distance <= record.distance.back()) continue;
    record.distance.push_back(distance);
    record.drag_area.push_back(std::max(0.0, load[i] / q));
  }
  record.steady_drag_area = result.at("steady_load_n").get<double>() / q;
  if (record.distance.empty() || !(record.steady_drag_area > 0))
    throw Error(ExitCode::bad_data, fmt::format("{}: its history has no load", folder.string()));
  return record;
}

}  // namespace ripstop
