#include "ripstop/inflation/air.h"

#include <algorithm>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/coupling/sheet_transfer.h"
#include "ripstop/coupling/transfer.h"

namespace ripstop {
namespace {

FlowProblem with_surface(FlowProblem problem, std::vector<Triangle> surface) {
  if (problem.sheets.size() != 1)
    throw Error(ExitCode::usage, "an opening in its own air takes the canopy as one sheet");
  problem.sheets[0].surface = std::move(surface);
  return problem;
}

/// The least of a cell's corners: tape and lines make some of them heavier, and cloth that gives way a little
/// too easily is stable.
std::vector<double> least_mass(const Mesh& mesh, const std::vector<Cell>& cells) {
  std::vector<double> area(mesh.mass.size(), 0.0), cut;
  for (const Patch& patch : mesh.patches)
    cut.insert(cut.end(), patch.cell_area.begin(),
               patch.cell_area.begin() + std::ptrdiff_t{patch.rows - 1} * patch.columns);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].corner[0] < 0) continue;
    for (const int node : cells[c].corner) area[node] += 0.25 * cut[c];
  }
  std::vector<double> result;
  for (const Cell& cell : cells) {
    if (cell.corner[0] < 0) continue;
    double least = 1e300;
    for (const int node : cell.corner) least = std::min(least, mesh.mass[node] / area[node]);
    result.insert(result.end(), 2, least);
  }
  return result;
}

}  // namespace

OpeningAir::OpeningAir(const AirProblem& problem, const Mesh& mesh)
    : engine_(problem.engine),
      grid_(problem.flow.grid),
      courant_(problem.courant),
      speed_(problem.flow.air.speed),
      dynamic_pressure_(0.5 * problem.flow.air.density * speed_ * speed_),
      cells_(cells_of(mesh)),
      mass_(least_mass(mesh, cells_)) {
  flow_ = engine_->start(with_surface(problem.flow, surface_of(cells_, mesh.start)));
}

void OpeningAir::settle(const std::vector<Vec3>& positions) {
  double first = 1e300, last = -1e300;
  for (const Cell& cell : cells_) {
    if (cell.corner[0] < 0) continue;
    first = std::min(first, positions[cell.corner[0]].z), last = std::max(last, positions[cell.corner[0]].z);
  }
  flow_->place(surface_of(cells_, positions));
  for (double passed = 0; passed < last - first;) passed += speed_ * flow_->step(longest_step()).length;
}

Loads OpeningAir::step(const std::vector<Vec3>& positions, double length, AirMemory& memory, AirRow& row) {
  const std::vector<Triangle> surface = surface_of(cells_, positions);
  SheetMotion motion;
  motion.mass = mass_;
  memory.velocity.resize(cells_.size()), memory.acceleration.resize(cells_.size());
  memory.pressure.resize(cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (cells_[c].corner[0] < 0) continue;
    motion.velocity.insert(motion.velocity.end(), 2, memory.velocity[c]);
    motion.acceleration.insert(motion.acceleration.end(), 2, memory.acceleration[c]);
    motion.pressure.insert(motion.pressure.end(), 2, memory.pressure[c]);
  }
  flow_->place(surface, motion);
  const FlowStep step = flow_->step(length);
  ClothLoad load = load_of_flow(flow_->sheet_loads(), grid_, surface, cells_, positions);
  row.length = length, row.courant = step.courant;
  row.drag = step.force.z, row.side_x = step.force.x, row.side_y = step.force.y;
  row.drag_area = row.drag / dynamic_pressure_;
  row.momentum_gap = step.momentum_gap, row.mass_defect = step.mass_defect;
  row.remainder = remainder_share(load, cells_, positions);
  memory.pressure = load.pressure;
  ++memory.steps;
  Loads loads;
  loads.cell_pressure = std::exchange(load.pressure, std::vector<double>(cells_.size(), 0.0));
  loads.node_force = node_forces(load, cells_, positions);
  return loads;
}

void OpeningAir::moved(const std::vector<Vec3>& from, const std::vector<Vec3>& to, double length,
                       const Loads& loads, AirMemory& memory) const {
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (cells_[c].corner[0] < 0) continue;
    Vec3 way;
    for (const int node : cells_[c].corner) way += 0.25 * (to[node] - from[node]);
    const Vec3 velocity = way / length;
    memory.acceleration[c] = (velocity - memory.velocity[c]) / length;
    memory.velocity[c] = velocity;
  }
  for (std::size_t n = 0; n < to.size(); ++n) memory.work += dot(loads.node_force[n], to[n] - from[n]);
}

}  // namespace ripstop
