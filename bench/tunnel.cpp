// Effect of a tunnel on the air, and on the drag of a disk in it.
//   bench_tunnel empty [cells across the nozzle]       an open jet without a body
//   bench_tunnel disks [cells across the disk [plot]]  disks in an open jet and between walls against free air
//   bench_tunnel edges canopy.stl RESISTANCE           a canopy's shape, held, in open jets in time; skirt at z = 3 m,
//                                                      RESISTANCE of its cloth [Pa s/m]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "far_box.h"
#include "ripstop/flow/blockage.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"
#include "ripstop/flow/stl.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/output/plot.h"
#include "table.h"

using namespace ripstop;

namespace {

constexpr double speed = 20;                        // [m/s]
constexpr double shear_layer = 0.035;               // over the nozzle's width
constexpr double disk_area = std::numbers::pi / 4;  // of 1 m across [m2]

FlowField solved(FlowProblem problem) {
  problem.air.velocity = {0, 0, speed};
  problem.outlet = Outlet::still_air;
  problem.stopping.residual = 1e-5;
  problem.stopping.max_iterations = 500;
  problem.stopping.average_over = 100;
  CartesianSettings settings;
  settings.second_order = true;
  settings.threads = 1;
  return solve(*make_cartesian(settings), problem);
}

double dynamic_pressure() {
  return 0.5 * Freestream{}.density * speed * speed;
}

double axial(const FlowField& field, double x, double y, double z) {
  return sample(field.grid, field.velocity, {x, y, z}).z;
}

/// Radius at which the speed along +x falls through a share of the difference from outside to the axis.
double radius_at(const FlowField& field, double z, double outside, double share) {
  const double wanted = outside + share * (axial(field, 0, 0, z) - outside), step = 1e-3;
  double r = 0;
  while (r < 3 && axial(field, r, 0, z) > wanted) r += step;
  return r;
}

/// Difference of speed over the largest slope: of a profile along +x.
double vorticity_thickness(const FlowField& field, double z, double outside) {
  const FlowGrid& grid = field.grid;
  double steepest = 0;
  for (int i = grid.nx / 2; i + 1 < grid.nx; ++i) {
    const double a = grid.centre(0, i), b = grid.centre(0, i + 1);
    steepest = std::max(steepest, (axial(field, a, 0, z) - axial(field, b, 0, z)) / (b - a));
  }
  return (axial(field, 0, 0, z) - outside) / steepest;
}

double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    n += 1, sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// A round jet of 1 m, nothing in it.
void empty_jet(int across, double outside) {
  FlowProblem problem;
  const FlowGrid box = about_body({{-4, -4, 0}, {8, 8, 12}, 0, 0, 0}, 1, across, 4);
  problem.grid = {{-4, -4, 0}, {8, 8, 12}, box.nx, box.ny, 96};
  problem.grid = graded(problem.grid, {-0.7, -0.7, 0}, {0.7, 0.7, 0}, 1.125);
  problem.sides = Sides::entraining;
  problem.jet = Jet{{NozzleShape::circle, 1, 0}, outside, shear_layer};
  const FlowField field = solved(problem);
  const double still = outside * speed;
  std::vector<double> z, vorticity, wide;
  for (double at = 1; at <= 4.01; at += 0.25) {
    z.push_back(at);
    vorticity.push_back(vorticity_thickness(field, at, still));
    wide.push_back(radius_at(field, at, still, 0.1) - radius_at(field, at, still, 0.9));
  }
  double core = 0;
  while (core < 12 && axial(field, 0, 0, core) > 0.98 * speed) core += 0.01;
  const double momentum = 2 * dynamic_pressure() * disk_area;
  print_row({fmt::format("{}", across), fmt::format("{:g} %", 100 * outside), fmt::format("{:.1f}", core),
             fmt::format("{:.3f}", slope(z, vorticity)), fmt::format("{:.3f}", slope(z, wide)),
             fmt::format("{:+.2f} %", 100 * field.momentum_deficit.z / momentum),
             fmt::format("{:.0e}", largest_residual(field.last))});
}

void empty_jets(int finest, int argc, char** argv) {
  print_table_head("Empty open jet, nozzle 1 m wide, 20 m/s, domain of 8 x 8 x 12 m", argc, argv,
                   {"cells across the nozzle", "speed outside", "length of the core, nozzle widths",
                    "growth rate of the vorticity thickness", "growth rate of the width from 10 to 90 %",
                    "momentum lost in the domain", "residual"});
  for (const auto& [across, outside] : {std::pair{finest / 2, 0.01}, std::pair{finest / 2, 0.02},
                                        std::pair{finest / 2, 0.05}, std::pair{finest, 0.02}})
    empty_jet(across, outside);
}

struct Drag {
  double coefficient = 0, back = 0;  // the latter: mean pressure coefficient behind
  double balance = 0;                // momentum lost in the box over the drag, less 1
  double bubble = 0;                 // effective volume of disk and closed wake [m3]
  double approach = 0;               // speed one diameter before, over the nozzle's
};

/// The closed wake behind a disk at z0: for each plane the radius within which as much air goes back as on.
double bubble_volume(const FlowField& field, double z0) {
  const FlowGrid& grid = field.grid;
  double length = 0, widest = 0;
  for (int k = grid.cell_at(2, z0) + 1; k < grid.nz; ++k) {
    std::vector<std::pair<double, int>> by_radius;
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i)
        by_radius.emplace_back(std::hypot(grid.centre(0, i), grid.centre(1, j)), grid.index(i, j, k));
    std::sort(by_radius.begin(), by_radius.end());
    double passed = 0, area = 0;
    for (const auto& [radius, cell] : by_radius) {
      const double here = grid.cell_volume(cell) / grid.width(2, k);
      passed += field.velocity[cell].z * here;
      if (passed > 0) break;
      area += here;
    }
    if (area == 0) break;
    length += grid.width(2, k);
    widest = std::max(widest, std::sqrt(4 / std::numbers::pi * area));
  }
  return length > widest ? spheroid_effective_volume(length, widest) : 0;
}

Drag drag_of_disk(const FlowGrid& box, double loss, int across, double z, Sides sides,
                  std::optional<Jet> jet) {
  FlowProblem problem;
  problem.grid = about_body(box, 1, across, z);
  problem.sides = sides;
  problem.jet = jet;
  problem.bodies = {sheet_body(disk(1, {0, 0, z}), {loss > 0 ? 0 : 1e6, loss * Freestream{}.density / 2})};
  const FlowField field = solved(problem);
  Drag result;
  const double force = field.porous_force.z;
  result.coefficient = force / (dynamic_pressure() * disk_area);
  result.balance = field.momentum_deficit.z / force - 1;
  result.bubble = bubble_volume(field, z);
  result.approach = axial(field, 0, 0, z - 1) / speed;
  double area = 0;
  for (const SheetLoad& load : field.sheet_loads) {
    if (load.force.z == 0) continue;
    const Vec3 behind{load.point.x, load.point.y, z + 0.75 / across};
    const double share = std::abs(load.force.z / load.drop);
    area += share, result.back += share * sample(field.grid, field.pressure, behind);
  }
  result.back /= area * dynamic_pressure();
  return result;
}

FlowGrid box_of(double x, double z) {
  return {{-x / 2, -x / 2, 0}, {x, x, z}, 0, 0, 0};
}

std::string percent(double ratio) {
  return fmt::format("{:+.1f} %", 100 * (ratio - 1));
}

/// One disk in free air, between walls and in a round jet; adds its curves to the plot.
void one_disk(const std::string& name, double loss, int across, std::vector<PlotSeries>& plot) {
  const Drag free = drag_of_disk(box_of(8, 12), loss, across, 4, Sides::entraining, {});
  const auto row = [&](const std::string& where, double blockage, const Drag& drag, double theory) {
    print_row({name, where, blockage > 0 ? fmt::format("{:g} %", 100 * blockage) : "",
               fmt::format("{:.3f}", drag.coefficient), percent(drag.coefficient / free.coefficient),
               blockage > 0 ? percent(theory) : "", fmt::format("{:.3f}", drag.back),
               fmt::format("{:.3f}", drag.approach), fmt::format("{:+.2f} %", 100 * drag.balance)});
  };
  row("free air", 0, free, 0);
  PlotSeries walls{name + ", walls", {}, {}, true, true, false},
      jets{name + ", open jet", {}, {}, true, true, false};
  PlotSeries in_walls{
      name + ", walls: " + (loss > 0 ? "momentum theory" : "Maskell"), {}, {}, true, false, true};
  PlotSeries in_jet{name + ", open jet: Glauert", {}, {}, true, false, true};
  const auto note = [](PlotSeries& series, double blockage, double ratio) {
    series.x.push_back(100 * blockage), series.y.push_back(100 * (ratio - 1));
  };
  for (PlotSeries* series : {&walls, &jets, &in_walls, &in_jet}) note(*series, 0, 1);
  for (const double blockage : {0.05, 0.1, 0.2}) {
    const double side = std::sqrt(disk_area / blockage);
    const Drag drag = drag_of_disk(box_of(side, 12), loss, across, 4, Sides::slip, {});
    const double theory = loss > 0 ? porous_disk_drag(loss, blockage) / porous_disk_drag(loss, 0)
                                   : maskell_ratio(free.coefficient, free.back, blockage);
    row("walls", blockage, drag, theory);
    note(walls, blockage, drag.coefficient / free.coefficient), note(in_walls, blockage, theory);
  }
  for (const double blockage : {0.05, 0.1, 0.2}) {
    const double width = std::sqrt(1 / blockage), z = width;
    const Jet jet{{NozzleShape::circle, width, 0}, 0.02, shear_layer * width};
    const FlowGrid box = box_of(std::max(6.0, 2.8 * width), z + std::max(5.0, 2 * width));
    const Drag drag = drag_of_disk(box, loss, across, z, Sides::entraining, jet);
    const double faster = 1 + open_jet_speed_change(free.bubble, disk_area / blockage);
    row("open jet", blockage, drag, faster * faster);
    note(jets, blockage, drag.coefficient / free.coefficient), note(in_jet, blockage, faster * faster);
  }
  plot.insert(plot.end(), {walls, in_walls, jets, in_jet});
}

void disks(int across, const std::string& file, int argc, char** argv) {
  print_table_head(
      fmt::format("A disk of 1 m in tunnels, 20 m/s, cells of 1/{} m", across), argc, argv,
      {"disk", "air", "blockage", "drag coefficient", "change from free air", "theory", "base Cp",
       "speed 1 m upstream on the axis over tunnel speed", "momentum deficit over drag - 1"});
  std::vector<PlotSeries> series;
  one_disk("K = 2", 2, across, series);
  one_disk("impermeable", 0, across, series);
  if (!file.empty())
    write_plot(file, {"Drag of a disk in a tunnel against free air",
                      {"blockage [%]", false, 0, 20},
                      {"change of drag [%]", false, {}, {}},
                      series});
}

/// One jet around a rigid shape, in unsteady flow.
struct JetInTime {
  double distance = 3;   // from the nozzle to the skirt [m]
  double edge = 0;       // its thickness [m]; 0: free air
  double ahead = 0.57;   // how far before the skirt the fine cells begin [m]
  int cells_along = 70;  // of the box, such that the fine ones are 6 cm long
};

constexpr double octagon_width = 2.85;  // [m]

struct DragInTime {
  MeanOverTime drag;      // [N]
  double first_cell = 0;  // along the stream, behind the nozzle [m]
};

DragInTime drag_in_time(const std::vector<Triangle>& shape, double resistance, const JetInTime& how) {
  FlowProblem problem;
  problem.air.velocity = {0, 0, speed};
  problem.outlet = Outlet::still_air, problem.sides = Sides::entraining;
  const double half = 0.93, z = how.distance;
  problem.grid = graded({{-4, -4, 0}, {8, 8, z + 6}, 60, 60, how.cells_along}, {-half, -half, z - how.ahead},
                        {half, half, z + 1.71}, 1.125);
  if (how.edge > 0) problem.jet = Jet{{NozzleShape::octagon, octagon_width, 0}, 0.02, how.edge};
  problem.bodies = {sheet_body(shape, {resistance, 0})};
  for (Triangle& triangle : problem.bodies.front().surface)
    for (Vec3* corner : {&triangle.a, &triangle.b, &triangle.c}) corner->z += z - 3;
  CartesianSettings settings;
  settings.second_order = true;
  settings.threads = 1;
  const auto engine = make_cartesian(settings);
  const auto flow = engine->start(problem);
  Watch watching;
  watching.length = octagon_width;
  watching.standard_error = 1e-6, watching.shortest = 12, watching.longest = 24;
  FlowRecord record;
  watch(*flow, problem, watching, record);
  return {record.drag, problem.grid.width(2, 0)};
}

void edges(const std::string& surface, double resistance, int argc, char** argv) {
  print_table_head(fmt::format("Rigid canopy, unsteady, in jets from an octagonal nozzle of {:g} m, {:g} m/s",
                               octagon_width, speed),
                   argc, argv,
                   {"nozzle to skirt, m", "edge, m", "first cells downstream of the nozzle, m", "drag, N",
                    "standard error, N", "change from free air", "fluctuation of the drag (rms)"});
  const std::vector<Triangle> shape = read_stl(surface);
  double free = 0;
  for (const JetInTime& jet : std::array<JetInTime, 9>{{{},
                                                        {.edge = 0.1},
                                                        {.edge = 0.1, .ahead = 2.69, .cells_along = 110},
                                                        {.edge = 0.15},
                                                        {.edge = 0.285},
                                                        {.edge = 0.285, .ahead = 2.69, .cells_along = 110},
                                                        {.edge = 0.5},
                                                        {.distance = 2, .edge = 0.285, .cells_along = 66},
                                                        {.distance = 4, .edge = 0.285, .cells_along = 76}}}) {
    const auto [drag, first_cell] = drag_in_time(shape, resistance, jet);
    if (jet.edge == 0) free = drag.mean;
    print_row({jet.edge > 0 ? fmt::format("{:g}", jet.distance) : "free air",
               jet.edge > 0 ? fmt::format("{:g}", jet.edge) : "", fmt::format("{:.2f}", first_cell),
               fmt::format("{:.1f}", drag.mean), fmt::format("{:.1f}", drag.standard_error),
               percent(drag.mean / free), fmt::format("{:.1f} %", 100 * drag.deviation / drag.mean)});
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const int cells = argc > 2 ? std::atoi(argv[2]) : 0;
  if (what == "empty")
    empty_jets(cells > 0 ? cells : 16, argc, argv);
  else if (what == "disks")
    disks(cells > 0 ? cells : 12, argc > 3 ? argv[3] : "", argc, argv);
  else if (what == "edges" && argc == 4)
    edges(argv[2], std::atof(argv[3]), argc, argv);
  else
    return fmt::print(stderr,
                      "usage: bench_tunnel empty [cells] | disks [cells [plot.png]] | "
                      "edges canopy.stl RESISTANCE\n"),
           2;
  return 0;
}
