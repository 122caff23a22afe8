// ripstop inflate: the opening of a folded canopy, from a case file to a run folder.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "batch_option.h"
#include "case_options.h"
#include "commands.h"
#include "json_option.h"
#include "margins.h"
#include "opening.h"
#include "progress.h"
#include "ripstop/core/error.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/report/report.h"
#include "stopping.h"
#include "warnings.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct InflateArguments {
  OpeningOptions opening;
  BatchOptions batch;
  fs::path out;
  bool fresh = false, check = false, json = false;
};

void print_start(const Opening& solver, const InflationState& state, const LoadSource& source) {
  const FoldedStart& folded = solver.folded();
  const StartStrain strain = start_strain(solver.mesh(), folded.positions);
  fmt::print("folded start: {} folds, skirt folds at {:.4f} m and {:.4f} m from the axis\n", folded.folds,
             folded.inner_radius, folded.outer_radius);
  fmt::print("  largest strain {:.2e}{}\n", strain.largest,
             strain.part.empty() ? "" : " (" + strain.part + "); should be below 1e-3");
  if (const auto& air = solver.problem().air)
    fmt::print("{}: {} x {} x {} cells\n", source.text, air->flow.grid.nx, air->flow.grid.ny,
               air->flow.grid.nz);
  else
    fmt::print("pressure {:.2f} Pa ({})\n", solver.problem().pressure, source.text);
  const ViscosityLimit& limit = solver.viscosity_limit();
  if (limit.least_share < 1)
    fmt::print(
        "damping of the cloth: reduced in {:.1f} % of the cells, to no less than {:.2f} of cloth_damping_s, "
        "to keep the time step\n",
        100 * limit.reduced_cells, limit.least_share);
  fmt::print(
      "nodes {}, time step {:.3e} s (stability limit {:.3e} s), {} threads; the cloth alone takes about {} "
      "on one thread\n",
      solver.mesh().node_count(), state.step, state.step / solver.problem().settings.step_fraction,
      solver.threads(), duration_text(opening_seconds(solver, state)));
}

/// Of a reefed opening, a line a stage.
void print_stages(const InflationResult& r) {
  if (!r.stages) return;
  for (std::size_t i = 0; i < r.stages->size(); ++i) {
    const StageSummary& stage = (*r.stages)[i];
    std::string text = fmt::format("peak {:.1f} N at {:.1f} ms", stage.peak_load, 1000 * stage.peak_time);
    if (stage.smooth_peak) text += fmt::format(", low-passed {:.1f} N", *stage.smooth_peak);
    text += fmt::format("; {:.1f} N at the end of the stage, {:.1f} ms", stage.last_load, 1000 * stage.end);
    if (stage.drag_area) text += fmt::format(", C_D S {:.4g} m2", *stage.drag_area);
    if (stage.line_peak)
      text += fmt::format("; line {:.1f} N at {:.1f} ms", *stage.line_peak, 1000 * *stage.line_peak_time);
    const std::string name =
        stage.line ? fmt::format("stage {}, line {:g} m", i + 1, *stage.line) : std::string("open");
    fmt::print("  {:<26} {}\n", name, text);
  }
  if (!r.margins) return;
  for (const Margin& m : r.margins->members)
    if (m.member.starts_with("reefing") && m.margin)
      fmt::print("  {:<26} margin of safety {:+.2f}: {:.0f} N of {:.0f} N ({})\n", m.member, *m.margin,
                 m.load, *m.strength, m.strength_from);
}

void result_row(const char* name, const std::string& text) {
  fmt::print("  {:<26} {}\n", name, text);
}

void print_peaks(const InflationResult& r) {
  const auto row = result_row;
  const InflationSettings& s = r.settings;
  row("peak load",
      fmt::format("{:.1f} N at {:.2f} ms, unfiltered{}", r.peak_load, 1000 * r.peak_time,
                  r.start_up_time ? fmt::format(", after the start-up of {:.2f} ms (start-up peak {:.1f} N)",
                                                1000 * *r.start_up_time, *r.start_up_peak)
                                  : ""));
  if (r.low_pass) {
    row("peak, low-passed", fmt::format("{:.1f} N at {:.2f} ms ({:g} Hz)", *r.smooth_peak,
                                        1000 * *r.smooth_peak_time, s.low_pass_hz));
  }
  if (s.measured_peak_n) {
    const double own = r.low_pass ? *r.smooth_peak : r.peak_load;
    row("peak measured", fmt::format("{:.1f} N ({:+.1f} %{})", *s.measured_peak_n,
                                     100 * (own / *s.measured_peak_n - 1), r.low_pass ? ", low-passed" : ""));
  }
  if (s.printed_peak_n) row("peak, model of the source", fmt::format("{:.1f} N", *s.printed_peak_n));
  row("infinite-mass load",
      r.estimate.load ? fmt::format("{:.1f} N = C_x {:g} times {:.1f} N ({})", *r.estimate.load,
                                    r.estimate.coefficient, *r.estimate.drag, r.estimate.drag_from)
                      : std::string("not known: the opening has no steady load and no drag was given"));
  if (r.finite_mass_factor)
    row("finite-mass factor", fmt::format("{:.3f}: peak over the infinite-mass load", *r.finite_mass_factor));
  for (const MethodLoad& m : r.handbook)
    row(("  handbook: " + m.method).c_str(),
        fmt::format("{:.1f} N{}{}", m.load, m.applies ? "" : ", does not apply",
                    m.note.empty() ? "" : ": " + m.note));
}

void print_steady_load(const InflationResult& r) {
  const auto row = result_row;
  const double low_pass_hz = r.settings.low_pass_hz;
  row(r.steady_load ? "steady load" : "load at the end",
      fmt::format("{:.1f} N +- {:.1f} %, mean over the last fifth{}", r.summary.last_load,
                  100 * r.summary.unsteadiness,
                  r.steady_load ? "" : "; not a steady load at the speed of deployment"));
  if (r.steady_drag_returned) {
    row("deviation from steady run",
        fmt::format("{:+.2f} % of {:.1f} N", 100 * (*r.steady_drag_returned - 1), *r.source.steady_drag));
  }
  if (!r.steady_load) return;
  if (r.summary.inflation_time)
    row("inflation time",
        fmt::format("{:.1f} ms, after which the load remains within 10 % of the steady load",
                    1000 * *r.summary.inflation_time));
  if (r.summary.filling_time && r.summary.settling_time)
    row("filling, settling time",
        fmt::format("{:.1f} ms, {:.1f} ms ({:g} Hz, mean square over two periods)",
                    1000 * *r.summary.filling_time, 1000 * *r.summary.settling_time, low_pass_hz));
  row("overshoot", low_pass_hz > 0
                       ? fmt::format("{:.3f}, low-passed {:.3f}", *r.overshoot, *r.smooth_overshoot)
                       : fmt::format("{:.3f}", *r.overshoot));
}

void print_result(const InflationResult& r, const fs::path& folder, double wall_time) {
  const auto row = result_row;
  fmt::print("\n{}\n", r.title);
  print_margins(r.margins);
  print_peaks(r);
  print_steady_load(r);
  row("impulse", fmt::format("{:.3f} N s", r.impulse));
  print_stages(r);
  row("maximum line tension", fmt::format("{:.1f} N", r.max_line_tension));
  row("maximum von Mises stress",
      fmt::format("{:.0f} N/m ({}) at {:.1f} ms", r.stress.von_mises, r.stress.patch, 1000 * r.stress_time));
  row("energy balance", fmt::format("work in = kinetic + elastic + damped{} within {:.3f} %",
                                    r.stages ? " + cut" : "", 100 * r.energy_residual));
  if (r.settings.contact_pa > 0)
    row("contact of cloth",
        fmt::format("compressed by {:.0f} % at most; {:.2f} % of the edges pierced the cloth",
                    100 * r.contact_depth, 100 * r.pierced));
  row("files", fmt::format("{} (load.png, shapes.png, history.csv, canopy.pvd, result.json); {}",
                           folder.string(), duration_text(wall_time)));
  if (fs::exists(folder / report_name)) row("report", (folder / report_name).string());
}

/// Where the opening starts, or goes on, and how far it is.
class Terminal : public InflationObserver {
 public:
  Terminal(const LoadSource& source, const fs::path& folder, bool quiet, Progress& progress)
      : source_(source), folder_(folder), quiet_(quiet), progress_(progress) {}

  void warned(const std::string& text) override { progress_.line("ripstop: " + text); }
  void begin(const Opening& solver, InflationState& state, InflationHistory&) override {
    if (state.blocks > 0)
      progress_.line(fmt::format("resuming at {:.2f} ms in {}", 1000 * state.cloth.time, folder_.string()));
    else if (!quiet_)
      print_start(solver, state, source_);
    begin_ = Clock::now();
    first_ = state.blocks;
  }
  void advanced(const Opening& solver, const InflationState& state, const InflationHistory& history,
                const InflationFrame*) override {
    const double gone = std::chrono::duration<double>(Clock::now() - begin_).count();
    const double left = gone * double(solver.blocks() - state.blocks) / double(state.blocks - first_);
    progress_.show(
        fmt::format("{:.2f} of {:.0f} ms, load {:.1f} N, step {:.2e} s | elapsed {}, remaining about {}",
                    1000 * state.cloth.time, 1000 * solver.problem().settings.duration_s,
                    history.rows.back().mean, state.step, duration_text(gone), duration_text(left)));
  }

 private:
  using Clock = std::chrono::steady_clock;
  const LoadSource& source_;
  const fs::path& folder_;
  bool quiet_;
  Progress& progress_;
  Clock::time_point begin_;
  long long first_ = 0;
};

/// Of an opening whose end is held: without a steady load, what is a share of it is not known. A payload slows down and
/// has none.
int status_of(bool settled, const Settings& resolved) {
  if (settled || resolved.inflation().mass == InflationSettings::Mass::payload) return 0;
  std::fflush(stdout);
  fmt::print(stderr,
             "not settled within inflation.duration_s = {:g} s: the load did not remain within 10 % of its "
             "mean over the last tenth of that time; increase --duration\n",
             resolved.inflation().duration_s);
  return static_cast<int>(ExitCode::not_converged);
}

int run(const InflateArguments& options) {
  const auto begin = std::chrono::steady_clock::now();
  const Settings resolved = opening_settings(options.opening);
  const fs::path folder =
      options.out.empty() ? default_run_folder(options.opening.case_file, "inflation") : options.out;
  const LoadSource source = load_source(resolved, options.opening.steady_run);
  const int threads = threads_of(options.opening, resolved);
  const InflationFolderSettings settings{{folder, options.fresh}, threads};
  if (options.batch.wanted()) {
    check_inflation_in(settings, resolved, source);
    const BatchNeeds needs = opening_needs(resolved, threads, options.batch.cores.value_or(0));
    write_and_tell(folder, slurm_files(batch_job(options.batch, folder, needs)), "sbatch", "run.sbatch");
    return 0;
  }
  if (options.check) {
    check_inflation_in(settings, resolved, source);
    const std::unique_ptr<Opening> solver =
        make_opening(with_engine(resolved, opening_problem(resolved, source, threads)));
    print_start(*solver, solver->start(), source);
    return 0;
  }
  goes_on_when_repeated();
  Progress progress;
  Terminal terminal(source, folder, options.json, progress);
  const auto problem = [&] {
    progress.show("computing the equilibrium under the steady load");
    return opening_problem(resolved, source, threads);
  };
  const auto result = run_inflation_in(settings, resolved, source, problem, terminal);
  if (!result) {
    const std::string finished = *finished_result(folder);
    fmt::print("{}", finished);
    fmt::print(stderr, "{} contains the finished run; use --fresh to compute it again\n", folder.string());
    const auto json = nlohmann::json::parse(finished);
    const int quality =
        print_result_warnings(json.value("warnings", std::vector<std::string>{}), json.value("usable", true));
    return std::max(quality, status_of(json.value("settled", true), resolved));
  }
  const double wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (options.json)
    fmt::print("{}", to_json(*result));
  else
    print_result(*result, folder, wall_time);
  const int quality = print_result_warnings(result->warnings, result->usable);
  return std::max(quality, status_of(result->settled, resolved));
}

}  // namespace

void add_inflate(CLI::App& app, int& status) {
  auto options = std::make_shared<InflateArguments>();
  CLI::App* command =
      app.add_subcommand("inflate", "Compute the opening of the folded canopy and its load on the riser");
  command->footer("Example: ripstop inflate examples/stratos-iv/case.toml --steady runs/stratos-iv");
  add_opening_options(*command, options->opening);
  add_key_option(*command, "--damping", "inflation.damping_n_s_m3",
                 "Damping C_a per unit area of cloth [N s/m3]", options->opening.overrides);
  command
      ->add_option_function<std::string>(
          "--air",
          [options](const std::string& air) {
            options->opening.overrides.set.push_back({"inflation.air", air, "--air"});
          },
          "Load model: uniform pressure, or flow that is computed in time together with the cloth")
      ->check(CLI::IsMember({"uniform", "coupled"}))
      ->option_text("uniform|coupled");
  command->add_option("--out", options->out, "Run folder (default: runs/<name of the case>-inflation)");
  command->add_flag("--fresh", options->fresh,
                    "Replace the files of Ripstop in the run folder; default: resume the run");
  command->add_flag("--check", options->check,
                    "Fold the canopy, print strain, pressure and time step, and stop");
  add_json_option(*command, options->json);
  add_batch_options(*command, options->batch);
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop
