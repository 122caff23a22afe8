// The air: a box of cells with bodies in it, as a problem, and a flow that continues from its present state. Only
// surface and resistance of a body are used here.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ripstop/core/pressure_drop.h"
#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow_grid.h"
#include "ripstop/flow/jet.h"

namespace ripstop::inline flow {

/// The undisturbed air far from all bodies, [NFM] section 5. A jet, and boundaries other than the far field, need a
/// velocity along +z.
struct Freestream {
  Vec3 velocity;                        // [m/s]
  double density = 1.2;                 // [kg/m3]
  double viscosity = 1.84e-5;           // mu [Pa s]
  double temperature = 293.15;          // [K]; the static pressure follows from the density
  double turbulence_intensity = 0.005;  // [-]
  double viscosity_ratio = 10;          // nu_t / nu at the inlet [-]

  double speed() const { return norm(velocity); }  // U [m/s]
  Vec3 direction() const { return {velocity.x / speed(), velocity.y / speed(), velocity.z / speed()}; }
  bool along_z() const { return velocity.x == 0 && velocity.y == 0 && velocity.z > 0; }
  bool operator==(const Freestream&) const = default;
};

/// Throws Error(usage) for a speed of zero or above Mach 0.3.
void check_stream(const Freestream& air);

inline constexpr double gas_constant_of_air = 8314.47 / 28.9647;  // R [J/(kg K)]

struct Triangle {
  Vec3 a, b, c;
};

inline double surface_area(const std::vector<Triangle>& surface) {
  double area = 0;
  for (const Triangle& t : surface) area += 0.5 * norm(cross(t.b - t.a, t.c - t.a));
  return area;
}

/// Cells with the isotropic resistance -(mu d + rho |u| f / 2) u
/// per volume (`paper` model, method section 4).
struct PorousCells {
  std::vector<int> cells;  // sorted, unique
  double darcy = 0;        // d [1/m2]
  double forchheimer = 0;  // f [1/m]
};

/// Of a body that moves as a whole, in a time step of the flow.
struct RigidMotion {
  Vec3 velocity;  // of the point `about` [m/s]
  Vec3 spin;      // angular velocity [rad/s]
  Vec3 about;     // [m]

  Vec3 at(Vec3 point) const { return velocity + cross(spin, point - about); }
};

/// Motion of a sheet, triangle by triangle, during a time step of the flow: with `velocity` where `pressure`
/// is the drop across it, plus `yields` (compliance) along its normal for every additional pascal. Or that of a rigid
/// body.
struct SheetMotion {
  std::vector<Vec3> velocity;             // [m/s]; empty: at rest
  std::vector<double> yields;             // [m/(s Pa)]; empty: it moves as given, independent of the flow
  std::vector<double> pressure;           // inside over outside [Pa]; empty: none
  std::optional<RigidMotion> rigid = {};  // in place of the others
};

/// Of a rigid body without holes, practically: at 100 Pa the air passes at 0.1 mm/s.
inline constexpr PressureDrop impermeable{1e6, 0};

/// A body in the flow: a canopy, a screen, a payload. Its cloth resists either as a surface without thickness, across
/// which the pressure drops by a v + b v |v| with v the air's velocity along its normal, relative to the cloth ([NFM]
/// Eq. 15; `sheet` model, method section 4), or as porous cells.
struct FlowBody {
  std::string name;  // one of its own
  std::vector<Triangle> surface;
  std::variant<PressureDrop, PorousCells> resistance;
  SheetMotion motion = {};  // of a sheet
  Vec3 moment_about = {};   // the point that its moment is about [m]

  bool is_sheet() const { return std::holds_alternative<PressureDrop>(resistance); }
  const PressureDrop& drop() const { return std::get<PressureDrop>(resistance); }
  PressureDrop& drop() { return std::get<PressureDrop>(resistance); }
  const PorousCells& porous() const { return std::get<PorousCells>(resistance); }
  PorousCells& porous() { return std::get<PorousCells>(resistance); }
};
FlowBody sheet_body(std::vector<Triangle> surface, PressureDrop law, std::string name = "canopy");
FlowBody porous_body(PorousCells cells, std::string name = "canopy");

/// Loads of the air on a body.
struct BodyLoad {
  Vec3 force;   // [N]
  Vec3 moment;  // about FlowBody::moment_about [N m]
};

/// Loads of the air on a sheet at one face of the grid.
struct SheetLoad {
  int body = 0, triangle = 0;  // of FlowProblem::bodies
  Vec3 point;                  // on the triangle [m]
  Vec3 outward;                // mean normal of the sheet there, unit, as the triangles' corners turn
  double drop = 0;  // of the pressure from the sheet's inner side to its outer one, mean over the face [Pa]
  Vec3 force;       // on the sheet: drop times the face's area, along an axis of the grid [N]
  double cover =
      1;  // the part of the face that the sheet covers: drop / cover is the pressure drop of the cloth there
  double area = 0;  // of the sheet that the face represents, as far as it covers the face: a share n_a^2 [m2]
  /// Pressure on the sheet's own two sides, as far as the grid has air there: nothing on a side where another layer
  /// lies before the next centre [Pa].
  std::optional<double> inside, outside;
};

/// A kind of boundary for the four sides of the box, by its word; boundaries.h explains each word. The far field
/// applies to all six faces of the box, instead of inlet and outlet.
struct Sides {
  std::string_view word;
  bool operator==(const Sides&) const = default;
  static const Sides zero_gradient, slip, entraining, far_field;
};
inline constexpr Sides Sides::zero_gradient{"zero-gradient"}, Sides::slip{"slip"},
    Sides::entraining{"entraining"}, Sides::far_field{"far-field"};

/// The same for the end of the box.
struct Outlet {
  std::string_view word;
  bool operator==(const Outlet&) const = default;
  static const Outlet fixed_pressure, still_air;
};
inline constexpr Outlet Outlet::fixed_pressure{"fixed-pressure"}, Outlet::still_air{"still-air"};

/// When a flow counts as solved.
struct Stopping {
  double residual = 1e-5;  // on every equation
  int max_iterations = 1000;
  /// Without convergence after max_iterations, the result is the mean over the last so many of them; 0: the
  /// last iteration.
  int average_over = 0;
  int average_every = 1;  // iterations from one field of that mean to the next
  /// Enough, too, once the drag moved by less than this share of itself within `piece` iterations; 0: never.
  double settled_drag = 0;
  static constexpr int piece = 25;
  /// But not where the drag lies within the share `near` of `reference_drag` [N]; 0: there too.
  double reference_drag = 0, near = 0;
  /// The residual is not enough before drag_left() is below this share; 0: it is.
  double most_drag_left = 0;
  /// Nor before the momentum deficit of the box agrees with the drag within this share: until then the wake still
  /// grows or shrinks, and the drag may only turn. 0: it is.
  double momentum_gap = 0;
};

struct FlowProblem {
  FlowGrid grid;
  Freestream air;
  Sides sides = Sides::zero_gradient;  // the far field wherever the stream is not along +z
  Outlet outlet = Outlet::fixed_pressure;
  std::optional<Jet> jet;  // through the inlet, air.velocity the nozzle's; empty: the stream over all of it
  std::vector<FlowBody> bodies;
  std::vector<Vec3> body_force;  // on the air of each cell [N/m3]; empty: none
  Stopping stopping;
  /// Bodies, cells and stream are their own mirror images in the planes x = 0 and y = 0, and the flow is steady: a
  /// quarter of it is solved. Only where the engine's Abilities have it.
  bool quarter = false;

  bool has_sheets() const;
};
/// Throws Error(usage) for two bodies of one name, for a body that leaves the box other than through walls, and for
/// sheets that cut each other.
void check_bodies(const FlowProblem& problem);

/// One iteration as it comes; return false from the callback to stop early (the field counts as unconverged).
struct FlowProgress {
  int iteration = 0;
  double residual_u = 0, residual_p = 0, residual_k = 0, residual_omega = 0,
         residual_e = 0;  // u: largest of three
  double drag = 0;        // force along the stream on all bodies so far [N]
};
using FlowReport = std::function<bool(const FlowProgress&)>;
double largest_residual(const FlowProgress& progress);

/// Over the last iterations of a run that does not converge. Iterations are not time: the mean is that of the
/// limit cycle of the iteration, and the deviation is the size of the cycle.
struct FlowAverage {
  int iterations = 0;         // in the window; 0: nothing was averaged
  double drag_deviation = 0;  // standard deviation of the force along the stream [N]
};

struct FlowField {
  FlowGrid grid;
  std::vector<double> pressure;        // over the outlet's [Pa], one a cell
  std::vector<Vec3> velocity;          // [m/s]
  Vec3 porous_force;                   // by the fluid on all bodies [N]
  std::vector<BodyLoad> bodies;        // and on each of FlowProblem::bodies
  std::vector<SheetLoad> sheet_loads;  // their forces add up to the sheets' part of it
  Vec3 momentum_deficit;  // force from the fluxes through the faces of the box [N]; NaN: not known
  FlowProgress last;
  bool converged = false;
  double drag_left = 0;  // see drag_left() in steady.h; 0 for a mean in time
  FlowAverage average;   // where it has iterations, the fields and forces above are means over them
};

/// How far Flow::advance() came.
struct FlowAdvance {
  FlowProgress last;  // its iteration counts from 1 within the call
  bool converged = false;
  bool stopped = false;  // the report wanted no more
};

/// Where the viscosity of eddies that the cells do not resolve comes from, in time: none but the air's; the velocity's
/// gradient (WALE); the k-omega SST model with the sink of detached-eddy simulation.
enum class SmallEddies { none, wale, des };

/// One step in time as it comes.
struct FlowStep {
  int step = 0;                  // from 1, since the march began
  double time = 0;               // since then, at the end of the step [s]
  double length = 0;             // of the step [s]
  double courant = 0;            // largest Courant number of a cell, summed over the axes
  Vec3 force;                    // by the fluid on all bodies [N]
  std::vector<BodyLoad> bodies;  // and on each of FlowProblem::bodies
  /// Sum of force, change of the momentum of the box and fluxes through its faces; forces on the air are omitted, and
  /// across the axis the viscous stress on slip sides [N].
  Vec3 momentum_gap;
  double mass_defect = 0;  // mass that cells gain or lose, over the mass that the stream brings into the box
};
/// Return false to stop.
using StepReport = std::function<bool(const FlowStep&)>;

class FieldMean;

/// New position of one of the bodies of a flow, with its motion if it is a sheet.
struct Placement {
  std::size_t body = 0;  // of FlowProblem::bodies
  std::vector<Triangle> surface;
  SheetMotion motion = {};
};

/// A flow in progress. It continues from its present state, independent of earlier calls.
class Flow {
 public:
  virtual ~Flow() = default;

  /// New position of one of the bodies, with its motion if it is a sheet. The flow continues from its present state.
  virtual void place(std::size_t body, const std::vector<Triangle>& surface,
                     const SheetMotion& motion = {}) = 0;
  /// The same of several bodies.
  virtual void place_all(const std::vector<Placement>& bodies);
  /// At most so many iterations; fewer when every residual falls below `residual` or the report stops it.
  /// Throws Error(diverged) with iteration, field and place, Error(external) where a child program fails.
  virtual FlowAdvance advance(int iterations, double residual, const FlowReport& report = {}) = 0;
  /// So many steps in time of the flow as it is now, each as long as a Courant number of `courant` lets it be;
  /// fewer when the report stops it. Only where the engine's Abilities have time. Throws Error(diverged) as
  /// advance() does. Returns the last step.
  virtual FlowStep march(int steps, double courant, const StepReport& report = {});
  /// Largest length of the next time step for a Courant number of `courant` [s], and a step of this length or
  /// shorter, for callers that step a structure with the flow. Otherwise as march().
  virtual double longest_step(double courant);
  virtual FlowStep step(double length);
  /// Before a step in time: the undisturbed stream has this velocity at the end of the step [m/s]. `acceleration` is
  /// that of the stream in an accelerated frame, such as one that moves with a body in flight: a force on all of the
  /// air [m/s2]. Both remain for later steps. Throws Error(usage) for a jet, and where a velocity that is not along
  /// +z meets boundaries other than the far field.
  virtual void stream(Vec3 velocity, Vec3 acceleration);
  /// The last iteration's or step's.
  virtual FlowField field() const = 0;
  /// The same, as one more of those that a mean is over.
  virtual void add_to(FieldMean& mean) const;
  /// Loads on the sheets: FlowField::sheet_loads.
  virtual std::vector<SheetLoad> sheet_loads() const { return field().sheet_loads; }

  /// Whether nothing has happened yet: the uniform stream as the problem has it.
  virtual bool untouched() const = 0;
  /// A first field that is cheaper than iterations from the stream, if the engine provides one. Only for a
  /// flow before its first iteration.
  virtual void guess() {}
  /// Back to the uniform stream, the cloth where it is.
  virtual void start_afresh() = 0;

  /// Everything on which the next iteration depends: a restored flow continues as if it had never stopped, to
  /// the last bit. Throws Error(io).
  virtual void save(const std::filesystem::path& folder) const = 0;
  /// Of a problem with the same box, sides and outlet. A saved flow of different air is scaled to that of this
  /// problem if the engine can; else Error(usage). Error(bad_data) or Error(io) for data that save() did not write.
  virtual void restore(const std::filesystem::path& folder) = 0;
  /// The fields of a saved flow of the same bodies and air, interpolated to the cells of this one. Box, cells and
  /// boundaries may differ. On the same cells a flow in time keeps its rates too, so that only the boundaries differ.
  /// Throws as restore().
  virtual void continue_from(const std::filesystem::path& folder);
};

class FlowEngine {
 public:
  virtual ~FlowEngine() = default;
  virtual std::string name() const = 0;  // "OpenFOAM 1912"
  /// Throws Error(usage) or Error(bad_data) for a problem that no flow can have, or not this engine's. The
  /// engine must outlive its flows.
  virtual std::unique_ptr<Flow> start(const FlowProblem& problem) = 0;
};

/// On all bodies but the first, the canopy.
Vec3 force_on_others(const std::vector<BodyLoad>& bodies);

/// Those of one body.
std::vector<SheetLoad> loads_on(std::size_t body, std::vector<SheetLoad> loads);

/// Trilinear interpolation between cell centres, constant beyond the outermost ones.
double sample(const FlowGrid& grid, const std::vector<double>& field, Vec3 point);
Vec3 sample(const FlowGrid& grid, const std::vector<Vec3>& field, Vec3 point);

/// Cells that a surface cuts: those whose closed box shares at least a point with a triangle (separating
/// axes). Sorted and unique. Parts of the surface outside the grid cut nothing.
std::vector<int> cut_cells(const FlowGrid& grid, const std::vector<Triangle>& surface);

}  // namespace ripstop::inline flow
