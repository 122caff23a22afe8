// Bodies turned together with the stream, in a box that stays: how much of the force depends on how they lie on the
// cells.
//
// bench_turned [BODY] [ANGLE:AZIMUTH ...] [CELLS ...]
//     BODY           disk (porous), cup, or FILE.stl A B, a surface with the pressure drop A v + B v |v|, enlarged to 1 m
//                    across x; without one disk and cup
//     ANGLE:AZIMUTH  of the stream; compared with that along z. Without one all of the list below
//     CELLS          across the body, coarse to fine
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/extent.h"
#include "ripstop/flow/projections.h"
#include "ripstop/flow/steady.h"
#include "ripstop/flow/stl.h"
#include "table.h"

namespace ripstop {
namespace {

constexpr double speed = 20, half_box = 5, half_core = 0.8;  // [m/s], [m]; the body is 1 m wide

struct Body {
  std::string name;
  std::vector<Triangle> surface;  // its axis along z, its middle in the origin
  double linear,
      loss;  // of its cloth: [Pa s/m], and the drop over the dynamic pressure of the flow through it
};

Body porous_disk() {
  return {"porous disk, loss coefficient 2", disk(1, {}), 0, 2};
}
Body cup() {
  return {"hemispherical cup of F-111 cloth", hemispherical_cup(1, {0, 0, -0.25}), 8169.3, 0};
}

Body body_from(const std::string& file, double a, double b) {
  std::vector<Triangle> surface = read_stl(file);
  const Extent extent = extent_of(surface);
  const Vec3 low = extent.lower(), high = extent.upper();
  const Vec3 middle = 0.5 * (low + high);
  const double scale = 1 / (high.x - low.x);
  for (Triangle& t : surface)
    for (Vec3* p : {&t.a, &t.b, &t.c}) *p = scale * (*p - middle);
  return {file, surface, a, b / (0.5 * Freestream{}.density)};
}

struct Direction {
  double angle, azimuth;  // of the stream [degrees]
};
const std::vector<Direction> all_directions = {{0, 0},   {20, 0},  {45, 0},       {90, 0},
                                               {20, 45}, {45, 45}, {54.7356, 45}, {90, 45}};

FlowProblem problem_of(const Body& body, Direction direction, int across) {
  FlowProblem problem;
  const Vec3 wind = wind_direction(direction.angle, direction.azimuth), corner{half_box, half_box, half_box},
             core{half_core, half_core, half_core};
  const int cells = static_cast<int>(std::lround(2 * half_core * across)) + 2 * 14;
  problem.grid = graded({-corner, 2 * corner, cells, cells, cells}, -core, core, 1.2);
  problem.air.velocity = speed * wind;
  problem.sides = Sides::far_field;
  problem.bodies = {
      sheet_body(turned(body.surface, wind), {body.linear, body.loss * problem.air.density / 2}, body.name)};
  problem.stopping = {.residual = 1e-4, .max_iterations = 400, .average_over = 100};
  return problem;
}

struct Result {
  double along = 0, across = 0;  // C_D and the remaining force, over the frontal area
  double ledger = 0;             // momentum through the faces of the box over the force, minus 1
};

Result force_on(const Body& body, Direction direction, int across) {
  const FlowProblem problem = problem_of(body, direction, across);
  CartesianSettings settings;
  settings.second_order = true;
  settings.threads = 1;  // rows may run at the same time
  const FlowField field = solve(*make_cartesian(settings), problem);
  const Vec3 wind = wind_direction(direction.angle, direction.azimuth);
  const double unit = 0.5 * problem.air.density * speed * speed * 0.25 * 3.14159265358979;
  const double drag = dot(field.porous_force, wind);
  return {drag / unit, norm(field.porous_force - drag * wind) / unit,
          dot(field.momentum_deficit, wind) / drag - 1};
}

// Of |C_D - that of the stream along z| from the coarsest to the finest grid, by their cells; none where it does not
// fall from grid to grid.
std::string order_of(const std::vector<double>& off, const std::vector<int>& across) {
  const double first = std::abs(off.front()), last = std::abs(off.back());
  if (off.size() < 2 || std::max(first, last) < 1e-6) return "-";
  for (std::size_t n = 1; n < off.size(); ++n)
    if (std::abs(off[n]) >= std::abs(off[n - 1])) return "none";
  return fmt::format("{:.1f}", std::log(first / last) / std::log(double(across.back()) / across.front()));
}

void turn(const std::vector<Body>& bodies, const std::vector<Direction>& directions,
          const std::vector<int>& across, int argc, char** argv) {
  std::vector<std::string> columns = {"body", "angle, deg", "azimuth, deg"};
  for (const int n : across) {
    columns.push_back(fmt::format("C_D, {} cells", n));
    columns.push_back(fmt::format("change from the stream along z, {} cells", n));
  }
  columns.insert(columns.end(), {"order of convergence of the change", "force across the stream, % of C_D",
                                 "momentum balance on the finest grid, %"});
  print_table_head("Drag of bodies by direction of the stream: far field on all six faces, steady, 20 m/s",
                   argc, argv, columns);
  for (const Body& body : bodies) {
    std::vector<double> along_z;
    for (const Direction direction : directions) {
      std::vector<std::string> row = {body.name, fmt::format("{:.1f}", direction.angle),
                                      fmt::format("{:.0f}", direction.azimuth)};
      std::vector<double> off;
      Result last;
      for (std::size_t n = 0; n < across.size(); ++n) {
        last = force_on(body, direction, across[n]);
        if (direction.angle == 0) along_z.push_back(last.along);
        off.push_back(last.along / along_z[n] - 1);
        row.push_back(fmt::format("{:.4f}", last.along));
        row.push_back(fmt::format("{:+.2f} %", 100 * off.back()));
      }
      row.push_back(direction.angle == 0 ? "-" : order_of(off, across));
      row.push_back(fmt::format("{:.2f}", 100 * last.across / last.along));
      row.push_back(fmt::format("{:+.2f}", 100 * last.ledger));
      print_row(row);
    }
  }
}

}  // namespace
}  // namespace ripstop

int main(int argc, char** argv) {
  using namespace ripstop;
  const std::vector<std::string> words(argv + 1, argv + argc);
  std::vector<Body> bodies = {porous_disk(), cup()};
  std::vector<Direction> directions;
  std::vector<int> across;
  std::size_t n = 0;
  if (!words.empty() && words[0] == "disk") bodies = {porous_disk()}, n = 1;
  if (!words.empty() && words[0] == "cup") bodies = {cup()}, n = 1;
  if (words.size() > 2 && words[0].ends_with(".stl"))
    bodies = {body_from(words[0], std::stod(words[1]), std::stod(words[2]))}, n = 3;
  for (; n < words.size(); ++n) {
    const std::size_t colon = words[n].find(':');
    if (colon == std::string::npos) {
      across.push_back(std::stoi(words[n]));
    } else {
      if (directions.empty()) directions.push_back({0, 0});
      directions.push_back({std::stod(words[n]), std::stod(words[n].substr(colon + 1))});
    }
  }
  turn(bodies, directions.empty() ? all_directions : directions,
       across.empty() ? std::vector<int>{8, 16, 24} : across, argc, argv);
}
