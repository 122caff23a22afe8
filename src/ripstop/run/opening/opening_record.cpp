#include "ripstop/run/opening/opening_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "ripstop/case/cluster.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/opening/handbook.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/steady/steady_folder.h"

namespace ripstop::inline run {

namespace fs = std::filesystem;

namespace {

/// Stream of an opening: of constant speed, or that of a payload which decelerates.
struct Stream {
  struct State {
    double distance = 0, dynamic_pressure = 0;  // [m], [Pa]
  };
  double deployment_speed = 0, density = 0;       // [m/s], [kg/m3]
  std::optional<double> height;                   // of the deployment [m]
  std::vector<double> time, speed, path, fallen;  // rows of air.csv of a payload; empty: the stream is steady

  State at(double t) const {
    if (time.empty()) return {deployment_speed * t, 0.5 * density * deployment_speed * deployment_speed};
    const auto above = std::lower_bound(time.begin(), time.end(), t);
    const auto i = static_cast<std::size_t>(std::min(above, time.end() - 1) - time.begin());
    const double begin = i == 0 ? 0 : time[i - 1];
    const double share = std::clamp((t - begin) / (time[i] - begin), 0.0, 1.0);
    const auto between = [&](const std::vector<double>& of, double first) {
      const double low = i == 0 ? first : of[i - 1];
      return low + share * (of[i] - low);
    };
    const double v = between(speed, deployment_speed);
    const double here = density * (height ? density_ratio(*height, between(fallen, 0)) : 1);
    return {between(path, 0), 0.5 * here * v * v};
  }
};

Stream stream_of(const Settings& run, const fs::path& folder) {
  Stream stream{run.flow().speed_m_s, run.flow().density_kg_m3, run.flow().height_m, {}, {}, {}, {}};
  if (run.inflation().mass != InflationSettings::Mass::payload) return stream;
  if (!fs::exists(folder / "air.csv"))
    throw Error(ExitCode::bad_data,
                fmt::format("{}: an opening with a payload requires air.csv with its speed and distance",
                            folder.string()));
  const CsvTable table = read_csv(folder / "air.csv");
  stream.time = table.column("time_s"), stream.speed = table.column("speed_m_s");
  stream.path = table.column("path_m"), stream.fallen = table.column("height_lost_m");
  return stream;
}

/// result.json of the opening in a folder, which must be one of this parachute.
nlohmann::json opening_result(const fs::path& folder, const Settings& resolved) {
  const std::optional<std::string> text = finished_result(folder);
  auto result = text ? nlohmann::json::parse(*text, nullptr, false) : nlohmann::json();
  if (!result.is_object() || !result.contains("peak_load_n")) refuse_unfinished(folder, "inflate");
  const Settings run = settings_of_run(folder);
  require_one_canopy(run, "an opening load");
  const double here = nominal_area(resolved.parachute()), there = nominal_area(run.parachute());
  if (std::abs(here - there) > 1e-6 * here)
    throw Error(
        ExitCode::usage,
        fmt::format(
            "{}: is an opening of a different parachute: S0 is {:g} m2 in that run and {:g} m2 in this case",
            folder.string(), there, here));
  return result;
}

/// A uniform pressure does not contain the air that limits the load, and a canopy that has not filled has not had its
/// peak.
std::string limit_of(const Settings& run, const nlohmann::json& result) {
  if (run.inflation().air != AirModel::coupled)
    return "uniform-pressure inflation: " + limit_of_damping(run.inflation());
  const auto filled = result.find("filled");
  return filled != result.end() && filled->is_boolean() && filled->get<bool>()
             ? ""
             : "the run does not contain the filling of a folded canopy, hence it may lack the peak";
}

/// Of the members in the margins of an opening, over its `load` [N].
MemberShares shares_of(const nlohmann::json& result, double load) {
  MemberShares shares;
  const auto margins = result.find("margins");
  if (!(load > 0) || margins == result.end() || !margins->is_object()) return shares;
  for (const nlohmann::json& m : margins->at("members")) {
    const std::string member = m.at("member");
    double* share = member == "cloth"             ? &shares.cloth
                    : member == "tape"            ? &shares.tape
                    : member == "riser"           ? &shares.riser
                    : member.starts_with("line ") ? &shares.line
                                                  : nullptr;
    if (share) *share = std::max(*share, m.at("load").get<double>() / load);
  }
  return shares;
}

}  // namespace

OpeningRecord opening_record(const fs::path& folder, const Settings& resolved) {
  const nlohmann::json result = opening_result(folder, resolved);
  const Settings run = settings_of_run(folder);
  if (!run.inflation().reefing.empty())
    throw Error(ExitCode::usage,
                fmt::format("{}: is a reefed opening, with lines cut at given times: its drag area is not a "
                            "function of distance; use an opening without reefing",
                            folder.string()));
  OpeningRecord record;
  record.limit = limit_of(run, result);
  const fs::path smooth = folder / "history_low_pass.csv";
  const bool low_passed = fs::exists(smooth) && result.contains("low_pass_peak_load_n");
  record.shares = shares_of(result, result.at(low_passed ? "low_pass_peak_load_n" : "peak_load_n"));
  const CsvTable table = read_csv(fs::exists(smooth) ? smooth : folder / "history.csv");
  const std::vector<double> time = table.column("time_s");
  const std::vector<double> load = table.column(fs::exists(smooth) ? "load_n" : "load_mean_n");
  const Stream stream = stream_of(run, folder);
  for (std::size_t i = 0; i < time.size(); ++i) {
    const Stream::State now = stream.at(time[i]);
    if (!record.distance.empty() && now.distance <= record.distance.back()) continue;
    record.distance.push_back(now.distance);
    record.drag_area.push_back(std::max(0.0, load[i] / now.dynamic_pressure));
  }
  const std::size_t last = std::max<std::size_t>(1, record.drag_area.size() / 5);
  for (std::size_t i = record.drag_area.size() - std::min(last, record.drag_area.size());
       i < record.drag_area.size(); ++i)
    record.steady_drag_area += record.drag_area[i] / double(last);
  if (record.distance.empty() || !(record.steady_drag_area > 0))
    throw Error(ExitCode::bad_data, fmt::format("{}: the load history is zero", folder.string()));
  return record;
}

ComputedFilling computed_filling(const fs::path& folder, const Settings& resolved) {
  const nlohmann::json result = opening_result(folder, resolved);
  const auto number = [&](const char* key) {
    const auto found = result.find(key);
    return found != result.end() && found->is_number() ? found->get<double>() : 0;
  };
  const Stream stream = stream_of(settings_of_run(folder), folder);
  const double speed = stream.speed.empty() ? stream.deployment_speed : stream.speed.front();
  const ComputedFilling filling{number("filling_time_s") * speed / nominal_diameter(resolved.parachute()),
                                number("area_growth_exponent")};
  if (!(filling.constant > 0 && filling.exponent > 0))
    throw Error(
        ExitCode::usage,
        fmt::format("{}: has no filling time: the canopy has not filled (increase "
                    "inflation.duration_s), or the inflation is one under uniform pressure (inflation.air)",
                    folder.string()));
  return filling;
}

}  // namespace ripstop::inline run
