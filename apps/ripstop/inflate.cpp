// ripstop inflate: the opening of a folded canopy, from a case file to a run folder.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "case_options.h"
#include "commands.h"
#include "opening.h"
#include "progress.h"
#include "ripstop/run/inflation_folder.h"
#include "warnings.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

constexpr double seconds_between_checkpoints = 10;

struct Options {
  OpeningOptions opening;
  fs::path out;
  bool fresh = false, check = false;
};

void print_start(const Inflation& solver, const InflationState& state, const LoadSource& source) {
  const FoldedStart& folded = solver.folded();
  const StartStrain strain = start_strain(solver.mesh(), folded.positions);
  fmt::print("folded start: {} folds, skirt folds at {:.4f} m and {:.4f} m from the axis\n", folded.folds,
             folded.inner_radius, folded.outer_radius);
  fmt::print("  largest strain {:.2e}{}\n", strain.largest,
             strain.part.empty() ? "" : " (" + strain.part + "); wanted below 1e-3");
  fmt::print("pressure {:.2f} Pa ({})\n", solver.problem().pressure, source.text);
  const ViscosityLimit& limit = solver.viscosity_limit();
  if (limit.least_share < 1)
    fmt::print(
        "cloth_damping_s is weakened in {:.1f} % of the cells, to {:.2f} of itself at least, for the step's "
        "sake\n",
        100 * limit.reduced_cells, limit.least_share);
  fmt::print("nodes {}, step {:.3e} s (largest stable {:.3e} s), {} threads\n", solver.mesh().node_count(),
             state.step, state.step / solver.problem().settings.step_fraction, solver.threads());
}

void print_result(const InflationResult& r, const Case& value, const LoadSource& source,
                  const fs::path& folder) {
  const auto row = [](const char* name, const std::string& text) { fmt::print("  {:<26} {}\n", name, text); };
  const InflationSettings& s = value.inflation;
  fmt::print("\n{}\n", value.title);
  row("peak load", fmt::format("{:.1f} N at {:.2f} ms, over every step", r.peak_load, 1000 * r.peak_time));
  if (s.low_pass_hz > 0) {
    row("peak, low-passed", fmt::format("{:.1f} N at {:.2f} ms ({:g} Hz)", r.summary.smooth_peak,
                                        1000 * r.summary.smooth_peak_time, s.low_pass_hz));
  }
  if (s.measured_peak_n) {
    const double own = s.low_pass_hz > 0 ? r.summary.smooth_peak : r.peak_load;
    row("peak measured",
        fmt::format("{:.1f} N ({:+.1f} %{})", *s.measured_peak_n, 100 * (own / *s.measured_peak_n - 1),
                    s.low_pass_hz > 0 ? ", low-passed" : ""));
  }
  if (s.printed_peak_n) row("peak of the source's model", fmt::format("{:.1f} N", *s.printed_peak_n));
  row("Knacke's estimate",
      fmt::format("{:.1f} N, C_x = {:g} (infinite mass)", r.estimate.load, r.estimate.coefficient));
  row("steady load", fmt::format("{:.1f} N +- {:.1f} % over the last fifth", r.summary.steady_load,
                                 100 * r.summary.unsteadiness));
  if (source.steady_drag) {
    row("steady drag returned",
        fmt::format("{:+.2f} % of {:.1f} N", 100 * (r.summary.steady_load / *source.steady_drag - 1),
                    *source.steady_drag));
  }
  row("inflation time",
      r.summary.inflation_time
          ? fmt::format("{:.1f} ms until within 10 % of steady for good", 1000 * *r.summary.inflation_time)
          : "still outside 10 % of steady at the end; a longer inflation.duration_s may settle it");
  if (r.summary.filling_time && r.summary.settling_time)
    row("filled, settled",
        fmt::format("{:.1f} ms, {:.1f} ms ({:g} Hz, mean square over two periods)",
                    1000 * *r.summary.filling_time, 1000 * *r.summary.settling_time, s.low_pass_hz));
  row("overshoot", s.low_pass_hz > 0
                       ? fmt::format("{:.3f}, low-passed {:.3f}", r.overshoot, r.smooth_overshoot)
                       : fmt::format("{:.3f}", r.overshoot));
  row("impulse", fmt::format("{:.3f} N s", r.impulse));
  row("highest line tension",
      fmt::format("{:.1f} N", *std::max_element(r.line_peaks.begin(), r.line_peaks.end())));
  row("highest stress",
      fmt::format("{:.0f} N/m von Mises on the {} at {:.1f} ms{}", r.stress.von_mises, r.stress.patch,
                  1000 * r.stress_time,
                  r.break_load > 0 ? fmt::format(", margin {:.1f} to its {:.0f} N/m",
                                                 r.break_load / r.stress.von_mises, r.break_load)
                                   : ""));
  row("energy balance",
      fmt::format("work in = kinetic + elastic + damped within {:.3f} %", 100 * r.energy_residual));
  row("files", fmt::format("{} (load.png, shapes.png, history.csv, canopy.pvd, result.json); {}",
                           folder.string(), duration_text(r.wall_time)));
}

int run(const Options& options) {
  const Case value = opening_case(options.opening);
  const fs::path folder =
      options.out.empty()
          ? fs::path("runs") / (options.opening.case_file.parent_path().filename().string() + "-inflation")
          : options.out;
  const LoadSource source = load_source(value, options.opening.steady_run);
  const int threads = threads_of(options.opening, value);
  if (options.check) {
    const Inflation solver(opening_problem(value, source, threads));
    print_start(solver, solver.start(), source);
    return 0;
  }
  InflationFolder files({folder, options.fresh}, value, "inflation; pressure from " + source.text, threads);
  if (const auto result = files.finished_result()) {
    fmt::print("{}", *result);
    fmt::print(stderr, "{} holds the finished run; --fresh computes it again\n", folder.string());
    return 0;
  }
  Progress progress;
  progress.show("equilibrium under the steady load");
  Inflation solver(opening_problem(value, source, threads));
  InflationState state;
  if (auto saved = files.go_on(solver)) {
    state = std::move(*saved);
    progress.line(fmt::format("going on at {:.2f} ms of {}", 1000 * state.cloth.time, folder.string()));
  } else {
    state = solver.start();
    files.write_start(solver, state);
    print_start(solver, state, source);
  }

  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point t) {
    return std::chrono::duration<double>(Clock::now() - t).count();
  };
  const Clock::time_point begin = Clock::now();
  Clock::time_point saved = begin;
  const long long first = state.blocks;
  while (state.blocks < solver.blocks()) {
    const std::vector<HistoryRow> rows = solver.advance(state);
    files.add_rows(rows);
    if (solver.at_frame(state)) {
      files.write_frame(solver, state, solver.frame(state));
      if (seconds_since(saved) > seconds_between_checkpoints) {
        files.save(state);
        saved = Clock::now();
      }
    }
    const double gone = seconds_since(begin);
    const double left = gone * double(solver.blocks() - state.blocks) / double(state.blocks - first);
    progress.show(fmt::format("{:.2f} of {:.0f} ms, load {:.1f} N, step {:.2e} s | {} gone, about {} left",
                              1000 * state.cloth.time, 1000 * value.inflation.duration_s, rows.back().mean,
                              state.step, duration_text(gone), duration_text(left)));
  }
  files.save(state);
  const InflationResult result = files.finish(solver, state, value, source);
  print_result(result, value, source, folder);
  print_mesh_warning(value);
  print_material_warnings(value, result.stress.strain);
  return 0;
}

}  // namespace

void add_inflate(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("inflate", "How a folded canopy opens, and the load it puts on the riser");
  command->footer("Example: ripstop inflate examples/stratos-iv/case.toml --steady runs/stratos-iv");
  add_opening_options(*command, options->opening);
  add_key_option(*command, "--damping", "inflation.damping_n_s_m3", "C_a a unit area [N s/m3]",
                 options->opening.overrides);
  command->add_option("--out", options->out, "Run folder (default: runs/<folder of the case>-inflation)");
  command->add_flag("--fresh", options->fresh, "Replace what the run folder holds; default: go on with it");
  command->add_flag("--check", options->check, "Fold, say strain, pressure and step, and stop");
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop
