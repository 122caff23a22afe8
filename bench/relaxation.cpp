// How the cloth of every example finds its equilibrium under an even pressure:
//   bench_relaxation [--nodes N] [--threads N] [--tolerance T] [--pressures 5,20,...] [EXAMPLE ...]
// prints a table of steps (of the whole cloth, after the sector predictor), seconds, residual and projected
// diameter;
//   bench_relaxation --ratio [EXAMPLE ...]
// the time of the whole cloth alone on one thread and on two, the best of five, alternately.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/canopy/shape.h"
#include "ripstop/case/assemble.h"
#include "ripstop/cloth/cloth.h"
#include "table.h"

namespace {

using namespace ripstop;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

CanopyMesh example(const std::string& name, int nodes) {
  Case given = read_case(data_directory() / "examples" / name / "case.toml");
  given.parachute.mesh.cloth_nodes = nodes;
  given.flow.porosity_model = PorosityModel::sheet;
  return parachute_mesh(resolve(given));
}

std::vector<std::string> all_examples() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(data_directory() / "examples"))
    if (std::filesystem::exists(entry.path() / "case.toml")) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

struct Arguments {
  int nodes = 25000, threads = 2, steps = 200000;
  double tolerance = 5e-4;  // as coupling.cloth_tolerance
  std::vector<double> pressures = {5, 20, 80, 320, 1000, 5000};
  bool ratio = false;
  std::vector<std::string> examples;
};

Arguments arguments(int count, char** values) {
  Arguments result;
  for (int i = 1; i < count; ++i) {
    const std::string word = values[i];
    const auto number = [&] { return std::atof(++i < count ? values[i] : "0"); };
    if (word == "--nodes") {
      result.nodes = static_cast<int>(number());
    } else if (word == "--threads") {
      result.threads = static_cast<int>(number());
    } else if (word == "--steps") {
      result.steps = static_cast<int>(number());
    } else if (word == "--tolerance") {
      result.tolerance = number();
    } else if (word == "--ratio") {
      result.ratio = true;
    } else if (word == "--pressures") {
      result.pressures.clear();
      for (const char* at = ++i < count ? values[i] : ""; *at;) {
        char* end = nullptr;
        result.pressures.push_back(std::strtod(at, &end));
        at = *end == ',' ? end + 1 : end;
      }
    } else {
      result.examples.push_back(word);
    }
  }
  if (result.examples.empty()) result.examples = all_examples();
  return result;
}

void print_table(const Arguments& given, int argc, char** argv) {
  print_table_head(
      fmt::format("Equilibrium from the flat canopy, {} nodes, {} threads, residual {:.0e} of the load",
                  given.nodes, given.threads, given.tolerance),
      argc, argv,
      {"example", "pressure, Pa", "steps of the whole canopy", "wall time, s", "residual",
       "projected diameter, m"});
  ThreadTeam team(given.threads);
  for (const std::string& name : given.examples) {
    const CanopyMesh mesh = example(name, given.nodes);
    const ClothPtr cloth = make_cloth(mesh);
    for (const double pressure : given.pressures) {
      ClothState state = start_state(*cloth);
      const Loads loads{std::vector<double>(mesh.cell_count(), pressure), {}};
      RelaxOptions options;
      options.tolerance = given.tolerance;
      options.max_steps = given.steps;
      const double begin = seconds();
      const RelaxResult result = relax(state, *cloth, loads, options, team);
      fmt::print("| {} | {} | {} | {:.2f} | {:.1e}{} | {:.5f} |\n", name, pressure, result.steps,
                 seconds() - begin, result.residual, result.converged ? "" : " (none)",
                 canopy_size(mesh, positions(state, *cloth)).projected_diameter);
      std::fflush(stdout);
    }
  }
}

// The whole relaxation from flat by the whole cloth, equal to the last bit on any number of threads,
// alternately on one and on two.
void print_ratio(const Arguments& given, int argc, char** argv) {
  constexpr int turns = 5;
  print_table_head(fmt::format("Equilibrium from the flat canopy, {} nodes, one thread and two", given.nodes),
                   argc, argv, {"example", "pressure, Pa", "steps", "1 thread, s", "2 threads, s", "ratio"});
  ThreadTeam alone(1), pair(2);
  for (const std::string& name : given.examples) {
    const CanopyMesh mesh = example(name, given.nodes);
    const ClothPtr cloth = make_cloth(mesh);
    for (const double pressure : given.pressures) {
      // Forces on nodes, though none: a cloth under them goes the whole way as a whole.
      const Loads loads{std::vector<double>(mesh.cell_count(), pressure),
                        std::vector<Vec3>(mesh.node_count())};
      RelaxOptions options;
      options.tolerance = given.tolerance;
      options.max_steps = given.steps;
      int steps = 0;
      const auto time = [&](ThreadTeam& team) {
        ClothState state = start_state(*cloth);
        const double begin = seconds();
        steps = relax(state, *cloth, loads, options, team).steps;
        return seconds() - begin;
      };
      double one = 1e30, two = 1e30;
      for (int turn = 0; turn < turns; ++turn) {
        one = std::min(one, time(alone));
        two = std::min(two, time(pair));
      }
      fmt::print("| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", name, pressure, steps, one, two, one / two);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments given = arguments(argc, argv);
  if (given.ratio)
    print_ratio(given, argc, argv);
  else
    print_table(given, argc, argv);
}
