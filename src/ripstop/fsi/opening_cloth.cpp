#include "ripstop/fsi/opening_cloth.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "ripstop/core/quantity_error.h"
#include "ripstop/fsi/folded_start.h"

namespace ripstop::inline fsi {
namespace {

// Share of the cloth's viscosity that acts along yarns between nodes two cells apart. For the same loss in a resolved
// wave it reduces the stable step by a quarter of the reduction between neighbours, and it resists folding at the
// scale of the grid. A wave of two cells is damped by the rest only.
constexpr double share_over_two_cells = 2.0 / 3;

/// The imperfection over the azimuth: one harmonic, or those from 1 to 8 at random azimuths with the same root mean
/// square.
class FoldWaves {
 public:
  /// The canopies of a cluster have different random azimuths.
  FoldWaves(const InflationSettings& settings, int canopy) : harmonic_(settings.imperfection_harmonic) {
    constexpr std::uint64_t to_next_canopy = 1u << 20;
    std::uint64_t state = static_cast<std::uint64_t>(settings.imperfection_seed) +
                          to_next_canopy * static_cast<unsigned>(canopy);
    for (int k = 0; settings.imperfection_seed > 0 && k < harmonics; ++k) {
      state += 0x9e3779b97f4a7c15u;  // splitmix64
      std::uint64_t z = state;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      phases_.push_back(2 * std::numbers::pi * static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53);
    }
  }
  double at(double azimuth) const {
    if (phases_.empty()) return std::cos(harmonic_ * azimuth);
    double sum = 0;
    for (int k = 0; k < harmonics; ++k) sum += std::cos((k + 1) * azimuth + phases_[k]);
    return sum / std::sqrt(double(harmonics));
  }

 private:
  static constexpr int harmonics = 8;
  int harmonic_;
  std::vector<double> phases_;
};

double required_radius(const InflationSettings& settings) {
  if (!settings.initial_radius_m) {
    throw QuantityError(
        ExitCode::usage,
        "radius of the folded skirt is not given; give for example a tenth of the nominal diameter",
        {"radius of the folded skirt"});
  }
  return *settings.initial_radius_m;
}

std::vector<Vec3> with_imperfection(const CanopyMesh& mesh, const FoldedStart& folded,
                                    const InflationSettings& s, int canopy) {
  std::vector<Vec3> x = folded.positions;
  if (s.imperfection_m == 0) return x;
  const FoldWaves waves(s, canopy);
  for (const Patch& patch : mesh.patches) {
    for (int i = patch.first_node; i < patch.first_node + patch.rows * patch.columns; ++i) {
      const double wave = waves.at(std::atan2(x[i].y, x[i].x));
      x[i] += (s.imperfection_m * wave / folded.outer_radius) * Vec3{x[i].x, x[i].y, 0};
    }
  }
  return x;
}

}  // namespace

void damp_springs(Mesh& mesh, double line_time, double cloth_time) {
  for (Spring& spring : mesh.springs) {
    const SpringLaw& law = mesh.laws[spring.law];
    spring.damping += line_time * law.tangent(0) * spring.scale / spring.rest_length;
  }
  if (cloth_time == 0) return;
  for (Patch& patch : mesh.patches) {
    for (const Direction d : {along_row, along_column})
      patch.viscosity[d] += (1 - share_over_two_cells) * cloth_time * patch.law[d].tangent(0);
    for (const Direction d : {shear_up, shear_down, bend_row, bend_column})
      patch.viscosity[d] += cloth_time * patch.law[d].tangent(0);
    // Two such springs cross every section, each with half the w / L0.
    patch.viscosity[bend_row] += 0.5 * share_over_two_cells * cloth_time * patch.law[along_row].tangent(0);
    patch.viscosity[bend_column] +=
        0.5 * share_over_two_cells * cloth_time * patch.law[along_column].tangent(0);
  }
}

OpeningCloth::OpeningCloth(const CanopyMesh& as_cut, const InflationSettings& s,
                           std::vector<ReefingLine> reefing, int symmetry, bool linear, ThreadTeam& team,
                           const std::optional<ClusterLayout>& cluster, const std::vector<SizedCanopy>& sizes)
    : folded_(folded_start(as_cut, {required_radius(s), s.folds, s.slack_m}, symmetry, team)),
      reefing_(std::move(reefing)) {
  mesh_ = with_creases(as_cut, folded_);
  if (cluster)
    join(*cluster, sizes, s, symmetry, team);
  else
    start_ = with_imperfection(mesh_, folded_, s, 0);
  const double cloth_damping = s.cloth_damping_s.value_or(0);
  damp_springs(mesh_, s.line_damping_s, cloth_damping);
  ClothOptions options{linear, s.damping_n_s_m3, s.quadratic_damping_n_s2_m4};
  if (s.contact_pa > 0) options.contact = ContactOptions{s.contact_pa, s.contact_friction, folded_.positions};
  if (cloth_damping > 0)
    viscosity_limit_ = limit_viscosity(mesh_, options, folded_.positions, s.cloth_damping_step_share);
  add_reefed_stages(s, options);
  stages_.push_back(make_cloth(mesh_, options));
  elastic_at_start_ = elastic_energy(open(), start());
}

void OpeningCloth::add_reefed_stages(const InflationSettings& settings, const ClothOptions& options) {
  Mesh reefed = mesh_;
  for (const ReefingLine& line : reefing_) {
    const double damping = settings.line_damping_s * line.law.tangent(0) / line.length;
    reefed.drawstring = Drawstring{line_joints(mesh_), line.length, line.law, damping};
    stages_.push_back(make_cloth(reefed, options));
  }
  if (reefing_.empty()) return;
  ClothState folded = start_state(*stages_.front());
  set_positions(folded, *stages_.front(), folded_.positions);
  const double needed = drawn_length(*stages_.front(), folded), length = reefing_.front().length;
  if (needed > length)
    throw QuantityError(
        ExitCode::usage,
        fmt::format("length of the first reefing line = {:g}: the circumference of the folded skirt, {:.4g} "
                    "m, exceeds the reefing line; use a smaller radius of the folded skirt",
                    length, needed),
        {"length of the first reefing line", "radius of the folded skirt"});
}

// Every canopy is folded about its own axis, and put at its place in the cluster.
void OpeningCloth::join(const ClusterLayout& layout, const std::vector<SizedCanopy>& sizes,
                        const InflationSettings& settings, int symmetry, ThreadTeam& team) {
  std::vector<CanopyMesh> meshes;
  std::vector<FoldedStart> starts;
  for (const auto& [mesh, ratio] : sizes) {
    const Folding folding{ratio * required_radius(settings), settings.folds, ratio * settings.slack_m};
    starts.push_back(ratio == 1 ? folded_ : folded_start(mesh, folding, symmetry, team));
    meshes.push_back(with_creases(mesh, starts.back()));
  }
  if (sizes.empty()) meshes.push_back(mesh_), starts.push_back(folded_);
  cluster_.emplace(std::move(meshes), layout);
  JoinedCluster joined = join_risers(cluster_->mesh());
  std::vector<Vec3> folded(joined.node.size()), start = folded;
  for (int k = 0; k < layout.canopies; ++k) {
    const std::size_t size = sizes.empty() ? 0 : static_cast<std::size_t>(k);
    InflationSettings own = settings;
    if (!sizes.empty()) own.imperfection_m *= sizes[size].ratio;
    cluster_->put(k, starts[size].positions, folded);
    cluster_->put(k, with_imperfection(cluster_->one(k), starts[size], own, k), start);
  }
  folded_.positions = joined.joined(folded);
  start_ = joined.joined(start);
  mesh_ = std::move(joined.mesh);
  joined_ = std::move(joined.node);
}

std::vector<std::vector<Vec3>> OpeningCloth::upright(const std::vector<Vec3>& x) const {
  if (!cluster_) return {x};
  std::vector<Vec3> all;
  for (const int node : joined_) all.push_back(x[node]);
  std::vector<std::vector<Vec3>> canopies;
  for (int k = 0; k < cluster_->canopies(); ++k)
    canopies.push_back(cluster_->upright(k, cluster_->own(k, all)));
  return canopies;
}

std::vector<GuidedNode> OpeningCloth::guided_canopy(int k) const {
  const CanopyMesh& canopy = cluster_->one(k);
  const std::size_t first = static_cast<std::size_t>(k) * canopy.start.size();
  std::vector<int> nodes;
  for (const Patch& patch : canopy.patches)
    for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node)
      nodes.push_back(joined_[first + static_cast<std::size_t>(node)]);
  return guided_along(cluster_->frame(k).z, nodes);
}

ClothState OpeningCloth::start() const {
  ClothState state = start_state(open());
  set_positions(state, open(), start_);
  return state;
}

bool OpeningCloth::cut_due(InflationState& state) const {
  const double now = state.cloth.time;
  const std::size_t before = state.cuts.size();
  while (state.cuts.size() < reefing_.size() && reefing_[state.cuts.size()].cut <= now * (1 + 1e-12)) {
    state.cut_energy += elastic_energy(of_stage(state), state.cloth);
    state.cuts.push_back(now);
    state.cut_energy -= elastic_energy(of_stage(state), state.cloth);
  }
  return state.cuts.size() > before;
}

}  // namespace ripstop::inline fsi
