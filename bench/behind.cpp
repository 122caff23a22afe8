// Drag of a solid disk behind a blunt cylinder over the trailing distance, and of two disks side by side, in time.
//
// bench_behind CELLS wake|pair [DISTANCE...]   cells across the cylinder, or across a disk of the pair; distances in
// diameters, of the disk from the cylinder or between the centres of the pair
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "face_pressures.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/extent.h"
#include "ripstop/flow/unsteady.h"
#include "table.h"

namespace ripstop {
namespace {

constexpr double speed = 20, circle = std::numbers::pi / 4;

/// A box with equal cells in the core from `low` to `high`, and room about it.
FlowProblem problem_with(Vec3 low, Vec3 high, int across, double beside, double before, double after) {
  const double h = 1.0 / across;
  const Vec3 corner = low - Vec3{beside, beside, before}, far = high + Vec3{beside, beside, after};
  const auto cells = [&](double from, double to) {
    return static_cast<int>(std::lround((to - from) / h)) + 26;
  };
  FlowProblem problem;
  problem.grid =
      graded({corner, far - corner, cells(low.x, high.x), cells(low.y, high.y), cells(low.z, high.z)}, low,
             high, 1.2);
  problem.air.velocity = {0, 0, speed};
  problem.sides = Sides::entraining;
  return problem;
}

/// Mean force along the stream on each body over its reference area and the dynamic pressure, with standard error.
struct Drag {
  std::vector<double> coefficient, error;
  FlowField mean;
  FacePressures first;  // of the first body
};

Drag drag_of(FlowProblem problem, double length, const std::vector<double>& areas, int across) {
  // On cells that are symmetric about the axis a flow in time remains symmetric for long.
  const double h = 1.0 / across;
  for (FlowBody& body : problem.bodies)
    for (Triangle& t : body.surface)
      for (Vec3* p : {&t.a, &t.b, &t.c}) *p += Vec3{h / 4, h / 8, 0};
  CartesianSettings settings;
  settings.small_eddies = SmallEddies::des;
  settings.threads = 1;
  const auto engine = make_cartesian(settings);
  const auto flow = engine->start(problem);
  Watch how;
  how.length = length, how.standard_error = 0.015, how.shortest = 25, how.longest = 60;
  FlowRecord record;
  Drag drag;
  drag.mean = watch(*flow, problem, how, record);
  const double q = 0.5 * problem.air.density * speed * speed;
  for (std::size_t n = 0; n < problem.bodies.size(); ++n) {
    const MeanOverTime& force = n == 0 ? record.drag : record.body_drag[n - 1];
    drag.coefficient.push_back(force.mean / (q * areas[n]));
    drag.error.push_back(force.standard_error / (q * areas[n]));
  }
  drag.first = face_pressures(drag.mean, 0, q);
  return drag;
}

std::string text(const FacePressures& pressures) {
  return fmt::format("{:.2f}, {:.2f}", pressures.front, pressures.back);
}

/// Mean of (u / U)^2 over the disk at `centre` in a flow without it: the ratio of drag by the dynamic pressure of the
/// wake alone.
double wake_pressure(const FlowField& mean, Vec3 centre, double diameter) {
  double sum = 0, area = 0;
  constexpr int rings = 20, parts = 48;
  for (int r = 0; r < rings; ++r) {
    const double radius = 0.5 * diameter * (r + 0.5) / rings;
    for (int n = 0; n < parts; ++n) {
      const double angle = 2 * std::numbers::pi * n / parts;
      const double w =
          sample(mean.grid, mean.velocity, centre + radius * Vec3{std::cos(angle), std::sin(angle), 0}).z /
          speed;
      sum += radius * w * std::abs(w), area += radius;
    }
  }
  return sum / area;
}

constexpr double disk_diameter = 2, body_length = 2;  // in diameters of the body

// The disk is at z = 0 on the same cells in every run; the body is upstream of it.
void behind_cylinder(int across, const std::vector<double>& distances) {
  const double last = *std::max_element(distances.begin(), distances.end()), farthest = last + body_length;
  const FlowProblem empty = problem_with({-1.35, -1.35, -farthest - 0.5}, {1.35, 1.35, 2}, across, 5, 3, 8);
  const auto cylinder = [](double distance) {
    return sheet_body(nosed_cylinder(1, body_length, 0, {0, 0, -distance}), impermeable, "cylinder");
  };
  const double area = circle * disk_diameter * disk_diameter;
  FlowProblem problem = empty;
  problem.bodies = {sheet_body(disk(disk_diameter, {}), impermeable, "disk")};
  const Drag alone = drag_of(problem, disk_diameter, {area}, across);
  problem.bodies = {cylinder(last)};
  const Drag body = drag_of(problem, disk_diameter, {circle}, across);
  print_row({"alone", fmt::format("{:.3f} ± {:.3f}", alone.coefficient[0], alone.error[0]), "1", "1",
             text(alone.first), fmt::format("{:.3f} ± {:.3f}", body.coefficient[0], body.error[0])});
  for (const double distance : distances) {
    problem.bodies = {sheet_body(disk(disk_diameter, {}), impermeable, "disk"), cylinder(distance)};
    const Drag both = drag_of(problem, disk_diameter, {area, circle}, across);
    const double ratio = both.coefficient[0] / alone.coefficient[0];
    const double error =
        ratio * std::hypot(both.error[0] / both.coefficient[0], alone.error[0] / alone.coefficient[0]);
    const Vec3 place{0.25 / across, 0.125 / across, distance - last};
    print_row({fmt::format("{:g}", distance),
               fmt::format("{:.3f} ± {:.3f}", both.coefficient[0], both.error[0]),
               fmt::format("{:.3f} ± {:.3f}", ratio, error),
               fmt::format("{:.3f}", wake_pressure(body.mean, place, disk_diameter)), text(both.first),
               fmt::format("{:.3f} ± {:.3f}", both.coefficient[1], both.error[1])});
  }
}

// Both on the same cells in every run, the first always in the same place.
void side_by_side(int across, const std::vector<double>& distances) {
  const double last = *std::max_element(distances.begin(), distances.end());
  const FlowProblem empty = problem_with({-0.85, -0.85, -0.5}, {last + 0.85, 0.85, 2}, across, 5, 3, 8);
  FlowProblem problem = empty;
  problem.bodies = {sheet_body(disk(1, {}), impermeable, "first")};
  const Drag alone = drag_of(problem, 1, {circle}, across);
  print_row({"alone", fmt::format("{:.3f} ± {:.3f}", alone.coefficient[0], alone.error[0]), "-", "1"});
  for (const double distance : distances) {
    problem.bodies = {sheet_body(disk(1, {}), impermeable, "first"),
                      sheet_body(disk(1, {distance, 0, 0}), impermeable, "second")};
    const Drag both = drag_of(problem, 1, {circle, circle}, across);
    const double mean = 0.5 * (both.coefficient[0] + both.coefficient[1]),
                 error = 0.5 * std::hypot(both.error[0], both.error[1]);
    print_row({fmt::format("{:g}", distance),
               fmt::format("{:.3f} ± {:.3f}", both.coefficient[0], both.error[0]),
               fmt::format("{:.3f} ± {:.3f}", both.coefficient[1], both.error[1]),
               fmt::format("{:.3f} ± {:.3f}", mean / alone.coefficient[0],
                           mean / alone.coefficient[0] *
                               std::hypot(error / mean, alone.error[0] / alone.coefficient[0]))});
  }
}

}  // namespace
}  // namespace ripstop

int main(int argc, char** argv) {
  using namespace ripstop;
  const std::string what = argc > 2 ? argv[2] : "";
  const int across = argc > 2 ? std::atoi(argv[1]) : 0;
  std::vector<double> distances;
  for (int n = 3; n < argc; ++n) distances.push_back(std::atof(argv[n]));
  const bool wake = what == "wake";
  if (across < 4 || (!wake && what != "pair") ||
      std::any_of(distances.begin(), distances.end(), [&](double d) { return !(d > (wake ? 0 : 1)); }))
    return fmt::print("bench_behind CELLS wake|pair [DISTANCE...]\n"), 2;
  if (distances.empty())
    distances = wake ? std::vector<double>{2, 4, 6, 8, 12} : std::vector<double>{1.1, 1.25, 1.5, 2, 3, 6};
  if (wake) {
    print_table_head(
        fmt::format("Disk of 2 diameters behind a cylinder 2 diameters long, {} cells across it, unsteady",
                    across),
        argc, argv,
        {"distance / diameter", "C_D of the disk", "drag ratio", "mean of (u/U)² in the wake alone",
         "Cp upstream, downstream side of the disk", "C_D of the cylinder"});
    behind_cylinder(across, distances);
  } else {
    print_table_head(fmt::format("Two disks side by side, {} cells across each, unsteady", across), argc,
                     argv,
                     {"distance of the centres / diameter", "C_D of the first", "C_D of the second",
                      "mean over that of one alone"});
    side_by_side(across, distances);
  }
}
