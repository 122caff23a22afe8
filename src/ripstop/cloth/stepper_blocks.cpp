// The relaxation's second level: blocks move as a whole, after every node has moved by itself.
#include "ripstop/cloth/stepper.h"

namespace ripstop {

void Stepper::set_blocks(const Blocks* blocks) {
  blocks_ = blocks;
  if (!blocks) return;
  block_sums_.assign(3 * static_cast<std::size_t>(lanes) * blocks->chunk_count(), 0.0);
  kept_alone_.clear();
  for (const Cloth::Kept& kept : cloth_.kept) kept_alone_.push_back(blocks->block_of(kept.node) < 0);
  motion_force_.assign(3 * static_cast<std::size_t>(lanes) * blocks->motion_count(), 0.0);
  block_move_.assign(3 * static_cast<std::size_t>(blocks->padded()), 0.0);
  block_force_ = block_move_;
}

void Stepper::sum_row_blocks(int row, const double* f) {
  const std::vector<int>& edges = blocks_->edges(row);
  sum_blocks({static_cast<int>(edges.size()) - 1, edges.data(),
              inverse_tensor_.data() + 6 * static_cast<std::size_t>(cloth_.row_slot(row)), f,
              block_sums_.data() + 3 * static_cast<std::size_t>(lanes) * blocks_->first_chunk(row)});
}

void Stepper::gather_blocks(int rank) {
  blocks_->gather(block_sums_, motion_force_, block_force_, rank, static_cast<int>(workers_.size()));
}

void Stepper::solve_blocks(int rank) {
  const int pair = 2 * lanes;
  const IndexRange pairs = part_of(blocks_->padded() / pair, rank, static_cast<int>(workers_.size()));
  multiply_blocks({blocks_->padded(), blocks_->inverse(), block_force_.data(), block_move_.data()},
                  pair * pairs.begin, pair * pairs.end);
}

double Stepper::move_blocks(int rank) {
  Worker& worker = workers_[rank];
  const double kick = worker.block_kick;
  int last = -1;
  for (int row = worker.begin_row; row < worker.end_row; ++row) {
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
    move_kept_with_blocks(cloth_.kept_of_row[row], cloth_.kept_of_row[row + 1], kick);
  }
  const IndexRange blocks =
      part_of(static_cast<int>(loose_sums_.size()), rank, static_cast<int>(workers_.size()));
  const int loose = cloth_.kept_of_row.back(), all = static_cast<int>(cloth_.kept.size());
  move_kept_with_blocks(std::min(all, loose + blocks.begin * kept_block),
                        std::min(all, loose + blocks.end * kept_block), kick);
  double power = 0;
  for (std::size_t i = 0; i < block_move_.size(); ++i) power += block_force_[i] * block_move_[i];
  return kick * power;
}

void Stepper::move_kept_with_blocks(int begin, int end, double kick) {
  const int padded = blocks_->padded();
  for (int k = begin; k < end; ++k) {
    if (kept_alone_[k]) continue;
    const int block = blocks_->block_of_sum(blocks_->sum_of_kept(k));
    if (block < 0) continue;
    const double* y = block_move_.data() + block;
    const Vec3 u = kick * Vec3{y[0], y[padded], y[2 * padded]};
    const int slot = cloth_.kept[k].slot;
    put(state_.v.data(), slot, get(state_.v.data(), slot) + u);
    put(state_.x.data(), slot, get(state_.x.data(), slot) + u);
  }
}

}  // namespace ripstop
