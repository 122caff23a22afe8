// Drag of a rigid disk-gap-band of F-111 as a sheet, shifted by parts of a cell, on finer and finer grids.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"

using namespace ripstop;

int main(int argc, char** argv) {
  const int finest = argc > 1 ? std::atoi(argv[1]) : 100;
  fmt::print(
      "Rigid disk-gap-band, 30 m/s, box 2 x 2 x 4 m, mean drag of the last 100 of 600 iterations [N]\n");
  fmt::print("{:>16} {:>8} {:>10} {:>10} {:>10} {:>10} {:>9}\n", "cells", "a Pa s/m", "at 0", "1/4 cell",
             "1/2 cell", "3/4 cell", "spread");
  for (int n = 25; n <= finest; n *= 2) {
    for (const auto& [a, b] : {std::pair{66.0, 37.45}, std::pair{8169.3, 0.0}}) {
      std::vector<double> drags;
      for (const double shift : {0.0, 0.25, 0.5, 0.75}) {
        FlowProblem problem;
        problem.grid = {{-1, -1, 0}, {2, 2, 4}, n, n, 3 * n / 2};
        problem.air.speed = 30;
        problem.max_iterations = 600;
        const Vec3 h = problem.grid.spacing();
        problem.sheets = {{rigid_disk_gap_band({shift * h.x, 0.7 * shift * h.y, 2 + shift * h.z}), a, b}};
        double sum = 0;
        int count = 0;
        const FlowField field = make_cartesian()->solve(problem, [&](const FlowProgress& progress) {
          if (progress.iteration > 500) sum += progress.drag, ++count;
          return true;
        });
        drags.push_back(count > 0 ? sum / count : field.porous_force.z);
      }
      const auto [low, high] = std::minmax_element(drags.begin(), drags.end());
      fmt::print("{:>16} {:>8} {:>10.2f} {:>10.2f} {:>10.2f} {:>10.2f} {:>7.2f} %\n",
                 fmt::format("{}x{}x{}", n, n, 3 * n / 2), a, drags[0], drags[1], drags[2], drags[3],
                 100 * (*high - *low) / *low);
      std::fflush(stdout);
    }
  }
}
