// ripstop steady: the coupled steady case, from a case file to a run folder.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

#include "case_options.h"
#include "commands.h"
#include "progress.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/parachute/known_shape.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/steady_run.h"
#include "warnings.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path case_file;
  Overrides overrides;
  fs::path hostfile;
  fs::path out;
  bool fresh = false;
  bool dry_run = false;
};

// Iterations still to come: as many as the drag's change needs at its rate of fall so far, five at the first.
double iterations_left(const SteadyState& state, const CouplingSettings& settings) {
  const auto& all = state.iterations;
  if (all.size() < 3) return 5;
  const double now = all.back().drag_change, before = all[all.size() - 2].drag_change;
  if (now <= settings.drag_tolerance) return 1;
  const double rate = std::min(0.7, now / before);
  return 1 + std::log(settings.drag_tolerance / now) / std::log(rate);
}

std::string progress_text(const SteadyProgress& p, double elapsed, double left) {
  const std::string time =
      left > 0 ? fmt::format("{} gone, about {} left", duration_text(elapsed), duration_text(left))
               : fmt::format("{} gone", duration_text(elapsed));
  if (p.stage == SteadyStage::cloth) {
    return fmt::format("[{}] cloth: step {}, residual {:.1e} | {}", p.iteration, p.cloth.steps,
                       p.cloth.residual, time);
  }
  return fmt::format("[{}] flow: iteration {}, residuals U {:.1e} p {:.1e} k {:.1e}, drag {:.1f} N | {}",
                     p.iteration, p.flow.iteration, p.flow.residual_u, p.flow.residual_p, p.flow.residual_k,
                     p.flow.drag, time);
}

std::string iteration_text(const SteadyIteration& i) {
  return fmt::format(
      "{:>4} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>8.3f} {:>10} {:>10.3f} {:>9.1e} {:>9.1e} {:>7} {:>6} "
      "{:>8}",
      i.iteration, i.fluid_force, i.nodal_load, i.line_tension, i.momentum_deficit, i.transfer_factor,
      std::isfinite(i.drag_change) ? fmt::format("{:.3f} %", 100 * i.drag_change) : "-",
      1000 * i.shape_change, i.omega, i.printed_tolerance, i.cloth_steps, i.flow_iterations,
      duration_text(i.wall_time));
}

constexpr const char* iteration_header =
    "      fluid N    nodal N    lines N   deficit N  transfer  d(drag)   e_k mm     omega   Eq. 19    cloth "
    "  flow     time";

void print_result(const SteadyResult& r, const Case& value, const fs::path& folder) {
  const auto row = [](const char* name, const std::string& text) { fmt::print("  {:<26} {}\n", name, text); };
  fmt::print("\n{}\n", value.title);
  row("speed, density", fmt::format("{:.4g} m/s, {:.4g} kg/m3", r.speed, r.density));
  const Measured* measured = measured_row(value);
  if (measured && measured->drag_n) {
    row("drag measured",
        fmt::format("{:.1f} N (tunnel set to {:.4g} m/s, read {:.4g} m/s)", *measured->drag_n,
                    measured->nominal_speed_m_s, measured->measured_speed_m_s));
    row("drag computed", fmt::format("{:.1f} N ({:+.1f} %)", r.drag, 100 * (r.drag / *measured->drag_n - 1)));
  } else {
    row("drag computed", fmt::format("{:.1f} N", r.drag));
  }
  if (measured && measured->printed_nonlinear_n) {
    row("drag in [NFM]", fmt::format("{:.1f} N (its nonlinear model)", *measured->printed_nonlinear_n));
  }
  row("drag area", fmt::format("{:.4f} m2", r.drag_area));
  const KnownRange usual = known_drag_coefficient(value.parachute);
  row("drag coefficient", fmt::format("{:.4f} on S0 = {:.4f} m2{}", r.drag_coefficient, r.reference_area,
                                      usual.high > 0 ? fmt::format("; in descent {:.2f} to {:.2f} (Knacke)",
                                                                   usual.low, usual.high)
                                                     : ""));
  row("projected diameter", fmt::format("{:.3f} m", r.size.projected_diameter));
  row("skirt diameter", fmt::format("{:.3f} m", r.size.skirt_diameter));
  row("highest line tension", fmt::format("{:.1f} N", r.max_line_tension));
  row("highest stress", fmt::format("{:.0f} N/m von Mises, on the {}", r.stress.von_mises, r.stress.patch));
  row("ledger",
      fmt::format("fluid {:.2f}, nodes {:.2f}, lines {:.2f}, momentum deficit {:.2f} N", r.last.fluid_force,
                  r.last.nodal_load, r.last.line_tension, r.last.momentum_deficit));
  if (r.last.flow_averaged > 0)
    row("flow", fmt::format("did not settle: mean of its last {} iterations, drag {:.2f} +- {:.2f} N",
                            r.last.flow_averaged, r.last.fluid_force, r.last.drag_deviation));
  row("coupling", fmt::format("{} iterations, {}, {}", r.iterations,
                              r.converged ? "converged" : "NOT converged", duration_text(r.wall_time)));
  row("files", fmt::format("{} (canopy.png, canopy.pvd, {}, result.json)", folder.string(),
                           flow_grid(value).uniform() ? "flow.vti" : "flow.vtr"));
}

// A run that another process already finished is only shown.
int show_finished(const std::string& result, const fs::path& folder) {
  fmt::print("{}\n", result);
  fmt::print(stderr, "{} holds the finished run; --fresh computes it again\n", folder.string());
  return result.find("\"converged\": true") != std::string::npos ? 0
                                                                 : static_cast<int>(ExitCode::not_converged);
}

int run(const Options& options) {
  const Case value = read_case(options.case_file, options.overrides);
  const CouplingSettings coupling = resolve(value).coupling;
  const fs::path folder =
      options.out.empty() ? fs::path("runs") / options.case_file.parent_path().filename() : options.out;

  if (options.dry_run) {
    const SteadyProblem problem = steady_problem(value);
    fmt::print("{}: {} nodes, {} x {} x {} cells, {:.4g} m/s, {} ranks; would run in {}\n", value.title,
               problem.mesh.node_count(), problem.flow.grid.nx, problem.flow.grid.ny, problem.flow.grid.nz,
               problem.flow.air.speed, value.flow.ranks, folder.string());
    return 0;
  }

  Progress progress;
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  double before = 0;  // elapsed at the end of the last iteration
  SteadyRunEvents events;
  events.begun = [&](const SteadyState& state, const std::string& engine, int nodes) {
    if (!state.iterations.empty()) {
      progress.line(fmt::format("going on after coupling iteration {} of {}", state.iterations.size(),
                                folder.string()));
    }
    progress.line(fmt::format("{}: {}, {} cloth nodes, {}", value.title, engine, nodes, folder.string()));
    progress.line(iteration_header);
    for (const SteadyIteration& i : state.iterations) progress.line(iteration_text(i));
  };
  events.progress = [&](const SteadyProgress& p, const SteadyState& state) {
    const double now = elapsed();
    double left = 0;
    if (!state.iterations.empty()) {
      left = iterations_left(state, coupling) * state.iterations.back().wall_time -
             (now - before);
    }
    progress.show(progress_text(p, now, left));
  };
  events.iterated = [&](const SteadyState& state) {
    before = elapsed();
    progress.line(iteration_text(state.iterations.back()));
  };
  const SteadyRunOutcome outcome =
      run_steady(value, {{folder, options.fresh}, 0, options.hostfile, {}}, events);
  if (outcome.already_finished) return show_finished(outcome.json, folder);
  const SteadyResult& result = outcome.result;
  print_result(result, value, folder);
  print_mesh_warning(value);
  print_porosity_warning(value);
  print_material_warnings(value, result.stress.strain);
  if (!result.converged) {
    fmt::print(stderr,
               "not converged within {} coupling iterations: drag still changed by {:.2g} (wanted {:.2g}), "
               "shape by {:.2g} m (wanted {:.2g}), or the ledger is not closed within 1 %\n",
               result.iterations, result.last.drag_change, coupling.drag_tolerance,
               result.last.shape_change, value.coupling.shape_tolerance_m);
    return static_cast<int>(ExitCode::not_converged);
  }
  return 0;
}

}  // namespace

void add_steady(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("steady", "Inflated shape, drag and loads in a steady flow");
  command->footer(
      "Example: ripstop steady examples/stratos-iv/case.toml --speed 30 --grid 50,50,75 --ranks 2");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  add_case_options(*command, options->overrides);
  add_flow_options(*command, options->overrides);
  command->add_option("--hostfile", options->hostfile, "Hosts for MPI")->check(CLI::ExistingFile);
  command->add_option("--out", options->out, "Run folder (default: runs/<folder of the case>)");
  command->add_flag("--fresh", options->fresh, "Replace what the run folder holds; default: go on with it");
  command->add_flag("--dry-run", options->dry_run, "Say what would be done, and stop");
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop
