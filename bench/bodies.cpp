// Bodies of known drag as sheets, on finer and finer grids, second-order convection.
//   bench_bodies [cells across the body on the finest of three grids [body [width of the box in diameters
//                [turbulence intensity [sides: slip, entraining or zero-gradient]]]]]
//   bench_bodies sides      effect of near sides on disks
//   bench_bodies in-time [cells across the body [body, or all [eddies: wale or des]]]
//                           steady flows and means over time, cells offset by a quarter of one from the axis
//   bench_bodies openfoam [cells across the body [body]]   built-in engine and OpenFOAM on the same cells
//   bench_bodies places [cells across the body [canopy.stl RESISTANCE]]
//                           effect of the grid alignment on bodies, or on a canopy's shape of 1 m with its skirt at
//                           z = 3 m and cloth of so many Pa s/m
#include "ripstop/flow/bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "face_pressures.h"
#include "far_box.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"
#include "ripstop/flow/stl.h"
#include "ripstop/flow/unsteady.h"
#include "table.h"

using namespace ripstop;

namespace {

struct Body {
  std::string name;
  std::vector<Triangle> surface;
  double area, loss, reference;  // loss: coefficient K of a porous disk, 0: impermeable
};

struct Result {
  double coefficient = 0,
         change = 0;           // the latter: standard deviation over the last 100 iterations, relative
  double front = 0, back = 0;  // mean pressure coefficient, weighted with the area across the flow
};

FlowProblem problem_of(const Body& body, const FlowGrid& grid, double turbulence, Sides sides) {
  FlowProblem problem;
  problem.grid = grid;
  problem.air.velocity = {0, 0, 30};
  problem.air.turbulence_intensity = turbulence;
  problem.sides = sides;
  problem.stopping.max_iterations = 600;
  problem.stopping.average_over = 100;
  // K = dp / (rho v^2 / 2) at the velocity v through the disk.
  problem.bodies = {sheet_body(body.surface, {body.loss > 0 ? 0 : 1e6, body.loss * problem.air.density / 2})};
  problem.outlet = Outlet::still_air;
  return problem;
}

double dynamic_pressure(const FlowProblem& problem) {
  return 0.5 * problem.air.density * problem.air.speed() * problem.air.speed();
}

CartesianSettings second_order() {
  CartesianSettings settings;
  settings.second_order = true;
  return settings;
}

Result result_of(const Body& body, const FlowProblem& problem, const FlowField& field) {
  Result result;
  result.coefficient = field.porous_force.z / (dynamic_pressure(problem) * body.area);
  if (field.average.iterations > 0) result.change = field.average.drag_deviation / field.porous_force.z;
  const FacePressures sides = face_pressures(field, 0, dynamic_pressure(problem));
  result.front = sides.front, result.back = sides.back;
  return result;
}

Result drag_coefficient(const Body& body, const FlowGrid& grid, double turbulence, Sides sides) {
  const FlowProblem problem = problem_of(body, grid, turbulence, sides);
  return result_of(body, problem, solve(*make_cartesian(second_order()), problem));
}

std::string off_by(double value, double reference) {
  return fmt::format("{:+.1f} %", 100 * (value / reference - 1));
}

std::vector<Body> all_bodies(Vec3 centre) {
  const double d = 1, disk_area = std::numbers::pi / 4 * d * d;
  return {
      {"disk", disk(d, centre), disk_area, 0, 1.17},
      {"square plate", square_plate(d, centre), d * d, 0, 1.17},
      {"cup facing the stream", hemispherical_cup(d, centre), disk_area, 0, 1.42},
      {"porous disk K = 0.5", disk(d, centre), disk_area, 0.5, 0.5 / std::pow(1 + 0.5 / 4, 2)},
      {"porous disk K = 1", disk(d, centre), disk_area, 1, 1 / std::pow(1 + 1.0 / 4, 2)},
      {"porous disk K = 2", disk(d, centre), disk_area, 2, 2 / std::pow(1 + 2.0 / 4, 2)},
  };
}

Vec3 place_in(double box) {
  return {0, 0, 0.45 * 1.5 * box};
}

void refine(const Body& body, int finest, double box, double turbulence, Sides sides) {
  std::vector<std::string> row = {body.name, fmt::format("{:.3f}", body.reference)};
  std::vector<double> all;
  Result result;
  for (const int n : {finest / 4, finest / 2, finest}) {
    result = drag_coefficient(body, far_box(1, box, n, place_in(box).z), turbulence, sides);
    all.push_back(result.coefficient);
    row.push_back(fmt::format("{:.3f}", result.coefficient));
  }
  const auto found = observed_order(all, 2);
  row.insert(
      row.end(),
      {off_by(result.coefficient, body.reference), found ? fmt::format("{:.2f}", found->order) : "none",
       found ? fmt::format("{:.3f} ({})", found->limit, off_by(found->limit, body.reference)) : "",
       fmt::format("{:.3f}, {:.3f}", result.front, result.back),
       fmt::format("{:.2f} %", 100 * result.change)});
  print_row(row);
}

/// Effect of a near side on an open and on an impermeable disk.
void compare_sides(int argc, char** argv) {
  constexpr std::pair<Sides, const char*> kinds[] = {
      {Sides::zero_gradient, "zero gradient"}, {Sides::slip, "slip"}, {Sides::entraining, "entraining"}};
  std::vector<std::string> columns = {"disk", "width of the domain, d"};
  for (const auto& [sides, name] : kinds) columns.push_back(name);
  print_table_head("Drag coefficient of a disk on cells of d/8 by width and sides of the domain", argc, argv,
                   columns);
  for (const char* name : {"porous disk K = 2", "disk"}) {
    for (const double box : {3.0, 4.0, 6.0, 12.0}) {
      std::vector<std::string> row = {name, fmt::format("{:g}", box)};
      for (const Body& body : all_bodies(place_in(box))) {
        if (body.name != name) continue;
        for (const auto& kind : kinds) {
          const Result r = drag_coefficient(body, far_box(1, box, 8, place_in(box).z), 0.005, kind.first);
          row.push_back(fmt::format("{:.3f}", r.coefficient));
        }
      }
      print_row(row);
    }
  }
}

std::vector<Body> bodies_in_time(Vec3 centre) {
  std::vector<Body> bodies = all_bodies(centre);
  Body away{"cup facing away", hemispherical_cup(1, centre), bodies[0].area, 0, 0.40};
  for (Triangle& t : away.surface) {
    for (Vec3* p : {&t.a, &t.b, &t.c}) p->z = 2 * centre.z - p->z;
    std::swap(t.a, t.b);  // the same side stays outside
  }
  bodies.insert(bodies.begin() + 3, away);
  return bodies;
}

/// The same sheet among the same cells, by both engines.
void compare_engines(int argc, char** argv) {
  const int across = argc > 2 ? std::atoi(argv[2]) : 8;
  const std::string only = argc > 3 ? argv[3] : "";
  constexpr double box = 12;
  print_table_head(fmt::format("Drag coefficients of bodies 1 m across at 30 m/s on cells of d/{}, built-in "
                               "engine and OpenFOAM, domain 12 "
                               "x 12 x 18 m, slip sides",
                               across),
                   argc, argv,
                   {"body", "reference", "built-in", "OpenFOAM", "OpenFOAM compared with built-in",
                    "area of OpenFOAM's faces over that of the body - 1",
                    "OpenFOAM compared with built-in, referred to its area", "force imbalance of OpenFOAM",
                    "Cp upstream, downstream side, built-in", "Cp upstream, downstream side, OpenFOAM",
                    "minutes, built-in, OpenFOAM"});
  for (const Body& body : all_bodies(place_in(box))) {
    if (!only.empty() && body.name != only) continue;
    FlowProblem problem = problem_of(body, far_box(1, box, across, place_in(box).z), 0.005, Sides::slip);
    problem.outlet = Outlet::fixed_pressure;
    auto minutes = [begin = std::chrono::steady_clock::now()]() mutable {
      const auto before = std::exchange(begin, std::chrono::steady_clock::now());
      return std::chrono::duration<double>(begin - before).count() / 60;
    };
    const Result ours = result_of(body, problem, solve(*make_cartesian(second_order()), problem));
    const double own = minutes();
    const TemporaryFolder folder("bodies");
    OpenFoamSettings settings;
    settings.folder = folder.path / "case";
    settings.second_order = true;
    problem.stopping.average_over = 0;
    problem.stopping.residual = 1e-4;
    const FlowField field = solve(*make_openfoam(settings), problem);
    const Result theirs = result_of(body, problem, field);
    double area = 0;
    for (const SheetLoad& load : field.sheet_loads) area += std::abs(load.force.z / load.drop);
    const double drag = field.porous_force.z;
    print_row({body.name, fmt::format("{:.3f}", body.reference), fmt::format("{:.3f}", ours.coefficient),
               fmt::format("{:.3f}", theirs.coefficient), off_by(theirs.coefficient, ours.coefficient),
               off_by(area, body.area), off_by(theirs.coefficient * body.area / area, ours.coefficient),
               off_by(field.momentum_deficit.z, drag), fmt::format("{:.3f}, {:.3f}", ours.front, ours.back),
               fmt::format("{:.3f}, {:.3f}", theirs.front, theirs.back),
               fmt::format("{:.1f}, {:.1f}", own, minutes())});
  }
}

/// A steady flow, then 60 times that the stream takes for the body's width, and more until the error is 1 %. The grid
/// alignment of the body is that of a canopy in unsteady flow.
void compare_in_time(int argc, char** argv) {
  const int across = argc > 2 ? std::atoi(argv[2]) : 16;
  const std::string only = argc > 3 ? argv[3] : "all", only_eddies = argc > 4 ? argv[4] : "";
  constexpr double box = 12;
  const Vec3 place = place_in(box) + Vec3{0.25 / across, 0.125 / across, 0};
  constexpr std::pair<SmallEddies, const char*> kinds[] = {{SmallEddies::wale, "wale"},
                                                           {SmallEddies::des, "des"}};
  print_table_head(
      fmt::format("Drag coefficients of bodies 1 m across at 30 m/s on cells of d/{}, steady and unsteady, "
                  "domain 12 x 12 x 18 m, "
                  "entraining sides",
                  across),
      argc, argv,
      {"body", "subgrid-scale model", "reference", "steady", "error, steady", "unsteady, standard error",
       "error, unsteady", "Cp upstream, downstream side, steady", "Cp upstream, downstream side, unsteady",
       "Strouhal number", "steps; start-up time of total time, d/U", "minutes"});
  for (const Body& body : bodies_in_time(place)) {
    for (const auto& [eddies, word] : kinds) {
      if ((only != "all" && body.name != only) || (!only_eddies.empty() && only_eddies != word)) continue;
      const FlowProblem problem =
          problem_of(body, far_box(1, box, across, place.z), 0.005, Sides::entraining);
      const auto begin = std::chrono::steady_clock::now();
      CartesianSettings settings = second_order();
      settings.small_eddies = eddies;
      const auto engine = make_cartesian(settings);
      const auto flow = engine->start(problem);
      const Result steady = result_of(body, problem, solve_to_rest(*flow, problem.stopping));
      FlowRecord record;
      Watch how;
      how.shortest = 60, how.longest = 200, how.length = 1;
      const Result mean = result_of(body, problem, watch(*flow, problem, how, record));
      const double minutes =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / 60;
      const double in_time = 1 / (dynamic_pressure(problem) * body.area), unit = 1 / problem.air.speed();
      print_row(
          {body.name, word, fmt::format("{:.3f}", body.reference), fmt::format("{:.3f}", steady.coefficient),
           off_by(steady.coefficient, body.reference),
           fmt::format("{:.3f} +- {:.3f}", in_time * record.drag.mean, in_time * record.drag.standard_error),
           off_by(in_time * record.drag.mean, body.reference),
           fmt::format("{:.3f}, {:.3f}", steady.front, steady.back),
           fmt::format("{:.3f}, {:.3f}", mean.front, mean.back),
           fmt::format("{:.3f}", record.swing.frequency * unit),
           fmt::format("{}, {:.0f} of {:.0f}", record.steps.size(), record.start_up / unit,
                       record.watched() / unit),
           fmt::format("{:.1f}", minutes)});
    }
  }
}

/// Steady drag [N] in air of 20 m/s; the middle of the cells is offset by `off` cells from the axis along x, by half
/// as many along y.
double drag_at_place(const FlowBody& sheet, FlowGrid box, double half, double z, double off) {
  const auto cells = [&](double x, double y) {
    return graded(box, {x - half, y - half, z - 0.5}, {x + half, y + half, z + 1.5}, 1.125);
  };
  const Vec3 h = cells(0, 0).spacing();
  FlowProblem problem;
  problem.grid = cells(off * h.x, 0.5 * off * h.y);
  problem.air.velocity = {0, 0, 20};
  problem.sides = Sides::entraining, problem.outlet = Outlet::still_air;
  problem.bodies = {sheet};
  problem.stopping = {.residual = 1e-5, .max_iterations = 300, .average_over = 100};
  CartesianSettings settings;
  settings.second_order = true;
  settings.threads = 1;
  return solve(*make_cartesian(settings), problem).porous_force.z;
}

void compare_places(int argc, char** argv) {
  const int across = argc > 2 ? std::atoi(argv[2]) : 16;
  constexpr double z = 3, narrowest = 0.65, widest = 0.75;
  constexpr int widths = 8;
  std::vector<std::pair<std::string, FlowBody>> bodies;
  if (argc > 4) {
    bodies = {{"canopy", sheet_body(read_stl(argv[3]), {std::atof(argv[4]), 0})}};
  } else {
    bodies = {{"disk", sheet_body(disk(1, {0, 0, z}), impermeable)},
              {"hemispherical cup", sheet_body(hemispherical_cup(1, {0, 0, z}), impermeable)},
              {"rigid disk-gap-band of 0.65 m", sheet_body(rigid_disk_gap_band({0, 0, z}), impermeable)}};
  }
  const FlowGrid like = about_body({{-4, -4, 0}, {8, 8, 10}, 0, 0, 0}, 1, across, z);
  const FlowGrid box{like.origin, like.size, like.nx, like.ny, like.nz};
  print_table_head(
      fmt::format(
          "Steady drag on {} grids, fine region {:g} to {:g} m wide, about {} cells per metre, 20 m/s",
          widths, 2 * narrowest, 2 * widest, across),
      argc, argv,
      {"body", "displacement of the cells from the axis", "mean drag, N", "standard deviation", "lowest, N",
       "highest, N"});
  for (const auto& [name, sheet] : bodies) {
    for (const double off : {0.0, 0.25}) {
      std::vector<double> drags;
      for (int n = 0; n < widths; ++n)
        drags.push_back(
            drag_at_place(sheet, box, narrowest + (widest - narrowest) * n / (widths - 1), z, off));
      const double mean = std::accumulate(drags.begin(), drags.end(), 0.0) / widths;
      double squares = 0;
      for (const double drag : drags) squares += (drag - mean) * (drag - mean);
      const auto [low, high] = std::minmax_element(drags.begin(), drags.end());
      print_row({name, off == 0 ? "none" : fmt::format("{:g} cells along x, {:g} along y", off, off / 2),
                 fmt::format("{:.1f}", mean),
                 fmt::format("{:.1f} %", 100 * std::sqrt(squares / (widths - 1)) / mean),
                 fmt::format("{:.1f}", *low), fmt::format("{:.1f}", *high)});
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "places") {
    compare_places(argc, argv);
    return 0;
  }
  if (argc > 1 && std::string(argv[1]) == "in-time") {
    compare_in_time(argc, argv);
    return 0;
  }
  if (argc > 1 && std::string(argv[1]) == "openfoam") {
    compare_engines(argc, argv);
    return 0;
  }
  if (argc > 1 && std::string(argv[1]) == "sides") {
    compare_sides(argc, argv);
    return 0;
  }
  const int finest = argc > 1 ? std::atoi(argv[1]) : 32;
  const std::string only = argc > 2 ? argv[2] : "";
  const double box = argc > 3 ? std::atof(argv[3]) : 12, turbulence = argc > 4 ? std::atof(argv[4]) : 0.005;
  const std::string side = argc > 5 ? argv[5] : "slip";
  const Sides sides = side == "entraining" ? Sides::entraining
                      : side == "slip"     ? Sides::slip
                                           : Sides::zero_gradient;
  print_table_head(
      fmt::format("Drag coefficients of bodies 1 m across at 30 m/s, domain {:g} x {:g} x {:g} m, {} sides",
                  box, box, 1.5 * box, side),
      argc, argv,
      {"body", "reference", fmt::format("h/d = 1/{}", finest / 4), fmt::format("1/{}", finest / 2),
       fmt::format("1/{}", finest), "error", "order of convergence",
       "extrapolated to zero cell width (error)", "Cp upstream, downstream side",
       "change of drag in the last 100 iterations"});
  for (const Body& body : all_bodies(place_in(box)))
    if (only.empty() || body.name == only) refine(body, finest, box, turbulence, sides);
}
