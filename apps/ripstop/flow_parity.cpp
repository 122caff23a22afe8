// ripstop flow-parity: the built-in flow engine and OpenFOAM on the same cells, side by side.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "json_option.h"
#include "number_option.h"
#include "option.h"
#include "progress.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/stl.h"
#include "ripstop/run/steady/parity.h"

namespace ripstop::cli {
namespace {

struct FlowParityArguments {
  ParitySettings settings;
  std::filesystem::path surface;
  bool json = false;
};

void print_header(const ParityResult& result) {
  fmt::print("{} x {} x {} cells, {} of them porous, {} m/s\n\n", result.cells[0], result.cells[1],
             result.cells[2], result.porous_cells, result.speed);
  fmt::print("{:13}{:>22}{:>40}{:>18}{:>18}\n", "", "drag, N", "difference of drag, velocity, pressure, %",
             "iterations", "wall time, s");
  fmt::print("{:13}{:>11}{:>11}{:>8}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>9}{:>9}\n", "canopy", "OpenFOAM",
             "built-in", "drag", "U rms", "p rms", "U max", "p max", "OpenFOAM", "built-in", "OpenFOAM",
             "built-in");
}

void print_parity(const ParityRow& row) {
  const ParityRun &theirs = row.openfoam, &ours = row.builtin;
  if (row.diverged()) {
    for (const auto& [engine, run] : {std::pair{"OpenFOAM", &theirs}, std::pair{"built-in", &ours}})
      fmt::print("{:13}{}: {}\n", row.canopy, engine,
                 run->diverged.empty() ? fmt::format("drag {:.4f} N, momentum deficit {:.4f} N", run->drag,
                                                     run->momentum_deficit)
                                       : run->diverged);
    return;
  }
  fmt::print("{:13}{:11.4f}{:11.4f}{:8.4f}{:8.4f}{:8.4f}{:8.4f}{:8.4f}{:9}{:9}{:9.2f}{:9.2f}{}\n", row.canopy,
             theirs.drag, ours.drag, 100 * row.drag, 100 * row.velocity, 100 * row.pressure,
             100 * row.largest_velocity, 100 * row.largest_pressure, theirs.iterations, ours.iterations,
             theirs.wall_time, ours.wall_time, theirs.converged && ours.converged ? "" : "  not converged");
}

int run(const FlowParityArguments& options) {
  ParitySettings settings = options.settings;
  if (!options.surface.empty()) settings.surface = read_stl(options.surface);
  Progress progress;
  ParityEvents events;
  events.progress = [&](const std::string& canopy, const std::string& engine, const FlowProgress& p) {
    progress.show(fmt::format("{}, {}: iteration {}, residual of p {:.1e}, drag {:.3f} N", canopy, engine,
                              p.iteration, p.residual_p, p.drag));
  };
  events.row = [&](const ParityResult& so_far) {
    if (options.json) return;
    if (so_far.rows.empty())
      print_header(so_far);
    else
      print_parity(so_far.rows.back());
    std::fflush(stdout);
  };
  const ParityResult result = flow_parity(settings, events);
  if (options.json) fmt::print("{}", to_json(result));
  bool within = true;
  for (const ParityRow& row : result.rows) within = within && row.within;
  if (!within)
    throw Error(
        ExitCode::not_converged,
        fmt::format("an engine diverged, or they differ by more than {:g} % of drag or 1 % of a field",
                    100 * result.drag_tolerance));
  return 0;
}

}  // namespace

void add_flow_parity(CLI::App& app, int& status) {
  auto options = std::make_shared<FlowParityArguments>();
  CLI::App* command = app.add_subcommand(
      "flow-parity", "Run the built-in flow engine and OpenFOAM on the same cells and compare them");
  add_three(*command, "--cells", options->settings.cells, key_range("flow.cells"),
            "Cells along x, y and z of the flow domain of 2 x 2 x 4 m");
  add_number(*command, "--speed", options->settings.speed, from(0.1).up_to(100),
             "Speed of the free stream [m/s]");
  add_number(*command, "--density", options->settings.density, from(0.1).up_to(10),
             "Density of the air [kg/m3]");
  add_existing_file(*command, "--surface", options->surface,
                    "Canopy as a binary STL in the axes of the domain (z from 0 to 4 m)")
      ->default_str("a rigid disk-gap-band");
  command->add_option("--folder", options->settings.folder, "Folder that keeps the case of OpenFOAM")
      ->default_str("a temporary folder");
  add_number(*command, "--ranks", options->settings.ranks, key_range("flow.ranks"),
             "MPI processes of OpenFOAM");
  add_number(*command, "--threads", options->settings.threads, key_range("coupling.threads"),
             "Threads of the built-in engine; 0: all cores");
  command->add_flag("--incompressible", options->settings.incompressible,
                    "Constant density in both engines: porousSimpleFoam instead of rhoPorousSimpleFoam");
  command->add_flag("--slip", options->settings.slip,
                    "Frictionless walls instead of open boundaries at the sides of the domain");
  command->add_flag(
      "--coarse-start", options->settings.coarse_start,
      "Start the built-in engine from coarser grids, as in other commands; without this option both "
      "engines start from the uniform stream");
  std::vector<std::string> names;
  for (const ParityCanopy& canopy : parity_canopies) names.emplace_back(canopy.name);
  accept_words(
      command->add_option("--canopy", options->settings.canopies, "Compute only this canopy; repeatable"),
      names)
      ->default_str("all");
  command->footer(
      "The command fails when drag differs by more than 0.5 % (1 % above 20 m/s with compressible air).\n"
      "It also fails when the rms difference of velocity or pressure is above 1 % of the stream's speed or\n"
      "dynamic pressure.\n"
      "Examples: ripstop flow-parity --cells 50 50 75 --speed 30\n"
      "          ripstop flow-parity --speed 30 --incompressible --canopy printed");
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop::cli
