#include "ripstop/cloth/relaxation_step.h"

#include <algorithm>

#include "ripstop/core/thread_team.h"

namespace ripstop::inline cloth {
namespace {

// t / (t + 3) of the velocity remains t steps after a stop, see relax.cpp.
double keep_after(int steps) {
  return steps / (steps + 3.0);
}

}  // namespace

RelaxationStep::RelaxationStep(const Cloth& cloth, Forces& forces, ClothState& state,
                               const FictitiousMasses& masses)
    : cloth_(cloth),
      forces_(forces),
      state_(state),
      row_sums_(cloth.row_count),
      irregular_sums_(forces.irregular_ranges()),
      workers_(forces.threads()) {
  set_masses(masses);
}

void RelaxationStep::set_masses(const FictitiousMasses& masses) {
  inverse_tensor_.assign(6 * static_cast<std::size_t>(cloth_.slots), 0.0);
  irregular_inverse_.resize(cloth_.irregular.size());
  if (!masses.freedom.empty()) irregular_freedom_.resize(cloth_.irregular.size());
  const auto tensor = [&](int slot) {
    return inverse_tensor_.data() + 6 * static_cast<std::size_t>(slot / lanes * lanes) + slot % lanes;
  };
  for (int node = 0; node < cloth_.mesh.node_count(); ++node)
    for (int i = 0; i < 6; ++i) tensor(cloth_.slot[node])[i * lanes] = masses.inverse[node][i];
  for (std::size_t k = 0; k < cloth_.irregular.size(); ++k) {
    irregular_inverse_[k] = masses.inverse[cloth_.irregular[k].node];
    if (!masses.freedom.empty()) irregular_freedom_[k] = masses.freedom[cloth_.irregular[k].node];
    for (int i = 0; i < 6; ++i) tensor(cloth_.irregular[k].slot)[i * lanes] = 0;
  }
}

void RelaxationStep::set_blocks(const Blocks* blocks) {
  blocks_ = blocks;
  if (!blocks) return;
  block_sums_.assign(3 * static_cast<std::size_t>(lanes) * blocks->chunk_count(), 0.0);
  moves_alone_.clear();
  for (const Cloth::IrregularNode& irregular : cloth_.irregular)
    moves_alone_.push_back(blocks->block_of(irregular.node) < 0);
  motion_force_.assign(3 * static_cast<std::size_t>(lanes) * blocks->motion_count(), 0.0);
  block_move_.assign(3 * static_cast<std::size_t>(blocks->padded()), 0.0);
  block_force_ = block_move_;
}

void RelaxationStep::move_rows(int rank) {
  const Pace pace = workers_[rank].pace;
  forces_.add_irregular_springs(rank, state_);
  forces_.add_fabric(rank, state_, [&](int row, const double* f) { move_row(row, f, pace); });
}

void RelaxationStep::move_irregular_nodes(int rank) {
  Worker& worker = workers_[rank];
  forces_.finish_fabric(rank, [&](int row, const double* f) { move_row(row, f, worker.pace); });
  forces_.for_irregular_nodes(rank, [&](int begin, int end, int range) {
    irregular_sums_[range] = move_irregular(begin, end, worker.pace);
  });
  worker.block_kick = worker.pace.kick;
  const double keep = keep_after(++worker.steps_since_stop);
  worker.pace = {0.5 * (1 + keep), keep};
}

void RelaxationStep::move_row(int row, const double* f, Pace pace) {
  const int first = cloth_.row_slot(row);
  row_sums_[row] = relax_row({cloth_.patches[cloth_.row_patch[row]].vectors, pace.kick, pace.keep,
                              inverse_tensor_.data() + 6 * static_cast<std::size_t>(first), f,
                              state_.x.data() + at(first), state_.v.data() + at(first)});
  if (blocks_) sum_row_blocks(row, f);
}

RowSums RelaxationStep::move_irregular(int begin, int end, Pace pace) {
  RowSums sums;
  for (int k = begin; k < end; ++k) {
    Symmetric inverse = irregular_inverse_[k];
    if (inverse[2] == 0) continue;
    for (double& component : inverse) component *= pace.kick;
    const int slot = cloth_.irregular[k].slot;
    Vec3 force = forces_.on_irregular(k);
    if (!irregular_freedom_.empty()) force = irregular_freedom_[k] * force;
    if (blocks_ && !moves_alone_[k]) {
      double* sum = block_sums_.data() + blocks_->sum_of_irregular(k);
      const Vec3 others =
          k < cloth_.irregular_of_row.back() ? Vec3{sum[0], sum[lanes], sum[2 * lanes]} : Vec3{};
      const Vec3 all = others + force;
      sum[0] = all.x, sum[lanes] = all.y, sum[2 * lanes] = all.z;
    }
    const Vec3 old = get(state_.v.data(), slot);
    const Vec3 now = pace.keep * old + inverse * force;
    sums.force_squared += dot(force, force);
    sums.power += dot(force, old + now);
    put(state_.v.data(), slot, now);
    put(state_.x.data(), slot, get(state_.x.data(), slot) + now);
  }
  return sums;
}

void RelaxationStep::sum_row_blocks(int row, const double* f) {
  const std::vector<int>& edges = blocks_->edges(row);
  sum_blocks({static_cast<int>(edges.size()) - 1, edges.data(),
              inverse_tensor_.data() + 6 * static_cast<std::size_t>(cloth_.row_slot(row)), f,
              block_sums_.data() + 3 * static_cast<std::size_t>(lanes) * blocks_->first_chunk(row)});
}

void RelaxationStep::gather_blocks(int rank) {
  blocks_->gather(block_sums_, motion_force_, block_force_, rank, static_cast<int>(workers_.size()));
}

void RelaxationStep::solve_blocks(int rank) {
  const int pair = 2 * lanes;
  const IndexRange pairs = part_of(blocks_->padded() / pair, rank, static_cast<int>(workers_.size()));
  multiply_blocks({blocks_->padded(), blocks_->inverse(), block_force_.data(), block_move_.data()},
                  pair * pairs.begin, pair * pairs.end);
}

double RelaxationStep::move_blocks(int rank) {
  Worker& worker = workers_[rank];
  const double kick = worker.block_kick;
  int last = -1;
  const IndexRange rows = forces_.rows(rank);
  for (int row = rows.begin; row < rows.end; ++row) {
    const std::vector<int>& edges = blocks_->edges(row);
    const int chunks = static_cast<int>(edges.size()) - 1, first = blocks_->first_chunk(row);
    if (blocks_->motion_of(first) != last) {
      last = blocks_->motion_of(first);
      worker.motion.resize(3 * static_cast<std::size_t>(lanes) * chunks);
      for (int c = 0; c < chunks; ++c)
        blocks_->spread(first + c, block_move_.data(), kick, worker.motion.data() + 3 * lanes * c);
    }
    const int slot = cloth_.row_slot(row);
    ripstop::move_blocks({chunks, edges.data(), inverse_tensor_.data() + 6 * static_cast<std::size_t>(slot),
                          worker.motion.data(), state_.x.data() + at(slot), state_.v.data() + at(slot)});
  }
  forces_.for_irregular_nodes(rank,
                              [&](int begin, int end, int) { move_irregular_with_blocks(begin, end, kick); });
  double power = 0;
  for (std::size_t i = 0; i < block_move_.size(); ++i) power += block_force_[i] * block_move_[i];
  return kick * power;
}

void RelaxationStep::move_irregular_with_blocks(int begin, int end, double kick) {
  const int padded = blocks_->padded();
  for (int k = begin; k < end; ++k) {
    if (moves_alone_[k]) continue;
    const int block = blocks_->block_of_sum(blocks_->sum_of_irregular(k));
    if (block < 0) continue;
    const double* y = block_move_.data() + block;
    const Vec3 u = kick * Vec3{y[0], y[padded], y[2 * padded]};
    const int slot = cloth_.irregular[k].slot;
    put(state_.v.data(), slot, get(state_.v.data(), slot) + u);
    put(state_.x.data(), slot, get(state_.x.data(), slot) + u);
  }
}

void RelaxationStep::stop(int rank) {
  Worker& worker = workers_[rank];
  worker.pace = {0.5, 0};
  worker.steps_since_stop = 0;
  const IndexRange rows = forces_.rows(rank);
  for (int row = rows.begin; row < rows.end; ++row)
    std::fill_n(state_.v.data() + at(cloth_.row_slot(row)),
                3 * cloth_.patches[cloth_.row_patch[row]].row_slots(), 0.0);
  if (rank + 1 < static_cast<int>(workers_.size())) return;
  for (std::size_t k = cloth_.irregular_of_row.back(); k < cloth_.irregular.size(); ++k)
    put(state_.v.data(), cloth_.irregular[k].slot, {});
}

RowSums RelaxationStep::sums() const {
  RowSums total;
  for (const auto* list : {&row_sums_, &irregular_sums_})
    for (const RowSums& sums : *list) {
      total.force_squared += sums.force_squared;
      total.power += sums.power;
    }
  return total;
}

}  // namespace ripstop::inline cloth
