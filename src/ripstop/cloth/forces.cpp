#include "ripstop/cloth/forces.h"

#include <cmath>

namespace ripstop::inline cloth {
namespace {

// Cost of an irregular node over that of a vector of the lattice (measured on Stratos IV, AVX-512).
constexpr double vectors_per_irregular_node = 0.25;

}  // namespace

Forces::Forces(const Cloth& cloth, const Loads& loads, bool damped, int threads)
    : cloth_(cloth),
      damped_(damped),
      damps_fabric_(damped && std::any_of(cloth.patches.begin(), cloth.patches.end(),
                                          [](const PatchLayout& patch) { return patch.damped; })),
      pressure_(compile_pressure(cloth, loads)),
      node_force_(compile_node_force(cloth, loads)),
      damper_power_(cloth.row_count, 0.0) {
  const int parts = static_cast<int>(cloth.rings.size());
  irregular_.assign(at(cloth.first_string_force + (parts + lanes) / lanes * lanes), 0.0);
  const int loose = static_cast<int>(cloth.irregular.size()) - cloth.irregular_of_row.back();
  loose_blocks_ = (loose + loose_block - 1) / loose_block;
  deal_rows(threads);
}

// Rows are dealt by their cost in the first phase, the longest: vectors and the forces on irregular nodes.
// The two rows of springs computed twice count for the thread above.
void Forces::deal_rows(int threads) {
  workers_.resize(threads);
  std::vector<double> cost_before(cloth_.row_count + 1, 0.0);
  for (int row = 0; row < cloth_.row_count; ++row)
    cost_before[row + 1] =
        cost_before[row] + cloth_.patches[cloth_.row_patch[row]].vectors +
        vectors_per_irregular_node * (cloth_.irregular_of_row[row + 1] - cloth_.irregular_of_row[row]);
  const auto edge = [&](int rank) {
    const double part = cost_before.back() * rank / threads;
    return static_cast<int>(std::lower_bound(cost_before.begin(), cost_before.end(), part) -
                            cost_before.begin());
  };
  for (int rank = 0; rank < threads; ++rank) {
    Worker& worker = workers_[rank];
    worker.begin_row = edge(rank);
    worker.end_row = rank + 1 == threads ? cloth_.row_count : edge(rank + 1);
    for (int p = 0; p < static_cast<int>(cloth_.patches.size()); ++p) {
      const PatchLayout& patch = cloth_.patches[p];
      const int begin = std::max(0, worker.begin_row - patch.first_row);
      const int end = std::min(patch.rows, worker.end_row - patch.first_row);
      if (begin >= end) continue;
      const Piece piece{p, begin, end, begin > 0, end < patch.rows};
      worker.pieces.push_back(piece);
      worker.row_doubles = std::max(worker.row_doubles, static_cast<std::size_t>(3 * patch.row_slots()));
      for (int row = begin; row < end; ++row)
        if (piece.waits(row)) worker.waiting.push_back(patch.first_row + row);
    }
    worker.buffer.assign((rows_in_turn + 1 + worker.waiting.size()) * worker.row_doubles, 0.0);
  }
}

void Forces::set_node_force(const std::vector<Vec3>& force) {
  node_force_ = compile_node_force(cloth_, {{}, force});
}

void Forces::regularise(double per_area, const AlignedDoubles& towards) {
  regular_shape_ = towards;
  regular_stiffness_.assign(towards.size(), 0.0);
  for (int node = 0; node < cloth_.mesh.node_count(); ++node) {
    const double k = per_area * cloth_.area[node];
    put(regular_stiffness_.data(), cloth_.slot[node], {k, k, k});
  }
}

void Forces::add_irregular_springs(int rank, const ClothState& state, const SpringRecord& record) {
  const IndexRange blocks = part_of(cloth_.springs.blocks, rank, threads());
  pull_springs({&cloth_.springs, state.x.data(), damped_ ? state.v.data() : nullptr,
                irregular_.data() + at(cloth_.first_spring_force), record},
               blocks.begin, blocks.end);
  if (rank != 0) return;
  if (!cloth_.rings.empty()) add_drawstring(state);
  for (std::size_t k = cloth_.irregular_of_row.back(); k < cloth_.irregular.size(); ++k)
    put(irregular_.data(), static_cast<int>(k),
        node_force_.empty() ? Vec3{} : get(node_force_.data(), cloth_.irregular[k].slot));
}

// One tension along all of a string that slides through its rings: with n the direction of a part,
//   e = sum l / L0 - 1,   T = law(e) + C d(sum l)/dt where e > 0,   T n on the ring at a part's beginning, -T n at its end.
void Forces::add_drawstring(const ClothState& state) {
  const Drawstring& string = *cloth_.mesh.drawstring;
  const std::size_t parts = cloth_.rings.size() - 1;
  const auto between = [&](const AlignedDoubles& vectors, std::size_t i) {
    return get(vectors.data(), cloth_.rings[i + 1]) - get(vectors.data(), cloth_.rings[i]);
  };
  double length = 0, rate = 0;
  for (std::size_t i = 0; i < parts; ++i) {
    const Vec3 d = between(state.x, i);
    const double part = norm(d);
    length += part;
    if (damped_ && part > 0) rate += dot(d, between(state.v, i)) / part;
  }
  const double strain = length / string.rest_length - 1;
  string_damper_ = strain > 0 ? string.damping * rate : 0.0;
  string_tension_ = string.law.tension(std::max(strain, 0.0)) + string_damper_;
  for (std::size_t i = 0; i < parts; ++i) {
    const Vec3 d = between(state.x, i);
    const double part = norm(d);
    const Vec3 n = part > 0 ? d / part : Vec3{};
    put(irregular_.data(), cloth_.first_string_force + static_cast<int>(i), string_tension_ * n);
  }
}

double* Forces::force_row(Worker& worker, const Piece& piece, int row) {
  if (row < piece.begin || row >= piece.end) return worker.others_row();
  if (!piece.waits(row)) return worker.buffer.data() + (row % rows_in_turn) * worker.row_doubles;
  const int number = cloth_.patches[piece.patch].first_row + row;
  const auto found = std::lower_bound(worker.waiting.begin(), worker.waiting.end(), number);
  return worker.others_row() + (1 + (found - worker.waiting.begin())) * worker.row_doubles;
}

/// Springs from a row to itself and the next two, pressure between it and the next. The power of the dampers [W].
double Forces::add_row_springs(Worker& worker, const Piece& piece, int row, const ClothState& state) {
  const PatchLayout& patch = cloth_.patches[piece.patch];
  const int stride = 3 * patch.row_slots();
  const std::size_t first = at(patch.first + patch.row_slots() * row);
  const bool damped = damped_ && patch.damped;
  const double* x = state.x.data() + first;
  const double* v = damped ? state.v.data() + first : nullptr;
  const bool pressed = !pressure_.empty() && row + 1 < patch.rows;
  return add_row_forces(
      {&patch, patch.springs(cloth_.lattice, row),
       pressed ? pressure_.data() + patch.first + patch.row_slots() * row : nullptr, x, x + stride,
       x + 2 * stride, v, damped ? v + stride : nullptr, damped ? v + 2 * stride : nullptr,
       damped ? patch.damper_share(cloth_.damper_shares, row) : nullptr, force_row(worker, piece, row),
       force_row(worker, piece, row + 1), force_row(worker, piece, row + 2)});
}

/// Ghosts return their force; then the forces on single nodes follow.
void Forces::complete_row(int row, const ClothState& state, double* f) {
  const PatchLayout& patch = cloth_.patches[cloth_.row_patch[row]];
  const int first = cloth_.row_slot(row);
  for (const PatchLayout::Copy& copy : patch.copies)
    for (int c = 0; c < 3; ++c) f[at(copy.source) + c * lanes] += f[at(copy.ghost) + c * lanes];
  if (!node_force_.empty()) add_row(3 * lanes * patch.vectors, node_force_.data() + at(first), f);
  if (!regular_shape_.empty()) {
    const double *stiffness = regular_stiffness_.data() + at(first),
                 *shape = regular_shape_.data() + at(first), *x = state.x.data() + at(first);
    for (int i = 0; i < 3 * lanes * patch.vectors; ++i) f[i] += stiffness[i] * (shape[i] - x[i]);
  }
  for (int k = cloth_.irregular_of_row[row]; k < cloth_.irregular_of_row[row + 1]; ++k)
    set_of_fabric(k, get(f, cloth_.irregular[k].slot - first));
}

void Forces::follow_masters(int rank, ClothState& state) const {
  const auto [begin, end] = rows(rank);
  for (double* vectors : {state.x.data(), state.v.data()})
    follow(cloth_, vectors, begin, end, rank + 1 == threads());
  mirror(cloth_, state.x.data(), begin, end);
  // Velocities of ghosts are read by the dampers of the lattice only.
  if (damps_fabric_) mirror(cloth_, state.v.data(), begin, end);
}

double Forces::damper_power_at(int rank, int row, const AlignedDoubles& positions,
                               const AlignedDoubles& velocities) {
  const PatchLayout& patch = cloth_.patches[cloth_.row_patch[row]];
  if (!patch.damped) return 0;
  double* const unwanted = workers_[rank].others_row();
  const int stride = 3 * patch.row_slots();
  const double *x = positions.data() + at(cloth_.row_slot(row)),
               *v = velocities.data() + at(cloth_.row_slot(row));
  return add_row_forces({&patch, patch.springs(cloth_.lattice, cloth_.patch_row(row)), nullptr, x, x + stride,
                         x + 2 * stride, v, v + stride, v + 2 * stride,
                         patch.damper_share(cloth_.damper_shares, cloth_.patch_row(row)), unwanted, unwanted,
                         unwanted});
}

}  // namespace ripstop::inline cloth
