#include "ripstop/flow/openfoam/case_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/flow/boundaries.h"
#include "ripstop/flow/cartesian/quarter.h"
#include "ripstop/flow/openfoam/case_writer.h"

namespace ripstop::inline flow::openfoam {
namespace {

namespace fs = std::filesystem;

/// Resistance of every cell, d and f of method section 4, and the body that it belongs to; -1: none.
struct Resistance {
  std::vector<double> darcy, forchheimer;
  std::vector<int> body_of;

  explicit Resistance(const FlowProblem& problem)
      : darcy(static_cast<std::size_t>(problem.grid.cells())),
        forchheimer(darcy.size()),
        body_of(darcy.size(), -1) {
    for (std::size_t n = 0; n < problem.bodies.size(); ++n) {
      const FlowBody& body = problem.bodies[n];
      if (body.is_sheet()) continue;
      const PorousCells& porous = body.porous();
      for (const int cell : porous.cells) {
        darcy[cell] = porous.darcy;
        forchheimer[cell] = porous.forchheimer;
        body_of[cell] = static_cast<int>(n);
      }
    }
  }
};

/// Axial momentum that the air loses between the faces of the box,
///   F = -sum_faces (phi U_z + p A_z) + viscous,
/// with the values that the solver's own scheme has on the faces, so that it equals the porous force when every
/// cell's momentum balances. The viscous and turbulent normal stress at the inlet is neglected: with mu_t = 10 mu it
/// is some 1e-6 of the dynamic pressure for cells of centimetres. `density`: that of phi.
double outflow_of_momentum(const MeshPart& part, const FieldData& phi, double density,
                           const FieldData& velocity, const std::vector<double>& gauge,
                           const FlowProblem& problem) {
  const FlowGrid& grid = problem.grid;
  double loss = 0;
  for (const Patch& patch : part.patches) {
    const auto flux = phi.patches.find(patch.name);
    const bool inlet = patch.name == "inlet", outlet = patch.name == "outlet", sides = patch.name == "sides";
    if (!(inlet || outlet || sides) || patch.faces == 0) continue;  // faces between ranks cancel
    if (flux == phi.patches.end())
      throw Error(ExitCode::io, "OpenFOAM's phi has no values on patch " + patch.name);
    for (int face = 0; face < patch.faces; ++face) {
      const int cell = part.owner[patch.start + face];
      const double out = density * phi.at(flux->second, face);  // [kg/s], positive outward
      const double inside = velocity.at(velocity.inner, cell, 2);
      const double speed = inlet ? problem.air.velocity.z : outlet && out < 0 ? 0 : inside;
      loss -= out * speed;
      if (!inlet) continue;  // outlet: p is 0; sides: no axial area
      const int of_grid = part.global(cell);
      loss += gauge[of_grid] * grid.width(0, of_grid % grid.nx) * grid.width(1, of_grid / grid.nx % grid.ny);
    }
  }
  return loss;
}

/// A pressure at the solver's own limits, and of course no number, is no solution. `outlet`: the pressure
/// that the limits are multiples of; infinite without limits.
// A field that is cut short on its way may have a few clipped cells where the porous ones have just changed;
// a flow that has nowhere to go has many.
void check_range(const FlowField& field, double outlet) {
  constexpr double many = 0.01;  // of the cells
  const double low = (kLowestPressure - 1) * outlet, high = (kHighestPressure - 1) * outlet;
  std::size_t clipped = 0, last = 0;
  for (std::size_t cell = 0; cell < field.pressure.size(); ++cell) {
    const double gauge = field.pressure[cell];
    if (!std::isfinite(gauge) || !is_finite(field.velocity[cell])) {
      throw Error(ExitCode::diverged, fmt::format("OpenFOAM's fields are not finite in cell {}", cell));
    }
    if (gauge < 0.999 * low || gauge > 0.999 * high) ++clipped, last = cell;
  }
  if (static_cast<double>(clipped) > many * static_cast<double>(field.pressure.size())) {
    throw Error(ExitCode::diverged,
                fmt::format("the flow diverged: the pressure reached its limits, {:.0f} and {:.0f} Pa "
                            "relative to the outlet, in {} cells (for example cell {}). The given speed is "
                            "not possible in a blocked duct: lower the resistance or the speed",
                            low, high, clipped, last));
  }
}

}  // namespace

std::vector<MeshPart> read_mesh(const fs::path& folder, int ranks) {
  std::vector<MeshPart> parts;
  for (int rank = 0; rank < ranks; ++rank) {
    MeshPart part;
    part.folder = ranks == 1 ? folder : folder / fmt::format("processor{}", rank);
    const fs::path mesh = part.folder / "constant/polyMesh";
    if (ranks > 1) part.cells = read_labels(mesh / "cellProcAddressing");
    part.owner = read_labels(mesh / "owner");
    part.patches = read_boundary(mesh / "boundary");
    parts.push_back(std::move(part));
  }
  return parts;
}

std::string latest_time(const fs::path& folder) {
  std::string latest;
  double newest = -1;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    double time = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), time);
    if (error == std::errc() && end == name.data() + name.size() && entry.is_directory() && time > newest) {
      newest = time;
      latest = name;
    }
  }
  return latest;
}

FlowField read_case(const std::vector<MeshPart>& parts, const std::string& time, const FlowProblem& problem,
                    bool incompressible) {
  const FlowGrid& grid = problem.grid;
  const Resistance resistance(problem);
  const double mu = problem.air.viscosity;
  // Incompressible: p [m2/s2] is 0 at the outlet, phi is in m3/s, and there is no field of the density.
  const double unit = incompressible ? problem.air.density : 1;
  const double outlet = incompressible ? 0 : outlet_pressure(problem.air);
  const bool far = sides_of(problem) == Sides::far_field;
  FlowField field;
  field.grid = grid;
  if (far) field.momentum_deficit = {NAN, NAN, NAN};  // not summed over faces of all directions
  field.bodies.resize(problem.bodies.size());
  field.pressure.resize(static_cast<std::size_t>(grid.cells()));
  field.velocity.resize(field.pressure.size());
  for (const MeshPart& part : parts) {
    const std::size_t count = part.count(grid);
    const fs::path folder = part.folder / time;
    const FieldData p = read_field(folder / "p", 1, count);
    const FieldData velocity = read_field(folder / "U", 3, count);
    const FieldData rho = incompressible ? FieldData{1, {unit}, {}} : read_field(folder / "rho", 1, count);
    const FieldData phi = read_field(folder / "phi", 1, part.inner_faces());
    const auto gauge = [&](std::size_t local) { return unit * p.at(p.inner, local) - outlet; };
    const auto moves = [&](std::size_t local) -> Vec3 {
      return {velocity.at(velocity.inner, local, 0), velocity.at(velocity.inner, local, 1),
              velocity.at(velocity.inner, local, 2)};
    };
    for (std::size_t local = 0; local < count; ++local) {
      const int cell = part.global(local);
      const Vec3 u = moves(local);
      field.pressure[cell] += part.weight(local) * gauge(local);
      field.velocity[cell] += part.weight(local) * u;
      // Force of the air on the porous cells: (mu d + rho |u| f / 2) u V.
      const double drag = mu * resistance.darcy[cell] +
                          0.5 * rho.at(rho.inner, local) * norm(u) * resistance.forchheimer[cell];
      const Vec3 force = drag * grid.cell_volume(cell) * u;
      field.porous_force += force;
      if (resistance.body_of[cell] < 0) continue;
      const auto body = static_cast<std::size_t>(resistance.body_of[cell]);
      field.bodies[body].force += force;
      field.bodies[body].moment +=
          cross(grid.centre(cell % grid.nx, cell / grid.nx % grid.ny, cell / grid.nx / grid.ny) -
                    problem.bodies[body].moment_about,
                force);
    }
    for (const auto& [cell, nearest] : part.stand_ins) {
      field.pressure[cell] = gauge(nearest);
      field.velocity[cell] = moves(nearest);
    }
    if (!far)
      field.momentum_deficit.z += outflow_of_momentum(part, phi, unit, velocity, field.pressure, problem);
  }
  check_range(field, incompressible ? INFINITY : outlet);
  if (!problem.quarter) return field;
  field.porous_force = cartesian::of_whole_box(field.porous_force);
  field.momentum_deficit = cartesian::of_whole_box(field.momentum_deficit);
  for (std::size_t n = 0; n < field.bodies.size(); ++n)
    field.bodies[n] = cartesian::of_whole_box(field.bodies[n], problem.bodies[n].moment_about);
  return field;
}

FlowProblem solved_part(const FlowProblem& whole) {
  return whole.quarter ? cartesian::quarter_of(whole) : whole;
}

int parts_of(const FlowProblem& problem) {
  return problem.quarter ? cartesian::images : 1;
}

FlowField whole_field(FlowField part, const FlowGrid& whole) {
  return part.grid == whole ? part : cartesian::whole_of(std::move(part), whole);
}

}  // namespace ripstop::inline flow::openfoam
