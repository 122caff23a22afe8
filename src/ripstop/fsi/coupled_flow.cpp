#include "ripstop/fsi/coupled_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/flow/apart.h"
#include "ripstop/fsi/added_mass.h"
#include "ripstop/fsi/in_parts.h"
#include "ripstop/fsi/lattice.h"
#include "ripstop/fsi/sheet_transfer.h"
#include "ripstop/fsi/transfer.h"

namespace ripstop::inline fsi {
namespace {

/// Of the velocity that a constant load gives at the end of so many steps, v' = v + dt f/m and x' = x + dt v', the mean
/// over all of them: the whole for one step, half for many.
double mean_share(int steps) {
  return 0.5 * (1 + 1.0 / steps);
}

bool is_rigid(const FlowBody& body) {
  return body.is_sheet() && body.drop().linear >= impermeable.linear && body.motion.velocity.empty();
}

std::unique_ptr<Flow> start_flow(const AirProblem& problem, std::vector<Triangle> surface) {
  if (!problem.engine) throw Error(ExitCode::usage, "coupled inflation needs a flow engine");
  FlowProblem flow = problem.flow;
  if (flow.bodies.empty() || !flow.bodies[0].is_sheet())
    throw Error(ExitCode::usage, "coupled inflation needs a canopy that is a sheet");
  for (std::size_t n = 1; n < flow.bodies.size(); ++n)
    if (!is_rigid(flow.bodies[n]))
      throw Error(
          ExitCode::usage,
          fmt::format("coupled inflation supports one canopy and rigid, impermeable bodies: \"{}\" is "
                      "neither",
                      flow.bodies[n].name));
  flow.bodies[0].surface = std::move(surface);
  return problem.engine->start(flow);
}

/// The least of a cell's corners: tape and lines make some of them heavier, and a compliance that is a little too large
/// is stable.
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

// Widths of the flow's cells over which the air sees the velocity of the cloth smoothed.
constexpr double smoothed_over = 0.5;

/// Cells of cloth, without those that have none: centre, area vector and velocity.
struct MovingCells {
  std::vector<Vec3> centre, area, velocity;
};

/// Visits the shares, together 1, of a unit vector in the six directions of the axes.
template <class Visit>
void shares_of_directions(Vec3 normal, const Visit& visit) {
  const double n[] = {normal.x, normal.y, normal.z};
  for (int axis = 0; axis < 3; ++axis)
    if (n[axis] != 0) visit(2 * axis + (n[axis] < 0), n[axis] * n[axis]);
}

// Mean by area over the cloth within `width` that has the same orientation. A face of the flow represents many cells of
// cloth and must not have the velocity of one of them: the load, which is smooth on that scale, could not stop it. The
// operation is symmetric with respect to the areas, so it increases no velocity.
std::vector<Vec3> smoothed_velocity(const MovingCells& cells, double width, ThreadTeam* team) {
  struct Sum {
    double area = 0;  // [m2]
    Vec3 swept;       // [m3/s]
  };
  std::vector<std::array<Sum, 6>> sums(1);    // of points with cloth about them
  Lattice<int> lattice(cells.centre, width);  // which of the sums; 0: none yet
  const auto each = [&](std::size_t c, const auto& visit) {
    const double area = norm(cells.area[c]);
    if (!(area > 0)) return;
    shares_of_directions(cells.area[c] / area, [&](int direction, double of_direction) {
      lattice.about(cells.centre[c], [&](int& point, double share) {
        if (point == 0) point = static_cast<int>(sums.size()), sums.emplace_back();
        visit(sums[point][direction], share * of_direction, area);
      });
    });
  };
  for (std::size_t c = 0; c < cells.centre.size(); ++c)
    each(c, [&](Sum& sum, double share, double area) {
      sum.area += share * area, sum.swept += share * area * cells.velocity[c];
    });
  std::vector<Vec3> result = cells.velocity;
  each_in_parts(team, cells.centre.size(), [&](std::size_t c) {
    if (norm(cells.area[c]) > 0) result[c] = {};
    each(c, [&](const Sum& sum, double share, double) {
      if (share > 0) result[c] += share / sum.area * sum.swept;
    });
  });
  return result;
}

}  // namespace

ClothMotion predict_motion(const ClothState& state, const Cloth& cloth, const Loads& last_load, double length,
                           int steps, ThreadTeam& team, StepMemory& memory) {
  ClothState moved = state;
  ripstop::step(moved, cloth, last_load, length / steps, steps, team, nullptr, memory);
  const std::vector<Vec3> before = positions(state, cloth);
  ClothMotion motion{positions(moved, cloth), steps};
  for (std::size_t n = 0; n < before.size(); ++n)
    motion.velocity[n] = (motion.velocity[n] - before[n]) / length;
  return motion;
}

CoupledFlow::CoupledFlow(const AirProblem& problem, const Mesh& mesh, ThreadTeam* team)
    : team_(team),
      engine_(problem.engine),
      grid_(problem.flow.grid),
      courant_(problem.courant),
      density_(problem.flow.air.density),
      node_mass_(mesh.mass),
      cells_(cells_of(mesh)),
      mass_(least_mass(mesh, cells_)),
      bodies_(problem.flow.bodies),
      flow_(start_flow(problem, surface_of(cells_, mesh.start)), density_) {}

// On the axis, where the canopy is.
double CoupledFlow::cell_width() const {
  const Vec3 cell = grid_.spacing({0, 0, grid_.origin.z + 0.5 * grid_.size.z});
  return std::max({cell.x, cell.y, cell.z});
}

double CoupledFlow::heaviness() const {
  return density_ * cell_width() / *std::min_element(mass_.begin(), mass_.end());
}

Loads CoupledFlow::last_load(const Surroundings& surroundings, const AirMemory& memory) const {
  Loads load{memory.pressure, memory.force, surroundings.guided};
  if (memory.pressure.empty()) load.cell_pressure.assign(cells_.size(), 0.0);
  load.node_force.resize(node_mass_.size());
  for (std::size_t n = 0; n < memory.other.size(); ++n) load.node_force[n] += memory.other[n];
  return load;
}

// The Robin condition: v_n = v_n,predicted + compliance (p - p_last), compliance = mean_share dt / (mass an area). On
// folded cloth most of the last load is traction, which the drop of the faces contains: the motion of the sheet is
// that without the tractions, else the air would respond to them twice. Guided cloth moves as predicted.
SheetMotion CoupledFlow::sheet_motion(const std::vector<Vec3>& positions, const ClothMotion& predicted,
                                      double length, const std::vector<GuidedNode>& guided,
                                      const AirMemory& memory) const {
  SheetMotion motion;
  MovingCells cells;
  std::vector<double> area_about(node_mass_.size(), 0.0);  // every node [m2]
  for (const Cell& cell : cells_) {
    if (cell.corner[0] < 0) continue;
    const auto& [a, b, c, d] = cell.corner;
    cells.area.push_back(area_vector(positions[a], positions[b], positions[c], positions[d]));
    for (const int node : cell.corner) area_about[node] += 0.25 * norm(cells.area.back());
  }
  for (const double mass : mass_) motion.yields.push_back(mean_share(predicted.steps) * length / mass);
  std::vector<char> is_guided(node_mass_.size(), 0);
  for (const GuidedNode& one : guided) is_guided[one.node] = 1;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (cells_[c].corner[0] < 0) continue;
    const std::size_t triangle = 2 * cells.centre.size();  // the first of two
    if (std::ranges::all_of(cells_[c].corner, [&](int node) { return is_guided[node]; }))
      motion.yields[triangle] = motion.yields[triangle + 1] = 0;
    const double compliance = motion.yields[triangle];
    Vec3 centre, velocity;
    for (const int node : cells_[c].corner) {
      centre += 0.25 * positions[node], velocity += 0.25 * predicted.velocity[node];
      if (!memory.force.empty() && area_about[node] > 0)
        velocity -= 0.25 * compliance / area_about[node] * memory.force[node];
    }
    cells.centre.push_back(centre), cells.velocity.push_back(velocity);
    motion.pressure.insert(motion.pressure.end(), 2, memory.pressure.empty() ? 0 : memory.pressure[c]);
  }
  for (const Vec3 velocity : smoothed_velocity(cells, smoothed_over * cell_width(), team_))
    motion.velocity.insert(motion.velocity.end(), 2, velocity);
  return motion;
}

FlowStep CoupledFlow::step(const std::vector<Vec3>& positions, const ClothMotion& predicted, double length,
                           const Surroundings& surroundings, AirMemory& memory) {
  flow_.set_density_ratio(surroundings.density_ratio);
  surface_ = surface_of(cells_, positions);
  for (const Placement& placed : surroundings.rigid) bodies_.at(placed.body).surface = placed.surface;
  require_apart(surface_, bodies_);
  flow_.place(surface_, sheet_motion(positions, predicted, length, surroundings.guided, memory),
              surroundings.rigid);
  if (surroundings.moves) flow_.stream(surroundings.stream, surroundings.gained);
  ++memory.steps;
  return flow_.step(length);
}

Loads CoupledFlow::transfer(const std::vector<Vec3>& positions, const Surroundings& surroundings,
                            AirMemory& memory, double& residual_traction) const {
  ClothLoad load = load_of_flow(loads_on(0, flow_.sheet_loads()), grid_, surface_, cells_, positions,
                                Folds::filled, team_);
  residual_traction = residual_traction_share(load, cells_, positions);
  memory.pressure = std::exchange(load.pressure, std::vector<double>(cells_.size(), 0.0));
  memory.force = node_forces(load, cells_, positions);
  memory.other.assign(node_mass_.size(), {});
  if (surroundings.moves)
    for (std::size_t n = 0; n < node_mass_.size(); ++n)
      memory.other[n] = node_mass_[n] * surroundings.on_mass;
  if (surroundings.node >= 0) memory.other[surroundings.node] += surroundings.force;
  return last_load(surroundings, memory);
}

void CoupledFlow::compute_added_mass(const std::vector<Vec3>& positions, double density_ratio,
                                     AirMemory& memory) const {
  memory.added_mass = added_mass(*engine_, surface_of(cells_, positions), density_ * density_ratio);
}

}  // namespace ripstop::inline fsi
