// Bodies of known drag as sheets, on finer and finer grids, second-order convection.
//   bench_bodies [cells across the body on the finest grid [body [width of the box in diameters
//                [turbulence intensity [sides: slip, entraining or zero-gradient]]]]]
#include "ripstop/flow/bodies.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "far_box.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"

using namespace ripstop;

namespace {

struct Body {
  std::string name;
  std::vector<Triangle> surface;
  double area, loss, reference;  // loss: coefficient K of a porous disk, 0: impermeable
};

struct Result {
  int cells = 0;
  double coefficient = 0, change = 0;  // the latter over the last 100 iterations, relative
  double front = 0, back = 0;          // mean pressure coefficient, weighted with the area across the flow
};

// Means over the faces across the stream that the body parts, of the cells before and behind them.
void read_pressures(const FlowField& field, double dynamic_pressure, Result& result) {
  const FlowGrid& grid = field.grid;
  double area = 0;
  for (const SheetLoad& load : field.sheet_loads) {
    if (load.force.z == 0) continue;
    int k = grid.cell_at(2, load.point.z);
    if (grid.centre(2, k) > load.point.z) --k;
    const int i = grid.cell_at(0, load.point.x), j = grid.cell_at(1, load.point.y);
    const double share = load.force.z / load.drop;
    area += share;
    result.front += share * field.pressure[grid.index(i, j, k)];
    result.back += share * field.pressure[grid.index(i, j, k + 1)];
  }
  result.front /= area * dynamic_pressure, result.back /= area * dynamic_pressure;
}

Result drag_coefficient(const Body& body, const FlowGrid& grid, double turbulence, Sides sides) {
  FlowProblem problem;
  problem.grid = grid;
  problem.air.speed = 30;
  problem.air.turbulence_intensity = turbulence;
  problem.sides = sides;
  problem.stopping.max_iterations = 600;
  problem.stopping.average_over = 100;
  const double rho = problem.air.density, speed = problem.air.speed;
  // K = dp / (rho v^2 / 2) at the velocity v through the disk.
  problem.sheets = {{body.surface, body.loss > 0 ? 0 : 1e6, body.loss * rho / 2}};
  problem.outlet = Outlet::still_air;
  CartesianSettings settings;
  settings.second_order = true;
  const FlowField field = solve(*make_cartesian(settings), problem);
  const FlowAverage& mean = field.average;
  const double dynamic_pressure = 0.5 * rho * speed * speed;
  Result result;
  result.cells = grid.cells();
  result.coefficient = field.porous_force.z / (dynamic_pressure * body.area);
  if (mean.iterations > 0) result.change = (mean.drag_high - mean.drag_low) / mean.drag;
  read_pressures(field, dynamic_pressure, result);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const int finest = argc > 1 ? std::atoi(argv[1]) : 32;
  const std::string only = argc > 2 ? argv[2] : "";
  const double box = argc > 3 ? std::atof(argv[3]) : 12, turbulence = argc > 4 ? std::atof(argv[4]) : 0.005;
  const std::string side = argc > 5 ? argv[5] : "slip";
  const Sides sides = side == "entraining" ? Sides::entraining
                      : side == "slip"     ? Sides::slip
                                           : Sides::zero_gradient;
  const double d = 1, disk_area = std::numbers::pi / 4 * d * d;
  const Vec3 centre{0, 0, 0.45 * 1.5 * box * d};
  const std::vector<Body> bodies = {
      {"disk", disk(d, centre), disk_area, 0, 1.17},
      {"square plate", square_plate(d, centre), d * d, 0, 1.17},
      {"cup facing the stream", hemispherical_cup(d, centre), disk_area, 0, 1.42},
      {"porous disk K = 0.5", disk(d, centre), disk_area, 0.5, 0.5 / std::pow(1 + 0.5 / 4, 2)},
      {"porous disk K = 1", disk(d, centre), disk_area, 1, 1 / std::pow(1 + 1.0 / 4, 2)},
      {"porous disk K = 2", disk(d, centre), disk_area, 2, 2 / std::pow(1 + 2.0 / 4, 2)},
  };
  fmt::print("Diameter or side d = 1 m, 30 m/s, box {} x {} x {} m, {} sides, second order\n", box, box,
             1.5 * box, side);
  fmt::print("{:>22} {:>9} {:>6} {:>9} {:>11} {:>9} {:>8} {:>8} {:>14}\n", "body", "reference", "h/d",
             "cells", "coefficient", "off by", "Cp front", "Cp back", "last 100 it.");
  for (const Body& body : bodies) {
    if (!only.empty() && body.name != only) continue;
    std::vector<double> all;
    for (int n = finest / 4; n <= finest; n *= 2) {
      const Result r = drag_coefficient(body, far_box(d, box, n, centre.z), turbulence, sides);
      fmt::print("{:>22} {:>9.3f} {:>6} {:>9} {:>11.3f} {:>+7.1f} % {:>8.3f} {:>8.3f} {:>12.2f} %\n",
                 body.name, body.reference, fmt::format("1/{}", n), r.cells, r.coefficient,
                 100 * (r.coefficient / body.reference - 1), r.front, r.back, 100 * r.change);
      std::fflush(stdout);
      all.push_back(r.coefficient);
    }
    print_order(all, 2);
  }
}
