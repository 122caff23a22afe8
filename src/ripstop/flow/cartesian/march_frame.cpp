#include "ripstop/flow/cartesian/march_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ripstop::inline flow::cartesian {
namespace {

/// Another axis is chosen if the component of the stream along it exceeds that along +z by this ratio.
constexpr double clearly = 1.001;

std::array<double, 3> components_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

}  // namespace

MarchFrame::MarchFrame(Vec3 stream) {
  const std::array<double, 3> along = components_of(stream);
  int nearest = 2;
  double most = std::max(clearly * along[2], 0.0);
  for (const int axis : {2, 0, 1})
    if (std::abs(along[axis]) > most) most = clearly * std::abs(along[axis]), nearest = axis;
  const int sign = along[nearest] < 0 ? -1 : 1;
  axis_ = {(nearest + 1) % 3, (nearest + 2) % 3, nearest};
  sign_ = {1, sign, sign};
}

std::string MarchFrame::text() const {
  const auto name = [&](int a) { return fmt::format("{}{}", sign_[a] < 0 ? "-" : "", "xyz"[axis_[a]]); };
  return fmt::format("x, y, z = {}, {}, {} of the case", name(0), name(1), name(2));
}

Vec3 MarchFrame::into(Vec3 v) const {
  const std::array<double, 3> own = components_of(v);
  return {sign_[0] * own[axis_[0]], sign_[1] * own[axis_[1]], sign_[2] * own[axis_[2]]};
}

Vec3 MarchFrame::back(Vec3 v) const {
  const std::array<double, 3> own = components_of(v);
  std::array<double, 3> result{};
  for (int a = 0; a < 3; ++a) result[axis_[a]] = sign_[a] * own[a];
  return {result[0], result[1], result[2]};
}

std::vector<Triangle> MarchFrame::into(std::vector<Triangle> surface) const {
  for (Triangle& t : surface) t = {into(t.a), into(t.b), into(t.c)};
  return surface;
}

SheetMotion MarchFrame::into(SheetMotion motion) const {
  for (Vec3& v : motion.velocity) v = into(v);
  if (motion.rigid)
    for (Vec3* v : {&motion.rigid->velocity, &motion.rigid->spin, &motion.rigid->about}) *v = into(*v);
  return motion;
}

FlowGrid MarchFrame::into(const FlowGrid& grid) const {
  FlowGrid result = grid;
  const std::array<double, 3> low = components_of(grid.origin), size = components_of(grid.size);
  std::array<double, 3> origin{};
  for (int a = 0; a < 3; ++a) {
    const Grading& g = grid.grading[axis_[a]];
    const bool reversed = sign_[a] < 0;
    origin[a] = reversed ? -(low[axis_[a]] + size[axis_[a]]) : low[axis_[a]];
    result.grading[a] =
        reversed ? Grading{-g.core_high, -g.core_low, g.after, g.before, g.ratio_after, g.ratio_before} : g;
  }
  result.origin = {origin[0], origin[1], origin[2]};
  result.size = {size[axis_[0]], size[axis_[1]], size[axis_[2]]};
  result.nx = grid.count(axis_[0]), result.ny = grid.count(axis_[1]), result.nz = grid.count(axis_[2]);
  return result;
}

template <class Visit>
void MarchFrame::each_cell(const FlowGrid& problem, const Visit& visit) const {
  const std::array<int, 3> strides{1, problem.nx, problem.nx * problem.ny};
  std::array<int, 3> count{}, step{};
  int corner = 0;
  for (int a = 0; a < 3; ++a) {
    count[a] = problem.count(axis_[a]), step[a] = sign_[a] * strides[axis_[a]];
    if (sign_[a] < 0) corner += (count[a] - 1) * strides[axis_[a]];
  }
  int cell = 0;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) visit(cell++, corner + i * step[0] + j * step[1] + k * step[2]);
}

FlowProblem MarchFrame::into(FlowProblem problem) const {
  if (same()) return problem;
  const FlowGrid grid = problem.grid;
  problem.grid = into(grid);
  problem.air.velocity = into(problem.air.velocity);
  problem.sides = Sides::far_field;  // that of the other axes: only +z can have an inlet and an outlet
  for (FlowBody& body : problem.bodies) {
    body.surface = into(std::move(body.surface));
    body.motion = into(std::move(body.motion));
    body.moment_about = into(body.moment_about);
    if (body.is_sheet()) continue;
    std::vector<char> cut(static_cast<std::size_t>(grid.cells()));
    for (const int cell : body.porous().cells) cut[static_cast<std::size_t>(cell)] = 1;
    body.porous().cells.clear();
    each_cell(grid, [&](int cell, int of_problem) {
      if (cut[static_cast<std::size_t>(of_problem)]) body.porous().cells.push_back(cell);
    });
  }
  if (problem.body_force.empty()) return problem;
  const std::vector<Vec3> force = problem.body_force;
  each_cell(grid, [&](int cell, int of_problem) { problem.body_force[cell] = into(force[of_problem]); });
  return problem;
}

void MarchFrame::turn_back(BodyLoad& load) const {
  load = {back(load.force), back(load.moment)};
}

std::vector<SheetLoad> MarchFrame::back(std::vector<SheetLoad> loads) const {
  if (same()) return loads;
  for (SheetLoad& load : loads)
    load.point = back(load.point), load.outward = back(load.outward), load.force = back(load.force);
  return loads;
}

FlowStep MarchFrame::back(FlowStep step) const {
  if (same()) return step;
  step.force = back(step.force), step.momentum_gap = back(step.momentum_gap);
  for (BodyLoad& load : step.bodies) turn_back(load);
  return step;
}

FlowField MarchFrame::back(FlowField field, const FlowGrid& grid) const {
  if (same()) return field;
  field.grid = grid;
  const std::vector<double> pressure = field.pressure;
  const std::vector<Vec3> velocity = field.velocity;
  each_cell(grid, [&](int cell, int of_problem) {
    field.pressure[of_problem] = pressure[cell], field.velocity[of_problem] = back(velocity[cell]);
  });
  field.porous_force = back(field.porous_force), field.momentum_deficit = back(field.momentum_deficit);
  for (BodyLoad& load : field.bodies) turn_back(load);
  field.sheet_loads = back(std::move(field.sheet_loads));
  return field;
}

}  // namespace ripstop::inline flow::cartesian
