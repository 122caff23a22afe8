// The steady loop of [NFM] section 6: cloth equilibrium -> cut cells -> flow -> pressure on both sides ->
// next.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/coupling/acceleration.h"
#include "ripstop/coupling/settings.h"
#include "ripstop/coupling/sheet_transfer.h"
#include "ripstop/coupling/transfer.h"
#include "ripstop/flow/flow.h"

namespace ripstop {

/// What one coupling iteration says of itself. Forces are axial, along +z [N].
struct SteadyIteration {
  int iteration = 0;             // from 1
  double fluid_force = 0;        // of the fluid on the porous cells: the drag
  double nodal_load = 0;         // sum of the pressure loads on the cloth's nodes
  double line_tension = 0;       // of the cloth on its fixed end
  double momentum_deficit = 0;   // through the faces of the flow's box
  double transfer_factor = 0;    // fluid force over that of the pressures alone, as they came to the cloth
  double load_remainder = 0;     // remainder_share() of the load; 0 but for CanopyLoad::of_flow
  double drag_change = 0;        // relative to the iteration before; infinite at the first
  double shape_change = 0;       // e_k = mean |x^{k+1} - x^k| [m], [NFM] Eq. 18
  double omega = 0;              // |X_{k+1} - X_k| / |X_k|, [NFM] Eq. 19
  double printed_tolerance = 0;  // R dx^2 / (S0 K_max), what Eq. 19 asks of omega
  int cloth_steps = 0;
  double cloth_residual = 0;
  int flow_iterations = 0;
  double flow_residual = 0;     // largest of all equations
  bool flow_converged = false;  // to FlowProblem::residual
  int flow_averaged = 0;        // iterations of a flow that did not settle, whose mean stands; 0: none
  double drag_deviation = 0;    // standard deviation of the drag over them [N]
  int cut_cells = 0;
  double wall_time = 0;  // [s]
};

/// Everything that the next iteration depends on beside the flow engine's own memory: what a checkpoint
/// holds.
struct SteadyState {
  std::vector<SteadyIteration> iterations;
  std::vector<Vec3> shape;       // X_k
  std::vector<double> pressure;  // difference applied in the next iteration, on every cell of cloth [Pa]
  RigidTraction remainder;       // applied beside it
  SidePressures sides;           // as the last flow gave them [Pa]
  std::vector<double> applied;   // difference that made `shape` [Pa]
  Accelerator accelerator;
  bool converged = false;
};

struct SteadyProblem {
  Mesh mesh;         // start shape in the flow's frame
  FlowProblem flow;  // one PorousCells or one Sheet that has the resistance; where it is, is found here
  double reference_area = 0;  // S0 [m2]
  CouplingSettings settings;
};

enum class SteadyStage { cloth, flow };
/// Live progress within an iteration; flow values are those of the last SIMPLE iteration.
struct SteadyProgress {
  SteadyStage stage = SteadyStage::cloth;
  int iteration = 0;
  RelaxProgress cloth;
  FlowProgress flow;
};
using SteadyReport = std::function<void(const SteadyProgress&)>;

/// A flow need not be solved to its last digit while the shape still moves: it is left as soon as the drag
/// has settled, and once the coupling looks converged it is solved to FlowProblem::residual.
class SteadySolver {
 public:
  /// The engine must outlive the solver. Throws Error(usage) when the start shape does not fit into the box.
  SteadySolver(SteadyProblem problem, FlowEngine& engine);

  /// Uniform pressure of 1 q on the start shape.
  SteadyState start() const;
  /// One coupling iteration. Throws Error(not_converged) when the cloth finds no equilibrium, Error(external)
  /// or Error(diverged) from the flow. Returns the flow round the new
  /// shape.
  FlowField iterate(SteadyState& state, const SteadyReport& report = {});
  bool finished(const SteadyState& state) const;

  const Cloth& cloth() const { return *cloth_; }
  const Mesh& mesh() const { return problem_.mesh; }
  const std::vector<Cell>& cells() const { return cells_; }
  /// The cloth's state at `state.shape`, at rest.
  ClothState cloth_state(const SteadyState& state) const;

 private:
  ClothLoad answer_of(const FlowField& field, const std::vector<Triangle>& surface,
                      const std::vector<int>& cut, const std::vector<Vec3>& shape, SteadyState& state,
                      SteadyIteration& now) const;
  FlowField solve_flow(const std::vector<Triangle>& surface, const std::vector<int>& cut, bool to_the_end,
                       int iteration, const SteadyReport& report);

  SteadyProblem problem_;
  FlowEngine& engine_;
  ClothPtr cloth_;
  std::vector<Cell> cells_;
  std::vector<double> area_;  // of the cells as cut [m2]
  ThreadTeam team_;
};

}  // namespace ripstop
