// Bodies of known drag as sheets, on finer and finer grids: slip sides, second-order convection.
//   bench_bodies [cells across the finest box [body]]
#include "ripstop/flow/bodies.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "ripstop/flow/cartesian/cartesian.h"

using namespace ripstop;

namespace {

struct Body {
  std::string name;
  std::vector<Triangle> surface;
  double area, loss, reference;  // loss: coefficient K of a porous disk, 0: impermeable
};

// Drag coefficient and the change of drag over the last 100 iterations.
std::pair<double, double> drag_coefficient(const Body& body, double box, int n) {
  FlowProblem problem;
  problem.grid = {{-box / 2, -box / 2, 0}, {box, box, 1.5 * box}, n, n, 3 * n / 2};
  problem.air.speed = 30;
  problem.duct = true;
  problem.max_iterations = 500;
  const double rho = problem.air.density, speed = problem.air.speed;
  // K = dp / (rho v^2 / 2) at the velocity v through the disk.
  problem.sheets = {{body.surface, body.loss > 0 ? 0 : 1e6, body.loss * rho / 2}};
  CartesianSettings settings;
  settings.second_order = true;
  double low = 1e300, high = 0;
  const FlowField field = make_cartesian(settings)->solve(problem, [&](const FlowProgress& progress) {
    if (progress.iteration > problem.max_iterations - 100)
      low = std::min(low, progress.drag), high = std::max(high, progress.drag);
    return true;
  });
  return {field.porous_force.z / (0.5 * rho * speed * speed * body.area), high > 0 ? (high - low) / high : 0};
}

}  // namespace

int main(int argc, char** argv) {
  const int finest = argc > 1 ? std::atoi(argv[1]) : 96;
  const std::string only = argc > 2 ? argv[2] : "";
  const double d = 1, box = 6, disk_area = std::numbers::pi / 4 * d * d;
  const Vec3 centre{0, 0, 3};
  const std::vector<Body> bodies = {
      {"disk", disk(d, centre), disk_area, 0, 1.17},
      {"square plate", square_plate(d, centre), d * d, 0, 1.17},
      {"cup facing the stream", hemispherical_cup(d, centre), disk_area, 0, 1.42},
      {"porous disk K = 0.5", disk(d, centre), disk_area, 0.5, 0.5 / std::pow(1 + 0.5 / 4, 2)},
      {"porous disk K = 1", disk(d, centre), disk_area, 1, 1 / std::pow(1 + 1.0 / 4, 2)},
      {"porous disk K = 2", disk(d, centre), disk_area, 2, 2 / std::pow(1 + 2.0 / 4, 2)},
  };
  fmt::print("Diameter or side 1 m, 30 m/s, box {} x {} x {} m, slip sides, second order\n", box, box,
             1.5 * box);
  fmt::print("{:>22} {:>9} {:>5} {:>11} {:>9} {:>14}\n", "body", "reference", "h/d", "coefficient", "off by",
             "last 100 it.");
  for (const Body& body : bodies) {
    if (!only.empty() && body.name != only) continue;
    for (int n = finest / 4; n <= finest; n *= 2) {
      const auto [coefficient, change] = drag_coefficient(body, box, n);
      fmt::print("{:>22} {:>9.3f} {:>5.3f} {:>11.3f} {:>+7.1f} % {:>12.2f} %\n", body.name, body.reference,
                 box / n / d, coefficient, 100 * (coefficient / body.reference - 1), 100 * change);
      std::fflush(stdout);
    }
  }
}
