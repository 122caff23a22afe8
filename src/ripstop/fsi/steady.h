// The steady loop of [NFM] section 6: cloth equilibrium -> cut cells -> flow
// -> pressure on both sides -> next.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/core/members.h"
#include "ripstop/flow/flow.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/fsi/acceleration.h"
#include "ripstop/fsi/coupling_settings.h"
#include "ripstop/fsi/iteration.h"
#include "ripstop/fsi/sheet_transfer.h"
#include "ripstop/fsi/transfer.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop {

/// What a watch of the flow in time came to.
struct Watched {
  int steps = 0;
  double time = 0, start_up = 0;              // in all, and what of it was discarded [s]
  double drag = 0, error = 0, deviation = 0;  // mean, its standard error, standard deviation [N]
  Vec3 side_force, side_error;                // means across the stream and their standard errors [N]
  double side_deviation = 0;                  // root mean square of the side force about its mean [N]
  double swing = 0, swing_share = 0;  // strongest frequency of the side force [1/s], its part of the power
  bool enough = false;                // the standard error is what was asked for
};
template <Of<Watched> T, class Visit>
void each_member(T& w, Visit&& visit) {
  visit("steps", w.steps);
  visit("time_s", w.time);
  visit("start_up_s", w.start_up);
  visit("drag_n", w.drag);
  visit("standard_error_n", w.error);
  visit("deviation_n", w.deviation);
  visit("side_force_n", w.side_force);
  visit("side_force_error_n", w.side_error);
  visit("side_force_deviation_n", w.side_deviation);
  visit("swing_hz", w.swing);
  visit("swing_share", w.swing_share);
  visit("enough", w.enough);
}

/// Everything that the next iteration depends on beside the flow engine's
/// own memory: what a checkpoint holds.
struct SteadyState {
  std::vector<SteadyIteration> iterations;
  std::vector<Vec3> shape;       // X_k
  std::vector<double> pressure;  // difference applied in the next iteration, on every cell of cloth [Pa]
  RigidTraction remainder;       // applied beside it
  SidePressures sides;           // as the last flow gave them [Pa]
  std::vector<double> applied;   // difference that made `shape` [Pa]
  Accelerator accelerator;
  bool in_time = false;  // the flow is watched in time from the next iteration on
  Watched watched;       // the last one
  bool converged = false;
  double speed = 0;  // of the stream that this state is of, where a run seeks it; 0: that of the case [m/s]
  int speeds = 0;    // tried so far
};

template <Of<SteadyState> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("iterations", s.iterations);
  visit("shape", s.shape);
  visit("pressure", s.pressure);
  visit("remainder", s.remainder.at_centre);
  visit("remainder_twist", s.remainder.twist);
  visit("inside", s.sides.inside);
  visit("outside", s.sides.outside);
  visit("applied", s.applied);
  visit("update", s.accelerator.update);
  visit("relaxation", s.accelerator.relaxation);
  visit("memory", s.accelerator.memory);
  visit("guesses", s.accelerator.guesses);
  visit("residuals", s.accelerator.residuals);
  visit("aitken_factor", s.accelerator.aitken_factor);
  visit("in_time", s.in_time);
  visit("watched", s.watched);
  visit("converged", s.converged);
  visit("speed", s.speed);
  visit("speeds", s.speeds);
}

struct SteadyProblem {
  CanopyMesh mesh;   // start shape in the flow's frame
  FlowProblem flow;  // one PorousCells or one Sheet that has the resistance; where it is, is found here
  double reference_area = 0;  // S0 [m2]
  CouplingSettings settings;
  std::optional<Watch> watch;  // once shape and drag stand still, the flow is watched in time
};

enum class SteadyStage { cloth, flow, time };
/// Live progress within an iteration; flow values are those of the last SIMPLE iteration.
struct SteadyProgress {
  SteadyStage stage = SteadyStage::cloth;
  int iteration = 0;
  RelaxProgress cloth = {};
  FlowProgress flow = {};
  WatchProgress time = {};
};
using SteadyReport = std::function<void(const SteadyProgress&)>;

/// A flow need not be solved to its last digit while the shape still moves: it is left as soon as the drag
/// has settled, and once the coupling looks converged it is solved to its residual. It goes on from iteration
/// to iteration. With a watch, the loop goes on from there with the mean of the flow in time and its load.
class SteadySolver {
 public:
  /// Starts the flow; the engine must outlive the solver. Throws Error(usage) when the start shape does not fit
  /// into the box, and what FlowEngine::start() throws.
  SteadySolver(SteadyProblem problem, FlowEngine& engine);

  /// Uniform pressure of 1 q on the start shape.
  SteadyState start() const;
  /// One coupling iteration. Throws Error(not_converged) when the cloth finds no equilibrium, Error(external)
  /// or Error(diverged) from the flow. Returns the flow round the new
  /// shape.
  FlowField iterate(SteadyState& state, const SteadyReport& report = {});
  bool finished(const SteadyState& state) const;

  /// What a checkpoint saves and restores beside the state.
  Flow& flow() { return *flow_; }
  const Flow& flow() const { return *flow_; }
  const Cloth& cloth() const { return *cloth_; }
  const CanopyMesh& mesh() const { return problem_.mesh; }
  const std::vector<Cell>& cells() const { return cells_; }
  /// Of the last iteration, if that watched the flow in time.
  const FlowRecord& record() const { return record_; }
  /// The cloth's state at `state.shape`, at rest.
  ClothState cloth_state(const SteadyState& state) const;

 private:
  std::vector<Vec3> next_shape(const SteadyState& state, SteadyIteration& now, const SteadyReport& report);
  ClothLoad answer_of(const FlowField& field, const std::vector<Triangle>& surface,
                      const std::vector<int>& cut, const std::vector<Vec3>& shape, SteadyState& state,
                      SteadyIteration& now) const;
  FlowField solve_flow(const std::vector<Triangle>& surface, bool to_the_end, int iteration,
                       const SteadyReport& report);
  FlowField watch_flow(const std::vector<Triangle>& surface, bool to_the_end, SteadyState& state,
                       SteadyIteration& now, const SteadyReport& report);
  double lean_by_chance(const SteadyState& state) const;
  bool converged(const SteadyState& state, const SteadyIteration& now) const;
  void step(SteadyState& state, const ClothLoad& answer, double drag_change) const;

  SteadyProblem problem_;
  std::unique_ptr<Flow> flow_;
  ClothPtr cloth_;
  std::vector<Cell> cells_;
  std::vector<double> area_;  // of the cells as cut [m2]
  ThreadTeam team_;
  FlowRecord record_;
};

}  // namespace ripstop
