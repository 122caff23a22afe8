// Speed of the built-in flow engine: bench_flow [--openfoam] [--large], or bench_flow --in-time
//
// --openfoam also times rhoPorousSimpleFoam and porousSimpleFoam with two ranks on the printed grid (some twenty
// minutes on two free cores), each against the built-in engine with the same density, in the same run; --large adds
// the grid of 12 million cells; --in-time counts steps in time instead, with a sheet on graded cells. Figures of one
// run may be compared with each other.
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"

namespace {

using namespace ripstop;

FlowProblem printed_case(double fineness) {
  FlowProblem problem;
  const auto cells = [&](double n) { return static_cast<int>(std::lround(n * fineness)); };
  problem.grid = {{-1, -1, 0}, {2, 2, 4}, cells(100), cells(100), cells(150)};
  problem.air.velocity = {0, 0, 30};
  problem.bodies.push_back(
      porous_body({cut_cells(problem.grid, rigid_disk_gap_band({0, 0, 2})), 65.98, 37.45}));
  return problem;
}

double memory_gib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / (1024.0 * 1024.0);
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

struct Timing {
  FlowField field;
  double seconds = 0;   // wall, everything
  double cpu = 0;       // processor seconds of all threads, everything
  double per_cell = 0;  // wall seconds a cell and iteration, iterations 3 and later of the final grid
};

Timing run(FlowEngine& engine, const FlowProblem& problem) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point t) {
    return std::chrono::duration<double>(Clock::now() - t).count();
  };
  Timing timing;
  const auto start = Clock::now();
  const double before = cpu_seconds();
  auto steady = start;
  timing.field = solve(engine, problem, [&](const FlowProgress& progress) {
    if (progress.iteration == 2) steady = Clock::now();
    if (progress.iteration > 2) {
      timing.per_cell = since(steady) / (static_cast<double>(progress.iteration - 2) * problem.grid.cells());
    }
    return true;
  });
  timing.seconds = since(start);
  timing.cpu = cpu_seconds() - before;
  return timing;
}

CartesianSettings settings(int threads, bool sequencing, bool compressible = true) {
  CartesianSettings s;
  s.threads = threads;
  s.compressible = compressible;
  s.grid_sequencing = sequencing;
  return s;
}

void speed_and_growth(bool large) {
  fmt::print("\nCell-iterations a second, double precision, 20 iterations\n{:>12}{:>14}{:>14}{:>10}\n",
             "cells", "one thread", "two threads", "gain");
  std::vector<double> sizes = {0.4, 0.63, 1, 1.26};
  if (large) sizes.push_back(2);
  for (const double fineness : sizes) {
    FlowProblem problem = printed_case(fineness);
    problem.stopping.max_iterations = 20;
    double rate[2] = {};
    for (int threads : {1, 2}) {
      rate[threads - 1] = 1e-6 / run(*make_cartesian(settings(threads, false)), problem).per_cell;
    }
    fmt::print("{:12}{:12.1f} M{:12.1f} M{:10.2f}\n", problem.grid.cells(), rate[0], rate[1],
               rate[1] / rate[0]);
  }
}

double cold_solution(bool compressible) {
  fmt::print(
      "\nCold solution to 1e-5 on 100 x 100 x 150 cells, 30 m/s, printed porosity, {} density, two threads\n",
      compressible ? "variable" : "constant");
  const FlowProblem problem = printed_case(1);
  const auto engine = make_cartesian(settings(2, true, compressible));
  const Timing t = run(*engine, problem);
  fmt::print("  {:.1f} s, {} iterations on the full grid, drag {:.3f} N, momentum deficit {:.3f} N, {}\n",
             t.seconds, t.field.last.iteration, t.field.porous_force.z, t.field.momentum_deficit.z,
             t.field.converged ? "converged" : "NOT converged");
  fmt::print(
      "  {:.1f} s of processor time; what a loaded machine cannot distort much: {:.1f} M cell-iterations "
      "each\n"
      "  processor second, coarser grids included\n",
      t.cpu, 1e-6 * t.field.last.iteration * problem.grid.cells() / t.cpu);
  fmt::print("  {:.1f} M cell-iterations/s on the full grid; peak memory of the process {:.2f} GiB\n",
             1e-6 / t.per_cell, memory_gib());
  return t.seconds;
}

void against_openfoam(double ours, bool incompressible) {
  OpenFoamSettings reference;
  reference.folder = std::filesystem::temp_directory_path() / "ripstop-bench-flow";
  reference.ranks = 2;
  reference.incompressible = incompressible;
  const auto engine = make_openfoam(reference);
  fmt::print("\n{}, two ranks, the same case\n", engine->name());
  const Timing t = run(*engine, printed_case(1));
  std::filesystem::remove_all(reference.folder);
  fmt::print("  {:.1f} s, {} iterations, drag {:.3f} N, {}; the built-in engine is {:.1f} times faster\n",
             t.seconds, t.field.last.iteration, t.field.porous_force.z,
             t.field.converged ? "converged" : "NOT converged", t.seconds / ours);
  std::fflush(stdout);
}

// A rigid disk-gap-band as a sheet, in the default domain of such a canopy, as in a coupled run.
FlowProblem sheet_case(double fineness) {
  FlowProblem problem;
  const auto cells = [&](double n) { return static_cast<int>(std::lround(n * fineness)); };
  problem.grid = graded({{-2.1, -2.1, 0}, {4.2, 4.2, 6.3}, cells(80), cells(80), cells(98)},
                        {-0.63, -0.63, 2.4}, {0.63, 0.63, 3.94}, 1.125);
  problem.air.velocity = {0, 0, 20};
  problem.sides = Sides::entraining;
  problem.outlet = Outlet::still_air;
  problem.bodies = {sheet_body(rigid_disk_gap_band({0, 0, 2.8}), {66, 37.45})};
  return problem;
}

void steps_in_time() {
  constexpr int warm = 10, timed = 40;
  fmt::print("\nCell-steps a second in time, {} steps\n{:>12}{:>8}{:>14}{:>14}{:>10}\n", timed, "cells",
             "eddies", "one thread", "two threads", "gain");
  for (const auto& [fineness, eddies] : {std::pair{1.17, SmallEddies::des},
                                         {1.17, SmallEddies::wale},
                                         {1.34, SmallEddies::des},
                                         {1.34, SmallEddies::wale}}) {
    const FlowProblem problem = sheet_case(fineness);
    double rate[2] = {};
    for (const int threads : {1, 2}) {
      CartesianSettings how = settings(threads, false);
      how.small_eddies = eddies;
      const auto engine = make_cartesian(how);
      const auto flow = engine->start(problem);
      flow->march(warm, 0.7);
      const auto begin = std::chrono::steady_clock::now();
      flow->march(timed, 0.7);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      rate[threads - 1] = 1e-6 * timed * problem.grid.cells() / seconds;
    }
    fmt::print("{:12}{:>8}{:12.1f} M{:12.1f} M{:10.2f}\n", problem.grid.cells(),
               eddies == SmallEddies::des ? "des" : "wale", rate[0], rate[1], rate[1] / rate[0]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  bool large = false, openfoam = false;
  for (int a = 1; a < argc; ++a) {
    large = large || std::string(argv[a]) == "--large";
    openfoam = openfoam || std::string(argv[a]) == "--openfoam";
  }
  double load[1] = {};
  if (getloadavg(load, 1) == 1) fmt::print("load of the machine before the run: {:.1f}\n", load[0]);
  if (argc > 1 && std::string(argv[1]) == "--in-time") {
    steps_in_time();
    return 0;
  }
  const double compressible = cold_solution(true);
  speed_and_growth(large);
  if (openfoam) {
    const double incompressible = cold_solution(false);
    against_openfoam(incompressible, true);
    against_openfoam(compressible, false);
  }
  return 0;
}
