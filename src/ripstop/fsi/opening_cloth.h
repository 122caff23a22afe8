// The cloth of an opening: folded, damped, with the reefing line of every stage.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/fsi/inflation_settings.h"
#include "ripstop/fsi/opening_record.h"
#include "ripstop/parachute/cluster.h"
#include "ripstop/parachute/fold.h"

namespace ripstop::inline fsi {

/// A line through rings at the joints of skirt and lines, until it is cut.
struct ReefingLine {
  double length = 0;  // [m]
  double cut = 0;     // [s]
  SpringLaw law;      // [N]
};

/// Lines, riser and tape get dampers C = `line_time` K_1 w / L0, the cloth's springs likewise with
/// `cloth_time`: Kelvin-Voigt solids whose loss does not depend on the mesh. Of the cloth's, half acts along
/// yarns between nodes two cells apart. Times in [s].
void damp_springs(Mesh& mesh, double line_time, double cloth_time);

/// A canopy of a cluster as it is cut, with its size over that of the largest one. Radius of the folded skirt, slack
/// and imperfection are so much smaller too.
struct SizedCanopy {
  CanopyMesh mesh;
  double ratio = 1;
};

class OpeningCloth {
 public:
  /// Throws Error(usage) for a folding or a reefing line that does not fit.
  /// `as_cut` is one canopy; with `cluster` there are several of them, whose risers end at one node. `sizes`: of each
  /// canopy of the cluster; empty: all of them are as `as_cut`.
  OpeningCloth(const CanopyMesh& as_cut, const InflationSettings& settings, std::vector<ReefingLine> reefing,
               int symmetry, bool linear, ThreadTeam& team, const std::optional<ClusterLayout>& cluster,
               const std::vector<SizedCanopy>& sizes = {});

  const CanopyMesh& mesh() const { return mesh_; }
  const FoldedStart& folded() const { return folded_; }
  /// By how much the dampers of the cloth are weaker than `cloth_damping_s`, so that they do not limit the time step.
  const ViscosityLimit& viscosity_limit() const { return viscosity_limit_; }
  /// One canopy, with its creases; of several sizes that of the first one.
  const CanopyMesh& one() const { return cluster_ ? cluster_->one() : mesh_; }
  /// Positions of the nodes of every canopy, of a cluster each in its own frame with the skirt on the axis.
  std::vector<std::vector<Vec3>> upright(const std::vector<Vec3>& x) const;
  /// Without reefing line.
  const Cloth& open() const { return *stages_.back(); }
  /// With the reefing line of the present stage.
  const Cloth& of_stage(const InflationState& state) const { return *stages_[state.cuts.size()]; }

  /// The cloth of canopy `k` of a cluster, which stays folded: it moves along the axis of the canopy only.
  std::vector<GuidedNode> guided_canopy(int k) const;

  /// The folded start with its imperfection, at rest.
  ClothState start() const;
  /// Of an imperfection, or of a start that folds with some strain [J].
  double elastic_energy_at_start() const { return elastic_at_start_; }
  /// Cuts the reefing lines that are due; the energy of a line goes with it. Returns whether one was cut.
  bool cut_due(InflationState& state) const;

 private:
  void join(const ClusterLayout& layout, const std::vector<SizedCanopy>& sizes,
            const InflationSettings& settings, int symmetry, ThreadTeam& team);
  void add_reefed_stages(const InflationSettings& settings, const ClothOptions& options);

  CanopyMesh mesh_;
  FoldedStart folded_;  // of all canopies
  std::optional<Cluster> cluster_;
  std::vector<int> joined_;  // nodes of the mesh, by nodes of the cluster
  ViscosityLimit viscosity_limit_;
  std::vector<ReefingLine> reefing_;  // in the order of their cuts
  std::vector<ClothPtr> stages_;      // the last without reefing line
  std::vector<Vec3> start_;
  double elastic_at_start_ = 0;
};

}  // namespace ripstop::inline fsi
