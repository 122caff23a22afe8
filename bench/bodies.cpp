// Bodies of known drag as sheets, on finer and finer grids: slip sides, second-order convection.
//   bench_bodies [cells across the body on the finest grid [body [width of the box in diameters]]]
#include "ripstop/flow/bodies.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/flow/cartesian/cartesian.h"

using namespace ripstop;

namespace {

struct Body {
  std::string name;
  std::vector<Triangle> surface;
  double area, loss, reference;  // loss: coefficient K of a porous disk, 0: impermeable
};

// Box of `box` diameters across and 1.5 times that long, the body at 0.45 of its length; cells of d /
// `across` in a core about it, growing by an eighth outside.
FlowGrid box_about(double d, double box, int across, Vec3 centre) {
  const double from = 0.4 * d, past = 1.4 * d, half = 0.7 * d, growth = 1.125;
  FlowGrid grid{{-box / 2 * d, -box / 2 * d, 0}, {box * d, box * d, 1.5 * box * d}, 0, 0, 0};
  const auto filled = [&](int& cells, int axis) {
    for (cells = 8;; ++cells) {
      FlowGrid one = grid;
      one.nx = axis == 0 ? cells : 8, one.ny = axis == 1 ? cells : 8, one.nz = axis == 2 ? cells : 8;
      const Vec3 low{axis == 0 ? -half : 0, axis == 1 ? -half : 0, axis == 2 ? centre.z - from : 0},
          high{axis == 0 ? half : 0, axis == 1 ? half : 0, axis == 2 ? centre.z + past : 0};
      try {
        const Vec3 h = graded(one, low, high, growth).spacing();
        if ((axis == 0 ? h.x : axis == 1 ? h.y : h.z) <= 1.0001 * d / across) return;
      } catch (const Error&) {  // too few for a core at all
      }
    }
  };
  filled(grid.nx, 0), filled(grid.ny, 1), filled(grid.nz, 2);
  return graded(grid, {-half, -half, centre.z - from}, {half, half, centre.z + past}, growth);
}

struct Result {
  int cells = 0;
  double coefficient = 0, change = 0;  // the latter over the last 100 iterations, relative
};

Result drag_coefficient(const Body& body, const FlowGrid& grid) {
  FlowProblem problem;
  problem.grid = grid;
  problem.air.speed = 30;
  problem.duct = true;
  problem.max_iterations = 600;
  problem.average_over = 100;
  const double rho = problem.air.density, speed = problem.air.speed;
  // K = dp / (rho v^2 / 2) at the velocity v through the disk.
  problem.sheets = {{body.surface, body.loss > 0 ? 0 : 1e6, body.loss * rho / 2}};
  CartesianSettings settings;
  settings.second_order = true;
  const FlowField field = make_cartesian(settings)->solve(problem, {});
  const FlowAverage& mean = field.average;
  return {grid.cells(), field.porous_force.z / (0.5 * rho * speed * speed * body.area),
          mean.iterations > 0 ? (mean.drag_high - mean.drag_low) / mean.drag : 0};
}

}  // namespace

int main(int argc, char** argv) {
  const int finest = argc > 1 ? std::atoi(argv[1]) : 32;
  const std::string only = argc > 2 ? argv[2] : "";
  const double box = argc > 3 ? std::atof(argv[3]) : 12;
  const double d = 1, disk_area = std::numbers::pi / 4 * d * d;
  const Vec3 centre{0, 0, 0.45 * 1.5 * box};
  const std::vector<Body> bodies = {
      {"disk", disk(d, centre), disk_area, 0, 1.17},
      {"square plate", square_plate(d, centre), d * d, 0, 1.17},
      {"cup facing the stream", hemispherical_cup(d, centre), disk_area, 0, 1.42},
      {"porous disk K = 0.5", disk(d, centre), disk_area, 0.5, 0.5 / std::pow(1 + 0.5 / 4, 2)},
      {"porous disk K = 1", disk(d, centre), disk_area, 1, 1 / std::pow(1 + 1.0 / 4, 2)},
      {"porous disk K = 2", disk(d, centre), disk_area, 2, 2 / std::pow(1 + 2.0 / 4, 2)},
  };
  fmt::print("Diameter or side d = 1 m, 30 m/s, box {} x {} x {} m, slip sides, second order\n", box, box,
             1.5 * box);
  fmt::print("{:>22} {:>9} {:>6} {:>9} {:>11} {:>9} {:>14}\n", "body", "reference", "h/d", "cells",
             "coefficient", "off by", "last 100 it.");
  for (const Body& body : bodies) {
    if (!only.empty() && body.name != only) continue;
    for (int n = finest / 4; n <= finest; n *= 2) {
      const Result r = drag_coefficient(body, box_about(d, box, n, centre));
      fmt::print("{:>22} {:>9.3f} {:>6} {:>9} {:>11.3f} {:>+7.1f} % {:>12.2f} %\n", body.name, body.reference,
                 fmt::format("1/{}", n), r.cells, r.coefficient, 100 * (r.coefficient / body.reference - 1),
                 100 * r.change);
      std::fflush(stdout);
    }
  }
}
