// The built-in flow engine and OpenFOAM on the same cells, side by side.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline run {

/// Cloth of the `paper` model, by name.
struct ParityCanopy {
  const char* name;
  double darcy, forchheimer;  // d [1/m2], f [1/m]
};
// Ten times more open than [NFM] Table 3's canopy, that canopy, and one that lets almost nothing through.
inline constexpr ParityCanopy parity_canopies[] = {
    {"open", 6.598, 3.745}, {"printed", 65.98, 37.45}, {"nearly solid", 1000, 1000}};

struct ParitySettings {
  std::array<int, 3> cells = {25, 25, 38};  // of the 2 x 2 x 4 m box
  double speed = 10, density = 1.2;         // [m/s], [kg/m3]
  std::vector<Triangle> surface;            // in the box's axes; empty: a rigid disk-gap-band
  std::filesystem::path folder;             // of OpenFOAM's case; empty: a temporary one
  int ranks = 1;                            // OpenFOAM's MPI processes
  int threads = 0;                          // of the built-in engine; 0: all
  bool incompressible = false, slip = false;
  bool coarse_start = false;          // of the built-in engine; else both start from the uniform stream
  std::vector<std::string> canopies;  // empty: all

  /// Of drag. Above 20 m/s the built-in engine's energy equation is not quite OpenFOAM's.
  double drag_tolerance() const { return speed > 20 && !incompressible ? 0.01 : 0.005; }
};

/// One engine on one canopy.
struct ParityRun {
  double drag = 0;              // [N]
  double momentum_deficit = 0;  // [N]
  int iterations = 0;
  double wall_time = 0;  // [s]
  bool converged = false;
  std::string diverged;  // message of the engine; empty: it did not diverge
};
template <Of<ParityRun> T, class Visit>
void each_member(T& run, Visit&& visit) {
  visit("drag_n", run.drag);
  visit("momentum_deficit_n", run.momentum_deficit);
  visit("iterations", run.iterations);
  visit("wall_time_s", run.wall_time);
  visit("converged", run.converged);
  visit("diverged", run.diverged);
}

/// Differences of the built-in engine to OpenFOAM: drag relative, fields of the stream's
/// speed and dynamic pressure.
struct ParityRow {
  std::string canopy;
  ParityRun openfoam, builtin;
  double drag = 0, velocity = 0, pressure = 0;  // fields as root mean square over the cells
  double largest_velocity = 0, largest_pressure = 0;
  bool within = false;  // no engine diverged; drag within its tolerance, both fields within 1 %

  bool diverged() const { return !openfoam.diverged.empty() || !builtin.diverged.empty(); }
};
template <Of<ParityRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("canopy", row.canopy);
  visit("openfoam", row.openfoam);
  visit("builtin", row.builtin);
  visit("drag_difference", row.drag);
  visit("velocity_difference", row.velocity);
  visit("pressure_difference", row.pressure);
  visit("largest_velocity_difference", row.largest_velocity);
  visit("largest_pressure_difference", row.largest_pressure);
  visit("within", row.within);
}

/// Differences of two fields on one grid: fills the differences of velocity and pressure of the row.
void compare_fields(const FlowField& a, const FlowField& b, const Freestream& air, ParityRow& row);

struct ParityResult {
  std::array<int, 3> cells = {};
  int porous_cells = 0;
  double speed = 0, drag_tolerance = 0;
  std::vector<ParityRow> rows;
};
template <Of<ParityResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("cells", r.cells);
  visit("porous_cells", r.porous_cells);
  visit("speed_m_s", r.speed);
  visit("drag_tolerance", r.drag_tolerance);
  visit("canopies", r.rows);
}
std::string to_json(const ParityResult& result);

/// Either may be empty.
struct ParityEvents {
  std::function<void(const std::string& canopy, const std::string& engine, const FlowProgress&)> progress;
  std::function<void(const ParityResult& so_far)> row;  // first without one, then after each
};

/// The divergence of an engine is recorded in its row. Throws Error(external) if OpenFOAM is missing.
ParityResult flow_parity(const ParitySettings& settings, const ParityEvents& events = {});

}  // namespace ripstop::inline run
