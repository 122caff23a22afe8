#include "ripstop/cloth/blocks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "ripstop/mesh/each_spring.h"

namespace ripstop::inline cloth {
namespace {

// Of cloth: their matrix is multiplied in every step and costs a tenth of it.
constexpr double most_blocks = 300, nodes_a_block = 40;
constexpr int loose_nodes = 3;       // of a line, that move together
constexpr double growth = 1.15;      // of C's diagonal, before it is inverted anew
constexpr double ridge = 1e-6;       // part of C's diagonal that fixes blocks without any connection
constexpr int columns_at_once = 32;  // of the inverse

double mean_length(const Patch& patch, Direction direction) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < patch.width[direction].size(); ++i)
    if (patch.width[direction][i] > 0) sum += patch.rest_length[direction][i], ++count;
  return count > 0 ? sum / count : 0;
}

double block_size(const Mesh& mesh) {
  double area = 0;
  for (const Patch& patch : mesh.patches)
    area += std::accumulate(patch.cell_area.begin(), patch.cell_area.end(), 0.0);
  if (!(area > 0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(area / std::min(most_blocks, mesh.node_count() / nodes_a_block));
}

/// Rounded, from 1 to `most`.
int whole_blocks(double count, int most) {
  return count > 1 ? static_cast<int>(std::round(std::min(count, double(most)))) : 1;
}

/// Columns after which the springs outside the lattice repeat: those of a gore. All columns where they do not.
int period(const Patch& patch, const std::vector<char>& joined) {
  const auto repeats = [&](int columns) {
    for (int row = 0; row < patch.rows; ++row)
      for (int column = 0; column < patch.columns; ++column)
        if (joined[patch.node(row, column)] != joined[patch.node(row, (column + columns) % patch.columns)])
          return false;
    return true;
  };
  if (patch.periodic)
    for (int columns = 2; columns < patch.columns; ++columns)
      if (patch.columns % columns == 0 && repeats(columns)) return columns;
  return patch.columns;
}

/// Block of every column, some `wanted` in all. Blocks are alike in every gore and mirrored about its edge and its
/// middle, which preserves symmetry.
std::vector<int> blocks_of_columns(const Patch& patch, const std::vector<char>& joined, double wanted) {
  const int gore = period(patch, joined), gores = patch.columns / gore;
  const int half = whole_blocks(0.5 * wanted / gores, std::max(1, gore / 4));
  std::vector<int> block;
  for (int column = 0; column < patch.columns; ++column) {
    if (!patch.periodic) {
      block.push_back((2 * column + 1) * half / patch.columns);
      continue;
    }
    // The nearest multiple of gore / (2 half); a value between two of them is assigned to the one nearer to
    // the edge of the gore.
    const int in_gore = column % gore, mirrored = std::min(in_gore, gore - in_gore);
    const int nearest = (4 * mirrored * half + gore - 1) / (2 * gore);
    const int own = 2 * in_gore <= gore ? nearest : 2 * half - nearest;
    block.push_back((column / gore * 2 * half + own) % (2 * half * gores));
  }
  return block;
}

}  // namespace

Blocks::Blocks(const Cloth& cloth, const std::vector<char>& restricted)
    : row_patch_(cloth.row_patch),
      sum_of_irregular_(cloth.irregular.size()),
      block_of_node_(cloth.mesh.node_count(), -1) {
  const Mesh& mesh = cloth.mesh;
  const double size = block_size(mesh);
  std::vector<char> joined(mesh.node_count(), 0);
  for (const Spring& spring : mesh.springs) joined[spring.a] = joined[spring.b] = 1;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    const Patch& patch = mesh.patches[p];
    add_patch(patch, cloth.patches[p],
              blocks_of_columns(patch, joined, patch.columns * mean_length(patch, along_row) / size),
              whole_blocks(patch.rows * mean_length(patch, along_column) / size, patch.rows));
  }
  for (int row = 0; row < cloth.row_count; ++row)
    for (int k = cloth.irregular_of_row[row]; k < cloth.irregular_of_row[row + 1]; ++k) {
      const int in_row = cloth.irregular[k].slot - cloth.row_slot(row), vector = in_row / lanes;
      const std::vector<int>& edge = edges(row);
      const int chunk =
          static_cast<int>(std::upper_bound(edge.begin(), edge.end(), vector) - edge.begin()) - 1;
      sum_of_irregular_[k] = 3 * lanes * (first_chunk(row) + chunk) + in_row % lanes;
    }
  add_loose(cloth);
  padded_ = (count_ + 2 * lanes - 1) / (2 * lanes) * (2 * lanes);

  for (int row = 0; row < cloth.row_count; ++row) {
    const int p = cloth.row_patch[row], r = cloth.patch_row(row);
    const PatchLayout& layout = cloth.patches[p];
    for (int c = 0; c + 1 < static_cast<int>(edges(row).size()); ++c)
      for (int vector = edges(row)[c]; vector < edges(row)[c + 1]; ++vector)
        for (int lane = 0; lane < lanes; ++lane) {
          const int column = lane * layout.vectors + vector;
          if (column < mesh.patches[p].columns)
            block_of_node_[mesh.patches[p].node(r, column)] =
                block_of_[lanes * motion_of_[first_chunk_[row] + c] + lane];
        }
  }
  for (int k = cloth.irregular_of_row.back(); k < static_cast<int>(cloth.irregular.size()); ++k)
    block_of_node_[cloth.irregular[k].node] = block_of_sum(sum_of_irregular_[k]);
  for (int node = 0; node < mesh.node_count(); ++node)
    if (cloth.is_fixed[node] || cloth.is_tied[node] || (!restricted.empty() && restricted[node]))
      block_of_node_[node] = -1;
  list_crossings(cloth);
}

void Blocks::add_patch(const Patch& patch, const PatchLayout& layout, const std::vector<int>& block_of_column,
                       int up) {
  std::vector<int>& edges = edges_.emplace_back();
  const auto block_at = [&](int lane, int vector) {
    const int column = lane * layout.vectors + vector;
    return column < patch.columns ? block_of_column[column] : -1;
  };
  for (int vector = 0; vector < layout.vectors; ++vector) {
    bool begins = vector == 0;
    for (int lane = 0; lane < lanes && !begins; ++lane)
      begins = block_at(lane, vector) >= 0 && block_at(lane, vector) != block_at(lane, vector - 1);
    if (begins) edges.push_back(vector);
  }
  const int chunks = static_cast<int>(edges.size()), motions = motion_count();
  const int around = 1 + *std::max_element(block_of_column.begin(), block_of_column.end());
  for (int row = 0; row < patch.rows; ++row) {
    const int b = row * up / patch.rows, motion = motions + chunks * b, block = count_ + around * b;
    first_chunk_.push_back(chunk_count());
    if (groups_.empty() || groups_.back().motions.begin < motion)
      groups_.push_back({{chunk_count(), 0}, {motion, motion + chunks}, {block, block + around}});
    for (int c = 0; c < chunks; ++c) motion_of_.push_back(motion + c);
    groups_.back().chunks.end = chunk_count();
  }
  for (int b = 0; b < up; ++b)
    for (int c = 0; c < chunks; ++c)
      for (int lane = 0; lane < lanes; ++lane) {
        const int block = block_at(lane, edges[c]);
        block_of_.push_back(block >= 0 ? count_ + around * b + block : -1);
      }
  edges.push_back(layout.vectors);
  count_ += up * around;
}

// Nodes outside patches: so many in a row that are joined to each other, as along a line.
void Blocks::add_loose(const Cloth& cloth) {
  std::set<std::pair<int, int>> joined;
  for (const Spring& spring : cloth.mesh.springs) joined.insert(std::minmax(spring.a, spring.b));
  const int first_loose = cloth.irregular_of_row.back(), first = chunk_count();
  std::vector<std::pair<int, int>> by_node;
  for (int k = first_loose; k < static_cast<int>(cloth.irregular.size()); ++k) {
    if ((k - first_loose) % lanes == 0) {
      motion_of_.push_back(motion_count());
      block_of_.insert(block_of_.end(), lanes, -1);
    }
    sum_of_irregular_[k] = 3 * lanes * (first + (k - first_loose) / lanes) + (k - first_loose) % lanes;
    by_node.emplace_back(cloth.irregular[k].node, k);
  }
  std::sort(by_node.begin(), by_node.end());
  int last = -1, in_block = 0;
  const int motions = groups_.empty() ? 0 : groups_.back().motions.end, blocks = count_;
  for (const auto& [node, k] : by_node) {
    if (cloth.is_fixed[node] || cloth.is_tied[node]) continue;
    if (last < 0 || in_block == loose_nodes || !joined.count({last, node})) ++count_, in_block = 0;
    const int sum = sum_of_irregular_[k];
    block_of_[lanes * motion_of_[sum / (3 * lanes)] + sum % (3 * lanes)] = count_ - 1;
    last = node, ++in_block;
  }
  groups_.push_back({{first, chunk_count()}, {motions, motion_count()}, {blocks, count_}});
}

void Blocks::list_crossings(const Cloth& cloth) {
  const Mesh& mesh = cloth.mesh;
  std::vector<int> tie_of(mesh.node_count(), -1);
  for (std::size_t t = 0; t < mesh.ties.size(); ++t) tie_of[mesh.ties[t].node] = static_cast<int>(t);
  // A tied end is shared out to its masters (Jensen).
  const auto each_block = [&](int node, const auto& visit) {
    if (tie_of[node] < 0) return visit(block_of_node_[node], 1.0);
    for (const Tie::Master& master : mesh.ties[tie_of[node]].masters)
      visit(block_of_node_[master.node], master.weight);
  };
  each_spring(mesh, [&](const SpringView& s) {
    each_block(s.a, [&](int a, double of_a) {
      each_block(s.b, [&](int b, double of_b) {
        if (a != b) crossings_.push_back({a, b, s.a, s.b, s.scale * of_a * of_b, s.rest_length, s.law});
      });
    });
  });
}

void Blocks::set_stiffness(const Cloth& cloth, const ClothState& state, const std::vector<double>& also,
                           double scale, ThreadTeam& team) {
  std::vector<double> stiffness(crossings_.size()), diagonal(count_, 0.0);
  team.run([&](int rank) {
    const IndexRange part = part_of(static_cast<int>(crossings_.size()), rank, team.size());
    for (int i = part.begin; i < part.end; ++i) {
      const Crossing& s = crossings_[i];
      const Vec3 d = get(state.x.data(), cloth.slot[s.node_b]) - get(state.x.data(), cloth.slot[s.node_a]);
      const double strain = norm(d) / s.rest_length - 1;
      const double tangent = std::max(s.law->coefficients[0], strain > 0 ? s.law->tangent(strain) : 0.0);
      stiffness[i] = s.scale * tangent / s.rest_length;
    }
  });
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    if (const int a = crossings_[i].a; a >= 0) diagonal[a] += stiffness[i];
    if (const int b = crossings_[i].b; b >= 0) diagonal[b] += stiffness[i];
  }
  for (std::size_t node = 0; node < also.size(); ++node)
    if (block_of_node_[node] >= 0) diagonal[block_of_node_[node]] += also[node];
  bool outgrown = diagonal_.empty();
  for (int i = 0; i < count_ && !outgrown; ++i) outgrown = diagonal[i] > growth * diagonal_[i];
  if (!outgrown) return;
  diagonal_ = diagonal;
  Eigen::MatrixXd c = Eigen::Map<Eigen::VectorXd>(diagonal.data(), count_).asDiagonal();
  for (std::size_t i = 0; i < crossings_.size(); ++i)
    if (const Crossing& s = crossings_[i]; s.a >= 0 && s.b >= 0)
      c(s.a, s.b) -= stiffness[i], c(s.b, s.a) -= stiffness[i];
  c.diagonal().array() += ridge * c.trace() / count_;
  const Eigen::LLT<Eigen::MatrixXd> factor(c);
  inverse_.assign(static_cast<std::size_t>(padded_) * padded_, 0.0);
  team.run([&](int rank) {  // so many columns at once, whatever the number of threads
    const IndexRange mine = part_of((count_ + columns_at_once - 1) / columns_at_once, rank, team.size());
    for (int first = columns_at_once * mine.begin; first < std::min(count_, columns_at_once * mine.end);
         first += columns_at_once) {
      const int columns = std::min(columns_at_once, count_ - first);
      const Eigen::MatrixXd inverse =
          factor.solve(Eigen::MatrixXd::Identity(count_, count_).middleCols(first, columns));
      for (int i = 0; i < count_; ++i)
        for (int j = 0; j < columns; ++j)
          inverse_[static_cast<std::size_t>(lanes) *
                       (static_cast<std::size_t>(i / lanes) * padded_ + first + j) +
                   i % lanes] = scale * inverse(i, j);
    }
  });
}

void Blocks::gather(const AlignedDoubles& sums, AlignedDoubles& of_motions, AlignedDoubles& r, int part,
                    int parts) const {
  constexpr int stride = 3 * lanes;
  const IndexRange mine = part_of(chunk_count(), part, parts);
  for (const Group& group : groups_) {
    if (group.chunks.begin < mine.begin || group.chunks.begin >= mine.end) continue;
    std::fill(of_motions.begin() + stride * group.motions.begin,
              of_motions.begin() + stride * group.motions.end, 0.0);
    for (int chunk = group.chunks.begin; chunk < group.chunks.end; ++chunk) {
      const double* sum = sums.data() + stride * static_cast<std::size_t>(chunk);
      double* of_motion = of_motions.data() + stride * static_cast<std::size_t>(motion_of_[chunk]);
      for (int i = 0; i < stride; ++i) of_motion[i] += sum[i];
    }
    for (int axis = 0; axis < 3; ++axis)
      std::fill(r.begin() + axis * padded_ + group.blocks.begin,
                r.begin() + axis * padded_ + group.blocks.end, 0.0);
    for (int at = lanes * group.motions.begin; at < lanes * group.motions.end; ++at) {
      if (block_of_[at] < 0) continue;
      const double* sum = of_motions.data() + stride * static_cast<std::size_t>(at / lanes) + at % lanes;
      for (int axis = 0; axis < 3; ++axis) r[axis * padded_ + block_of_[at]] += sum[axis * lanes];
    }
  }
}

void Blocks::spread(int chunk, const double* y, double kick, double* motion) const {
  const int* block = block_of_.data() + static_cast<std::size_t>(lanes) * motion_of_[chunk];
  for (int lane = 0; lane < lanes; ++lane)
    for (int axis = 0; axis < 3; ++axis)
      motion[axis * lanes + lane] = block[lane] >= 0 ? kick * y[axis * padded_ + block[lane]] : 0.0;
}

}  // namespace ripstop::inline cloth
