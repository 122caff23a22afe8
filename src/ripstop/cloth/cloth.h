// The cloth: lumped masses, nonlinear springs, follower pressure, [NFM] section 2 as
// mended in docs/theory/cloth.md.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/aligned.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/core/vec3.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop::inline cloth {

/// Cloth does not pass through cloth (docs/theory/cloth.md): nodes of different places of it push each other apart.
struct ContactOptions {
  double pressure = 20e3;    // that would press two layers of nodes into one [Pa]
  double friction = 0.2;     // Coulomb's coefficient
  std::vector<Vec3> folded;  // by node [m]: nodes may be as close as they are here
};

struct ClothOptions {
  bool linear = false;           // keep only K_1 of every law
  double absolute_damping = 0;   // C_a per unit area of cloth [N s/m3]; force -C_a * area * v, [NFM] Eq. 20
  double quadratic_damping = 0;  // the same for -C area |v| v [N s2/m4]
  std::optional<ContactOptions> contact = {};  // of make_cloth(); relax() leaves it out
};

/// A node that explicit steps move along one axis only.
struct GuidedNode {
  int node = -1;
  Vec3 along{0, 0, 1};  // unit vector of the axis
};
/// All of them along the same axis.
std::vector<GuidedNode> guided_along(Vec3 axis, const std::vector<int>& nodes);

/// Pressure difference on every cell (inside minus outside, [Pa]; order of cells_of()), and
/// optional point forces.
struct Loads {
  std::vector<double> cell_pressure;
  std::vector<Vec3> node_force;         // empty, or one a node [N]
  std::vector<GuidedNode> guided = {};  // other nodes move freely
};

/// The compiled, immutable cloth: kernel layout, ties, masses. Shared by every state that is stepped over it.
struct Cloth;
struct ClothDeleter {
  void operator()(Cloth*) const;
};
using ClothPtr = std::unique_ptr<Cloth, ClothDeleter>;

/// Throws Error(bad_data) for a mesh that breaks its own rules (rest length <= 0,
/// mass <= 0, tie to a tied node).
ClothPtr make_cloth(const Mesh& mesh, const ClothOptions& options = {});

/// Positions and velocities in kernel layout. Copyable: a copy is a checkpoint.
struct ClothState {
  AlignedDoubles x, v;  // vector layout, see cloth/layout.h
  double time = 0;      // [s]
  long long steps = 0;
};

ClothState start_state(const Cloth& cloth);  // Mesh::start, at rest
void set_positions(ClothState& state, const Cloth& cloth, const std::vector<Vec3>& positions);
void set_velocities(ClothState& state, const Cloth& cloth, const std::vector<Vec3>& velocities);
std::vector<Vec3> positions(const ClothState& state, const Cloth& cloth);  // logical numbering
std::vector<Vec3> velocities(const ClothState& state, const Cloth& cloth);

struct StabilityLimit {
  double stable_step = 0;   // [s] semi-implicit Euler is stable below it: block Gershgorin, with damping
  double printed_step = 0;  // [s] Eq. 8/9 of [NFM], printed for comparison
  int node = -1;            // the node that sets it
  std::string part;         // "disk", "line 3", ...
};
/// With the tangent stiffness at the present strain.
StabilityLimit stability_limit(const Cloth& cloth, const ClothState& state);

/// Lowers Patch::viscosity_share, cell by cell, where the viscosity would reduce the stable step at `positions` below
/// `step_share` < 1 of its value without viscosity.
struct ViscosityLimit {
  double least_share = 1;    // of the viscosity, over all cells
  double reduced_cells = 0;  // their share of all
};
ViscosityLimit limit_viscosity(Mesh& mesh, const ClothOptions& options, const std::vector<Vec3>& positions,
                               double step_share);

/// Records of every step, made within the kernels; accumulated from call to call.
struct StepRecord {
  std::vector<Vec3> fixed_force;     // on the fixed nodes at the start of every step of the last call [N]
  std::vector<double> peak_tension;  // of every irregular spring over all steps, its damper included [N]
  std::vector<double> drawstring;    // its tension in every step of the last call, likewise [N]; empty: none
  double pressure_work = 0;          // [J]
  double damped = 0;                 // taken by absolute and relative damping [J]
};

/// `count` steps of semi-implicit Euler, [NFM] Eq. 6. Bit-identical for any team size, with a record or
/// without. Throws Error(diverged) with step, node, part and likely cause on NaN or runaway stretch.
void step(ClothState& state, const Cloth& cloth, const Loads& loads, double dt, int count, ThreadTeam& team,
          StepRecord* record = nullptr);

struct RelaxOptions {
  double tolerance = 1e-4;  // on |residual force| / |applied force|, both root sums of squares over the nodes
  int max_steps = 200000;
  double least_load = 0;      // [N] replaces the applied load if that is smaller: fixed ends pull, not loads
  double regularisation = 0;  // pulls every node towards its place at the start, by area of cloth [Pa/m]
};
struct RelaxProgress {
  int steps = 0;
  double residual = 0;  // as RelaxOptions::tolerance
  double kinetic_energy = 0;
};
struct RelaxResult {
  bool converged = false;
  int steps = 0;
  double residual = 0;
  /// Of the loads about the only held point [N m]: nothing but other loads can balance it, so it is left out
  /// of the residual. 0 for a cloth held at several points.
  double unbalanced_moment = 0;
  double regularisation_share =
      0;  // force of the regularisation at the end, norm over that of the applied force
  double mean_displacement = 0;  // e_k, [NFM] Eq. 18, over the whole relaxation [m]
};
/// Equilibrium under `loads` by dynamic relaxation with kinetic damping on fictitious masses (Barnes).
RelaxResult relax(ClothState& state, const Cloth& cloth, const Loads& loads, const RelaxOptions& options,
                  ThreadTeam& team, const std::function<void(const RelaxProgress&)>& report = {});

/// Taut cloth is pulled along both principal directions, wrinkled cloth along one, slack cloth along none: a second
/// force below 2 % of the first, a first one that would stretch a yarn by less than 1e-5.
enum class Tautness { slack, wrinkled, taut };

/// Membrane stress resultants of every cell, from the spring forces in virial form [N/m].
struct CellStress {
  double principal_max = 0, principal_min = 0, von_mises = 0;  // [N/m]
  Vec3 direction;                                              // of principal_max, unit, in the cell's plane
  double warp = 0, weft = 0;  // along the yarns, as a strip test has it [N/m]
  Tautness tautness = Tautness::slack;
  double max_strain = 0;  // largest spring strain at the cell [-]
};
std::vector<CellStress> cell_stress(const Cloth& cloth, const ClothState& state);

/// Tension of every irregular spring (Mesh::springs), T > 0 pulls [N].
std::vector<double> spring_tensions(const Cloth& cloth, const ClothState& state);

/// Force of the springs on every tied node (Mesh::ties), which it hands to its masters [N].
std::vector<Vec3> tie_forces(const Cloth& cloth, const ClothState& state);

struct ContactReport {
  int pairs = 0;       // of nodes that push each other
  double deepest = 0;  // largest 1 - r / d of a pair: 1 where nodes lie in one place
  double energy = 0;   // [J]
};
ContactReport contact_report(const Cloth& cloth, const ClothState& state);

/// Share of the edges of cells that pierce a cell elsewhere on the cloth, by the positions `x` alone. Cells within
/// three edges of each other at Mesh::start are not tested.
double pierced_share(const Mesh& mesh, const std::vector<Vec3>& x);

/// Length of the drawstring once round its rings [m]. The cloth has one.
double drawn_length(const Cloth& cloth, const ClothState& state);

/// Force that the cloth exerts on the fixed nodes, summed [N] (no damping, no loads).
Vec3 force_on_fixed(const Cloth& cloth, const ClothState& state);
/// The same for some of the fixed nodes, such as one clamp. Throws Error(bad_data) when one is not fixed.
Vec3 force_on(const Cloth& cloth, const ClothState& state, const std::vector<int>& fixed_nodes);
/// Sum of the pressure loads over all nodes at the present shape [N].
Vec3 pressure_force(const Cloth& cloth, const ClothState& state, const Loads& loads);

double elastic_energy(const Cloth& cloth, const ClothState& state);  // [J]
double kinetic_energy(const Cloth& cloth, const ClothState& state);  // [J]
Vec3 momentum(const Cloth& cloth, const ClothState& state);          // [kg m/s]

}  // namespace ripstop::inline cloth
