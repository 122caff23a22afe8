// The steady loop of [NFM] section 6: equilibrium of the cloth under the present load -> its surface in the flow ->
// flow -> load on the cloth -> next.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/flow.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/fsi/convergence.h"
#include "ripstop/fsi/coupling_settings.h"
#include "ripstop/fsi/equilibrium.h"
#include "ripstop/fsi/load_model.h"
#include "ripstop/fsi/steady_state.h"
#include "ripstop/parachute/canopy_mesh.h"
#include "ripstop/parachute/cluster.h"

namespace ripstop::inline fsi {

struct SteadyProblem {
  CanopyMesh mesh;            // start shape in the frame of the flow
  FlowProblem flow;           // one body that has the resistance; the loop finds its surface
  double reference_area = 0;  // S0, of all canopies [m2]
  CouplingSettings settings;
  std::optional<Watch> averaging_window;  // once shape and drag have settled, the flow is averaged in time
  std::string full_box_because = {};      // why FlowProblem::quarter is not set; empty where it is
  std::optional<Cluster> cluster = {};    // `mesh` is that of its canopies
  bool own_mesh = false;                  // `mesh` is that of the user, S0 its cloth as cut
};

enum class SteadyStage { cloth, flow, time };
/// Live progress within an iteration; flow values are those of the last SIMPLE iteration.
struct SteadyProgress {
  SteadyStage stage = SteadyStage::cloth;
  int iteration = 0;
  RelaxProgress cloth = {};
  FlowProgress flow = {};
  WatchProgress time = {};
  bool coarse = false;  // of a start on coarser cells
};
using SteadyReport = std::function<void(const SteadyProgress&)>;

/// Canopies of a cluster whose cloth crosses the plane midway between two of them.
class ClusterTouches : public QuantityError {
 public:
  using QuantityError::QuantityError;
};

class SteadySolver {
 public:
  /// Starts the flow; the engine must outlive the solver. Throws Error(usage) when the start shape does not fit
  /// into the box, and the exceptions of FlowEngine::start().
  SteadySolver(SteadyProblem problem, FlowEngine& engine);

  /// Uniform pressure of 1 q on the start shape.
  SteadyState start() const;
  /// One iteration. Returns the flow about the new shape, which continues in the next one. Throws Error(not_converged)
  /// when the cloth finds no equilibrium, ClusterTouches, Error(external) or Error(diverged) from the flow.
  FlowField iterate(SteadyState& state, const SteadyReport& report = {});
  bool finished(const SteadyState& state) const;

  /// Data of a checkpoint in addition to the state.
  Flow& flow() { return *flow_; }
  const Flow& flow() const { return *flow_; }
  const Cloth& cloth() const { return *cloth_; }
  const CanopyMesh& mesh() const { return problem_.mesh; }
  /// Null for a single canopy.
  const Cluster* cluster() const { return problem_.cluster ? &*problem_.cluster : nullptr; }
  bool has_own_mesh() const { return problem_.own_mesh; }
  double reference_area() const { return problem_.reference_area; }  // S0, of all canopies [m2]
  /// Of the flow: the canopy, whose surface is that of the start, and rigid bodies.
  const std::vector<FlowBody>& bodies() const { return problem_.flow.bodies; }
  /// Why the whole box is solved, as a clause; empty: a quarter of it is.
  const std::string& full_box_because() const { return problem_.full_box_because; }
  const std::vector<Cell>& cells() const { return cells_; }
  /// Of the last iteration, if its flow was averaged in time.
  const FlowRecord& record() const { return record_; }
  /// The cloth's state at `state.shape`, at rest.
  ClothState cloth_state(const SteadyState& state) const { return cloth_at(*cloth_, state.shape); }

 private:
  Equilibrium solve_cloth(const SteadyState& state, const Loads& loads, SteadyIteration& now,
                          const SteadyReport& report);
  /// `shape`: of the cloth in this flow.
  FlowField advance_flow(SteadyState& state, const std::vector<Vec3>& shape, const SteadyIteration& now,
                         bool in_full, const SteadyReport& report);
  void enter_first_estimate(SteadyState& state, const std::vector<Vec3>& shape,
                            const FlowProgress& progress) const;
  double printed_tolerance(double flow_residual) const;

  SteadyProblem problem_;
  std::unique_ptr<Flow> flow_;
  ClothPtr cloth_;
  std::vector<ClothPtr> canopies_;  // the cloth of each canopy of a cluster, or of one if they are equal
  std::vector<Cell> cells_;
  std::vector<double> area_;  // of the cells as cut [m2]
  SteadyConvergence convergence_;
  ThreadTeam team_;
  FlowRecord record_;
};

}  // namespace ripstop::inline fsi
