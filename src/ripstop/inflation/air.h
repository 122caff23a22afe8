// The air that a canopy opens in, stepped in time together with its cloth.
//
// Light cloth in heavy air: a load that is handed over after each step would throw the cloth farther than the
// air lets it go. So the air is told before its step how the cloth gives way, dt / m for every pascal beyond
// what it has carried, and finds the drop across it with that (a Robin condition; Banks, Henshaw and
// Schwendeman 2014, Fernandez, Mullaert and Vidrascu 2015). Then the cloth is stepped under that drop.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/core/members.h"
#include "ripstop/flow/flow.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop {

struct AirProblem {
  FlowProblem flow;  // one sheet, the canopy; its surface is left to the opening
  double courant = 0.5;
  std::shared_ptr<FlowEngine> engine;
};

/// What the next step of the air needs of the last one of the cloth, one a cell.
struct AirMemory {
  std::vector<Vec3> velocity, acceleration;  // mean over the step [m/s], and its change [m/s2]
  std::vector<double> pressure;              // that pressed in it [Pa]
  double work = 0;                           // done by what of the air's load is not pressure, so far [J]
  long long steps = 0;                       // of the air
};

template <Of<AirMemory> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("velocity", m.velocity);
  visit("acceleration", m.acceleration);
  visit("pressure", m.pressure);
  visit("work", m.work);
  visit("steps", m.steps);
}

/// One step of the air.
struct AirRow {
  double time = 0;                          // its end [s]
  double length = 0;                        // [s]
  double courant = 0;                       // largest in the box
  double drag = 0, side_x = 0, side_y = 0;  // of the air on the canopy [N]
  double drag_area = 0;                     // drag over the stream's dynamic pressure, C_D S [m2]
  double momentum_gap = 0;                  // FlowStep::momentum_gap [N]
  double mass_defect = 0;                   // FlowStep::mass_defect
  double remainder = 0;                     // remainder_share() of the load
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
  visit("momentum_gap_n", row.momentum_gap);
  visit("mass_defect", row.mass_defect);
  visit("load_remainder", row.remainder);
}

class OpeningAir {
 public:
  /// Throws Error(usage) where the engine has no time, the flow no single sheet, or the box no room for the
  /// mesh as it is cut.
  OpeningAir(const AirProblem& problem, const Mesh& mesh);

  /// The stream about cloth that is held, until it has passed it once.
  void settle(const std::vector<Vec3>& positions);
  /// That the next step of the air may have [s].
  double longest_step() { return flow_->longest_step(courant_); }
  /// One step of the air about cloth that lies at `positions` at its beginning: the load in it.
  Loads step(const std::vector<Vec3>& positions, double length, AirMemory& memory, AirRow& row);
  /// What the cloth did under that load.
  void moved(const std::vector<Vec3>& from, const std::vector<Vec3>& to, double length, const Loads& loads,
             AirMemory& memory) const;

  const Flow& flow() const { return *flow_; }
  void save(const std::filesystem::path& folder) const { flow_->save(folder); }
  void restore(const std::filesystem::path& folder) { flow_->restore(folder); }

 private:
  std::shared_ptr<FlowEngine> engine_;
  std::unique_ptr<Flow> flow_;
  FlowGrid grid_;
  double courant_, speed_, dynamic_pressure_;
  std::vector<Cell> cells_;
  std::vector<double> mass_;  // of every triangle of the surface, a unit area [kg/m2]
};

}  // namespace ripstop
