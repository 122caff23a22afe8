#include "ripstop/run/steady/finished_steady.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {

double drag_uncertainty(const SteadyIteration& last) {
  const double drag = last.fluid_force;
  // Of a mean over time its standard error counts, not how far the drag swings about it.
  const double of_mean = last.in_time ? last.drag_error : last.drag_deviation;
  const double shares[] = {last.drag_change, of_mean / drag, std::abs(last.nodal_load / drag - 1),
                           std::abs(last.momentum_deficit / drag - 1)};
  double largest = 0;
  for (const double share : shares)
    if (std::isfinite(share)) largest = std::max(largest, share);
  return largest;
}

namespace {

bool is_of_steady(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  return json.is_object() && json.contains("drag_n") && json.contains("coupling_iterations");
}

void require_converged(const SteadyResult& result, const std::string& where) {
  if (result.converged) return;
  throw Error(ExitCode::bad_data,
              fmt::format("{}the steady run has not converged and its drag cannot be used; increase "
                          "coupling.max_iterations and {} it",
                          where.empty() ? "" : where + ": ", where.empty() ? "repeat" : "continue"));
}

}  // namespace

FinishedSteady finished_steady(const Settings& resolved, const SteadyResult& result) {
  require_converged(result, "");
  return {{},
          resolved,
          result,
          mass_of_canopies(resolved),
          drag_uncertainty(result.last),
          warnings_if_usable(end_of_run(to_json(result), "steady run"))};
}

FinishedSteady finished_steady(const std::filesystem::path& folder) {
  const std::optional<std::string> text = finished_result(folder);
  if (std::filesystem::is_regular_file(folder))
    throw Error(
        ExitCode::usage,
        fmt::format("{}: is a file; the folder of a finished run is required: compute one with ripstop "
                    "steady {} --out runs/{}, and give that folder",
                    folder.string(), folder.string(), folder.stem().string()));
  if (!text || !is_of_steady(*text)) refuse_unfinished(folder, "steady");
  const SteadyResult result = steady_result_from_json(*text);
  require_converged(result, folder.string());
  const Settings resolved = settings_of_run(folder);
  FinishedSteady run{folder, resolved, result, mass_of_canopies(resolved)};
  run.result.last = final_state(folder).iterations.back();
  run.drag_uncertainty = drag_uncertainty(run.result.last);
  run.warnings = warnings_of_used({folder});
  return run;
}

}  // namespace ripstop::inline run
