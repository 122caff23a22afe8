#include "ripstop/cloth/contact.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ripstop/cloth/layout.h"

namespace ripstop::inline cloth {
namespace {

constexpr double thickness = 0.75;         // d, in spacings
constexpr double neighbourhood = 3;        // in spacings
constexpr double skin = 0.5;               // of the lists, in spacings
constexpr int usual_contacts = 8;          // of a node
constexpr double kick_angle = 0.5;         // fastest times interval: below 2 up to 64 contacts of a node
constexpr int longest_kick = 16;           // in steps
constexpr int most_cells = 256;            // along an axis
constexpr double clearly_more = 1 + 1e-9;  // than rounding
constexpr double most_stopped = 1.0 / 16;  // of a pair's relative momentum in one kick

}  // namespace

ContactLayout contact_layout(const Mesh& mesh, const Cloth& cloth) {
  const ContactOptions& options = *cloth.options.contact;
  ContactLayout layout;
  layout.friction = options.friction;
  layout.stiffness_over_spacing = options.pressure / thickness;
  std::vector<double> area(mesh.node_count(), 0.0);
  std::vector<int> cell_count(mesh.node_count(), 0), index(mesh.node_count(), -1);
  std::vector<int> piece(mesh.node_count(), 0);
  std::size_t cell = 0;
  const std::vector<Cell> cells = cells_of(mesh);
  for (const Patch& patch : mesh.patches)
    for (const double cut : patch.cell_area) {
      const Cell& c = cells[cell++];
      if (c.corner[0] < 0) continue;
      for (const int node : c.corner) area[node] += cut, ++cell_count[node], piece[node] = patch.piece;
    }
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (cell_count[node] == 0) continue;
    const double spacing = std::sqrt(area[node] / cell_count[node]);
    index[node] = static_cast<int>(layout.slot.size());
    layout.slot.push_back(cloth.slot[node]);
    layout.spacing.push_back(spacing);
    layout.mass.push_back(mesh.mass[node]);
    layout.as_cut.push_back(mesh.start[node]);
    layout.piece.push_back(piece[node]);
    layout.folded.push_back(options.folded[node]);
    layout.largest_spacing = std::max(layout.largest_spacing, spacing);
    layout.fastest = std::max(layout.fastest, std::sqrt(usual_contacts * layout.stiffness_over_spacing *
                                                        spacing / mesh.mass[node]));
  }
  std::vector<std::vector<ContactLayout::Part>> parts(mesh.node_count());
  for (int node = 0; node < mesh.node_count(); ++node)
    if (index[node] >= 0 && !cloth.is_tied[node]) parts[node].push_back({index[node], 1.0});
  for (const Tie& tie : mesh.ties)
    if (index[tie.node] >= 0)
      for (const auto& master : tie.masters) parts[master.node].push_back({index[tie.node], master.weight});
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (parts[node].empty() || cloth.is_fixed[node]) continue;
    layout.mover_slot.push_back(cloth.slot[node]);
    layout.mover_inverse_mass.push_back(1 / cloth.total_mass[node]);
    layout.first_part.push_back(static_cast<int>(layout.parts.size()));
    layout.parts.insert(layout.parts.end(), parts[node].begin(), parts[node].end());
  }
  layout.first_part.push_back(static_cast<int>(layout.parts.size()));
  return layout;
}

Contact::Contact(const ContactLayout& layout, int threads)
    : layout_(layout),
      threads_(threads),
      skin_(skin * layout.largest_spacing),
      x_(layout.slot.size()),
      v_(x_.size()),
      listed_at_(x_.size()),
      force_(x_.size()),
      lossy_(x_.size()),
      moved_(threads),
      workers_(threads),
      lost_(layout.mover_slot.size()) {
  cells_.width = thickness * layout.largest_spacing + skin_;
}

void Contact::begin() {
  std::fill(lost_.begin(), lost_.end(), 0.0);
}

int Contact::steps_a_kick(double dt) const {
  return static_cast<int>(std::clamp(kick_angle / (layout_.fastest * dt), 1.0, double{longest_kick}));
}

void Contact::kick(int rank, ThreadTeam& team, ClothState& state, double interval) {
  gather(rank, state);
  team.barrier();
  if (rank == 0) sort_into_cells();
  team.barrier();
  list_pairs(rank);
  add_forces(rank, interval);
  team.barrier();
  move(rank, state, interval);
  team.barrier();
}

double Contact::damped() const {
  return std::accumulate(lost_.begin(), lost_.end(), 0.0);
}

ContactReport Contact::report(const ClothState& state) {
  gather(0, state);
  sort_into_cells();
  list_pairs(0);
  add_forces(0, 1);
  return workers_[0].report;
}

void Contact::gather(int rank, const ClothState& state) {
  moved_[rank] = 0;
  const IndexRange mine = range_of(rank);
  for (int i = mine.begin; i < mine.end; ++i) {
    x_[i] = get(state.x.data(), layout_.slot[i]);
    v_[i] = get(state.v.data(), layout_.slot[i]);
    const Vec3 d = x_[i] - listed_at_[i];
    moved_[rank] = std::max(moved_[rank], dot(d, d));
  }
}

// The list remains valid while two nodes have approached each other by the skin at most.
void Contact::sort_into_cells() {
  const double moved = *std::max_element(moved_.begin(), moved_.end());
  anew_ = !listed_ || !(moved < 0.25 * skin_ * skin_);
  if (!anew_ || x_.empty()) return;
  finite_ = std::all_of(x_.begin(), x_.end(), is_finite);
  listed_ = finite_;
  if (!finite_) return;
  listed_at_ = x_;
  Vec3 low = x_[0], high = x_[0];
  for (const Vec3 a : x_) {
    low = {std::min(low.x, a.x), std::min(low.y, a.y), std::min(low.z, a.z)};
    high = {std::max(high.x, a.x), std::max(high.y, a.y), std::max(high.z, a.z)};
  }
  const auto place = [&](double a, int axis) {
    return static_cast<int>(std::clamp(a / cells_.width, 0.0, double(cells_.size[axis] - 1)));
  };
  const Vec3 extent = high - low;
  cells_.size = {most_cells, most_cells, most_cells};
  cells_.size = {place(extent.x, 0) + 1, place(extent.y, 1) + 1, place(extent.z, 2) + 1};
  cells_.begin.assign(static_cast<std::size_t>(cells_.size[0]) * cells_.size[1] * cells_.size[2] + 1, 0);
  cells_.of.resize(x_.size());
  cells_.nodes.resize(x_.size());
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const Vec3 a = x_[i] - low;
    cells_.of[i] = (place(a.z, 2) * cells_.size[1] + place(a.y, 1)) * cells_.size[0] + place(a.x, 0);
    ++cells_.begin[cells_.of[i] + 1];
  }
  std::partial_sum(cells_.begin.begin(), cells_.begin.end(), cells_.begin.begin());
  std::vector<int> next(cells_.begin.begin(), cells_.begin.end() - 1);
  cells_.x.resize(x_.size());
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const int k = next[cells_.of[i]]++;
    cells_.nodes[k] = static_cast<int>(i), cells_.x[k] = x_[i];
  }
}

void Contact::list_pairs(int rank) {
  if (!anew_) return;
  std::vector<Pair>& pairs = workers_[rank].pairs;
  std::vector<int>& first = workers_[rank].first;
  pairs.clear();
  const IndexRange mine = range_of(rank);
  first.assign(finite_ ? 1 : mine.end - mine.begin + 1, 0);
  if (!finite_) return;
  const auto [nx, ny, nz] = cells_.size;
  for (int i = mine.begin; i < mine.end; ++i) {
    const int cx = cells_.of[i] % nx, cy = cells_.of[i] / nx % ny, cz = cells_.of[i] / nx / ny;
    const std::size_t before = pairs.size();
    for (int z = std::max(0, cz - 1); z <= std::min(nz - 1, cz + 1); ++z)
      for (int y = std::max(0, cy - 1); y <= std::min(ny - 1, cy + 1); ++y) {
        const int row = (z * ny + y) * nx;
        const int end = cells_.begin[row + std::min(nx - 1, cx + 1) + 1];
        for (int k = cells_.begin[row + std::max(0, cx - 1)]; k < end; ++k) {
          const Vec3 d = cells_.x[k] - x_[i];
          if (!(dot(d, d) < cells_.width * cells_.width)) continue;
          const int j = cells_.nodes[k];
          if (j == i) continue;
          const double spacing = 0.5 * (layout_.spacing[i] + layout_.spacing[j]);
          const Vec3 on_cloth = layout_.as_cut[j] - layout_.as_cut[i];
          if (layout_.piece[i] == layout_.piece[j] &&
              dot(on_cloth, on_cloth) < neighbourhood * neighbourhood * spacing * spacing)
            continue;
          const Vec3 folded = layout_.folded[j] - layout_.folded[i];
          const double usual = thickness * spacing, square = dot(folded, folded);
          const bool nearer = square < clearly_more * usual * usual;  // else no root is needed
          pairs.push_back({j, nearer ? std::min(usual, std::sqrt(square)) : usual,
                           layout_.stiffness_over_spacing * spacing});
        }
      }
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(before), pairs.end(),
              [](const Pair& a, const Pair& b) { return a.other < b.other; });
    first.push_back(static_cast<int>(pairs.size()));
  }
}

// Friction is Coulomb's, as long as it does not turn the slip round; a damper along the normal takes from a collision.
void Contact::add_forces(int rank, double interval) {
  const Worker& worker = workers_[rank];
  const IndexRange mine = range_of(rank);
  ContactReport report;
  int touching = 0;
  for (int i = mine.begin; i < mine.end; ++i) {
    Vec3 force, lossy;
    for (int p = worker.first[i - mine.begin]; p < worker.first[i - mine.begin + 1]; ++p) {
      const Pair& pair = worker.pairs[p];
      const Vec3 d = x_[i] - x_[pair.other];
      if (!(dot(d, d) < clearly_more * pair.wanted * pair.wanted)) continue;  // needs no root
      const double r = norm(d);
      if (!(r < pair.wanted) || r == 0) continue;
      const Vec3 normal = d / r;
      const double push = pair.stiffness * (pair.wanted - r);
      force += push * normal;
      ++touching;
      report.energy += 0.25 * push * (pair.wanted - r);  // the other half is the other node's
      report.deepest = std::max(report.deepest, 1 - r / pair.wanted);
      const Vec3 v = v_[i] - v_[pair.other], closing = dot(v, normal) * normal, slip = v - closing;
      const double damper = most_stopped * std::min(layout_.mass[i], layout_.mass[pair.other]) / interval;
      const double speed = norm(slip);
      if (speed > 0) lossy -= std::min(damper, layout_.friction * push / speed) * slip;
      lossy -= damper * closing;
    }
    force_[i] = force + lossy;
    lossy_[i] = lossy;
  }
  report.pairs = touching / 2;
  workers_[rank].report = report;
}

void Contact::move(int rank, ClothState& state, double interval) {
  const IndexRange mine = part_of(static_cast<int>(layout_.mover_slot.size()), rank, threads_);
  for (int m = mine.begin; m < mine.end; ++m) {
    Vec3 force, lossy;
    for (int p = layout_.first_part[m]; p < layout_.first_part[m + 1]; ++p) {
      const ContactLayout::Part& part = layout_.parts[p];
      force += part.weight * force_[part.index];
      lossy += part.weight * lossy_[part.index];
    }
    const Vec3 before = get(state.v.data(), layout_.mover_slot[m]);
    const Vec3 after = before + interval * layout_.mover_inverse_mass[m] * force;
    lost_[m] -= 0.5 * interval * dot(lossy, before + after);
    put(state.v.data(), layout_.mover_slot[m], after);
  }
}

ContactReport contact_report(const Cloth& cloth, const ClothState& state) {
  if (!cloth.contact) return {};
  return Contact(*cloth.contact, 1).report(state);
}

}  // namespace ripstop::inline cloth
