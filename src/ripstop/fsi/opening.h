// The opening of a folded canopy: common part of uniform-pressure and coupled inflation.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ripstop/fsi/adaptive_stepper.h"
#include "ripstop/fsi/cluster_motion.h"
#include "ripstop/fsi/coupled_flow.h"
#include "ripstop/fsi/inflation_settings.h"
#include "ripstop/fsi/opening_cloth.h"
#include "ripstop/fsi/opening_record.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline fsi {

struct InflationProblem {
  CanopyMesh mesh;  // as cut; fold lines and line damping are applied by the solver
  InflationSettings settings;
  double pressure = 0;  // dp [Pa], without `air`
  bool linear = false;  // keep only K_1 of every law
  int threads = 0;
  int symmetry = 1;  // turns by 2 pi / symmetry map the parachute as cut onto itself
  std::optional<AirProblem> air = {};
  std::vector<ReefingLine> reefing = {};      // in the order of their cuts
  std::optional<ClusterLayout> cluster = {};  // `mesh` is one of its canopies, not yet joined
  std::vector<SizedCanopy> sizes = {};        // of each of its canopies; empty: all are as `mesh`
  std::vector<double> delays = {};            // of its canopies: they stay folded until then [s]; empty: 0
};

class Opening {
 public:
  virtual ~Opening() = default;

  virtual InflationState start() const;

  /// A run is `blocks()` blocks; every frame is a whole number of blocks, every block of rows.
  long long blocks() const { return static_cast<long long>(problem_.settings.frames) * blocks_per_frame_; }
  bool at_frame(const InflationState& state) const { return state.blocks % blocks_per_frame_ == 0; }
  int rows_per_block() const { return rows_per_block_; }
  double row_duration() const { return row_; }  // [s]

  /// One block; the steps of a coupled flow in it are added to `air_rows`. Throws Error(diverged).
  virtual std::vector<HistoryRow> advance(InflationState& state, std::vector<AirRow>* air_rows = nullptr) = 0;
  /// At the present state, whose highest stress it updates.
  virtual InflationFrame frame(InflationState& state) const;

  const CanopyMesh& mesh() const { return cloths_.mesh(); }
  /// Without reefing line.
  const Cloth& cloth() const { return cloths_.open(); }
  const FoldedStart& folded() const { return cloths_.folded(); }
  const ViscosityLimit& viscosity_limit() const { return cloths_.viscosity_limit(); }
  const InflationProblem& problem() const { return problem_; }
  /// The flow of a coupled opening; null under a uniform pressure.
  virtual CoupledFlow* air() const { return nullptr; }
  int threads() const { return team_.size(); }
  int canopies() const { return mesh().rigging.canopies; }
  /// Every canopy of a cluster at the present state.
  std::vector<CanopyRow> canopy_rows(const InflationState& state) const;
  std::vector<double> peak_tension_of_lines(const InflationState& state) const;  // [N]

 protected:
  /// Snapshots that the settings do not name are spread over `snapshot_span` [s]; the history has `least_rows` a
  /// second or more. Throws Error(usage) for a folding or a number that does not fit.
  Opening(InflationProblem problem, double snapshot_span, double least_rows, AdaptiveStepper::Step step);

  /// Counts the block, cuts reefing lines that are due and takes a snapshot. Returns whether a line was cut.
  bool end_block(InflationState& state) const;
  const Cloth& cloth_of(const InflationState& state) const { return cloths_.of_stage(state); }
  const OpeningCloth& cloths() const { return cloths_; }
  int blocks_per_frame() const { return blocks_per_frame_; }
  const AdaptiveStepper& stepper() const { return stepper_; }
  ThreadTeam& team() { return team_; }

 private:
  void take_snapshot(InflationState& state) const;

  InflationProblem problem_;
  ThreadTeam team_;
  OpeningCloth cloths_;
  int blocks_per_frame_ = 1, rows_per_block_ = 1;
  double row_ = 0;  // [s]
  AdaptiveStepper stepper_;
};

/// A CoupledOpening where the problem has `air`, else a UniformPressureOpening.
std::unique_ptr<Opening> make_opening(InflationProblem problem);

}  // namespace ripstop::inline fsi
