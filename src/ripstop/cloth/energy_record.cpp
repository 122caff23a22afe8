#include "ripstop/cloth/energy_record.h"

#include <algorithm>

namespace ripstop::inline cloth {
namespace {

// For the work of the pressure: the cloth moves a fraction of a cell meanwhile.
constexpr int steps_between_work = 16;
constexpr int steps_between_corrections = 64;  // one costs as much as three steps

}  // namespace

EnergyRecord::EnergyRecord(StepRecord& record, const Cloth& cloth, Forces& forces, const ClothState& state,
                           double dt, int count, ThreadTeam& team)
    : record_(record),
      cloth_(cloth),
      forces_(forces),
      state_(state),
      dt_(dt),
      count_(count),
      first_step_(state.steps),
      team_(team),
      before_(state.x),
      row_work_(cloth.row_count, 0.0),
      row_damped_(cloth.row_count, 0.0),
      node_dampers_(cloth.irregular.size()),
      string_dampers_(cloth.rings.size()) {
  record.fixed_force.clear();
  record.fixed_force.reserve(count);
  record.drawstring.clear();
  if (cloth.mesh.drawstring) record.drawstring.reserve(count);
  record.peak_tension.resize(cloth.mesh.springs.size(), 0.0);
  const int springs = cloth.springs.blocks * lanes;
  spring_damper_.assign(at(springs), 0.0);
  spring_taken_.assign(springs, 0.0);
  spring_peak_.assign(springs, 0.0);
  std::copy(record.peak_tension.begin(), record.peak_tension.end(), spring_peak_.begin());
  if (forces.damps_fabric()) step_x_ = step_v_ = step_change_ = state.x;
  for (std::size_t k = 0; k < cloth.irregular.size(); ++k)
    if (cloth.is_fixed[cloth.irregular[k].node]) fixed_.push_back(static_cast<int>(k));
}

void EnergyRecord::take(Damper& damper, Vec3 force, Vec3 v) {
  damper.energy += 0.5 * dot(damper.force + force, v);
  damper.force = force;
}

/// Calls work(first, count) with where each of a rank's rows lies in a vector of the lattice.
template <class Work>
void EnergyRecord::each_row(int rank, const Work& work) const {
  const IndexRange rows = forces_.rows(rank);
  for (int row = rows.begin; row < rows.end; ++row)
    work(at(cloth_.row_slot(row)), 3 * cloth_.patches[cloth_.row_patch[row]].row_slots());
}

void EnergyRecord::before_kick(int rank) {
  close_dampers(rank);
  team_.barrier();
}

bool EnergyRecord::corrects_dampers(int n) const {
  return forces_.damps_fabric() && (first_step_ + n) % steps_between_corrections == 0;
}

void EnergyRecord::before_forces(int rank, int n) {
  if (!corrects_dampers(n)) return;
  each_row(rank, [&](int first, int count) {
    std::copy_n(state_.x.data() + first, count, step_x_.data() + first);
    std::copy_n(state_.v.data() + first, count, step_v_.data() + first);
  });
  team_.barrier();
}

SpringRecord EnergyRecord::springs() {
  return {spring_damper_.data(), spring_taken_.data(), spring_peak_.data()};
}

void EnergyRecord::add_drawstring(int rank) {
  if (rank != 0 || cloth_.rings.empty()) return;
  for (std::size_t i = 0; i + 1 < cloth_.rings.size(); ++i) {
    const auto between = [&](const AlignedDoubles& vectors) {
      return get(vectors.data(), cloth_.rings[i + 1]) - get(vectors.data(), cloth_.rings[i]);
    };
    const Vec3 d = between(state_.x);
    const double part = norm(d);
    const Vec3 n = part > 0 ? d / part : Vec3{};
    take(string_dampers_[i], forces_.drawstring_damper() * n, between(state_.v));
  }
  record_.drawstring.push_back(forces_.drawstring_tension());
}

void EnergyRecord::add_fixed_force(int rank) {
  if (rank != 0) return;
  Vec3 sum;
  for (const int k : fixed_) sum += forces_.on_irregular(k);
  record_.fixed_force.push_back(sum);
}

void EnergyRecord::add_row(int row, double power) {
  row_damped_[row] += forces_.damper_power(row);
  row_damped_[row] += power;
}

void EnergyRecord::after_step(int rank, int n) {
  if (corrects_dampers(n)) correct_dampers(rank);
  if ((n + 1) % steps_between_work != 0 && n + 1 != count_) return;
  add_pressure_work(rank);
  team_.barrier();
  each_row(rank, [&](int first, int count) {
    std::copy_n(state_.x.data() + first, count, before_.data() + first);
  });
}

void EnergyRecord::add_pressure_work(int rank) {
  const AlignedDoubles& pressure = forces_.pressure();
  if (pressure.empty()) return;
  const IndexRange rows = forces_.rows(rank);
  for (int row = rows.begin; row < rows.end; ++row) {
    const PatchLayout& patch = cloth_.patches[cloth_.row_patch[row]];
    if (cloth_.patch_row(row) + 1 == patch.rows) continue;
    const int slot = cloth_.row_slot(row), first = at(slot), next = first + 3 * patch.row_slots();
    row_work_[row] += pressure_work({patch.vectors, pressure.data() + slot, state_.x.data() + first,
                                     state_.x.data() + next, before_.data() + first, before_.data() + next});
  }
}

// The dampers of the lattice are read at the velocities before a step, and take F . (v + v') / 2 in it. The
// difference to F . v is C n.v n.(v' - v) / 2 for each spring, and with Q(u) the sum of C (n.u)^2
//   (Q(v') - Q(v) - Q(v' - v)) / 4.
// One step in `steps_between_corrections` is evaluated and counts for all of them.
void EnergyRecord::correct_dampers(int rank) {
  each_row(rank, [&](int first, int count) {
    for (int i = first; i < first + count; ++i) step_change_[i] = state_.v[i] - step_v_[i];
  });
  team_.barrier();
  const IndexRange rows = forces_.rows(rank);
  for (int row = rows.begin; row < rows.end; ++row) {
    const auto taken = [&](const AlignedDoubles& v) {
      return forces_.damper_power_at(rank, row, step_x_, v);
    };
    const double more = 0.25 * (taken(state_.v) - taken(step_v_) - taken(step_change_));
    row_damped_[row] += steps_between_corrections * more;
  }
  team_.barrier();
}

void EnergyRecord::close_dampers(int rank) {
  const auto own = [&](std::size_t count) {
    return part_of(static_cast<int>(count), rank, forces_.threads());
  };
  const IndexRange nodes = own(node_dampers_.size());
  for (int k = nodes.begin; k < nodes.end; ++k)
    take(node_dampers_[k], {}, get(state_.v.data(), cloth_.irregular[k].slot));
  if (rank == 0)
    for (std::size_t i = 0; i + 1 < cloth_.rings.size(); ++i)
      take(string_dampers_[i], {},
           get(state_.v.data(), cloth_.rings[i + 1]) - get(state_.v.data(), cloth_.rings[i]));
  const IrregularSprings& springs = cloth_.springs;
  const auto speed = [&](std::int64_t end) {
    const double* v = state_.v.data() + end;
    return Vec3{v[0], v[lanes], v[2 * lanes]};
  };
  const IndexRange all = own(record_.peak_tension.size());
  for (int s = all.begin; s < all.end; ++s) {
    const Vec3 force = get(spring_damper_.data(), s);
    spring_taken_[s] += 0.5 * dot(force, speed(springs.b[s]) - speed(springs.a[s]));
    put(spring_damper_.data(), s, {});
  }
}

void EnergyRecord::finish() {
  for (int rank = 0; rank < forces_.threads(); ++rank) close_dampers(rank);
  double damped = 0;
  for (const Damper& damper : node_dampers_) damped += damper.energy;
  for (const Damper& damper : string_dampers_) damped += damper.energy;
  for (std::size_t s = 0; s < record_.peak_tension.size(); ++s) {
    damped += spring_taken_[s];
    record_.peak_tension[s] = spring_peak_[s];
  }
  for (const double power : row_damped_) damped += power;
  record_.damped += dt_ * damped;
  for (const double work : row_work_) record_.pressure_work += work;
}

}  // namespace ripstop::inline cloth
