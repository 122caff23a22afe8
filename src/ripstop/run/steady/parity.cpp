#include "ripstop/run/steady/parity.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "ripstop/case/quantity_keys.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"
#include "ripstop/run/json.h"

namespace ripstop::inline run {
namespace {

constexpr double field_tolerance = 0.01;

ParityRun timed(FlowEngine& engine, const FlowProblem& problem, const std::string& canopy,
                const ParityEvents& events, FlowField& field) {
  const auto start = std::chrono::steady_clock::now();
  ParityRun run;
  try {
    field = solve(engine, problem, [&](const FlowProgress& progress) {
      if (events.progress) events.progress(canopy, engine.name(), progress);
      return true;
    });
    run.drag = field.porous_force.z;
    run.momentum_deficit = field.momentum_deficit.z;
    run.iterations = field.last.iteration;
    run.converged = field.converged;
  } catch (const Error& error) {  // the other engine and the other canopies are of interest all the same
    if (error.code() != ExitCode::diverged) throw;
    run.diverged = message_of(error);
  }
  run.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace

void compare_fields(const FlowField& a, const FlowField& b, const Freestream& air, ParityRow& row) {
  const double dynamic = 0.5 * air.density * air.speed() * air.speed();
  const auto cells = static_cast<double>(a.pressure.size());
  for (std::size_t cell = 0; cell < a.pressure.size(); ++cell) {
    const double u = norm(a.velocity[cell] - b.velocity[cell]) / air.speed();
    const double p = std::abs(a.pressure[cell] - b.pressure[cell]) / dynamic;
    row.velocity += u * u / cells;
    row.pressure += p * p / cells;
    row.largest_velocity = std::max(row.largest_velocity, u);
    row.largest_pressure = std::max(row.largest_pressure, p);
  }
  row.velocity = std::sqrt(row.velocity);
  row.pressure = std::sqrt(row.pressure);
}

namespace {

ParityRow compare_engines(const ParitySettings& settings, const std::filesystem::path& folder,
                          const FlowProblem& problem, const std::string& canopy, const ParityEvents& events) {
  OpenFoamSettings reference;
  reference.folder = folder;
  reference.ranks = settings.ranks;
  reference.incompressible = settings.incompressible;
  CartesianSettings cartesian;
  cartesian.threads = settings.threads;
  cartesian.compressible = !settings.incompressible;
  cartesian.grid_sequencing = settings.coarse_start;
  ParityRow row;
  row.canopy = canopy;
  FlowField theirs, ours;
  row.openfoam = timed(*make_openfoam(reference), problem, canopy, events, theirs);
  row.builtin = timed(*make_cartesian(cartesian), problem, canopy, events, ours);
  if (row.diverged()) return row;
  compare_fields(ours, theirs, problem.air, row);
  row.drag = row.builtin.drag / row.openfoam.drag - 1;
  row.within = std::abs(row.drag) <= settings.drag_tolerance() && row.velocity <= field_tolerance &&
               row.pressure <= field_tolerance;
  return row;
}

/// A canopy that lies elsewhere has no drag, which both engines would agree on.
void require_inside(const FlowGrid& grid, const std::vector<Triangle>& surface) {
  if (surface.empty()) return;
  Vec3 low = surface.front().a, high = low;
  for (const Triangle& triangle : surface) {
    for (const Vec3 p : {triangle.a, triangle.b, triangle.c}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  const Vec3 end = grid.origin + grid.size;
  if (low.x > grid.origin.x && low.y > grid.origin.y && low.z > grid.origin.z && high.x < end.x &&
      high.y < end.y && high.z < end.z)
    return;
  throw Error(
      ExitCode::bad_data,
      fmt::format("the surface extends from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m; it must "
                  "be inside the domain from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m: move it there "
                  "(is it in millimetres?)",
                  low.x, low.y, low.z, high.x, high.y, high.z, grid.origin.x, grid.origin.y, grid.origin.z,
                  end.x, end.y, end.z));
}

}  // namespace

std::string to_json(const ParityResult& result) {
  return json_text(result);
}

ParityResult flow_parity(const ParitySettings& settings, const ParityEvents& events) {
  FlowProblem problem;
  problem.grid = {{-1, -1, 0}, {2, 2, 4}, settings.cells[0], settings.cells[1], settings.cells[2]};
  problem.air.velocity = {0, 0, settings.speed};
  problem.air.density = settings.density;
  if (settings.slip) problem.sides = Sides::slip;
  require_inside(problem.grid, settings.surface);
  const std::vector<int> cut =
      cut_cells(problem.grid, settings.surface.empty() ? rigid_disk_gap_band({0, 0, 2}) : settings.surface);
  if (cut.empty())
    throw Error(ExitCode::bad_data, "the surface intersects no cell: its triangles have no area");
  std::optional<TemporaryFolder> temporary;
  const std::filesystem::path folder =
      settings.folder.empty() ? temporary.emplace("flow-parity").path : settings.folder;
  ParityResult result{
      settings.cells, static_cast<int>(cut.size()), settings.speed, settings.drag_tolerance(), {}};
  if (events.row) events.row(result);
  for (const ParityCanopy& canopy : parity_canopies) {
    const std::vector<std::string>& asked = settings.canopies;
    if (!asked.empty() && std::find(asked.begin(), asked.end(), canopy.name) == asked.end()) continue;
    problem.bodies = {porous_body({cut, canopy.darcy, canopy.forchheimer})};
    result.rows.push_back(compare_engines(settings, folder, problem, canopy.name, events));
    if (events.row) events.row(result);
  }
  return result;
}

}  // namespace ripstop::inline run
