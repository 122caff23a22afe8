// The cloth of a case under a given pressure, without a flow, in memory; and its files.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/canopy/shape.h"
#include "ripstop/canopy/stress.h"
#include "ripstop/case/settings.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/cloth/watched_relaxation.h"
#include "ripstop/core/members.h"
#include "ripstop/output/vtk.h"
#include "ripstop/run/margins.h"

namespace ripstop::inline run {

/// result.json of `ripstop fabric`.
struct FabricResult {
  std::string title;
  std::optional<std::string> inputs_hash;  // of version, case and pressure
  double pressure = 0;                     // over the whole canopy [Pa]
  double pressure_load = 0;                // axial, on the cloth [N]
  double line_tension = 0;                 // axial sum, on the fixed end [N]
  CanopySize size;
  double projected_ratio = 0;                                  // projected over nominal diameter
  std::optional<std::array<double, 2>> known_projected_ratio;  // Knacke's range of the type, in flight
  double max_line_tension = 0;                                 // [N]
  StressPeak stress;
  int nodes = 0, steps = 0;
  double residual = 0;  // as RelaxOptions::tolerance
  double tolerance = 0;
  bool converged = false;
  double wall_time = 0;  // of the relaxation [s]
  std::optional<Margins> margins;
  std::vector<std::string> warnings;
};
template <Of<FabricResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("inputs_hash", r.inputs_hash);
  visit("pressure_pa", r.pressure);
  visit("pressure_load_n", r.pressure_load);
  visit("line_tension_n", r.line_tension);
  visit("projected_diameter_m", r.size.projected_diameter);
  visit("projected_area_m2", r.size.projected_area);
  visit("skirt_diameter_m", r.size.skirt_diameter);
  visit("canopy_length_m", r.size.length);
  visit("projected_over_nominal", r.projected_ratio);
  visit("known_projected_over_nominal", r.known_projected_ratio);
  visit("max_line_tension_n", r.max_line_tension);
  visit("max_von_mises_n_m", r.stress.von_mises);
  visit("max_von_mises_at_m", r.stress.place);
  visit("max_von_mises_on", r.stress.patch);
  visit("max_cloth_strain", r.stress.strain);
  sewing_members(r.stress, visit);
  visit("nodes", r.nodes);
  visit("steps", r.steps);
  visit("residual", r.residual);
  visit("cloth_tolerance", r.tolerance);
  visit("converged", r.converged);
  visit("wall_time_s", r.wall_time);
  visit("margins", r.margins);
  visit("warnings", r.warnings);
}
std::string to_json(const FabricResult& result);

struct FabricSolution {
  FabricResult result;
  CanopyMesh mesh;
  std::vector<Vec3> shape;
  std::vector<CellStress> stress;  // of every cell
  std::vector<double> tensions;    // of every irregular spring [N]
};

/// `given` [Pa]; absent: the case's dynamic pressure.
double fabric_pressure(const Settings& resolved, std::optional<double> given);

/// Equilibrium under that pressure. Convergence is not promised. `own`: a mesh in place of the canopy of the case
/// (parachute/own_mesh.h); null: none.
FabricSolution run_fabric(const Settings& resolved, std::optional<double> pressure,
                          const std::function<void(const RelaxProgress&)>& report = {},
                          const CanopyMesh* own = nullptr);

/// The same with the shape of the moment, by `threads` threads; 0: one per core.
FabricSolution run_watched_fabric(const Settings& resolved, std::optional<double> pressure, int threads,
                                  const RelaxWatch& watch, const CanopyMesh* own = nullptr);

/// Cloth with its stresses, and lines with their tension.
VtkSurface fabric_canopy(const FabricSolution& solution);
VtkSurface fabric_lines(const FabricSolution& solution);

/// canopy.png, canopy.vtp, lines.vtp and result.json.
void write_fabric(const std::filesystem::path& folder, const FabricSolution& solution);

}  // namespace ripstop::inline run
