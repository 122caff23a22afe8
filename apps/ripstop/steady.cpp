// ripstop steady: the coupled steady case, from a case file to a run folder.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "batch_option.h"
#include "case_options.h"
#include "commands.h"
#include "json_option.h"
#include "margins.h"
#include "number_option.h"
#include "option.h"
#include "progress.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/cost.h"
#include "ripstop/core/error.h"
#include "ripstop/core/words.h"
#include "ripstop/fsi/convergence.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/steady/steady_folder.h"
#include "steady_terminal.h"
#include "stopping.h"
#include "units_option.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct SteadyArguments {
  fs::path case_file;
  Overrides overrides;
  BatchOptions batch;
  fs::path hostfile;
  fs::path out;
  bool fresh = false;
  bool dry_run = false;
  bool json = false;
};

void print_unsteady(const UnsteadyResult& unsteady) {
  const WindowAverage& w = unsteady.watched;
  print_row("time-averaged drag",
            fmt::format("mean over {:.3f} s after a start-up of {:.3f} s, {} steps; standard error {}, "
                        "standard deviation {:.2g} N",
                        w.time - w.start_up, w.start_up, w.steps,
                        unsteady.standard_error ? fmt::format("{:.2g} N{}", *unsteady.standard_error,
                                                              w.enough ? "" : ", ABOVE the required value")
                                                : std::string("not known"),
                        w.deviation));
  print_row("side force",
            fmt::format("x {:.2g} +- {:.2g} N, y {:.2g} +- {:.2g} N; standard deviation {:.2g} N{}",
                        w.side_force.x, w.side_error.x, w.side_force.y, w.side_error.y, w.side_deviation,
                        w.swing > 0 ? fmt::format(", dominant frequency {:.3g} Hz (Strouhal number {:.2f})",
                                                  w.swing, unsteady.strouhal)
                                    : ""));
}

void print_cluster(const ClusterResult& cluster, double area) {
  const std::size_t count = cluster.canopies.size();
  const bool equal = !cluster.canopies.front().size_ratio;
  print_row("cluster",
            fmt::format("{} canopies at {:.4g} deg to the axis, S0 = {:.4f} m2 {}; smallest gap {:.3g} m",
                        count, cluster.spread_angle_deg, equal ? area / double(count) : area,
                        equal ? "each" : "together", cluster.gap));
  print_row("",
            fmt::format("forces inclined {} by {:.2g} deg; riser loads{} differ by {:.2g} %",
                        cluster.force_angle_deg > 0 ? "outward" : "inward", std::abs(cluster.force_angle_deg),
                        equal ? "" : " on an equal area", 100 * cluster.difference));
  if (cluster.search && in_equilibrium(cluster))
    print_row("", fmt::format("equilibrium of the spread angle, found with {} steady solutions",
                              cluster.search->size()));
  if (cluster.cluster_factor)
    print_row("cluster factor",
              fmt::format("{:.3f}, drag coefficient over that of one canopy", *cluster.cluster_factor));
  for (std::size_t k = 0; k < count; ++k) {
    const ClusterCanopy& canopy = cluster.canopies[k];
    print_row(fmt::format("canopy {}", k + 1).c_str(),
              (equal ? std::string() : fmt::format("size {:g}: ", *canopy.size_ratio)) +
                  fmt::format("riser load {:.1f} N, largest line load {:.2f} N, projected diameter {:.3f} m",
                              canopy.force, canopy.max_line_tension, canopy.projected_diameter));
  }
}

/// The members of the canopies that remain.
void print_failure(const ClusterResult& cluster) {
  double area = 0;  // over that of the largest canopy
  for (const ClusterCanopy& canopy : cluster.canopies) area += std::pow(canopy.size_ratio.value_or(1), 2);
  const Margin* least = weakest(cluster.one_failed);
  print_row(cluster.canopies.front().size_ratio ? "largest canopy failed" : "one canopy failed",
            fmt::format("{} times the load of each of the others{}", rounded(area / (area - 1)),
                        least ? fmt::format("; weakest member {}: margin of safety {}", least->member,
                                            margin_text(*least->margin))
                              : std::string()));
}

std::string flow_text(const SteadyIteration& last) {
  const std::string left =
      std::isfinite(last.drag_left)
          ? fmt::format("; estimated remaining change of the drag: {:.2g} %", 100 * last.drag_left)
          : std::string();
  if (last.flow_averaged > 0)
    return fmt::format("did not converge: mean of the last {} iterations, drag {:.2f} +- {:.2f} N{}",
                       last.flow_averaged, last.fluid_force, last.drag_deviation, left);
  return (last.flow_converged ? "converged" : "did not converge") + left;
}

void print_result(const SteadyResult& r, const Settings& resolved, const fs::path& folder) {
  const auto row = print_row;
  print_text("\n{}\n", r.title);
  row("speed, density", fmt::format("{:.4g} m/s, {:.4g} kg/m3", r.speed, r.density));
  row("approach speed",
      fmt::format("{:.4g} m/s, mean over the disk of the canopy, one diameter upstream", r.approach_speed));
  const std::optional<Measured>& measured = r.measured;
  if (measured && measured->drag_n) {
    row("drag measured", fmt::format("{:.1f} N (nominal {:.4g} m/s, measured {:.4g} m/s)", *measured->drag_n,
                                     measured->nominal_speed_m_s, measured->measured_speed_m_s));
    row("drag computed", fmt::format("{:.1f} N ({:+.1f} %)", r.drag, 100 * (r.drag / *measured->drag_n - 1)));
  } else {
    row("drag computed", fmt::format("{:.1f} N", r.drag));
  }
  if (measured && measured->printed_nonlinear_n) {
    row("drag in [NFM]", fmt::format("{:.1f} N (its nonlinear model)", *measured->printed_nonlinear_n));
  }
  row("drag area", fmt::format("{:.4f} m2", r.drag_area));
  row("drag coefficient",
      fmt::format("{:.4f} on S0 = {:.4f} m2{}", r.drag_coefficient, r.reference_area,
                  r.known_drag_coefficient
                      ? fmt::format("; in descent {:.2f} to {:.2f} (Knacke)", r.known_drag_coefficient->at(0),
                                    r.known_drag_coefficient->at(1))
                      : ""));
  const double projected = r.size.projected_area * (r.cluster ? double(r.cluster->canopies.size()) : 1);
  row("", fmt::format("{:.4f} on the projected area of {:.4f} m2", r.drag_area / projected, projected));
  row("projected diameter", fmt::format("{:.3f} m", r.size.projected_diameter));
  row("skirt diameter", fmt::format("{:.3f} m", r.size.skirt_diameter));
  print_stresses(r.max_line_tension, r.stress);
  if (r.cluster) print_cluster(*r.cluster, r.reference_area);
  for (const BodyResult& body : r.bodies.value_or(std::vector<BodyResult>()))
    row(("body " + body.name).c_str(),
        fmt::format("drag {:.3g} N{}, coefficient {:.3f} on {:.4g} m2; side force {:.2g} N", body.drag,
                    body.standard_error ? fmt::format(" +- {:.2g} N", *body.standard_error) : "",
                    body.drag_coefficient, body.reference_area, body.side));
  print_payload(r);
  print_margins(r.margins);
  if (r.cluster) print_failure(*r.cluster);
  row("force balance",
      fmt::format("air load {:.2f} N, cloth load {:.2f} N, line load {:.2f} N, momentum deficit {:.2f} N",
                  r.last.fluid_force, r.last.nodal_load, r.last.line_tension, r.last.momentum_deficit));
  if (r.domain && resolved.flow().symmetry != FlowSymmetry::full)
    row("flow domain", r.domain->part == "full"
                           ? fmt::format("full, because {}", r.domain->because)
                           : "a quarter, mirrored in the planes x = 0 and y = 0 (flow.symmetry)");
  if (r.unsteady) {
    print_unsteady(*r.unsteady);
  } else {
    row("flow", flow_text(r.last));
  }
  row("coupling",
      fmt::format("{} after {} iteration{}; {}", r.converged ? "converged" : "NOT converged", r.iterations,
                  r.iterations == 1 ? "" : "s", last_changes(r.last, resolved.coupling())));
  row("elapsed", duration_text(r.wall_time));
  row("files", fmt::format("{} (canopy.png, canopy.pvd, {}, result.json)", folder.string(),
                           flow_grid(resolved.flow()).uniform() ? "flow.vti" : "flow.vtr"));
  if (fs::exists(folder / report_name)) row("report", (folder / report_name).string());
}

int dry_run(const SteadyFolderSettings& settings, const Settings& resolved) {
  const fs::path& folder = settings.run.folder;
  check_steady_in(settings, resolved);
  const SteadyProblem problem = steady_problem(resolved);
  const Cost cost = cost_of(resolved, problem.flow.quarter);
  // Only the estimate of the built-in engine is reliable, and the length of an unsteady run is not known in
  // advance.
  const bool known = engine_of(resolved).word == engines().front().word && !resolved.flow().unsteady;
  print_text("{}: {} nodes, {} x {} x {} cells, {:.4g} m/s{}, about {:.2g} GB{}; would run in {}\n",
             resolved.title(), problem.mesh.node_count(), problem.flow.grid.nx, problem.flow.grid.ny,
             problem.flow.grid.nz, problem.flow.air.speed(),
             resolved.flow().ranks > 1 ? fmt::format(", {} ranks", resolved.flow().ranks) : "",
             1e-9 * cost.memory, known ? fmt::format(" and {} on one core", rough_duration(cost.time)) : "",
             folder.string());
  return 0;
}

int write_scripts(const SteadyArguments& options, const SteadyFolderSettings& settings,
                  const Settings& resolved) {
  check_steady_in(settings, resolved);
  const fs::path& folder = settings.run.folder;
  const BatchJob job =
      batch_job(options.batch, folder, steady_needs(resolved, options.batch.cores.value_or(0)));
  write_and_tell(folder, slurm_files(job), "sbatch", "run.sbatch");
  return 0;
}

/// Twice as many, as far as the key allows.
int more_iterations(int iterations) {
  return static_cast<int>(std::min(2.0 * iterations, key_range("coupling.max_iterations").high));
}

int run(const SteadyArguments& options) {
  const Settings resolved = read_settings(options.case_file, options.overrides);
  const fs::path folder = options.out.empty() ? default_run_folder(options.case_file) : options.out;
  const SteadyFolderSettings settings{
      {folder, options.fresh}, 0, options.hostfile, {}, options.batch.wanted()};
  if (options.batch.wanted()) return write_scripts(options, settings, resolved);
  if (options.dry_run) return dry_run(settings, resolved);
  goes_on_when_repeated();
  SteadyTerminal terminal(folder);
  const SteadyFolderRun done = run_steady_in(settings, resolved, terminal);
  SteadyResult result = done.result;
  if (done.already_finished) result.last = final_state(folder).iterations.back();  // not in result.json
  if (options.json)
    fmt::print("{}", to_json(result));
  else
    print_result(result, resolved, folder);
  std::fflush(stdout);
  const int quality = print_result_warnings(result.warnings, result.usable);
  const int status = result.converged ? quality : static_cast<int>(ExitCode::not_converged);
  if (done.already_finished) {
    fmt::print(stderr, "{} contains the finished run; use --fresh to compute it again\n", folder.string());
    return status;
  }
  if (!result.converged && result.cluster && search_failed(*result.cluster))
    fmt::print(stderr, "not converged: no equilibrium of the spread angle after {} steady solutions\n",
               result.cluster->search->size());
  else if (!result.converged)
    fmt::print(stderr,
               "not converged within {} coupling iterations: {}; repeat the command with --set "
               "coupling.max_iterations={} to continue the run\n",
               result.iterations, fmt::join(unmet_criteria(result.last, resolved.coupling()), "; "),
               more_iterations(resolved.coupling().max_iterations));
  return status;
}

}  // namespace

void add_steady(CLI::App& app, int& status) {
  auto options = std::make_shared<SteadyArguments>();
  CLI::App* command = app.add_subcommand("steady", "Compute inflated shape, drag and loads in a steady flow");
  command->footer(
      "Example: ripstop steady examples/stratos-iv/case.toml --speed 30\n"
      "         ripstop steady examples/stratos-iv/case.toml --flow openfoam --ranks 16 --batch slurm");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  add_case_options(*command, options->overrides);
  add_flow_options(*command, options->overrides);
  add_key_option(*command, "--cloth-nodes", "parachute.mesh.cloth_nodes", "Target number of cloth nodes",
                 options->overrides);
  command->add_flag_callback(
      "--unsteady",
      [options] {
        options->overrides.set.push_back({"flow.unsteady", "true", "--unsteady"});
      },
      "Continue in time and average an unsteady wake, with the standard error of the mean");
  add_existing_file(*command, "--hostfile", options->hostfile,
                    "Hosts for the MPI ranks, one per line: name slots=4");
  command->add_option("--out", options->out, "Run folder")->default_str("runs/<name of the case>");
  command->add_flag("--fresh", options->fresh,
                    "Replace the files of Ripstop in the run folder; without this option the run resumes");
  command->add_flag("--dry-run", options->dry_run, "Print run folder, size and estimated time, and stop");
  add_units_option(*command);
  add_json_option(*command, options->json);
  add_batch_options(*command, options->batch);
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop::cli
