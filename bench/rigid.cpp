// Drag of closed bodies alone in the stream, in time and steady, compared with published values.
//
// bench_rigid [steady] CELLS [sphere|cube|cylinder|long|nosed]...   cells across the body
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/extent.h"
#include "ripstop/flow/steady.h"
#include "ripstop/flow/unsteady.h"
#include "table.h"

namespace ripstop {
namespace {

constexpr double speed = 20;

struct Body {
  std::string name, title;
  std::vector<Triangle> surface;       // of 1 m across the stream
  double area = 0, low = 0, high = 0;  // [m2], published drag coefficients
};

// Hoerner, Fluid-Dynamic Drag (1965), chapter 3: sphere below the critical Reynolds number 0.47, cube with a face to
// the stream 1.05, cylinder along the stream with a flat front 0.81 to 0.85 at lengths of 2 to 4 diameters, with a round
// nose about 0.2 (his base drag). As remembered, not verified in print.
std::vector<Body> bodies() {
  constexpr double circle = 3.14159265358979 / 4;
  return {{"sphere", "sphere", sphere(1, {0, 0, 0.5}), circle, 0.47, 0.47},
          {"cube", "cube, a face to the stream", block({1, 1, 1}, {0, 0, 0.5}), 1, 1.05, 1.05},
          {"cylinder", "cylinder, 3 diameters long, flat front", nosed_cylinder(1, 3, 0, {0, 0, 1.5}), circle,
           0.81, 0.85},
          {"long", "cylinder, 5 diameters long, flat front", nosed_cylinder(1, 5, 0, {0, 0, 2.5}), circle,
           0.81, 0.85},
          {"nosed", "cylinder, 3 diameters long, hemispherical nose", nosed_cylinder(1, 3, 0.5, {0, 0, 1.5}),
           circle, 0.2, 0.2}};
}

FlowProblem problem_of(const Body& body, int across, bool in_time) {
  const Extent e = extent_of(body.surface);
  const double h = 1.0 / across;
  // On cells that are symmetric about the axis a flow in time remains symmetric for 40 diameters of travel.
  std::vector<Triangle> surface = body.surface;
  for (Triangle& t : surface)
    for (Vec3* p : {&t.a, &t.b, &t.c}) *p += in_time ? Vec3{h / 4, h / 8, 0} : Vec3{};
  const Vec3 spare = 0.35 * Vec3{1, 1, 1}, low = e.lower() - spare, high = e.upper() + spare + Vec3{0, 0, 1};
  const Vec3 corner = e.lower() - 4 * Vec3{1, 1, 1}, size = e.upper() - e.lower() + Vec3{8, 8, 12};
  const auto cells = [&](double from, double to) {
    return static_cast<int>(std::lround((to - from) / h)) + 26;
  };
  FlowProblem problem;
  problem.grid = graded({corner, size, cells(low.x, high.x), cells(low.y, high.y), cells(low.z, high.z)}, low,
                        high, 1.2);
  problem.air.velocity = {0, 0, speed};
  problem.sides = Sides::entraining;
  problem.bodies = {sheet_body(std::move(surface), impermeable, body.name)};
  return problem;
}

void drag(const Body& body, int across, bool in_time) {
  FlowProblem problem = problem_of(body, across, in_time);
  FlowField field;
  double error = 0;
  if (in_time) {
    CartesianSettings settings;
    settings.small_eddies = SmallEddies::des;
    const auto engine = make_cartesian(settings);
    const auto flow = engine->start(problem);
    Watch how;
    how.length = 1, how.standard_error = 0.01, how.shortest = 40, how.longest = 90;
    FlowRecord record;
    field = watch(*flow, problem, how, record);
    error = record.drag.standard_error / std::abs(record.drag.mean);
  } else {
    problem.stopping = {.residual = 1e-5, .max_iterations = 600, .average_over = 100};
    CartesianSettings settings;
    settings.second_order = true;
    field = solve(*make_cartesian(settings), problem);
  }
  const double q = 0.5 * problem.air.density * speed * speed;
  const double coefficient = field.porous_force.z / (q * body.area);
  const double off = coefficient / std::clamp(coefficient, body.low, body.high) - 1;
  print_row(
      {body.title, fmt::format("{:.3f}", coefficient), in_time ? fmt::format("{:.1f}", 100 * error) : "-",
       fmt::format("{:.2f}", body.low) + (body.high > body.low ? fmt::format(" to {:.2f}", body.high) : ""),
       fmt::format("{:+.0f} %", 100 * off),
       fmt::format("{:+.2f}",
                   100 * norm(field.momentum_deficit - field.porous_force) / norm(field.porous_force))});
}

}  // namespace
}  // namespace ripstop

int main(int argc, char** argv) {
  using namespace ripstop;
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool in_time = words.empty() || words[0] != "steady";
  if (!in_time) words.erase(words.begin());
  if (words.empty())
    return fmt::print("bench_rigid [steady] CELLS [sphere|cube|cylinder|long|nosed]...\n"), 2;
  print_table_head(fmt::format("Closed bodies in free air, {} cells across: {}", words[0],
                               in_time ? "unsteady, DES" : "steady"),
                   argc, argv,
                   {"body", "C_D", "standard error, %", "published", "difference", "force imbalance, %"});
  for (const Body& body : bodies())
    if (words.size() == 1 || std::find(words.begin() + 1, words.end(), body.name) != words.end()) try {
        drag(body, std::atoi(words[0].c_str()), in_time);
      } catch (const Error& error) {
        if (error.code() != ExitCode::diverged) throw;
        print_row({body.title, "diverged", "-", "-", "-", "-"});
      }
}
