// What a step writes down: forces on fixed nodes, peaks, and where the energy goes.
#include <algorithm>
#include <cmath>

#include "ripstop/cloth/stepper.h"
#include "ripstop/core/thread_team.h"

namespace ripstop {

void Stepper::start_record(StepRecord& record) {
  record_ = &record;
  before_ = state_.x;
  row_work_.assign(cloth_.row_count, 0.0);
  row_damped_.assign(cloth_.row_count, 0.0);
  kept_dampers_.assign(cloth_.kept.size(), Damper{});
  string_dampers_.assign(cloth_.rings.size(), Damper{});
  const int springs = cloth_.springs.blocks * lanes;
  spring_damper_.assign(at(springs), 0.0);
  spring_taken_.assign(springs, 0.0);
  spring_peak_.assign(springs, 0.0);
  if (damped_lattice_) step_x_ = step_v_ = step_change_ = state_.x;
  std::copy(record.peak_tension.begin(), record.peak_tension.end(), spring_peak_.begin());
  for (std::size_t k = 0; k < cloth_.kept.size(); ++k)
    if (cloth_.is_fixed[cloth_.kept[k].node]) fixed_kept_.push_back(static_cast<int>(k));
}

void Stepper::take(Damper& damper, Vec3 force, Vec3 v) {
  damper.energy += 0.5 * dot(damper.force + force, v);
  damper.force = force;
}

void Stepper::record_fixed_force() {
  Vec3 sum;
  for (const int k : fixed_kept_) sum += force_on_kept(k);
  record_->fixed_force.push_back(sum);
}

void Stepper::add_pressure_work(int rank) {
  if (pressure_.empty()) return;
  const Worker& worker = workers_[rank];
  for (int row = worker.begin_row; row < worker.end_row; ++row) {
    const PatchLayout& patch = cloth_.patches[cloth_.row_patch[row]];
    if (cloth_.patch_row(row) + 1 == patch.rows) continue;
    const int slot = cloth_.row_slot(row), first = at(slot), next = first + 3 * patch.row_slots();
    row_work_[row] += pressure_work({patch.vectors, pressure_.data() + slot, state_.x.data() + first,
                                     state_.x.data() + next, before_.data() + first, before_.data() + next});
  }
}

/// Calls work(first, count) with where each of a rank's rows lies in a vector of the lattice.
template <class Work>
void Stepper::each_row(int rank, const Work& work) const {
  const Worker& worker = workers_[rank];
  for (int row = worker.begin_row; row < worker.end_row; ++row)
    work(at(cloth_.row_slot(row)), 3 * cloth_.patches[cloth_.row_patch[row]].row_slots());
}

void Stepper::remember_positions(int rank) {
  each_row(rank, [&](int first, int count) {
    std::copy_n(state_.x.data() + first, count, before_.data() + first);
  });
}

// The dampers of the lattice are read at the velocities before a step, and take F . (v + v') / 2 in it. What that makes
// beside F . v is C n.v n.(v' - v) / 2 a spring, and with Q(u) the sum of C (n.u)^2 (Q(v') - Q(v) - Q(v' - v)) / 4.
void Stepper::remember_step(int rank) {
  each_row(rank, [&](int first, int count) {
    std::copy_n(state_.x.data() + first, count, step_x_.data() + first);
    std::copy_n(state_.v.data() + first, count, step_v_.data() + first);
  });
}

void Stepper::change_of_step(int rank) {
  each_row(rank, [&](int first, int count) {
    for (int i = first; i < first + count; ++i) step_change_[i] = state_.v[i] - step_v_[i];
  });
}

void Stepper::look_at_dampers(int rank, int steps) {
  Worker& worker = workers_[rank];
  double* const unwanted = worker.buffer.data() + rows_in_turn * worker.row_doubles;
  for (const Piece& piece : worker.pieces) {
    const PatchLayout& patch = cloth_.patches[piece.patch];
    if (!patch.damped) continue;
    const int stride = 3 * patch.row_slots();
    for (int row = piece.begin; row < piece.end; ++row) {
      const std::size_t first = at(patch.first + patch.row_slots() * row);
      const double* x = step_x_.data() + first;
      const auto taken = [&](const AlignedDoubles& velocities) {
        const double* v = velocities.data() + first;
        return add_row_forces({&patch, patch.springs(cloth_.lattice, row), nullptr, x, x + stride,
                               x + 2 * stride, v, v + stride, v + 2 * stride,
                               patch.damper_share(cloth_.damper_shares, row), unwanted, unwanted, unwanted});
      };
      const double more = 0.25 * (taken(state_.v) - taken(step_v_) - taken(step_change_));
      row_damped_[patch.first_row + row] += steps * more;
    }
  }
}

void Stepper::close_dampers(int rank) {
  const int threads = static_cast<int>(workers_.size());
  const auto own = [&](std::size_t count) { return part_of(static_cast<int>(count), rank, threads); };
  const IndexRange kept = own(kept_dampers_.size());
  for (int k = kept.begin; k < kept.end; ++k)
    take(kept_dampers_[k], {}, get(state_.v.data(), cloth_.kept[k].slot));
  if (rank == 0)
    for (std::size_t i = 0; i + 1 < cloth_.rings.size(); ++i)
      take(string_dampers_[i], {},
           get(state_.v.data(), cloth_.rings[i + 1]) - get(state_.v.data(), cloth_.rings[i]));
  const KeptSprings& springs = cloth_.springs;
  const auto speed = [&](std::int64_t end) {
    const double* v = state_.v.data() + end;
    return Vec3{v[0], v[lanes], v[2 * lanes]};
  };
  const IndexRange all = own(record_->peak_tension.size());
  for (int s = all.begin; s < all.end; ++s) {
    const Vec3 force = get(spring_damper_.data(), s);
    spring_taken_[s] += 0.5 * dot(force, speed(springs.b[s]) - speed(springs.a[s]));
    put(spring_damper_.data(), s, {});
  }
}

void Stepper::finish_record() {
  for (int rank = 0; rank < static_cast<int>(workers_.size()); ++rank) close_dampers(rank);
  double damped = 0;
  for (const Damper& damper : kept_dampers_) damped += damper.energy;
  for (const Damper& damper : string_dampers_) damped += damper.energy;
  for (std::size_t s = 0; s < record_->peak_tension.size(); ++s) {
    damped += spring_taken_[s];
    record_->peak_tension[s] = spring_peak_[s];
  }
  for (const double power : row_damped_) damped += power;
  record_->damped += dt_ * damped;
  for (const double work : row_work_) record_->pressure_work += work;
  record_ = nullptr;
}

}  // namespace ripstop
