#include "ripstop/run/sizing/fabric.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "ripstop/case/assemble.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/positive.h"
#include "ripstop/output/picture.h"
#include "ripstop/output/vtk.h"
#include "ripstop/parachute/own_mesh.h"
#include "ripstop/run/json.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/steady/warnings.h"
#include "ripstop/run/stress_arrays.h"

namespace ripstop::inline run {
namespace {

constexpr double highest_pressure = 1e6;  // as of inflation.pressure_pa [Pa]

/// The result of `relaxation`. If it diverges, the stress p R / 2 of a sphere of the nominal `diameter` is
/// compared with the strength of the cloth.
template <class Relaxation>
RelaxResult relaxed_under(const Settings& resolved, double pressure, double diameter,
                          const Relaxation& relaxation) {
  try {
    return relaxation();
  } catch (const Error& error) {
    if (error.code() != ExitCode::diverged) throw;
    const double stress = 0.25 * pressure * diameter;
    const double strength = resolved.materials().canopy.break_load_n_m;
    throw Error(
        error.code(),
        fmt::format("the cloth has no equilibrium under {:g} Pa: a sphere of this nominal diameter would "
                    "carry {:.3g} N/m{}; take a lower pressure ({})",
                    pressure, stress,
                    strength > 0 ? fmt::format(", and the cloth breaks at {:.3g} N/m", strength) : "",
                    error.what()));
  }
}

}  // namespace

std::string to_json(const FabricResult& result) {
  return json_text(result);
}

double fabric_pressure(const Settings& resolved, std::optional<double> given) {
  if (given) require_within("pressure (Pa)", *given, 1e-9, highest_pressure);
  const double speed = resolved.flow().speed_m_s;
  return given.value_or(0.5 * resolved.flow().density_kg_m3 * speed * speed);
}

FabricSolution run_fabric(const Settings& resolved, std::optional<double> pressure,
                          const std::function<void(const RelaxProgress&)>& report, const CanopyMesh* own) {
  RelaxWatch watch;
  if (report) watch = [&](const RelaxProgress& progress, const auto&) { report(progress); };
  return run_watched_fabric(resolved, pressure, resolved.coupling().threads, watch, own);
}

FabricSolution run_watched_fabric(const Settings& resolved, std::optional<double> pressure, int threads,
                                  const RelaxWatch& watch, const CanopyMesh* own) {
  FabricSolution solution;
  auto& [r, mesh, shape, stress, tensions] = solution;
  r.title = resolved.title();
  r.pressure = fabric_pressure(resolved, pressure);
  if (!own) r.inputs_hash = inputs_hash(resolved, fmt::format("fabric under {} Pa", r.pressure));
  r.tolerance = resolved.coupling().cloth_tolerance;
  mesh = parachute_mesh(resolved, own);
  const double nominal =
      own ? std::sqrt(4 * cloth_area(*own) / std::numbers::pi) : nominal_diameter(resolved.parachute());
  ClothOptions cloth_options;
  cloth_options.linear = resolved.coupling().linear;
  const ClothPtr cloth = make_cloth(mesh, cloth_options);
  ClothState state = start_state(*cloth);
  const Loads loads{std::vector<double>(mesh.cell_count(), r.pressure), {}};
  RelaxOptions relax_options;
  relax_options.tolerance = r.tolerance;
  ThreadTeam team(threads);
  const auto begin = std::chrono::steady_clock::now();
  const RelaxResult relaxed = relaxed_under(resolved, r.pressure, nominal, [&] {
    return watched_relax(state, *cloth, loads, relax_options, team, watch);
  });
  r.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  shape = positions(state, *cloth);
  stress = cell_stress(*cloth, state);
  tensions = spring_tensions(*cloth, state);

  r.pressure_load = pressure_force(*cloth, state, loads).z;
  r.line_tension = force_on_fixed(*cloth, state).z;
  r.size = canopy_size(mesh, shape);
  r.projected_ratio = r.size.projected_diameter / nominal;
  const KnownRange known = experience(resolved.parachute()).projected_ratio;
  if (known.low > 0 && !own) r.known_projected_ratio = {known.low, known.high};
  for (const LineTension& t : line_tensions(mesh, tensions))
    r.max_line_tension = std::max(r.max_line_tension, t.largest_tension);
  r.stress = stress_peak(mesh, shape, stress);
  r.margins = case_margins(resolved, mesh, tensions, r.stress);
  r.warnings = margin_warnings(r.margins);
  for (const auto& more : {own ? std::vector<std::string>() : mesh_warnings(resolved),
                           strain_warnings(resolved, r.stress.strain)})
    r.warnings.insert(r.warnings.end(), more.begin(), more.end());
  r.nodes = mesh.node_count();
  r.steps = relaxed.steps;
  r.residual = relaxed.residual;
  r.converged = relaxed.converged;
  return solution;
}

VtkSurface fabric_canopy(const FabricSolution& solution) {
  const auto& [result, mesh, shape, stress, tensions] = solution;
  VtkSurface canopy = canopy_surface(mesh, shape);
  for (VtkArray& array : stress_arrays(mesh, shape, stress)) canopy.cell_arrays.push_back(std::move(array));
  return canopy;
}

VtkSurface fabric_lines(const FabricSolution& solution) {
  VtkSurface lines = spring_lines(solution.mesh, solution.shape);
  lines.cell_arrays.push_back(vtk_array("tension_n", solution.tensions));
  return lines;
}

void write_fabric(const std::filesystem::path& folder, const FabricSolution& solution) {
  const auto& [result, mesh, shape, stress, tensions] = solution;
  make_results_folder(folder, "fabric");
  std::vector<double> mises;
  for (const CellStress& s : stress) mises.push_back(s.von_mises);
  write_vtp(folder / "canopy.vtp", fabric_canopy(solution));
  write_vtp(folder / "lines.vtp", fabric_lines(solution));
  write_canopy_picture(folder / "canopy.png", mesh, shape,
                       {fmt::format("{} under {:.4g} Pa", result.title, result.pressure),
                        "von Mises stress [N/m]",
                        mises,
                        {}});
  write_file(folder / "result.json", to_json(result));
}

}  // namespace ripstop::inline run
