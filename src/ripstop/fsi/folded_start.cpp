#include "ripstop/fsi/folded_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "ripstop/cloth/cloth.h"
#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/parachute/fold_gores.h"
#include "ripstop/parachute/fold_sheet.h"
#include "ripstop/parachute/hang.h"

namespace ripstop::inline fsi {
namespace {

constexpr double bending_weight = 1e-3;
constexpr double strain_sought = 1e-4;
// A start with more strain is relaxed again, as cloth that wrinkles.
constexpr double strain_allowed = 1e-3;
// Of such cloth: the share of the stiffness that resists compression, and a strain that is never reached. With it the
// masses of the relaxation are those of cloth that moves fast across its threads. With equal masses in all directions
// the soft motions that fold a curved strip converge far more slowly.
constexpr double compression_weight = 0.5, buckling_strain = 0.5;
constexpr int steps_a_round = 2500, most_rounds = 24;
// After so many rounds the largest strain must have fallen to this share of its value.
constexpr int rounds_between_looks = 4;
constexpr double gain_wanted = 0.9;
constexpr double radius_tolerance = 0.01;
constexpr double largest_start_strain = 0.1;  // a result has its own, smaller limit

std::vector<int> pieces_of_cloth(const Mesh& mesh) {
  std::vector<int> piece(mesh.node_count(), -1);
  for (const Patch& patch : mesh.patches)
    std::fill_n(piece.begin() + patch.first_node, patch.rows * patch.columns, 0);
  return piece;
}

// The canopy without its supports: free lines and riser. All its springs are equally stiff, so that no part
// is favoured.
Mesh canopy_of(const CanopyMesh& mesh, const FoldedStart& folded, bool wrinkles) {
  Mesh canopy = with_creases(mesh, folded);
  const std::vector<int> piece = pieces_of_cloth(mesh);
  std::erase_if(canopy.springs, [&](const Spring& s) { return piece[s.a] < 0 || piece[s.b] < 0; });
  for (Patch& patch : canopy.patches) {
    for (int d = 0; d < direction_count; ++d) {
      const bool bends = d == bend_row || d == bend_column;
      patch.law[d] = {{bends ? bending_weight : 1.0}, 1.0};
      if (wrinkles)
        patch.law[d].compression = compression_weight, patch.law[d].buckling_strain = buckling_strain;
      for (std::size_t i = 0; i < patch.width[d].size(); ++i)
        if (patch.width[d][i] > 0) patch.width[d][i] = patch.rest_length[d][i];
    }
  }
  for (SpringLaw& law : canopy.laws) law = {{1.0}, law.compression};
  for (Spring& spring : canopy.springs) spring.scale = spring.rest_length;
  return canopy;
}

// Every node becomes the mean of the rotated and mirrored positions of its equivalent nodes.
void make_symmetric(const Mesh& mesh, int symmetry, std::vector<Vec3>& x) {
  const std::vector<Vec3> old = x;
  for (const Patch& patch : mesh.patches) {
    const int sector = patch.columns / symmetry;
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 0; column <= sector / 2; ++column) {
        Vec3 sum{};
        for (int k = 0; k < symmetry; ++k) {
          const double turn = -2 * std::numbers::pi * k / symmetry, c = std::cos(turn), s = std::sin(turn);
          const auto back = [&](Vec3 p) { return Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z}; };
          const Vec3 p = back(old[patch.node(row, (column + k * sector) % patch.columns)]);
          const Vec3 q = back(old[patch.node(row, (patch.columns - column + k * sector) % patch.columns)]);
          sum += p + Vec3{q.x, -q.y, q.z};
        }
        const Vec3 mean = (0.5 / symmetry) * sum;
        for (int k = 0; k < symmetry; ++k) {
          const double turn = 2 * std::numbers::pi * k / symmetry, c = std::cos(turn), s = std::sin(turn);
          const auto forth = [&](Vec3 p) { return Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z}; };
          x[patch.node(row, (column + k * sector) % patch.columns)] = forth(mean);
          x[patch.node(row, (patch.columns - column + k * sector) % patch.columns)] =
              forth({mean.x, -mean.y, mean.z});
        }
      }
    }
  }
}

// How well the cloth of a start fits: its largest strain, and the share of its edges that pierce other cloth.
struct Fit {
  double strain = 0, pierced = 0;

  bool is_clean() const { return strain <= strain_allowed && pierced == 0; }
  bool is_better_than(const Fit& other) const {
    if (is_clean() != other.is_clean()) return is_clean();
    return strain < other.strain && pierced <= other.pierced;
  }
};

// The zigzag of gores without strain, except where fold lines prevent it.
class GoreFolder {
 public:
  GoreFolder(const CanopyMesh& mesh, const Folding& folding, int symmetry, ThreadTeam& team)
      : mesh_(mesh),
        folding_(folding),
        folds_(folding.folds > 0 ? folding.folds : static_cast<int>(line_joints(mesh).size())),
        symmetry_(std::gcd(symmetry, folds_)),
        piece_(pieces_of_cloth(mesh)),
        team_(team) {}

  FoldedStart run() {
    if (mesh_.rigging.lines.empty())
      throw Error(ExitCode::bad_data, "a canopy without lines cannot be folded");
    check_folds(mesh_, folds_);
    FoldedStart start = of_radius(false);
    // Cloth that resists compression may buckle on its way from the zigzag. A second relaxation then remains in the
    // equilibrium of the buckled shape. Cloth that wrinkles from the beginning does not buckle there.
    if (const Fit fit = fit_of(start); !fit.is_clean()) {
      std::optional<FoldedStart> other = of_radius_that_wrinkles();
      if (other && fit_of(*other).is_better_than(fit)) start = std::move(*other);
    }
    hang_up(start);
    return start;
  }

 private:
  double off(const FoldedStart& start) const {
    return std::abs(0.5 * (start.inner_radius + start.outer_radius) / folding_.initial_radius - 1);
  }
  FoldedStart of_radius(bool wrinkles) const;
  /// Mean radius of the folded skirt of the zigzag [m]; infinite where its strips do not reach that far.
  double radius_of(double share) const;
  /// Absent where the correction of its radius is impossible, or the relaxation diverges.
  std::optional<FoldedStart> of_radius_that_wrinkles() const;
  Fit fit_of(const FoldedStart& start) const;
  double share_for(double radius) const;
  /// With `wrinkles` of cloth that wrinkles, else of such cloth only where strain remains.
  FoldedStart relaxed(double share, bool wrinkles) const;
  /// Returns the largest strain.
  double relax_rounds(FoldedStart& start, bool wrinkles) const;
  void hang_up(FoldedStart& start) const;
  void measure(FoldedStart& start) const;

  const CanopyMesh& mesh_;
  Folding folding_;
  int folds_, symmetry_;
  std::vector<int> piece_;
  ThreadTeam& team_;
};

double GoreFolder::radius_of(double share) const {
  try {
    const FoldedStart start = zigzag_of_gores(mesh_, folds_, share);
    return 0.5 * (start.inner_radius + start.outer_radius);
  } catch (const Error&) {
    return std::numeric_limits<double>::infinity();
  }
}

// The share of the seams' radius that the inner folds keep, for a zigzag whose folds at the skirt have the
// mean radius `radius`.
double GoreFolder::share_for(double radius) const {
  double low = least_inner_share, high = 1;
  if (const double least = radius_of(low); !(radius > least)) {
    throw QuantityError(
        ExitCode::usage,
        fmt::format(
            "radius of the folded skirt = {:.4g}: with {} folds the skirt folds to no less than {:.4g} m; "
            "more folds allow smaller radii",
            radius, folds_, least),
        {"radius of the folded skirt"});
  }
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (radius_of(middle) < radius ? low : high) = middle;
  }
  const double reached = radius_of(low);
  if (std::abs(reached / radius - 1) > radius_tolerance) {
    throw QuantityError(
        ExitCode::usage,
        fmt::format(
            "radius of the folded skirt = {:.4g}: with {} folds the skirt folds to no more than {:.4g} m, "
            "else its strips are too short",
            folding_.initial_radius, folds_, reached),
        {"radius of the folded skirt"});
  }
  return low;
}

void GoreFolder::measure(FoldedStart& start) const {
  const Patch& patch = mesh_.patches.front();
  const int strip = patch.columns / (2 * folds_);
  start.inner_radius = start.outer_radius = 0;
  for (int k = 0; k < 2 * folds_; ++k) {
    const Vec3 p = start.positions[patch.node(0, k * strip)];
    (k % 2 == 0 ? start.inner_radius : start.outer_radius) += std::hypot(p.x, p.y) / folds_;
  }
}

FoldedStart GoreFolder::relaxed(double share, bool wrinkles) const {
  FoldedStart start = zigzag_of_gores(mesh_, folds_, share);
  if (wrinkles || relax_rounds(start, false) > strain_allowed) relax_rounds(start, true);
  measure(start);
  return start;
}

FoldedStart GoreFolder::of_radius(bool wrinkles) const {
  FoldedStart start = relaxed(share_for(folding_.initial_radius), wrinkles);
  // The relaxation moves the outer folds a little. The zigzag has another radius, so that the relaxed shape has the
  // required one, or comes as near to it as the folds allow without strain.
  const double least = (1 + radius_tolerance) * radius_of(least_inner_share);
  const double moved = 0.5 * (start.inner_radius + start.outer_radius) - folding_.initial_radius;
  if (off(start) > radius_tolerance && folding_.initial_radius > least) {
    FoldedStart corrected = relaxed(share_for(std::max(folding_.initial_radius - moved, least)), wrinkles);
    if (fit_of(corrected).is_clean() || !fit_of(start).is_clean()) start = std::move(corrected);
  }
  return start;
}

std::optional<FoldedStart> GoreFolder::of_radius_that_wrinkles() const {
  try {
    return of_radius(true);
  } catch (const Error&) {
    return {};
  }
}

Fit GoreFolder::fit_of(const FoldedStart& start) const {
  return {start_strain(canopy_of(mesh_, start, false), start.positions).largest,
          pierced_share(mesh_, start.positions)};
}

double GoreFolder::relax_rounds(FoldedStart& start, bool wrinkles) const {
  Mesh canopy = canopy_of(mesh_, start, wrinkles);
  // Inner folds of the skirt stay where they are: the radius is given. All that are images of the first.
  const Patch& skirt = mesh_.patches.front();
  canopy.fixed.clear();
  for (int k = 0; k < symmetry_; ++k) canopy.fixed.push_back(skirt.node(0, k * (skirt.columns / symmetry_)));
  const ClothPtr cloth = make_cloth(canopy);
  ClothState state = start_state(*cloth);
  double before = std::numeric_limits<double>::infinity(), strain = before;
  for (int round = 0; round < most_rounds; ++round) {
    set_positions(state, *cloth, start.positions);
    relax(state, *cloth, {}, {1e-12, steps_a_round, 1.0}, team_);
    start.positions = positions(state, *cloth);
    make_symmetric(canopy, symmetry_, start.positions);
    strain = start_strain(canopy, start.positions).largest;
    if (strain < strain_sought) break;
    if (round % rounds_between_looks != 0) continue;
    if (strain > gain_wanted * before) break;
    before = strain;
  }
  return strain;
}

void GoreFolder::hang_up(FoldedStart& start) const {
  double by = std::numeric_limits<double>::infinity();
  const std::vector<LineLink> links = line_links(mesh_, piece_);
  for (const LineLink& link : links)
    by = std::min(by, free_way(link, mesh_, start.positions, folding_.slack));
  for (int node = 0; node < mesh_.node_count(); ++node)
    if (piece_[node] >= 0) start.positions[node].z += by;
  for (const LineLink& link : links) hang(link, start.positions);
}

}  // namespace

FoldedStart folded_start(const CanopyMesh& mesh, const Folding& folding, int symmetry, ThreadTeam& team) {
  if (is_flat_sheet(mesh)) return fold_sheet(mesh, folding);
  if (folds_without_strain(mesh)) return fold(mesh, folding);
  FoldedStart start = GoreFolder(mesh, folding, symmetry, team).run();
  const StartStrain strain = start_strain(with_creases(mesh, start), start.positions);
  if (strain.largest > largest_start_strain)
    throw QuantityError(
        ExitCode::usage,
        fmt::format(
            "the cloth of this canopy cannot be folded: the start would have a strain of {:.2g} % ({}), "
            "at most {:g} % is possible; change radius of the folded skirt or number of folds",
            100 * strain.largest, strain.part, 100 * largest_start_strain),
        {"radius of the folded skirt", "number of folds"});
  return start;
}

}  // namespace ripstop::inline fsi
