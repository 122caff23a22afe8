// The flow about a canopy that opens, stepped in time together with its cloth.
//
// Light cloth in heavy air: a load that is handed over after each step would throw the cloth farther than the air
// lets it go. So a predictor moves the cloth under its last load; the flow takes that motion and the compliance of
// the cloth to more load, and finds the drop across the cloth with both (a Robin condition; Banks, Henshaw and
// Schwendeman 2014, Fernandez, Mullaert and Vidrascu 2015); then the cloth is stepped under that drop.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/cloth/step_memory.h"
#include "ripstop/core/members.h"
#include "ripstop/flow/flow.h"
#include "ripstop/fsi/container.h"
#include "ripstop/fsi/flow_at_density.h"
#include "ripstop/fsi/payload.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop::inline fsi {

struct AirProblem {
  FlowProblem flow;  // the canopy, a sheet whose surface is left to the opening, then rigid bodies
  double courant = 0.5;
  std::shared_ptr<FlowEngine> engine = {};
  std::optional<Payload> payload = {};      // absent: the riser's end is held
  std::optional<Container> container = {};  // absent: the canopy is outside from the start
};

/// Values of the last step that the next one needs.
struct AirMemory {
  std::vector<double> pressure;  // Loads::cell_pressure of the last step [Pa]
  std::vector<Vec3> force;       // Loads::node_force of the last step, of the air [N]
  std::vector<Vec3>
      other;        // on the adjacent nodes: weight, inertia in an accelerating frame, drag of a payload [N]
  double work = 0;  // done by the part of the flow's load that is not pressure, so far [J]
  long long steps = 0;  // of the flow
  PayloadMotion flight;
  std::optional<ContainerMotion> container = {};  // of AirProblem::container
  double added_mass = 0;                          // of the canopy when it was last computed [kg]
};

template <Of<AirMemory> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("pressure", m.pressure);
  visit("force", m.force);
  visit("other_force", m.other);
  visit("work", m.work);
  visit("steps", m.steps);
  visit("speed", m.flight.speed);
  visit("acceleration", m.flight.acceleration);
  visit("path", m.flight.path);
  visit("angle", m.flight.angle);
  visit("fallen", m.flight.fallen);
  visit("container", m.container);
  visit("added_mass", m.added_mass);
}

/// One step of the flow.
struct AirRow {
  double time = 0;                          // its end [s]
  double length = 0;                        // [s]
  double courant = 0;                       // largest in the box
  double drag = 0, side_x = 0, side_y = 0;  // of the air on the canopy [N]
  double drag_area = 0;                     // drag over the stream's dynamic pressure, C_D S [m2]
  double speed = 0, path = 0;               // of the stream [m/s]; distance that the payload has flown [m]
  double angle = 0, fallen = 0;             // of its path below the horizon [deg], height lost [m]
  double momentum_gap = 0;                  // FlowStep::momentum_gap [N]
  double mass_defect = 0;                   // FlowStep::mass_defect
  double residual_traction = 0;             // residual_traction_share() of the load
  double added_mass = 0;                    // AirMemory::added_mass [kg]
  // These are no columns.
  std::vector<BodyLoad> bodies = {};  // on the rigid bodies, in their order
  double dynamic_pressure = 0;        // of the stream [Pa]
};

template <Of<AirRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("time_s", row.time);
  visit("step_s", row.length);
  visit("courant", row.courant);
  visit("drag_n", row.drag);
  visit("side_force_x_n", row.side_x);
  visit("side_force_y_n", row.side_y);
  visit("drag_area_m2", row.drag_area);
  visit("speed_m_s", row.speed);
  visit("path_m", row.path);
  visit("path_angle_deg", row.angle);
  visit("height_lost_m", row.fallen);
  visit("momentum_gap_n", row.momentum_gap);
  visit("mass_defect", row.mass_defect);
  visit("load_remainder", row.residual_traction);
  visit("added_mass_kg", row.added_mass);
}

/// External actions on air and masses in the box in one step of the flow, except those on each other. A box that
/// moves with V_b(t) sees the stream W - V_b, and masses in it feel g - dV_b/dt.
struct Surroundings {
  bool moves = false;        // false: the stream is that of the problem, and masses feel nothing
  Vec3 stream;               // at the end of the step [m/s]
  Vec3 gained;               // its acceleration [m/s2]
  Vec3 on_mass;              // force on a unit mass at rest in the box [m/s2]
  double density_ratio = 1;  // of the air to that at deployment
  int node = -1;             // on which `force` acts [N]; -1: none
  Vec3 force;
  std::vector<GuidedNode> guided = {};  // Loads::guided in the step
  std::vector<Placement> rigid = {};    // of the rigid bodies; empty: at rest in the box
};

/// Predicted motion of the cloth over one step of the flow.
struct ClothMotion {
  std::vector<Vec3> velocity;  // of every node, mean over the step [m/s]
  int steps = 1;               // of the cloth within it
};

/// Predictor: `steps` steps of the cloth, together of `length` [s], under `last_load`. The memory saves time in steps
/// from the same state.
ClothMotion predict_motion(const ClothState& state, const Cloth& cloth, const Loads& last_load, double length,
                           int steps, ThreadTeam& team, StepMemory& memory);

class CoupledFlow {
 public:
  /// Throws Error(usage) where the engine cannot step in time, the first body of the flow is no sheet or another one is
  /// not rigid, or the box has no room for the mesh as it is cut.
  /// `team` shares the work of projection and transfer; the results do not depend on it.
  CoupledFlow(const AirProblem& problem, const Mesh& mesh, ThreadTeam* team = nullptr);

  /// Largest length of the next step of the flow [s].
  double longest_step() { return flow_.longest_step(courant_); }
  /// The last step's load on the cloth, with the guided nodes of the present one.
  Loads last_load(const Surroundings& surroundings, const AirMemory& memory) const;
  /// One step about cloth that lies at `positions` at its beginning and moves as predicted. Throws Error(usage) where it
  /// touches a rigid body.
  FlowStep step(const std::vector<Vec3>& positions, const ClothMotion& predicted, double length,
                const Surroundings& surroundings, AirMemory& memory);
  /// The load of that step on the cloth at the same `positions`, which is the last load from now on. Sets
  /// `residual_traction` to its share of residual traction.
  Loads transfer(const std::vector<Vec3>& positions, const Surroundings& surroundings, AirMemory& memory,
                 double& residual_traction) const;

  /// Computes the canopy's added mass as it lies at `positions`; takes about as long as a step.
  void compute_added_mass(const std::vector<Vec3>& positions, double density_ratio, AirMemory& memory) const;

  double density() const { return flow_.density(); }  // in the last step [kg/m3]
  const FlowGrid& grid() const { return grid_; }
  const std::vector<Cell>& cells() const { return cells_; }

  /// Mass of the air of a cell on the axis over that of the lightest adjacent cloth, rho h / m.
  double heaviness() const;

  const Flow& flow() const { return flow_.at_deployment(); }
  void save(const std::filesystem::path& folder) const { flow_.at_deployment().save(folder); }
  void restore(const std::filesystem::path& folder) { flow_.at_deployment().restore(folder); }
  /// From a saved flow on other cells or with other boundaries: Flow::continue_from().
  void continue_from(const std::filesystem::path& folder) { flow_.at_deployment().continue_from(folder); }

 private:
  double cell_width() const;  // [m]
  SheetMotion sheet_motion(const std::vector<Vec3>& positions, const ClothMotion& predicted, double length,
                           const std::vector<GuidedNode>& guided, const AirMemory& memory) const;

  ThreadTeam* team_;
  std::shared_ptr<FlowEngine> engine_;
  FlowGrid grid_;
  double courant_, density_;       // the latter at deployment [kg/m3]
  std::vector<double> node_mass_;  // [kg]
  std::vector<Cell> cells_;
  std::vector<double> mass_;       // of every triangle of the surface, a unit area [kg/m2]
  std::vector<Triangle> surface_;  // of the last step
  std::vector<FlowBody> bodies_;   // the canopy without its surface, and the rigid ones
  FlowAtDensity flow_;
};

}  // namespace ripstop::inline fsi
