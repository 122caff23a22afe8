#include "ripstop/run/descent/flown.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/reasons.h"
#include "ripstop/core/words.h"

namespace ripstop::inline run {
namespace {

std::vector<FlownDrag> read_flown_drags() {
  const std::filesystem::path file = data_directory() / "examples/flown.json";
  try {
    const auto data = nlohmann::json::parse(read_file(file));
    const std::string made =
        fmt::format("{}, {}", data.at("made_by").get<std::string>(), data.at("made_on").get<std::string>());
    std::vector<FlownDrag> all;
    for (const auto& row : data.at("flights"))
      all.push_back({row.at("family"), row.at("type"), row.at("canopy_material"), row.at("drag_coefficient"),
                     row.at("standard_error"), row.at("axial_drag_coefficient"), row.at("half_swings"),
                     made});
    return all;
  } catch (const nlohmann::json::exception& error) {
    throw Error(ExitCode::bad_data,
                fmt::format("{}: not the table of flights: {}", file.string(), json_reason(error)));
  }
}

/// Ratios of the coefficients in descent to the axial ones, of the flights that `fits` accepts.
template <class Fits>
std::vector<double> ratios(Fits&& fits) {
  std::vector<double> all;
  for (const FlownDrag& row : flown_drags())
    if (fits(row)) all.push_back(row.drag_coefficient / row.axial_coefficient);
  return all;
}

}  // namespace

const std::vector<FlownDrag>& flown_drags() {
  static const std::vector<FlownDrag> all = read_flown_drags();
  return all;
}

std::vector<std::string> exchanged_parachutes(double drogue_area, double main_area) {
  if (drogue_area <= main_area) return {};
  const auto [drogue, main] = rounded_apart(drogue_area, main_area);
  return {
      fmt::format("the drogue has a drag area of {} m2, more than the {} m2 of the main: exchange the two "
                  "parachutes",
                  drogue, main)};
}

DescentDrag descent_drag(const Settings& resolved, const DragCoefficient& drag) {
  const double low = drag.value * (1 - drag.uncertainty), high = drag.value * (1 + drag.uncertainty);
  const std::string own = fmt::format("+- {:.0f} %", 100 * drag.uncertainty);
  if (drag.basis != "axial") return {low, high, own};
  const std::string type(resolved.parachute().canopy.family().type);
  const std::string& cloth = resolved.parachute().canopy_material;
  const auto same_type = [&](const FlownDrag& row) { return row.type == type; };
  const char* which = "computed flights of this family and cloth";
  std::vector<double> found =
      ratios([&](const FlownDrag& row) { return same_type(row) && row.cloth == cloth; });
  if (found.empty()) which = "computed flights of this family with another cloth", found = ratios(same_type);
  if (found.empty())
    which = "computed flights of other families", found = ratios([](const FlownDrag&) { return true; });
  const auto [least, most] = std::minmax_element(found.begin(), found.end());
  std::string times;
  if (*least < 1) times = fmt::format("the lower end also times {:.2f}", *least);
  if (*most > 1) times += fmt::format("{}the upper end also times {:.2f}", times.empty() ? "" : ", ", *most);
  return {low * std::min(1.0, *least), high * std::max(1.0, *most),
          times.empty() ? own : fmt::format("{}; {}, for the motion in descent ({})", own, times, which)};
}

}  // namespace ripstop::inline run
