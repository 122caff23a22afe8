// Rigid bodies at an angle of attack: the body stays on the cells, the stream turns. The angle is between the axis of the
// body and the stream: 0 for a plate across the stream.
//
// bench_attack [HOW] plate CELLS ANGLE...              a square plate of 1 m, impermeable
// bench_attack [HOW] FILE.stl A B D0 CELLS ANGLE...    a surface with the pressure drop A v + B v |v| and nominal
//                                                      diameter D0
//     HOW  nothing: built-in engine, in time; "steady": its steady iteration; "fitted FOLDER": OpenFOAM, steady, on a
//          mesh that follows the cloth, whose cells are half as wide at the cloth and twice as wide elsewhere
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/extent.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/projections.h"
#include "ripstop/flow/steady.h"
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

/// How the flow is computed.
enum class Method { in_time, steady, fitted };

struct Answer {
  FlowField field;
  double error = 0;  // standard error of the drag, over it
};

Answer in_time(const FlowProblem& problem, const Body& body) {
  CartesianSettings settings;
  settings.small_eddies = SmallEddies::des;
  const auto engine = make_cartesian(settings);
  const auto flow = engine->start(problem);
  Watch how;
  how.length = body.diameter, how.standard_error = 0.005, how.shortest = 20, how.longest = 60;
  FlowRecord record;
  Answer answer{watch(*flow, problem, how, record)};
  answer.error = record.drag.standard_error / std::abs(record.drag.mean);
  return answer;
}

Answer steady(FlowProblem problem) {
  problem.stopping = {.residual = 1e-5, .max_iterations = 600, .average_over = 100};
  CartesianSettings settings;
  settings.second_order = true;
  return {solve(*make_cartesian(settings), problem)};
}

Answer fitted(FlowProblem problem, const std::string& folder) {
  problem.stopping.residual = 1e-4;
  problem.stopping.max_iterations = 600;
  OpenFoamSettings settings;
  settings.folder = folder;
  settings.second_order = settings.fitted_mesh = true;
  settings.cloth_levels = 2;
  return {solve(*make_openfoam(settings), problem)};
}

constexpr const char* names[] = {"built-in engine, in time, DES", "built-in engine, steady",
                                 "OpenFOAM, steady, fitted mesh"};

void attack(const Body& body, int across, const std::vector<double>& angles, Method method,
            const std::string& folder, int argc, char** argv) {
  print_table_head(
      fmt::format("{} at an angle of attack, {} cells across: {}", body.name, across,
                  names[static_cast<int>(method)]),
      argc, argv,
      {"angle, deg", "C_T", "C_N", "side force / q S", "standard error of drag, %", "force imbalance, %"});
  for (const double angle : angles) {
    const bool foam = method == Method::fitted;
    const FlowProblem problem = problem_of(body, angle, foam ? across / 2 : across);
    const Answer answer = foam                       ? fitted(problem, folder)
                          : method == Method::steady ? steady(problem)
                                                     : in_time(problem, body);
    const FlowField& field = answer.field;
    const Attitude attitude{{0, 0, 1}, problem.air.velocity};
    const Coefficients c =
        coefficients(field.bodies.at(0), attitude, {problem.air.density, body.area, body.diameter});
    print_row({fmt::format("{:g}", angle), fmt::format("{:.3f}", c.tangential),
               fmt::format("{:.3f}", c.normal), fmt::format("{:.3f}", c.side),
               method == Method::in_time ? fmt::format("{:.2f}", 100 * answer.error) : "-",
               foam ? "-"
                    : fmt::format("{:+.2f}", 100 * norm(field.momentum_deficit - field.porous_force) /
                                                 norm(field.porous_force))});
  }
}

}  // namespace
}  // namespace ripstop

int main(int argc, char** argv) {
  using namespace ripstop;
  const std::vector<std::string> words(argv + 1, argv + argc);
  std::size_t at = 0;
  Method method = Method::in_time;
  std::string folder;
  if (words.size() > 1 && words[0] == "steady") method = Method::steady, at = 1;
  if (words.size() > 2 && words[0] == "fitted") method = Method::fitted, folder = words[1], at = 2;
  const bool plate = at < words.size() && words[at] == "plate";
  const std::size_t first = at + (plate ? 1 : 4);
  if (words.size() < first + 2)
    return fmt::print(
               "bench_attack [steady|fitted FOLDER] plate CELLS ANGLE... | FILE.stl A B D0 CELLS ANGLE...\n"),
           2;
  const auto number = [&](std::size_t n) { return std::atof(words[n].c_str()); };
  const double d0 = plate ? 1 : number(at + 3);
  const Body body =
      plate
          ? Body{"square plate", square_plate(1, {}), impermeable, 1, 1}
          : centred({words[at], read_stl(words[at]), {number(at + 1), number(at + 2)}, pi / 4 * d0 * d0, d0});
  std::vector<double> angles;
  for (std::size_t n = first + 1; n < words.size(); ++n) angles.push_back(number(n));
  attack(body, static_cast<int>(number(first)), angles, method, folder, argc, argv);
}
