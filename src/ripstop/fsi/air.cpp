#include "ripstop/fsi/air.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/fsi/added_mass.h"
#include "ripstop/fsi/sheet_transfer.h"
#include "ripstop/fsi/transfer.h"

namespace ripstop {
namespace {

/// Of the velocity that a constant load gives at the end of so many steps, v' = v + dt f/m and x' = x + dt v', the mean
/// over all of them: in one step the whole, in many a half.
double mean_share(int steps) {
  return 0.5 * (1 + 1.0 / steps);
}

constexpr double degree = std::numbers::pi / 180;

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
      density_(problem.flow.air.density),
      payload_(problem.payload),
      node_mass_(mesh.mass),
      cells_(cells_of(mesh)),
      mass_(least_mass(mesh, cells_)) {
  if (!engine_) throw Error(ExitCode::usage, "an opening in its own air needs a flow engine");
  flow_ = engine_->start(with_surface(problem.flow, surface_of(cells_, mesh.start)));
}

double OpeningAir::pull_of_weight(double angle) const {
  return payload_->gravity * std::sin(angle);
}

double OpeningAir::brake(const AirMemory& memory) const {
  const double q = 0.5 * density_ * thickening(memory) * memory.speed * memory.speed;
  return q * payload_->drag_area / payload_->mass;
}

double OpeningAir::thickening(const AirMemory& memory) const {
  return payload_ && payload_->density ? payload_->density(memory.fallen) : 1;
}

Loads OpeningAir::last_load(const AirMemory& memory) const {
  if (memory.pressure.empty())
    return {std::vector<double>(cells_.size(), 0.0), std::vector<Vec3>(node_mass_.size())};
  return {memory.pressure, memory.force};
}

Loads OpeningAir::step(const std::vector<Vec3>& positions, const ClothMotion& cloth, double length,
                       AirMemory& memory, AirRow& row) {
  const std::vector<Triangle> surface = surface_of(cells_, positions);
  const std::vector<double> pressure = last_load(memory).cell_pressure;
  // The engine's air has the density of deployment. A flow at one speed does not know its density, so what it does to
  // the cloth goes with the density there.
  const double thicker = thickening(memory);
  SheetMotion motion;
  for (const double mass : mass_) motion.yields.push_back(thicker * mean_share(cloth.steps) * length / mass);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (cells_[c].corner[0] < 0) continue;
    Vec3 mean;
    for (const int node : cells_[c].corner) mean += 0.25 * cloth.velocity[node];
    motion.velocity.insert(motion.velocity.end(), 2, mean);
    motion.pressure.insert(motion.pressure.end(), 2, pressure[c] / thicker);
  }
  flow_->place(surface, motion);
  if (memory.steps == 0) {
    memory.speed = speed_;
    if (payload_) {
      memory.angle = payload_->angle * degree;
      memory.acceleration = pull_of_weight(memory.angle) - brake(memory);
    }
  }
  row.speed = memory.speed + length * memory.acceleration;
  if (payload_) flow_->stream(row.speed, memory.acceleration);
  const FlowStep step = flow_->step(length);
  std::vector<SheetLoad> loads = flow_->sheet_loads();
  for (SheetLoad& one : loads) {
    one.drop *= thicker, one.force = thicker * one.force;
    if (one.inside) *one.inside *= thicker;
    if (one.outside) *one.outside *= thicker;
  }
  ClothLoad load = load_of_flow(loads, grid_, surface, cells_, positions, Folds::filled);
  row.length = length, row.courant = step.courant;
  const Vec3 force = thicker * step.force;
  row.drag = force.z, row.side_x = force.x, row.side_y = force.y;
  row.drag_area = row.drag / (0.5 * density_ * thicker * row.speed * row.speed);
  row.momentum_gap = step.momentum_gap, row.mass_defect = step.mass_defect;
  row.remainder = remainder_share(load, cells_, positions);
  row.added_mass = memory.added_mass;
  memory.pressure = std::exchange(load.pressure, std::vector<double>(cells_.size(), 0.0));
  memory.force = node_forces(load, cells_, positions);
  if (payload_) {  // weight, and what a frame that is slowed down does to what is in it
    for (std::size_t n = 0; n < node_mass_.size(); ++n)
      memory.force[n].z += node_mass_[n] * (memory.acceleration - pull_of_weight(memory.angle));
  }
  ++memory.steps;
  return last_load(memory);
}

void OpeningAir::weigh_air(const std::vector<Vec3>& positions, AirMemory& memory) const {
  memory.added_mass =
      thickening(memory) * ripstop::added_mass(*engine_, surface_of(cells_, positions), density_);
}

void OpeningAir::fly(double pull, double length, AirMemory& memory) const {
  if (!payload_) return;
  const double way = length * (memory.speed + 0.5 * length * memory.acceleration);
  const double turn = std::atan2(length * payload_->gravity * std::cos(memory.angle), memory.speed);
  memory.path += way;
  memory.fallen += way * std::sin(memory.angle + 0.5 * turn);
  memory.speed += length * memory.acceleration;
  memory.angle += turn;
  memory.acceleration = pull_of_weight(memory.angle) - brake(memory) - pull / payload_->mass;
}

}  // namespace ripstop
