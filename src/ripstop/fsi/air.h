// The air that a canopy opens in, stepped in time together with its cloth.
//
// Light cloth in heavy air: a load that is handed over after each step would throw the cloth farther than the
// air lets it go. So the cloth is stepped tentatively under its last load; the air is told how it would move
// and how it gives way to more, finds the drop across it with that (a Robin condition; Banks, Henshaw and
// Schwendeman 2014, Fernandez, Mullaert and Vidrascu 2015), and the cloth is stepped under that drop.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/core/members.h"
#include "ripstop/flow/flow.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop {

/// What hangs at the riser's end and flies along the axis of the box, which turns with its path.
struct Payload {
  double mass = 0;       // [kg]
  double gravity = 0;    // [m/s2]
  double angle = 90;     // of its path below the horizon at deployment [deg]
  double drag_area = 0;  // its own [m2]
  /// Density so many metres below the place of deployment over that there; empty: the same.
  std::function<double(double)> density = {};
};

struct AirProblem {
  FlowProblem flow;  // one sheet, the canopy; its surface is left to the opening
  double courant = 0.5;
  std::shared_ptr<FlowEngine> engine = {};
  std::optional<Payload> payload = {};  // absent: the riser's end is held
};

/// What the next step needs of the last one.
struct AirMemory {
  std::vector<double> pressure;                  // Loads::cell_pressure of the last step [Pa]
  std::vector<Vec3> force;                       // Loads::node_force of the last step [N]
  double work = 0;                               // done by what of the air's load is not pressure, so far [J]
  long long steps = 0;                           // of the air
  double speed = 0, acceleration = 0, path = 0;  // of the payload [m/s], [m/s2], [m]
  double angle = 0, fallen = 0;                  // of its path below the horizon [rad], height lost [m]
  double added_mass = 0;                         // of the canopy when it was last looked at [kg]
};

template <Of<AirMemory> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("pressure", m.pressure);
  visit("force", m.force);
  visit("work", m.work);
  visit("steps", m.steps);
  visit("speed", m.speed);
  visit("acceleration", m.acceleration);
  visit("path", m.path);
  visit("angle", m.angle);
  visit("fallen", m.fallen);
  visit("added_mass", m.added_mass);
}

/// One step of the air.
struct AirRow {
  double time = 0;                          // its end [s]
  double length = 0;                        // [s]
  double courant = 0;                       // largest in the box
  double drag = 0, side_x = 0, side_y = 0;  // of the air on the canopy [N]
  double drag_area = 0;                     // drag over the stream's dynamic pressure, C_D S [m2]
  double speed = 0, path = 0;               // of the stream [m/s]; what the payload has flown [m]
  double angle = 0, fallen = 0;             // of its path below the horizon [deg], height lost [m]
  double momentum_gap = 0;                  // FlowStep::momentum_gap [N]
  double mass_defect = 0;                   // FlowStep::mass_defect
  double remainder = 0;                     // remainder_share() of the load
  double added_mass = 0;                    // AirMemory::added_mass [kg]
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
  visit("load_remainder", row.remainder);
  visit("added_mass_kg", row.added_mass);
}

/// How the cloth would go through a step of the air under the last load.
struct ClothMotion {
  std::vector<Vec3> velocity;  // of every node, in the mean over the step [m/s]
  int steps = 1;               // of the cloth, in which it is taken
};

class OpeningAir {
 public:
  /// Throws Error(usage) where the engine has no time, the flow no single sheet, or the box no room for the
  /// mesh as it is cut.
  OpeningAir(const AirProblem& problem, const Mesh& mesh);

  /// That the next step of the air may have [s].
  double longest_step() { return flow_->longest_step(courant_); }
  /// The last step's load on the cloth.
  Loads last_load(const AirMemory& memory) const;
  /// One step of the air about cloth that lies at `positions` at its beginning: the load in it.
  Loads step(const std::vector<Vec3>& positions, const ClothMotion& motion, double length, AirMemory& memory,
             AirRow& row);

  /// Takes the canopy's added mass as it lies at `positions`, about what a step costs.
  void weigh_air(const std::vector<Vec3>& positions, AirMemory& memory) const;

  /// With what the riser pulled at its end in that step, in the mean [N]: the payload flies on, its path turned
  /// by the weight across it.
  void fly(double pull, double length, AirMemory& memory) const;

  const Flow& flow() const { return *flow_; }
  void save(const std::filesystem::path& folder) const { flow_->save(folder); }
  void restore(const std::filesystem::path& folder) { flow_->restore(folder); }

 private:
  double pull_of_weight(double angle) const;         // along the path, a unit mass [m/s2]
  double brake(const AirMemory& memory) const;       // of the payload's own drag [m/s2]
  double thickening(const AirMemory& memory) const;  // Payload::density where it is

  std::shared_ptr<FlowEngine> engine_;
  std::unique_ptr<Flow> flow_;
  FlowGrid grid_;
  double courant_, speed_, density_;
  std::optional<Payload> payload_;
  std::vector<double> node_mass_;  // [kg]
  std::vector<Cell> cells_;
  std::vector<double> mass_;  // of every triangle of the surface, a unit area [kg/m2]
};

}  // namespace ripstop
