// Records of explicit steps: forces on fixed nodes, peak tensions, and the energy that pressure and dampers exchange
// with the cloth. Internal to cloth/.
#pragma once

#include <vector>

#include "ripstop/cloth/forces.h"

namespace ripstop::inline cloth {

class EnergyRecord {
 public:
  /// Of the `count` next steps of dt.
  EnergyRecord(StepRecord& record, const Cloth& cloth, Forces& forces, const ClothState& state, double dt,
               int count, ThreadTeam& team);
  void finish();

  /// Called by every rank in step n of count. Before velocities change other than by a step:
  void before_kick(int rank);
  void before_forces(int rank, int n);
  /// For Forces::add_irregular_springs(), and after it:
  SpringRecord springs();
  void add_drawstring(int rank);
  /// Force of the damping on irregular node k at velocity v.
  void add_damping(int k, Vec3 force, Vec3 v) { take(node_dampers_[k], force, v); }
  /// Once all forces are complete, before irregular nodes move.
  void add_fixed_force(int rank);
  /// Of a row: the dampers of its springs, and `power` of its damping [W].
  void add_row(int row, double power);
  /// After Forces::follow_masters() and a barrier; ends with one where it has read other ranks' nodes.
  void after_step(int rank, int n);

 private:
  // The dampers of irregular nodes and springs take F . (v + v') / 2 in a step. v' is known when the next step
  // begins: so half of F . v is added at once and the rest of the last step's F then.
  struct Damper {
    Vec3 force;
    double energy = 0;  // over dt [W]
  };
  static void take(Damper& damper, Vec3 force, Vec3 v);
  void close_dampers(int rank);
  void add_pressure_work(int rank);
  bool corrects_dampers(int n) const;
  void correct_dampers(int rank);
  template <class Work>
  void each_row(int rank, const Work& work) const;

  StepRecord& record_;
  const Cloth& cloth_;
  Forces& forces_;
  const ClothState& state_;
  double dt_;
  int count_;
  long long first_step_;
  ThreadTeam& team_;
  AlignedDoubles before_;                         // positions when the work was last added
  AlignedDoubles step_x_, step_v_, step_change_;  // before a step whose dampers are corrected, and of v in it
  std::vector<double> row_work_, row_damped_;     // [J], over dt [W]; by row
  std::vector<Damper> node_dampers_;              // by irregular node
  AlignedDoubles spring_damper_, spring_taken_, spring_peak_;  // likewise, see SpringRecord
  std::vector<Damper> string_dampers_;                         // of the drawstring's parts
  std::vector<int> fixed_;                                     // irregular nodes that are fixed
};

}  // namespace ripstop::inline cloth
