// What a flow engine is: a box of air, porous cells in it, one steady field out. Cloth is not known here.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow_grid.h"

namespace ripstop {

/// Air that comes in through z = 0 with speed U, [NFM] section 5.
struct Freestream {
  double speed = 0;                     // [m/s]
  double density = 1.2;                 // [kg/m3]
  double viscosity = 1.84e-5;           // mu [Pa s]
  double temperature = 293.15;          // [K]; the static pressure follows from the density
  double turbulence_intensity = 0.005;  // [-]
  double viscosity_ratio = 10;          // nu_t / nu at the inlet [-]

  bool operator==(const Freestream&) const = default;
};

/// Cells with the isotropic resistance -(mu d + rho |u| f / 2) u per volume (`paper` model, method section
/// 4).
struct PorousCells {
  std::vector<int> cells;  // sorted, unique
  double darcy = 0;        // d [1/m2]
  double forchheimer = 0;  // f [1/m]
};

struct Triangle {
  Vec3 a, b, c;
};

/// Cloth as a surface without thickness, across which the pressure drops by a v + b v |v| with v the velocity
/// along its normal ([NFM] Eq. 15; `sheet` model, method section 4).
struct Sheet {
  std::vector<Triangle> surface;
  double linear = 0;     // a [Pa s/m]
  double quadratic = 0;  // b [Pa s2/m2]
};

/// What the air does to a sheet at one face of the grid.
struct SheetLoad {
  int sheet = 0, triangle = 0;  // of FlowProblem::sheets
  Vec3 point;                   // on the triangle [m]
  Vec3 normal;      // of the triangle, with a component along the face's normal that is not negative
  double drop = 0;  // of the pressure along `normal`, mean over the face [Pa]
  Vec3 force;       // on the sheet: drop times the face's area, along an axis of the grid [N]
  double area = 0;  // of the sheet that the face stands for, as far as it covers the face: a share n_a^2 [m2]
};

/// The four sides of the box. Slip: walls without friction. Zero gradient: nothing changes across them, air
/// goes in and out as it does just inside. Entraining: the outlet's pressure where air leaves; where it comes
/// in, air of the stream at the stream's total pressure (built-in engine only).
enum class Sides { zero_gradient, slip, entraining };

struct FlowProblem {
  FlowGrid grid;
  Freestream air;
  std::vector<PorousCells> porous;  // one entry a cloth
  std::vector<Sheet> sheets;        // the same for the `sheet` model
  Sides sides = Sides::zero_gradient;
  std::vector<Vec3> body_force;  // on the air of each cell [N/m3]; empty: none (built-in engine only)
  double residual = 1e-5;        // on every equation
  int max_iterations = 1000;
  /// A run that ends unconverged after max_iterations returns the mean over its last so many iterations;
  /// 0: the last iteration (built-in engine only).
  int average_over = 0;
};

/// One SIMPLE iteration as it comes; return false from the callback to stop early (the field counts as
/// unconverged).
struct FlowProgress {
  int iteration = 0;
  double residual_u = 0, residual_p = 0, residual_k = 0, residual_omega = 0,
         residual_e = 0;  // u: largest of three
  double drag = 0;        // axial force on the porous cells so far [N]
};
using FlowReport = std::function<bool(const FlowProgress&)>;

/// Over the last iterations of a run that does not settle. Iterations are not time: the mean is that of the
/// iteration's limit cycle, and the deviation says how large the cycle is.
struct FlowAverage {
  int iterations = 0;                  // in the window; 0: nothing was averaged
  double drag = 0;                     // mean of porous_force.z [N]
  double drag_deviation = 0;           // standard deviation over the window [N]
  double drag_low = 0, drag_high = 0;  // [N]
};

struct FlowField {
  FlowGrid grid;
  std::vector<double> pressure;        // over the outlet's [Pa], one a cell
  std::vector<Vec3> velocity;          // [m/s]
  Vec3 porous_force;                   // by the fluid on the porous cells and sheets [N]
  std::vector<SheetLoad> sheet_loads;  // their forces add up to the sheets' part of it
  double momentum_deficit = 0;         // axial force from the fluxes through the faces of the box [N]
  FlowProgress last;
  bool converged = false;
  FlowAverage average;  // where it has iterations, the fields and forces above are means over them
};

/// An engine keeps its last field as the start of the next solve (warm start).
class FlowEngine {
 public:
  virtual ~FlowEngine() = default;
  virtual std::string name() const = 0;  // "OpenFOAM 1912 (rhoPorousSimpleFoam)"
  virtual FlowField solve(const FlowProblem& problem, const FlowReport& report) = 0;
  /// Writes what a later process needs for a byte-identical warm start; restore() reads it. Throws Error(io).
  virtual void save(const std::filesystem::path& folder) const = 0;
  virtual void restore(const std::filesystem::path& folder) = 0;
};

/// Trilinear interpolation between cell centres, constant beyond the outermost ones.
double sample(const FlowGrid& grid, const std::vector<double>& field, Vec3 point);
Vec3 sample(const FlowGrid& grid, const std::vector<Vec3>& field, Vec3 point);

/// Cells that a surface cuts: those whose closed box shares at least a point with a triangle (separating
/// axes). Sorted and unique. Parts of the surface outside the grid cut nothing.
std::vector<int> cut_cells(const FlowGrid& grid, const std::vector<Triangle>& surface);

}  // namespace ripstop
