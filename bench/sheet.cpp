// Drag of a rigid disk-gap-band as a sheet, shifted by parts of a cell, on finer and finer grids: slip sides,
// second-order convection.
//   bench_sheet [cells across the canopy on the finest grid]
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "far_box.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"

using namespace ripstop;

int main(int argc, char** argv) {
  const int finest = argc > 1 ? std::atoi(argv[1]) : 40;
  const double d = 0.65, box = 12, skirt = 0.45 * 1.5 * box * d;
  fmt::print(
      "Rigid disk-gap-band, d = {} m, 30 m/s, box {} d wide, mean drag of the last 100 of 400 iterations "
      "[N]\n",
      d, box);
  fmt::print("{:>5} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "h/d", "cells", "a Pa s/m", "at 0",
             "1/4 cell", "1/2 cell", "3/4 cell", "mean", "spread");
  for (int n = finest / 4; n <= finest; n *= 2) {
    for (const auto& [a, b] : {std::pair{66.0, 37.45}, std::pair{8169.3, 0.0}}) {
      std::vector<double> drags;
      FlowProblem problem;
      problem.grid = far_box(d, box, n, skirt);
      problem.air.speed = 30;
      problem.sides = Sides::slip;
      problem.max_iterations = 400;
      problem.average_over = 100;
      const Vec3 h = problem.grid.spacing();
      CartesianSettings settings;
      settings.second_order = true;
      for (const double shift : {0.0, 0.25, 0.5, 0.75}) {
        problem.sheets = {{rigid_disk_gap_band({shift * h.x, 0.7 * shift * h.y, skirt + shift * h.z}), a, b}};
        drags.push_back(make_cartesian(settings)->solve(problem, {}).porous_force.z);
      }
      const auto [low, high] = std::minmax_element(drags.begin(), drags.end());
      const double mean = (drags[0] + drags[1] + drags[2] + drags[3]) / 4;
      fmt::print("{:>5} {:>9} {:>9} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>7.2f} %\n",
                 fmt::format("1/{}", n), problem.grid.cells(), a, drags[0], drags[1], drags[2], drags[3],
                 mean, 100 * (*high - *low) / mean);
      std::fflush(stdout);
    }
  }
}
