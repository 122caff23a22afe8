// Drag of a rigid disk-gap-band as a sheet, shifted by parts of a cell, on finer and finer grids: slip sides,
// second-order convection. Effect of the shift, and order of convergence of the mean over the shifts.
//   bench_sheet [cells across the canopy on the finest grid [grids]]
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "far_box.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"
#include "table.h"

using namespace ripstop;

namespace {

constexpr double d = 0.65, box = 12, skirt = 0.45 * 1.5 * box * d;  // diameter [m], width [d], place [m]
constexpr int iterations = 400, averaged = 100;
constexpr Vec3 shifts[] = {{0, 0, 0},           {0.25, 0.175, 0.25}, {0.5, 0.35, 0.5},
                           {0.75, 0.525, 0.75}, {0.5, 0, 0},         {0, 0, 0.5}};  // cells

double drag(const FlowGrid& grid, Vec3 shift, double a, double b) {
  FlowProblem problem;
  problem.grid = grid;
  problem.air.velocity = {0, 0, 30};
  problem.sides = Sides::slip;
  problem.stopping.max_iterations = iterations;
  problem.stopping.average_over = averaged;
  const Vec3 h = grid.spacing();
  problem.bodies = {
      sheet_body(rigid_disk_gap_band({shift.x * h.x, shift.y * h.y, skirt + shift.z * h.z}), {a, b})};
  problem.outlet = Outlet::still_air;
  CartesianSettings settings;
  settings.second_order = true;
  return solve(*make_cartesian(settings), problem).porous_force.z;
}

}  // namespace

int main(int argc, char** argv) {
  const int finest = argc > 1 ? std::atoi(argv[1]) : 40, grids = argc > 2 ? std::atoi(argv[2]) : 4;
  if (finest < 10 || grids < 1) {
    fmt::print(stderr, "usage: bench_sheet [finest >= 10 [grids >= 1]]\n");
    return 2;
  }
  std::vector<std::string> columns = {"h/d", "a, Pa s/m"};
  for (const Vec3& s : shifts) columns.push_back(fmt::format("{:g}, {:g}, {:g}", s.x, s.y, s.z));
  columns.insert(columns.end(), {"mean", "range over mean"});
  print_table_head(
      fmt::format(
          "Drag in N of a rigid disk-gap-band of {:g} m at 30 m/s by its displacement in cells along x, y, z",
          d),
      argc, argv, columns);
  for (const auto& [a, b] : {std::pair{66.0, 37.45}, std::pair{8169.3, 0.0}}) {
    std::vector<double> means;
    for (int g = grids - 1; g >= 0; --g) {
      const int across = static_cast<int>(std::lround(finest * std::pow(2, -0.5 * g)));
      const FlowGrid grid = far_box(d, box, across, skirt);
      std::vector<std::string> row = {fmt::format("1/{}", across), fmt::format("{:g}", a)};
      std::vector<double> drags;
      for (const Vec3& shift : shifts) {
        drags.push_back(drag(grid, shift, a, b));
        row.push_back(fmt::format("{:.2f}", drags.back()));
      }
      const auto [low, high] = std::minmax_element(drags.begin(), drags.end());
      double mean = 0;
      for (const double one : drags) mean += one / static_cast<double>(drags.size());
      row.insert(row.end(),
                 {fmt::format("{:.2f}", mean), fmt::format("{:.2f} %", 100 * (*high - *low) / mean)});
      print_row(row);
      means.push_back(mean);
    }
    if (const auto found = observed_order(means, std::sqrt(2.0)))
      fmt::print(stderr, "a = {:g}: order {:.2f} on the last three grids, toward {:.5g} N\n", a, found->order,
                 found->limit);
  }
}
