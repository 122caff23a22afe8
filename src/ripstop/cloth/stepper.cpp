#include "ripstop/cloth/stepper.h"

#include <algorithm>
#include <cmath>

#include "ripstop/core/thread_team.h"

namespace ripstop {
namespace {

// What a kept node costs, over a vector of the lattice (measured on Stratos IV, AVX-512).
constexpr double vectors_a_kept_node = 0.25;

// t / (t + 3) of the velocity is kept t steps after a stop, see relax.cpp.
double keep_after(int steps) {
  return steps / (steps + 3.0);
}

}  // namespace

Stepper::Stepper(const Cloth& cloth, const Loads& loads, ClothState& state, double dt, int threads)
    : cloth_(cloth),
      state_(state),
      dt_(dt),
      damped_(true),
      sums_wanted_(false),
      pressure_(compile_pressure(cloth, loads)),
      node_force_(compile_node_force(cloth, loads)) {
  inverse_mass_.assign(cloth.slots, 0.0);
  kept_inverse_mass_.assign(cloth.kept.size(), 0.0);
  const auto inverse = [&](int node) {
    return cloth.is_fixed[node] || !(cloth.total_mass[node] > 0) ? 0.0 : 1 / cloth.total_mass[node];
  };
  for (int node = 0; node < cloth.mesh.node_count(); ++node) inverse_mass_[cloth.slot[node]] = inverse(node);
  for (std::size_t k = 0; k < cloth.kept.size(); ++k) {
    kept_inverse_mass_[k] = inverse(cloth.kept[k].node);
    inverse_mass_[cloth.kept[k].slot] = 0;
  }
  if (cloth.options.absolute_damping > 0 || cloth.options.quadratic_damping > 0) {
    area_.assign(cloth.slots, 0.0);
    for (int node = 0; node < cloth.mesh.node_count(); ++node) {
      const int slot = cloth.slot[node];
      if (inverse_mass_[slot] > 0) area_[slot] = cloth.area[node];
    }
    for (const Cloth::Kept& kept : cloth.kept) kept_area_.push_back(cloth.area[kept.node]);
  }
  prepare(threads);
}

Stepper::Stepper(const Cloth& cloth, const Loads& loads, ClothState& state, const Fictitious& masses,
                 int threads)
    : cloth_(cloth),
      state_(state),
      dt_(1),
      damped_(false),
      sums_wanted_(true),
      pressure_(compile_pressure(cloth, loads)),
      node_force_(compile_node_force(cloth, loads)) {
  set_masses(masses);
  prepare(threads);
}

void Stepper::set_masses(const Fictitious& masses) {
  inverse_tensor_.assign(6 * static_cast<std::size_t>(cloth_.slots), 0.0);
  kept_inverse_tensor_.resize(cloth_.kept.size());
  if (!masses.freedom.empty()) kept_freedom_.resize(cloth_.kept.size());
  const auto tensor = [&](int slot) {
    return inverse_tensor_.data() + 6 * static_cast<std::size_t>(slot / lanes * lanes) + slot % lanes;
  };
  for (int node = 0; node < cloth_.mesh.node_count(); ++node)
    for (int i = 0; i < 6; ++i) tensor(cloth_.slot[node])[i * lanes] = masses.inverse_mass[node][i];
  for (std::size_t k = 0; k < cloth_.kept.size(); ++k) {
    kept_inverse_tensor_[k] = masses.inverse_mass[cloth_.kept[k].node];
    if (!masses.freedom.empty()) kept_freedom_[k] = masses.freedom[cloth_.kept[k].node];
    for (int i = 0; i < 6; ++i) tensor(cloth_.kept[k].slot)[i * lanes] = 0;
  }
}

void Stepper::set_node_force(const std::vector<Vec3>& force) {
  node_force_ = compile_node_force(cloth_, {{}, force});
}

void Stepper::hold(double per_area, const AlignedDoubles& at) {
  hold_at_ = at;
  hold_stiffness_.assign(at.size(), 0.0);
  for (int node = 0; node < cloth_.mesh.node_count(); ++node) {
    const double k = per_area * cloth_.area[node];
    put(hold_stiffness_.data(), cloth_.slot[node], {k, k, k});
  }
}

void Stepper::prepare(int threads) {
  damped_lattice_ = damped_ && std::any_of(cloth_.patches.begin(), cloth_.patches.end(),
                                           [](const PatchLayout& patch) { return patch.damped; });
  const int parts = static_cast<int>(cloth_.rings.size());
  kept_force_.assign(at(cloth_.first_string_force + (parts + lanes) / lanes * lanes), 0.0);
  row_sums_.assign(cloth_.row_count, RowSums{});
  const int loose = static_cast<int>(cloth_.kept.size()) - cloth_.kept_of_row.back();
  kept_sums_.assign(cloth_.row_count, RowSums{});
  loose_sums_.assign((loose + kept_block - 1) / kept_block, RowSums{});
  workers_.resize(threads);

  // Rows are dealt by what they cost in the first phase, the longest: vectors and the forces of kept nodes.
  // The two rows of springs computed twice count for the thread above.
  std::vector<double> cost_before(cloth_.row_count + 1, 0.0);
  for (int row = 0; row < cloth_.row_count; ++row)
    cost_before[row + 1] = cost_before[row] + cloth_.patches[cloth_.row_patch[row]].vectors +
                           vectors_a_kept_node * (cloth_.kept_of_row[row + 1] - cloth_.kept_of_row[row]);
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
      worker.pieces.push_back({p, begin, end, begin > 0, end < patch.rows});
      worker.row_doubles = std::max(worker.row_doubles, static_cast<std::size_t>(3 * patch.row_slots()));
      for (int row = begin; row < end; ++row)
        if ((begin > 0 && row < begin + ghosts) || (end < patch.rows && row >= end - ghosts))
          worker.waiting.push_back(patch.first_row + row);
    }
    worker.buffer.assign((rows_in_turn + 1 + worker.waiting.size()) * worker.row_doubles, 0.0);
  }
}

void Stepper::add_forces(int rank) {
  Worker& worker = workers_[rank];
  const IndexRange blocks = part_of(cloth_.springs.blocks, rank, static_cast<int>(workers_.size()));
  pull_springs({&cloth_.springs, state_.x.data(), damped_ ? state_.v.data() : nullptr,
                kept_force_.data() + at(cloth_.first_spring_force), record_ ? spring_damper_.data() : nullptr,
                record_ ? spring_taken_.data() : nullptr, record_ ? spring_peak_.data() : nullptr},
               blocks.begin, blocks.end);
  for (const Piece& piece : worker.pieces) step_piece(worker, piece);
  if (rank == 0) pull_drawstring();
  // Nodes outside patches have no lattice force; a point force may act on them.
  if (rank == 0)
    for (std::size_t k = cloth_.kept_of_row.back(); k < cloth_.kept.size(); ++k)
      put(kept_force_.data(), static_cast<int>(k),
          node_force_.empty() ? Vec3{} : get(node_force_.data(), cloth_.kept[k].slot));
}

// One tension along all of a string that slides through its rings: with n the direction of a part,
//   e = sum l / L0 - 1,   T = law(e) + C d(sum l)/dt where e > 0,   T n on the ring at a part's beginning, -T n at its end.
void Stepper::pull_drawstring() {
  if (cloth_.rings.empty()) return;
  const Drawstring& string = *cloth_.mesh.drawstring;
  const std::size_t parts = cloth_.rings.size() - 1;
  const auto between = [&](const AlignedDoubles& vectors, std::size_t i) {
    return get(vectors.data(), cloth_.rings[i + 1]) - get(vectors.data(), cloth_.rings[i]);
  };
  double length = 0, rate = 0;
  for (std::size_t i = 0; i < parts; ++i) {
    const Vec3 d = between(state_.x, i);
    const double part = norm(d);
    length += part;
    if (damped_ && part > 0) rate += dot(d, between(state_.v, i)) / part;
  }
  const double strain = length / string.rest_length - 1;
  const double damper = strain > 0 ? string.damping * rate : 0.0;
  const double tension = string.law.tension(std::max(strain, 0.0)) + damper;
  for (std::size_t i = 0; i < parts; ++i) {
    const Vec3 d = between(state_.x, i);
    const double part = norm(d);
    const Vec3 n = part > 0 ? d / part : Vec3{};
    put(kept_force_.data(), cloth_.first_string_force + static_cast<int>(i), tension * n);
    if (record_) take(string_dampers_[i], damper * n, between(state_.v, i));
  }
  if (record_) record_->drawstring.push_back(tension);
}

void Stepper::step_piece(Worker& worker, const Piece& piece) {
  const PatchLayout& patch = cloth_.patches[piece.patch];
  double* const unwanted = worker.buffer.data() + rows_in_turn * worker.row_doubles;
  const auto waits = [&](int row) {
    return (piece.shared_below && row < piece.begin + ghosts) ||
           (piece.shared_above && row >= piece.end - ghosts);
  };
  const auto force = [&](int row) {
    if (row < piece.begin || row >= piece.end) return unwanted;
    if (!waits(row)) return worker.buffer.data() + (row % rows_in_turn) * worker.row_doubles;
    const auto found = std::lower_bound(worker.waiting.begin(), worker.waiting.end(), patch.first_row + row);
    return unwanted + (1 + (found - worker.waiting.begin())) * worker.row_doubles;
  };
  for (int row = piece.begin; row < std::min(piece.end, ghosts); ++row)
    std::fill_n(force(row), 3 * patch.row_slots(), 0.0);

  const int stride = 3 * patch.row_slots();
  const bool damped = damped_ && patch.damped;
  for (int row = std::max(0, piece.begin - ghosts); row < piece.end; ++row) {
    const std::size_t first = at(patch.first + patch.row_slots() * row);
    const double* x = state_.x.data() + first;
    const double* v = damped ? state_.v.data() + first : nullptr;
    const bool pressed = !pressure_.empty() && row + 1 < patch.rows;
    const double damped_power = add_row_forces(
        {&patch, patch.springs(cloth_.lattice, row),
         pressed ? pressure_.data() + patch.first + patch.row_slots() * row : nullptr, x, x + stride,
         x + 2 * stride, v, damped ? v + stride : nullptr, damped ? v + 2 * stride : nullptr,
         damped ? patch.damper_share(cloth_.damper_shares, row) : nullptr, force(row), force(row + 1),
         force(row + 2)});
    if (row < piece.begin) continue;
    if (record_) row_damped_[patch.first_row + row] += damped_power;
    complete_row(patch.first_row + row, force(row));
    if (!waits(row)) move(patch.first_row + row, force(row), worker.pace);
  }
}

void Stepper::complete_row(int row, double* f) {
  const PatchLayout& patch = cloth_.patches[cloth_.row_patch[row]];
  const int first = cloth_.row_slot(row);
  for (const PatchLayout::Copy& copy : patch.copies)
    for (int c = 0; c < 3; ++c) f[at(copy.source) + c * lanes] += f[at(copy.ghost) + c * lanes];
  if (!node_force_.empty()) add_row(3 * lanes * patch.vectors, node_force_.data() + at(first), f);
  if (!hold_at_.empty()) {
    const double *stiffness = hold_stiffness_.data() + at(first), *from = hold_at_.data() + at(first),
                 *x = state_.x.data() + at(first);
    for (int i = 0; i < 3 * lanes * patch.vectors; ++i) f[i] += stiffness[i] * (from[i] - x[i]);
  }
  for (int k = cloth_.kept_of_row[row]; k < cloth_.kept_of_row[row + 1]; ++k) {
    Vec3 drag;
    if (!area_.empty()) {
      const Vec3 v = get(state_.v.data(), cloth_.kept[k].slot);
      double per_area = cloth_.options.absolute_damping;
      if (cloth_.options.quadratic_damping > 0) per_area += cloth_.options.quadratic_damping * norm(v);
      drag = (kept_area_[k] * per_area) * v;
      if (record_) take(kept_dampers_[k], drag, v);
    }
    put(kept_force_.data(), k, get(f, cloth_.kept[k].slot - first) - drag);
  }
}

void Stepper::move(int row, const double* f, Pace pace) {
  const int first = cloth_.row_slot(row);
  const int vectors = cloth_.patches[cloth_.row_patch[row]].vectors;
  if (sums_wanted_) {
    row_sums_[row] = relax_row({vectors, pace.kick, pace.keep,
                                inverse_tensor_.data() + 6 * static_cast<std::size_t>(first), f,
                                state_.x.data() + at(first), state_.v.data() + at(first)});
    if (blocks_) sum_row_blocks(row, f);
    return;
  }
  const RowMotion motion{vectors,
                         dt_,
                         inverse_mass_.data() + first,
                         area_.empty() ? nullptr : area_.data() + first,
                         cloth_.options.absolute_damping,
                         cloth_.options.quadratic_damping,
                         f,
                         state_.x.data() + at(first),
                         state_.v.data() + at(first)};
  const double damped = move_row(motion);
  if (record_) row_damped_[row] += damped;
}

void Stepper::move_kept(int rank) {
  Worker& worker = workers_[rank];
  const std::size_t unwanted_and_turns = rows_in_turn + 1;
  for (std::size_t i = 0; i < worker.waiting.size(); ++i)
    move(worker.waiting[i], worker.buffer.data() + (unwanted_and_turns + i) * worker.row_doubles,
         worker.pace);

  if (record_ && rank == 0) record_fixed_force();

  // The nodes of a row belong to the row's thread, which has moved its neighbours; the others are dealt out.
  const auto move_nodes = [&](int begin, int end, RowSums& sums) {
    if (sums_wanted_)
      sums = relax_kept_nodes(begin, end, worker.pace);
    else
      move_kept_nodes(begin, end);
  };
  for (int row = worker.begin_row; row < worker.end_row; ++row)
    move_nodes(cloth_.kept_of_row[row], cloth_.kept_of_row[row + 1], kept_sums_[row]);
  const IndexRange blocks =
      part_of(static_cast<int>(loose_sums_.size()), rank, static_cast<int>(workers_.size()));
  const int loose = cloth_.kept_of_row.back(), all = static_cast<int>(cloth_.kept.size());
  for (int block = blocks.begin; block < blocks.end; ++block)
    move_nodes(loose + block * kept_block, std::min(all, loose + (block + 1) * kept_block),
               loose_sums_[block]);
  if (sums_wanted_) {
    worker.block_kick = worker.pace.kick;
    const double keep = keep_after(++worker.steps_since_stop);
    worker.pace = {0.5 * (1 + keep), keep};
  }
}

Vec3 Stepper::force_on_kept(int k) const {
  const Cloth::Kept& kept = cloth_.kept[k];
  Vec3 force = get(kept_force_.data(), k);
  for (int i = kept.first_share; i < kept.end_share; ++i)
    force += cloth_.shares[i].weight * get(kept_force_.data(), cloth_.shares[i].source);
  return force;
}

void Stepper::move_kept_nodes(int begin, int end) {
  for (int k = begin; k < end; ++k) {
    if (kept_inverse_mass_[k] == 0) continue;
    const int slot = cloth_.kept[k].slot;
    const Vec3 now = get(state_.v.data(), slot) + (dt_ * kept_inverse_mass_[k]) * force_on_kept(k);
    put(state_.v.data(), slot, now);
    put(state_.x.data(), slot, get(state_.x.data(), slot) + dt_ * now);
  }
}

RowSums Stepper::relax_kept_nodes(int begin, int end, Pace pace) {
  RowSums sums;
  for (int k = begin; k < end; ++k) {
    Symmetric inverse = kept_inverse_tensor_[k];
    if (inverse[2] == 0) continue;
    for (double& component : inverse) component *= pace.kick;
    const int slot = cloth_.kept[k].slot;
    Vec3 force = force_on_kept(k);
    if (!kept_freedom_.empty()) force = kept_freedom_[k] * force;
    if (blocks_ && !kept_alone_[k]) {
      double* sum = block_sums_.data() + blocks_->sum_of_kept(k);
      const Vec3 others = k < cloth_.kept_of_row.back() ? Vec3{sum[0], sum[lanes], sum[2 * lanes]} : Vec3{};
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

void Stepper::follow_masters(int rank) {
  const Worker& worker = workers_[rank];
  const bool last = rank + 1 == static_cast<int>(workers_.size());
  for (double* vectors : {state_.x.data(), state_.v.data()})
    follow(cloth_, vectors, worker.begin_row, worker.end_row, last);
  mirror(cloth_, state_.x.data(), worker.begin_row, worker.end_row);
  // Velocities of ghosts are read by the dampers of the lattice only.
  if (damped_lattice_) mirror(cloth_, state_.v.data(), worker.begin_row, worker.end_row);
}

void Stepper::stop(int rank) {
  Worker& worker = workers_[rank];
  worker.pace = {0.5, 0};
  worker.steps_since_stop = 0;
  for (int row = worker.begin_row; row < worker.end_row; ++row)
    std::fill_n(state_.v.data() + at(cloth_.row_slot(row)),
                3 * cloth_.patches[cloth_.row_patch[row]].row_slots(), 0.0);
  if (rank + 1 < static_cast<int>(workers_.size())) return;
  for (std::size_t k = cloth_.kept_of_row.back(); k < cloth_.kept.size(); ++k)
    put(state_.v.data(), cloth_.kept[k].slot, {});
}

RowSums Stepper::sums() const {
  RowSums total;
  for (const auto* list : {&row_sums_, &kept_sums_, &loose_sums_})
    for (const RowSums& sums : *list) {
      total.force_squared += sums.force_squared;
      total.power += sums.power;
    }
  return total;
}

}  // namespace ripstop
