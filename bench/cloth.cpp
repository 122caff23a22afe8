// How fast the cloth steps and relaxes: `bench_cloth` prints a table. Many short runs; the median includes other work
// on the machine, the best is its own speed.
#include "ripstop/cloth/cloth.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "../tests/printed_materials.h"
#include "ripstop/cloth/kernel.h"
#include "ripstop/core/build_info.h"
#include "ripstop/material/lattice.h"
#include "ripstop/parachute/build.h"
#include "ripstop/parachute/disk_gap_band.h"

namespace {

using namespace ripstop;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Square of F-111 cloth, rim fixed, `tapes` columns with tape along them (irregular springs).
Mesh membrane(int size, double side, double damping, int tapes) {
  Mesh mesh;
  Patch patch;
  patch.name = "membrane";
  patch.rows = patch.columns = size;
  const double h = side / (size - 1), xi = 0.2, eps = 0.01;
  const LatticeLaws laws = lattice_laws(f111_curve, xi, eps, 1, 0.33);
  const CellWidths cell = cell_widths(h, h, xi, eps);
  const SpringLaw* law[] = {&laws.axial, &laws.axial, &laws.shear, &laws.shear, &laws.bending, &laws.bending};
  const double width[] = {2 * cell.along_row, 2 * cell.along_column, cell.shear,
                          cell.shear,         4 * cell.bend_row,     4 * cell.bend_column};
  const double rest[] = {h, h, h * std::sqrt(2.0), h * std::sqrt(2.0), 2 * h, 2 * h};
  for (int d = 0; d < direction_count; ++d) {
    patch.law[d] = *law[d];
    patch.damping[d] = damping;
    patch.width[d].assign(size * size, 0.0);
    patch.rest_length[d].assign(size * size, rest[d]);
    for (int row = 0; row + direction_offset[d].row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const int to = column + direction_offset[d].column;
        if (to >= 0 && to < size) patch.width[d][row * size + column] = width[d];
      }
  }
  patch.cell_area.assign((size - 1) * size, h * h);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      mesh.start.push_back({column * h, row * h, 0});
      mesh.mass.push_back(0.0407 * h * h);
      if (row == 0 || column == 0 || row + 1 == size || column + 1 == size)
        mesh.fixed.push_back(patch.node(row, column));
    }
  mesh.laws.push_back({{3064.2, 68823.4}, 1});
  mesh.parts.push_back("tape");
  for (int t = 0; t < tapes; ++t)
    for (int row = 0; row + 1 < size; ++row) {
      const int column = (t + 1) * size / (tapes + 1);
      mesh.springs.push_back({patch.node(row, column), patch.node(row + 1, column), h, 0.02, 0, 0, 0});
    }
  mesh.patches.push_back(std::move(patch));
  return mesh;
}

Mesh stratos() {
  return build_mesh(printed_stratos(25600), printed_materials());
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

}  // namespace

int main() {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  fmt::print("{}, {}, kernels {}\n", processor(), compiler(), kernel_target());
  fmt::print("{:<34}{:>21}{:>21}{:>17}\n", "node updates, M/s (median, best)", "1 thread", "2 threads",
             "2 over 1");
  struct Case {
    const char* name;
    Mesh mesh;
  };
  for (const Case& c : {Case{"25,600 nodes, damped", membrane(160, 1.0, 1e-3, 0)},
                        Case{"25,600 nodes, undamped", membrane(160, 1.0, 0, 0)},
                        Case{"25,600 nodes, damped, 10 tapes", membrane(160, 1.0, 1e-3, 10)},
                        Case{"4,096 nodes, damped", membrane(64, 1.0, 1e-3, 0)},
                        Case{"Stratos IV canopy, undamped", stratos()}}) {
    const Mesh& mesh = c.mesh;
    const ClothPtr cloth = make_cloth(mesh);
    const Loads loads{std::vector<double>(mesh.cell_count(), 500.0), {}};
    ClothState one = start_state(*cloth), two = one;
    const double dt = 0.5 * stability_limit(*cloth, one).stable_step;
    ThreadTeam alone(1), pair(2);
    const int steps = static_cast<int>(1.5e6 / mesh.node_count());
    std::vector<double> rate1, rate2;
    for (int run = 0; run < 60; ++run) {
      const double t0 = seconds();
      step(one, *cloth, loads, dt, steps, alone);
      const double t1 = seconds();
      step(two, *cloth, loads, dt, steps, pair);
      const double t2 = seconds();
      const double updates = 1e-6 * mesh.node_count() * steps;
      rate1.push_back(updates / (t1 - t0));
      rate2.push_back(updates / (t2 - t1));
    }
    const double best1 = *std::max_element(rate1.begin(), rate1.end());
    const double best2 = *std::max_element(rate2.begin(), rate2.end());
    fmt::print("{:<34}{:>12.1f}{:>9.1f}{:>12.1f}{:>9.1f}{:>10.2f}{:>7.2f}\n", c.name, median(rate1), best1,
               median(rate2), best2, median(rate2) / median(rate1), best2 / best1);
  }

  fmt::print("\n{:<30}{:>12}{:>10}{:>10}{:>12}\n", "relaxation from flat, 500 Pa", "tolerance", "steps", "s",
             "us a step");
  const auto time_relaxation = [&](const std::string& name, const Mesh& mesh, double tolerance) {
    const ClothPtr cloth = make_cloth(mesh);
    const Loads loads{std::vector<double>(mesh.cell_count(), 500.0), {}};
    ClothState state = start_state(*cloth);
    ThreadTeam team(static_cast<int>(std::min(2u, cores)));
    const double t0 = seconds();
    const RelaxResult result = relax(state, *cloth, loads, {tolerance, 50000}, team);
    const double t = seconds() - t0;
    fmt::print("{:<30}{:>12.0e}{:>10}{:>10.2f}{:>12.1f}{}\n", name, tolerance, result.steps, t,
               1e6 * t / result.steps, result.converged ? "" : "  not converged");
  };
  for (int size : {40, 80, 160})
    for (double tolerance : {1e-2, 1e-4, 1e-6})
      time_relaxation(fmt::format("{0} x {0} clamped membrane", size), membrane(size, 1.0, 0, 0), tolerance);
  for (double tolerance : {1e-2, 1e-3, 1e-4}) time_relaxation("Stratos IV canopy", stratos(), tolerance);
}
