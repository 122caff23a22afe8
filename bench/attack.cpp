// Rigid bodies at an angle of attack, in time: the body stays on the cells, the stream turns.
//
// bench_attack plate CELLS ANGLE...              a square plate of 1 m, tight
// bench_attack FILE.stl A B D0 CELLS ANGLE...    a surface with the pressure drop A v + B v |v| and nominal diameter D0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/extent.h"
#include "ripstop/flow/projections.h"
#include "ripstop/flow/stl.h"
#include "ripstop/flow/unsteady.h"
#include "table.h"

namespace ripstop {
namespace {

constexpr double speed = 20, pi = 3.14159265358979;

struct Body {
  std::string name;
  std::vector<Triangle> surface;  // its axis along z, its middle in the origin
  PressureDrop law;
  double area = 0, diameter = 0;  // that coefficients refer to [m2], [m]
};

Body centred(Body body) {
  const Extent e = extent_of(body.surface);
  const Vec3 middle = 0.5 * (e.lower() + e.upper());
  for (Triangle& t : body.surface)
    for (Vec3* p : {&t.a, &t.b, &t.c}) *p -= middle;
  return body;
}

FlowProblem problem_of(const Body& body, double angle, int across) {
  const Extent e = extent_of(body.surface);
  const double width = e.high[0] - e.low[0], h = width / across;
  const Vec3 wind = wind_direction(angle);
  // Fine cells about the body and, downstream, one width of its wake.
  const Vec3 spare = 0.35 * width * Vec3{1, 1, 1}, low = e.lower() - spare,
             high = e.upper() + spare + width * Vec3{wind.x, 0, wind.z};
  const Vec3 corner = -4 * width * Vec3{1, 1, 1}, size = 9 * width * Vec3{1, 1, 1};
  const auto cells = [&](double from, double to) {
    return static_cast<int>(std::lround((to - from) / h)) + 24;
  };
  FlowProblem problem;
  problem.grid = graded({corner, size, cells(low.x, high.x), cells(low.y, high.y), cells(low.z, high.z)}, low,
                        high, 1.2);
  problem.air.velocity = speed * wind;
  problem.sides = Sides::far_field;
  problem.bodies = {sheet_body(body.surface, body.law, body.name)};
  return problem;
}

void attack(const Body& body, int across, const std::vector<double>& angles, int argc, char** argv) {
  print_table_head(
      fmt::format("{} at an angle of attack, DES, {} cells across", body.name, across), argc, argv,
      {"angle, deg", "C_T", "C_N", "side force / q S", "standard error of drag, %", "balance, %"});
  for (const double angle : angles) {
    const FlowProblem problem = problem_of(body, angle, across);
    CartesianSettings settings;
    settings.small_eddies = SmallEddies::des;
    const auto engine = make_cartesian(settings);
    const auto flow = engine->start(problem);
    Watch how;
    how.length = body.diameter, how.standard_error = 0.005, how.shortest = 20, how.longest = 60;
    FlowRecord record;
    const FlowField mean = watch(*flow, problem, how, record);
    const Attitude attitude{{0, 0, 1}, problem.air.velocity};
    const Coefficients c =
        coefficients(mean.bodies.at(0), attitude, {problem.air.density, body.area, body.diameter});
    print_row({fmt::format("{:g}", angle), fmt::format("{:.3f}", c.tangential),
               fmt::format("{:.3f}", c.normal), fmt::format("{:.3f}", c.side),
               fmt::format("{:.2f}", 100 * record.drag.standard_error / std::abs(record.drag.mean)),
               fmt::format("{:+.2f}",
                           100 * norm(mean.momentum_deficit - mean.porous_force) / norm(mean.porous_force))});
  }
}

}  // namespace
}  // namespace ripstop

int main(int argc, char** argv) {
  using namespace ripstop;
  const bool plate = argc > 1 && std::string(argv[1]) == "plate";
  const int first = plate ? 2 : 5;
  if (argc < first + 2)
    return fmt::print("bench_attack plate CELLS ANGLE... | FILE.stl A B D0 CELLS ANGLE...\n"), 2;
  const double d0 = plate ? 1 : std::atof(argv[4]);
  const Body body =
      plate
          ? Body{"square plate", square_plate(1, {}), {1e6, 0}, 1, 1}
          : centred(
                {argv[1], read_stl(argv[1]), {std::atof(argv[2]), std::atof(argv[3])}, pi / 4 * d0 * d0, d0});
  std::vector<double> angles;
  for (int n = first + 1; n < argc; ++n) angles.push_back(std::atof(argv[n]));
  attack(body, std::atoi(argv[first]), angles, argc, argv);
}
