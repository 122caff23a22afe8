// Rigid bodies at an angle of attack: the body stays on the cells, the stream turns. The angle is between the axis of the
// body and the stream: 0 for a plate across the stream.
//
// bench_attack [HOW] plate CELLS ANGLE...              a square plate of 1 m, impermeable
// bench_attack between-walls SPAN CELLS ANGLE...       a plate of 1 m between two walls, SPAN m apart: a flow that is
//                                                      plane in the mean. Here the plate turns on the cells
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

// Plane flow: slip walls `span` apart at the ends of the plate, and 60 m apart above and below it, which leaves a
// blockage of 1.7 %.
std::vector<Triangle> plate_between_walls(double span) {
  const double end = 0.5 * span + 0.5;  // reaches into the walls
  const Vec3 a{-0.5, -end, 0}, b{0.5, -end, 0}, c{0.5, end, 0}, d{-0.5, end, 0};
  return {{a, b, c}, {a, c, d}};
}

FlowProblem between_walls(double span, double angle, int across) {
  constexpr double before = 12, behind = 12, above = 30, margin = 0.25, wake = 2, growth = 1.2;
  const double h = 1.0 / across, half = 0.5 + margin;
  const Vec3 off = h * Vec3{0.25, 0, 0.125};  // no two edges lie alike on the cells
  const Vec3 low = Vec3{-half, 0, -half} + off, high = Vec3{half, 0, half + wake} + off;
  const auto cells = [&](double from, double core_from, double core_to, double to) {
    return static_cast<int>(std::lround((core_to - core_from) / h)) +
           cells_outside(h, core_from - from, growth) + cells_outside(h, to - core_to, growth);
  };
  FlowProblem problem;
  problem.grid = graded({{-above, -0.5 * span, -before},
                         {2 * above, span, before + behind},
                         cells(-above, low.x, high.x, above),
                         static_cast<int>(std::lround(span / h)),
                         cells(-before, low.z, high.z, behind)},
                        low, high, growth);
  problem.air.velocity = {0, 0, speed};
  problem.sides = Sides::slip, problem.outlet = Outlet::still_air;
  problem.bodies = {sheet_body(turned(plate_between_walls(span), wind_direction(angle)), impermeable)};
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
  settings.threads = 1;  // angles may run at the same time
  settings.small_eddies = SmallEddies::des;
  const auto engine = make_cartesian(settings);
  const auto flow = engine->start(problem);
  Watch how;
  how.length = body.diameter, how.standard_error = 0.005, how.shortest = 20, how.longest = 60;
  if (body.surface.empty())
    how.standard_error = 0.02, how.shortest = 60, how.longest = 400;  // sheds every seven widths
  FlowRecord record;
  Answer answer{watch(*flow, problem, how, record)};
  answer.error = record.drag.standard_error / std::abs(record.drag.mean);
  return answer;
}

Answer steady(FlowProblem problem) {
  problem.stopping = {.residual = 1e-5, .max_iterations = 600, .average_over = 100};
  CartesianSettings settings;
  settings.threads = 1;
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

constexpr const char* names[] = {"built-in engine, unsteady, DES", "built-in engine, steady",
                                 "OpenFOAM, steady, fitted mesh"};

void attack(const Body& body, int across, const std::vector<double>& angles, Method method,
            const std::string& folder, int argc, char** argv) {
  const bool walls = body.surface.empty();
  print_table_head(
      fmt::format("{} at an angle of attack, {} cells across: {}", body.name, across,
                  names[static_cast<int>(method)]),
      argc, argv,
      {"angle, deg", "C_T", "C_N", "side force over q S", "standard error of drag, %", "force imbalance, %"});
  for (const double angle : angles) {
    const bool foam = method == Method::fitted;
    const FlowProblem problem =
        walls ? between_walls(body.area, angle, across) : problem_of(body, angle, foam ? across / 2 : across);
    const Answer answer = foam                       ? fitted(problem, folder)
                          : method == Method::steady ? steady(problem)
                                                     : in_time(problem, body);
    const FlowField& field = answer.field;
    const Attitude attitude{walls ? wind_direction(angle) : Vec3{0, 0, 1}, problem.air.velocity};
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
  const bool walls = !words.empty() && words[0] == "between-walls";
  const bool plate = walls || (at < words.size() && words[at] == "plate");
  const std::size_t first = at + (walls ? 2 : plate ? 1 : 4);
  if (words.size() < first + 2)
    return fmt::print(
               "bench_attack [steady|fitted FOLDER] plate CELLS ANGLE... | FILE.stl A B D0 CELLS ANGLE...\n"
               "bench_attack between-walls SPAN CELLS ANGLE...\n"),
           2;
  const auto number = [&](std::size_t n) { return std::atof(words[n].c_str()); };
  const double d0 = plate ? 1 : number(at + 3);
  const Body body =
      walls ? Body{fmt::format("Plate between walls {} m apart", words[1]), {}, impermeable, number(1), 1}
      : plate
          ? Body{"Square plate", square_plate(1, {}), impermeable, 1, 1}
          : centred({words[at], read_stl(words[at]), {number(at + 1), number(at + 2)}, pi / 4 * d0 * d0, d0});
  std::vector<double> angles;
  for (std::size_t n = first + 1; n < words.size(); ++n) angles.push_back(number(n));
  attack(body, static_cast<int>(number(first)), angles, method, folder, argc, argv);
}
