// ripstop flow-parity: the built-in flow engine and OpenFOAM on the same cells, side by side.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "progress.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"
#include "ripstop/output/stl.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<int> cells = {25, 25, 38};
  double speed = 10;
  double density = 1.2;
  fs::path surface;
  fs::path folder;
  int ranks = 1;
  int threads = 0;
  bool incompressible = false;
  std::vector<std::string> canopies;  // none: all
  bool coarse_start = false;
  bool slip = false;
};

struct Canopy {
  const char* name;
  double darcy, forchheimer;
};
// Ten times more open than [NFM] Table 3's canopy, that canopy, and one that lets almost nothing through.
constexpr Canopy canopies[] = {
    {"open", 6.598, 3.745}, {"printed", 65.98, 37.45}, {"nearly solid", 1000, 1000}};

struct Run {
  FlowField field;
  double seconds = 0;
  bool diverged = false;
  std::string outcome;  // what to say of it when one of the engines diverged
};

Run timed(FlowEngine& engine, const FlowProblem& problem, const char* canopy) {
  Progress progress;
  const auto start = std::chrono::steady_clock::now();
  Run run;
  const FlowReport report = [&](const FlowProgress& p) {
    progress.show(fmt::format("{}, {}: iteration {}, residual of p {:.1e}, drag {:.3f} N", canopy,
                              engine.name(), p.iteration, p.residual_p, p.drag));
    return true;
  };
  try {
    run.field = solve(engine, problem, report);
    run.outcome = fmt::format("{:13}{}: drag {:.4f} N, while the box loses {:.4f} N\n", canopy, engine.name(),
                              run.field.porous_force.z, run.field.momentum_deficit);
  } catch (const Error& error) {  // the other engine and the other canopies are of interest all the same
    if (error.code() != ExitCode::diverged) throw;
    run.diverged = true;
    run.outcome = fmt::format("{:13}{}: {}\n", canopy, engine.name(), error.what());
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

// Root mean square and largest difference of the fields, of the stream's speed and dynamic pressure.
struct Difference {
  double velocity = 0, pressure = 0, largest_velocity = 0, largest_pressure = 0;
};

Difference difference(const FlowField& a, const FlowField& b, const Freestream& air) {
  const double dynamic = 0.5 * air.density * air.speed * air.speed;
  const auto cells = static_cast<double>(a.pressure.size());
  Difference d;
  for (std::size_t cell = 0; cell < a.pressure.size(); ++cell) {
    const double u = norm(a.velocity[cell] - b.velocity[cell]) / air.speed;
    const double p = std::abs(a.pressure[cell] - b.pressure[cell]) / dynamic;
    d.velocity += u * u / cells;
    d.pressure += p * p / cells;
    d.largest_velocity = std::max(d.largest_velocity, u);
    d.largest_pressure = std::max(d.largest_pressure, p);
  }
  d.velocity = std::sqrt(d.velocity);
  d.pressure = std::sqrt(d.pressure);
  return d;
}

bool asked_for(const Options& options, const Canopy& canopy) {
  const std::vector<std::string>& names = options.canopies;
  return names.empty() || std::find(names.begin(), names.end(), canopy.name) != names.end();
}

// Of drag. Above 20 m/s the built-in engine's energy equation is not quite OpenFOAM's.
double tolerance(const Options& options) {
  return options.speed > 20 && !options.incompressible ? 0.01 : 0.005;
}

int compare(const Options& options) {
  FlowProblem problem;
  problem.grid = {{-1, -1, 0}, {2, 2, 4}, options.cells[0], options.cells[1], options.cells[2]};
  problem.air.speed = options.speed;
  problem.air.density = options.density;
  if (options.slip) problem.sides = Sides::slip;
  const std::vector<Triangle> surface =
      options.surface.empty() ? rigid_disk_gap_band({0, 0, 2}) : read_stl(options.surface);
  const std::vector<int> cut = cut_cells(problem.grid, surface);
  const fs::path folder = options.folder.empty()
                              ? fs::temp_directory_path() / fmt::format("ripstop-flow-parity-{}", getpid())
                              : options.folder;
  fmt::print("{} x {} x {} cells, {} of them porous, {} m/s\n\n", problem.grid.nx, problem.grid.ny,
             problem.grid.nz, cut.size(), options.speed);
  fmt::print("{:13}{:>13}{:>13}{:>9}{:>9}{:>9}{:>9}{:>9}{:>7}{:>7}{:>9}{:>9}\n", "canopy", "OpenFOAM, N",
             "built-in, N", "drag %", "U L2 %", "p L2 %", "U max %", "p max %", "it.", "it.", "time, s",
             "time, s");
  bool within = true;
  for (const Canopy& canopy : canopies) {
    if (!asked_for(options, canopy)) continue;
    problem.porous = {{cut, canopy.darcy, canopy.forchheimer}};
    OpenFoamSettings reference;
    reference.folder = folder;
    reference.ranks = options.ranks;
    reference.incompressible = options.incompressible;
    CartesianSettings settings;
    settings.threads = options.threads;
    settings.compressible = !options.incompressible;
    settings.grid_sequencing = options.coarse_start;
    const Run theirs = timed(*make_openfoam(reference), problem, canopy.name);
    const Run ours = timed(*make_cartesian(settings), problem, canopy.name);
    if (theirs.diverged || ours.diverged) {
      fmt::print("{}{}", theirs.outcome, ours.outcome);
      within = false;
      continue;
    }
    const Difference d = difference(ours.field, theirs.field, problem.air);
    const double drag = ours.field.porous_force.z / theirs.field.porous_force.z - 1;
    fmt::print("{:13}{:13.4f}{:13.4f}{:9.4f}{:9.4f}{:9.4f}{:9.4f}{:9.4f}{:7}{:7}{:9.2f}{:9.2f}{}\n",
               canopy.name, theirs.field.porous_force.z, ours.field.porous_force.z, 100 * drag,
               100 * d.velocity, 100 * d.pressure, 100 * d.largest_velocity, 100 * d.largest_pressure,
               theirs.field.last.iteration, ours.field.last.iteration, theirs.seconds, ours.seconds,
               theirs.field.converged && ours.field.converged ? "" : "  not converged");
    std::fflush(stdout);
    const double allowed = tolerance(options);
    within = within && std::abs(drag) <= allowed && d.velocity <= 0.01 && d.pressure <= 0.01;
  }
  if (options.folder.empty()) fs::remove_all(folder);
  if (!within)
    throw Error(
        ExitCode::not_converged,
        fmt::format("an engine diverged, or they differ by more than {:g} % of drag or 1 % of a field",
                    100 * tolerance(options)));
  return 0;
}

}  // namespace

void add_flow_parity(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "flow-parity", "Run the built-in flow engine and OpenFOAM on the same cells and compare them");
  command->add_option("--cells", options->cells, "Cells along x, y and z of the 2 x 2 x 4 m box")
      ->expected(3)
      ->check(CLI::Range(4, 2000));
  command->add_option("--speed", options->speed, "Free stream [m/s]")->check(CLI::Range(0.1, 100.0));
  command->add_option("--density", options->density, "Air [kg/m3]")->check(CLI::Range(0.1, 10.0));
  command
      ->add_option(
          "--surface", options->surface,
          "Canopy as a binary STL in the box's axes (z from 0 to 4 m); default: a rigid disk-gap-band")
      ->check(CLI::ExistingFile);
  command->add_option("--folder", options->folder,
                      "Where OpenFOAM's case goes and stays; default: a temporary folder");
  command->add_option("--ranks", options->ranks, "OpenFOAM's MPI processes")->check(CLI::Range(1, 1024));
  command->add_option("--threads", options->threads, "Threads of the built-in engine; 0: all")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--incompressible", options->incompressible,
                    "Constant density in both engines: porousSimpleFoam in place of rhoPorousSimpleFoam");
  command->add_flag("--slip", options->slip, "Sides of the box are walls without friction, not open");
  command->add_flag(
      "--coarse-start", options->coarse_start,
      "The built-in engine starts from coarser grids, as it does elsewhere; by default both start "
      "from the uniform stream");
  std::vector<std::string> names;
  for (const Canopy& canopy : canopies) names.emplace_back(canopy.name);
  command->add_option("--canopy", options->canopies, "Only this canopy; may be given more than once")
      ->check(CLI::IsMember(names));
  command->footer(
      "Fails when drag differs by more than 0.5 % (1 % above 20 m/s with compressible air), or velocity or\n"
      "pressure (L2) by more than 1 % of the stream's speed or dynamic pressure.\n"
      "Examples: ripstop flow-parity --cells 50 50 75 --speed 30\n"
      "          ripstop flow-parity --speed 30 --incompressible --canopy printed");
  command->callback([options, &status] { status = compare(*options); });
}

}  // namespace ripstop
