#include "ripstop/run/sizing/check.h"

#include <fmt/format.h>

#include "ripstop/case/assemble.h"
#include "ripstop/case/tape.h"
#include "ripstop/core/error.h"
#include "ripstop/core/words.h"
#include "ripstop/fsi/lines_apart.h"
#include "ripstop/run/json.h"
#include "ripstop/run/margins.h"
#include "ripstop/run/opening/load.h"
#include "ripstop/run/steady/warnings.h"

namespace ripstop::inline run {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const std::vector<Source>& sources, const Json& written) {
  Json list = Json::array();
  for (const Source& source : sources)
    list.push_back({{"key", source.key},
                    {"value", written.at(pointer_of(source.key))},
                    {"unit", source.unit},
                    {"given", source.given},
                    {"from", source.from}});
  return list;
}

/// Of the highest design load, as ripstop load has it. A family without a known drag coefficient has the usual one.
LoadUncertainty uncertainty_of(const Settings& resolved) {
  const bool known = resolved.inflation().drag_coefficient.has_value() ||
                     experience(resolved.parachute()).drag_coefficient.high > 0;
  return load_uncertainty(known ? opening_drag_coefficient(resolved, {})
                                : DragCoefficient{0, "assumed", usual_drag_uncertainty, ""});
}

/// As in ripstop load, on a level path, where every speed has a load.
std::string heavy_payload_caution(const Settings& resolved, double speed) {
  if (!resolved.payload().mass_kg) return {};
  LoadRequest request;
  request.payload_mass = *resolved.payload().mass_kg, request.speed = speed;
  request.path_angle = 0, request.descent = false;
  try {
    return run_load(resolved, request).design_load_caution;
  } catch (const Error& error) {  // ripstop load refuses this case too
    if (error.code() != ExitCode::usage) throw;
    return {};
  }
}

}  // namespace

CheckResult run_check(const Settings& resolved) {
  if (!resolved.written().bodies.empty()) {
    const CanopyMesh mesh = parachute_mesh(resolved);
    require_lines_apart(mesh, mesh.start, flow_problem(resolved).bodies);
  }
  std::vector<std::string> warnings = resolved.deprecations();
  for (const std::string& text : case_warnings(resolved)) warnings.push_back(text);
  const UsualOpening opening = usual_opening(resolved.written());
  const LoadUncertainty uncertainty = uncertainty_of(resolved);
  const double load = (1 + uncertainty.value) * opening.load;
  for (const std::string& text : margin_warnings(load_margins(resolved, load)))
    warnings.push_back(
        fmt::format("in an opening at {} m/s ({}), with the infinite-mass load of {} N, which contains the "
                    "uncertainty of {:.0f} %: {}; for another speed use ripstop load --speed",
                    rounded(opening.speed, 3), opening.from, rounded(load), 100 * uncertainty.value, text));
  if (const std::string caution = heavy_payload_caution(resolved, opening.speed); !caution.empty())
    warnings.push_back(
        fmt::format("in an opening at {} m/s ({}): {}", rounded(opening.speed, 3), opening.from, caution));
  return {summarize(resolved), resolved.sources(), std::move(warnings), resolved};
}

std::string to_json(const CheckResult& result) {
  const Json written = Json::parse(case_json(result.resolved));
  Json report = {{"valid", true}, {"problems", Json::array()}};
  report["warnings"] = result.warnings;
  report.update(Json(result.summary));
  report["sources"] = to_json(result.sources, written);
  report["case"] = written;
  return report.dump(2) + "\n";
}

std::string to_json(const std::vector<Problem>& problems) {
  Json report = {{"valid", false}, {"problems", Json::array()}};
  for (const Problem& problem : problems) {
    Json& last = report["problems"].emplace_back(Json(problem));
    last["text"] = to_text(problem);
  }
  return report.dump(2) + "\n";
}

}  // namespace ripstop::inline run
