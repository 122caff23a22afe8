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
#include "number_option.h"
#include "opening.h"
#include "option.h"
#include "progress.h"
#include "ripstop/case/deployment.h"
#include "ripstop/core/error.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/opening/samples.h"
#include "ripstop/run/opening/snatch.h"
#include "ripstop/run/quality.h"
#include "ripstop/run/report/report.h"
#include "stopping.h"
#include "units_option.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct InflateArguments {
  OpeningOptions opening;
  BatchOptions batch;
  fs::path out;
  bool fresh = false, check = false, json = false;
  int samples = 0;  // 0: one opening as the case has it
};

/// The airspeed at deployment, and the deployment in one dimension, a line a phase.
void print_deployment(const Settings& resolved) {
  print_deployment_speed(resolved);
  const auto deployment = deployment_of(resolved);
  if (!deployment) return;
  const PackedParachute packed = packed_parachute(resolved);
  print_text(
      "deployment: container {:.3g} kg, its drag area {:.3g} m2; canopy {:.3g} kg, lines {:.3g} kg; strip "
      "force {:.3g} N, line force {:.3g} N; each phase with its start\n",
      packed.bag_mass, packed.bag_drag_area, packed.canopy_mass, packed.lines_mass, packed.strip_force,
      packed.line_force);
  for (const DeploymentPhase& phase : deployment->phases)
    print_text("  {:<24} {:8.4f} s {:8.2f} m, payload at {:6.2f} m/s, container at {:6.2f} m/s\n", phase.name,
               phase.time, phase.path, phase.payload_speed, phase.bag_speed);
  if (deployment->phase(lines_stretch))
    print_text("  snatch load {:.1f} N at {:.4f} s, speed difference {:.2f} m/s at line stretch ({})\n",
               deployment->snatch_load, deployment->snatch_time, deployment->relative_speed,
               deployment_model);
  if (deployment->stopped) print_text("  did not open: {}\n", *deployment->stopped);
}

void print_start(const Opening& solver, const InflationState& state, const LoadSource& source) {
  const FoldedStart& folded = solver.folded();
  const StartStrain strain = start_strain(solver.mesh(), folded.positions);
  print_text("folded start: {} folds, skirt folds at {:.4f} m and {:.4f} m from the axis\n", folded.folds,
             folded.inner_radius, folded.outer_radius);
  print_text("  largest start strain {:.2e}{}\n", strain.largest,
             strain.part.empty() ? ""
                                 : fmt::format(" ({}; should be below {:.0e})", strain.part,
                                               quality_limit("start_strain").warn));
  print_text("  pierced edges {:.2f} %{}\n", 100 * pierced_share(solver.mesh(), folded.positions),
             solver.problem().settings.contact_pa > 0
                 ? fmt::format(" (should be below {:g} %)", 100 * quality_limit("pierced_edges").warn)
                 : "");
  if (const auto& air = solver.problem().air)
    print_text("{}: {} x {} x {} cells\n", source.text, air->flow.grid.nx, air->flow.grid.ny,
               air->flow.grid.nz);
  else
    print_text("pressure {:.2f} Pa ({})\n", solver.problem().pressure, source.text);
  const ViscosityLimit& limit = solver.viscosity_limit();
  if (limit.least_share < 1)
    print_text(
        "damping of the cloth: reduced in {:.1f} % of the cells, to no less than {:.2f} of cloth_damping_s, "
        "to keep the time step\n",
        100 * limit.reduced_cells, limit.least_share);
  print_text(
      "nodes {}, time step {:.3e} s (stability limit {:.3e} s), {} thread{}; the time steps {} about {} of "
      "processor time, without the writing of {} shapes\n",
      solver.mesh().node_count(), state.step, state.step / solver.problem().settings.step_fraction,
      solver.threads(), solver.threads() == 1 ? "" : "s",
      solver.air() ? "of cloth and air take" : "of the cloth take",
      rough_duration(opening_seconds(solver, state)), solver.problem().settings.frames);
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
    print_text("  {:<26} {}\n", name, text);
  }
  if (!r.margins) return;
  for (const Margin& m : r.margins->members)
    if (m.member.starts_with("reefing") && m.margin)
      print_text("  {:<26} margin of safety {}: {:.0f} N of {:.0f} N ({})\n", m.member,
                 margin_text(*m.margin), m.load, *m.strength, m.strength_from);
}

void print_peaks(const InflationResult& r) {
  const auto row = print_row;
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
  if (s.printed_peak_n) row("peak, published model", fmt::format("{:.1f} N", *s.printed_peak_n));
  if (r.speed && r.speed_source)
    row("airspeed at deployment", fmt::format("{:.4g} m/s ({})", *r.speed, *r.speed_source));
  if (r.density && r.height && r.air_source)
    row("air",
        fmt::format("{:.4g} kg/m3, {:.4g} m above sea level ({})", *r.density, *r.height, *r.air_source));
  row("infinite-mass load",
      r.estimate.load ? fmt::format("{:.1f} N = C_x {:g} times {:.1f} N ({})", *r.estimate.load,
                                    r.estimate.coefficient, *r.estimate.drag, r.estimate.drag_from)
                      : std::string("not known: the opening has no steady load and no drag was given"));
  if (r.outside)
    row("container",
        r.container_left
            ? fmt::format("the canopy has left it {:.1f} ms after the start", 1000 * *r.container_left)
            : fmt::format("{:.0f} % of the canopy's length are outside at the end", 100 * *r.outside));
  if (r.filling_distance)
    row("filled",
        fmt::format("{:.1f} ms after the start, {:.2f} nominal diameters; area grows as (t/t_f)^{:.2f}",
                    1000 * *r.filling_time, *r.filling_distance, *r.growth_exponent));
  if (r.finite_mass_factor)
    row("finite-mass factor", fmt::format("{:.3f}: peak over the infinite-mass load", *r.finite_mass_factor));
  for (const MethodLoad& m : r.handbook) {
    if (m.method == infinite_mass_method) continue;  // above
    row(("  handbook: " + m.method).c_str(),
        fmt::format("{:.1f} N{}{}", m.load, m.applies ? "" : ", does not apply",
                    m.note.empty() ? "" : ": " + m.note));
  }
}

void print_steady_load(const InflationResult& r) {
  const auto row = print_row;
  const double low_pass_hz = r.settings.low_pass_hz;
  row(r.steady_load ? "steady load" : "load at the end",
      fmt::format("{:.1f} N, mean over the last fifth, standard deviation {:.1f} %{}", r.summary.last_load,
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
  if (r.filling_time && r.summary.settling_time && !r.filling_distance)
    row("filling, settling time",
        fmt::format("{:.1f} ms, {:.1f} ms ({:g} Hz, mean square over two periods)", 1000 * *r.filling_time,
                    1000 * *r.summary.settling_time, low_pass_hz));
  row("overshoot", low_pass_hz > 0
                       ? fmt::format("{:.3f}, low-passed {:.3f}", *r.overshoot, *r.smooth_overshoot)
                       : fmt::format("{:.3f}", *r.overshoot));
}

void print_openings(const ClusterOpening& cluster) {
  const auto row = print_row;
  for (std::size_t k = 0; k < cluster.canopies.size(); ++k) {
    const CanopyOpening& canopy = cluster.canopies[k];
    row(fmt::format("canopy {}{}", k + 1,
                    canopy.size_ratio ? fmt::format(", size {:g}", *canopy.size_ratio) : "")
            .c_str(),
        fmt::format(
            "{}peak riser load {:.1f} N at {:.1f} ms, {}; at the end {:.1f} N, spread angle {:.1f} deg",
            canopy.delay ? fmt::format("folded until {:.1f} ms; ", 1000 * *canopy.delay) : "",
            canopy.peak_load, 1000 * canopy.peak_time,
            canopy.filling_time ? fmt::format("filled at {:.1f} ms", 1000 * *canopy.filling_time)
                                : std::string("not filled"),
            canopy.last_load, canopy.last_spread));
  }
  row("time differences",
      fmt::format("peaks {:.1f} ms{}; smallest gap {:.3g} m at {:.1f} ms", 1000 * cluster.peak_difference,
                  cluster.filling_difference
                      ? fmt::format(", filling {:.1f} ms", 1000 * *cluster.filling_difference)
                      : std::string(),
                  cluster.smallest_gap, 1000 * cluster.smallest_gap_time));
}

void print_result(const InflationResult& r, const fs::path& folder, double wall_time) {
  const auto row = print_row;
  print_text("\n{}\n", r.title);
  print_peaks(r);
  print_steady_load(r);
  if (r.cluster) print_openings(*r.cluster);
  print_margins(r.margins);
  row("impulse", fmt::format("{:.3f} N s", r.impulse));
  for (const OpeningBody& body : r.bodies.value_or(std::vector<OpeningBody>()))
    row(("body " + body.name).c_str(),
        fmt::format("largest drag {:.3g} N at {:.1f} ms; mean over the last fifth: drag area {:.4g} m2, "
                    "coefficient {:.3f} on {:.4g} m2",
                    body.peak_drag, 1000 * body.peak_time, body.drag_area, body.drag_coefficient,
                    body.reference_area));
  print_stages(r);
  row("maximum line tension", fmt::format("{:.1f} N", r.max_line_tension));
  row("maximum von Mises stress", fmt::format("{:.0f} N/m, mean over 50 mm ({}) at {:.1f} ms",
                                              r.stress.von_mises, r.stress.patch, 1000 * r.stress_time));
  row("energy balance", fmt::format("work in = kinetic + elastic + damped{} within {:.3f} %",
                                    r.stages ? " + cut" : "", 100 * r.energy_residual));
  if (r.settings.contact_pa > 0)
    row("contact of cloth",
        fmt::format("distance of layers reduced by at most {:.0f} %; {:.2f} % of the edges pierced the cloth",
                    100 * r.contact_depth, 100 * r.pierced));
  row("files", fmt::format("{} (load.png, shapes.png, history.csv, canopy.pvd, result.json); elapsed {}",
                           folder.string(), duration_text(wall_time)));
  if (fs::exists(folder / report_name)) row("report", (folder / report_name).string());
}

/// State at which the opening starts or resumes, and its progress.
class Terminal : public InflationObserver {
 public:
  Terminal(const LoadSource& source, const fs::path& folder, bool quiet, Progress& progress)
      : source_(source), folder_(folder), quiet_(quiet), progress_(progress) {}

  void warned(const std::string& text) override { progress_.line("warning: " + text); }
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
    const double spent = std::chrono::duration<double>(Clock::now() - begin_).count();
    const double remaining = spent * double(solver.blocks() - state.blocks) / double(state.blocks - first_);
    progress_.show(fmt::format("{:.1f} of {:.0f} ms, load {:.1f} N | elapsed {}, remaining about {}",
                               1000 * state.cloth.time, 1000 * solver.problem().settings.duration_s,
                               history.rows.back().mean, duration_text(spent), duration_text(remaining)));
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

/// Of an opening with a fixed end: values relative to a steady load are unknown without one. A payload
/// decelerates and has none.
int status_of(bool settled, const Settings& resolved) {
  if (settled || resolved.inflation().mass == InflationSettings::Mass::payload) return 0;
  std::fflush(stdout);
  fmt::print(
      stderr,
      "not settled within inflation.duration_s = {:g} s: in the last tenth of that time the load was not "
      "always within 10 % of its mean over the last fifth; increase --duration\n",
      resolved.inflation().duration_s);
  return static_cast<int>(ExitCode::not_converged);
}

void print_samples(const SampleSummary& summary, const fs::path& folder) {
  fmt::print("{}: {} openings with perturbed folds\n  {:<30} {:>10} {:>10} {:>10} {:>10}\n", summary.title,
             summary.samples, "", "mean", "std. dev.", "lowest", "highest");
  const auto row = [&](const char* name, const std::optional<Statistic>& s) {
    if (s)
      fmt::print("  {:<30} {:>10.4g} {:>10.3g} {:>10.4g} {:>10.4g}{}\n", name, s->mean, s->standard_deviation,
                 s->lowest, s->highest,
                 s->openings < summary.samples ? fmt::format("   of {} openings", s->openings) : "");
  };
  row("peak load, N", summary.peak_load);
  row("peak, low-passed, N", summary.smooth_peak);
  row("filling time, s", summary.filling_time);
  row("filling distance / D0", summary.filling_distance);
  row("opening force coefficient C_x", summary.opening_force_coefficient);
  row("finite-mass factor X_1", summary.finite_mass_factor);
  fmt::print("  files                          {} (result.json, sample-001 and following)\n",
             folder.string());
}

int sample(const InflateArguments& options, const InflationFolderSettings& settings, const Settings& resolved,
           const LoadSource& source) {
  goes_on_when_repeated();
  const SampleSummary summary = run_samples(
      settings, resolved, options.samples, [&](const InflationFolderSettings& one, const Settings& seeded) {
        Progress progress;
        Terminal terminal(source, one.run.folder, true, progress);
        run_inflation_in(
            one, seeded, source, [&] { return opening_problem(seeded, source, settings.threads); }, terminal);
      });
  if (options.json)
    fmt::print("{}", to_json(summary));
  else
    print_samples(summary, settings.run.folder);
  return print_result_warnings(summary.warnings, summary.usable);
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
    print_deployment(resolved);
    const std::unique_ptr<Opening> solver =
        make_opening(with_engine(resolved, opening_problem(resolved, source, threads)));
    print_start(*solver, solver->start(), source);
    print_warnings(source.warnings);
    print_warnings(opening_warnings(resolved, *solver));
    return 0;
  }
  if (!options.json) print_deployment(resolved);
  if (options.samples > 0) return sample(options, settings, resolved, source);
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
  CLI::Option* load_model = command->add_option_function<std::string>(
      "--air",
      [options](const std::string& air) {
        options->opening.overrides.set.push_back({"inflation.air", air, "--air"});
      },
      "Load model: uniform pressure, or flow that is computed in time together with the cloth (case key "
      "inflation.air)");
  accept_words(load_model, {"uniform", "coupled"});
  command->add_option("--out", options->out, "Run folder")->default_str("runs/<name of the case>-inflation");
  command->add_flag("--fresh", options->fresh,
                    "Replace the files of Ripstop in the run folder; without this option the run resumes");
  add_number(*command, "--samples", options->samples, from(2).up_to(1000),
             "Number of openings with different random perturbations of the folds, for mean and scatter")
      ->default_str("one opening as in the case");
  command->add_flag("--check", options->check,
                    "Fold the canopy, print strain, pressure and time step, and stop");
  add_units_option(*command);
  add_json_option(*command, options->json);
  add_batch_options(*command, options->batch);
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop::cli
