// How much of the stated pressure drop a thin porous layer really has in OpenFOAM: prints the measured drop
// over Forchheimer's for layers of 1, 2, 3 and 10 cells across a duct. See docs/theory/flow-openfoam.md.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"

int main() {
  using namespace ripstop;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("ripstop_slab_{}", getpid());
  OpenFoamSettings settings;
  settings.folder = folder;
  const auto engine = make_openfoam(settings);
  fmt::print("{}\nkappa = f h / 2   layers   drop / law   estimate\n", engine->name());
  for (const double kappa : {0.03, 0.1, 0.3, 0.5, 1.0, 3.0}) {
    for (const int layers : {1, 2, 3, 10}) {
      FlowProblem problem;
      problem.grid = {{0, 0, 0}, {0.2, 0.2, 2}, 4, 4, 40};
      problem.air.velocity = {0, 0, 5};  // slow, so that the gas keeps its density
      problem.sides = Sides::slip;
      PorousCells slab{{}, 0, 2 * kappa / problem.grid.spacing().z};
      for (int cell = 0; cell < 16 * layers; ++cell)
        slab.cells.push_back(problem.grid.index(0, 0, 20) + cell);
      problem.bodies = {porous_body(slab)};
      const FlowField field = solve(*engine, problem);
      const double law = layers * kappa * problem.air.density * 25;
      const double x = (std::sqrt(1 + kappa) - 1) / (kappa / 2);  // root of x = 1 - kappa x^2 / 4
      fmt::print("{:15g} {:8} {:12.4f} {}{}\n", kappa, layers, field.pressure.front() / law,
                 layers == 1 ? fmt::format("{:10.4f}", x * x) : "",
                 field.converged ? "" : "  (not converged)");
    }
  }
  std::filesystem::remove_all(folder);
}
