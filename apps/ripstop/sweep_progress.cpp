#include "sweep_progress.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "case_options.h"
#include "json_option.h"
#include "margins.h"
#include "number_option.h"
#include "progress.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/flow.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/sweep/sweep_files.h"
#include "stopping.h"

namespace ripstop::cli {
namespace {

std::string short_text(const SteadyProgress& p) {
  switch (p.stage) {
    case SteadyStage::cloth:
      return fmt::format("cloth {:.0e}", p.cloth.residual);
    case SteadyStage::flow:
      return fmt::format("flow {}, {:.1f} N", p.flow.iteration, p.flow.drag);
    case SteadyStage::time:
      break;
  }
  const WatchProgress& t = p.time;
  return t.mean != 0 ? fmt::format("time {:.1f} +- {:.2g} N, {:.0f} %", t.mean, t.standard_error,
                                   std::min(99.0, 100 * t.share))
                     : fmt::format("time {}, {:.1f} N", t.step.step,
                                   t.step.force.z - force_on_others(t.step.bodies).z);
}

}  // namespace

void add_sweep_options(CLI::App& command, SweepOptions& options) {
  command.add_option("case", options.case_file, "Case file (TOML)")->required();
  add_flow_options(command, options.overrides);
  add_set_option(command, options.overrides);
  add_number(command, "--jobs", options.settings.jobs, from(1).up_to(1024), "Number of simultaneous runs")
      ->default_str("as many as cores and free memory allow");
  command.add_flag("--cold", options.cold,
                   "Start every run from the undeformed canopy, not from a neighbouring run");
  command.add_flag("--fields", options.settings.fields,
                   "Keep shapes and flow of every iteration for ParaView");
  add_json_option(command, options.json);
  command.add_flag("--fresh", options.settings.fresh,
                   "Replace finished runs; without this option they are kept");
}

void finish(SweepOptions& options, const std::string& what) {
  options.settings.warm = !options.cold;
  if (options.settings.folder.empty()) options.settings.folder = default_run_folder(options.case_file, what);
}

std::vector<SweepRow> run_and_tell(const std::vector<SweepAxis>& axes, const std::vector<SweepPoint>& points,
                                   const SweepSettings& settings) {
  const auto name = [&](std::size_t i) {
    std::string text;
    for (std::size_t d = 0; d < axes.size(); ++d)
      text += fmt::format("{}{}={}", d ? " " : "", axes[d].name.substr(axes[d].name.rfind('.') + 1),
                          points[i].values[d]);
    return text;
  };
  goes_on_when_repeated();
  Progress progress;
  const auto begin = std::chrono::steady_clock::now();
  std::map<std::size_t, std::string> running;
  std::size_t ended = 0, ended_before = 0;
  SweepEvents events;
  events.progress = [&](std::size_t i, const SteadyProgress& p, const SteadyState&) {
    running[i] = fmt::format("{} [{}] {}", name(i), p.iteration, short_text(p));
    const double gone = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::string text = fmt::format("{}/{}", ended, points.size());
    for (const auto& [k, what] : running) text += " | " + what;
    if (ended > ended_before) {
      const double left = gone / double(ended - ended_before) * double(points.size() - ended);
      text += fmt::format(" | remaining about {}", duration_text(left));
    }
    progress.show(text);
  };
  events.ended = [&](std::size_t i, const std::vector<SweepRow>& rows) {
    // A run that an earlier process finished gives no estimate of the remaining time.
    if (!running.erase(i)) ++ended_before;
    ++ended;
    const SweepRow& row = rows[i];
    progress.line(
        row.done ? fmt::format(
                       "{:>3}/{} {}: {:.4g} m/s, drag {:.2f} N, drag area {:.4f} m2{}, {} iterations, {}{}",
                       ended, points.size(), name(i), row.result.speed, row.result.drag, row.result.drag_area,
                       weakest_text(row.result.margins), row.result.iterations,
                       duration_text(row.result.wall_time), row.result.converged ? "" : ", NOT converged")
                 : fmt::format("{:>3}/{} {}: FAILED: {}", ended, points.size(), name(i), row.error));
    write_csv(settings.folder / "sweep.csv", sweep_table(axes, points, rows));
  };
  return run_sweep(points, settings, events);
}

void require_all(const std::vector<SweepPoint>& points, const std::vector<SweepRow>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].done) throw Error(rows[i].code, fmt::format("{}: {}", points[i].folder, rows[i].error));
    if (!rows[i].result.converged)
      throw Error(
          ExitCode::not_converged,
          fmt::format("{}: the coupling did not converge; raise coupling.max_iterations or loosen its "
                      "tolerances",
                      points[i].folder));
    if (!rows[i].result.usable.value_or(true))
      throw Error(ExitCode::not_converged,
                  fmt::format("{}: the result must not be used, see its warnings", points[i].folder));
  }
}

}  // namespace ripstop::cli
