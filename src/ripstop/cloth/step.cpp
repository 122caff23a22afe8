#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "ripstop/cloth/contact.h"
#include "ripstop/cloth/energy_record.h"
#include "ripstop/cloth/forces.h"
#include "ripstop/cloth/stability_limit.h"
#include "ripstop/cloth/step_memory.h"
#include "ripstop/core/error.h"
#include "ripstop/core/words.h"

namespace ripstop::inline cloth {
namespace {

constexpr long long steps_between_checks = 2048;  // of the stability limit, which costs as much as 40 steps
constexpr double runaway_strain = 10;             // no fabric comes near: the cloth flies apart

void check_step(const Cloth& cloth, const ClothState& state, double dt) {
  check_health(cloth, state);
  const NodeStiffness stiffness = node_stiffness(cloth, state);
  if (stiffness.largest_strain > runaway_strain)
    throw Error(
        ExitCode::diverged,
        fmt::format("step {} (t = {:.6g} s): a spring at node {} ({}) is stretched by {:.3g} times its "
                    "length; the loads are too high for this cloth or the step {:.3g} s is too large",
                    state.steps, state.time, stiffness.stretched_node,
                    place_of(cloth.mesh, stiffness.stretched_node), stiffness.largest_strain, dt));
  const StabilityLimit limit = stability_limit(cloth, state, stiffness);
  if (dt > limit.stable_step) {
    const auto [step, stable] = rounded_apart(dt, limit.stable_step, 4);
    throw Error(
        ExitCode::diverged,
        fmt::format("step {} (t = {:.6g} s): the time step {} s exceeds the stability limit of {} s of "
                    "node {} ({}) at its present strain; reduce the time step",
                    state.steps, state.time, step, stable, limit.node, limit.part));
  }
}

/// That of the memory if it is of this cloth; null without contact.
Contact* contact_of(const Cloth& cloth, int threads, StepMemory& memory) {
  if (memory.layout != cloth.contact || memory.threads != threads) {
    memory = {cloth.contact, {}, threads};
    if (cloth.contact) memory.contact = std::make_shared<Contact>(*cloth.contact, threads);
  }
  if (memory.contact) memory.contact->begin();
  return memory.contact.get();
}

/// Steps [0, count) of one call, shared by all threads.
class ExplicitStep {
 public:
  ExplicitStep(ClothState& state, const Cloth& cloth, const Loads& loads, double dt, int count,
               ThreadTeam& team, StepRecord* record, StepMemory& memory);

  /// Step n. Semi-implicit Euler, [NFM] Eq. 6, with damping by area, Eq. 20, and contact in kicks of several steps:
  ///   f = f_springs(x, v) + f_fabric(x, v) + f_pressure(x) + f_point - area (C_a + C_q |v|) v
  ///   v' = v + dt f / m,    x' = x + dt v'
  void take(int rank, int n) {
    if (contact_ && n % steps_per_kick_ == 0) kick(rank, n);
    if (record_) record_->before_forces(rank, n);

    const auto integrate = [&](int row, const double* f) { integrate_row(row, f); };
    add_irregular_springs(rank);
    forces_.add_fabric(rank, state_, integrate);  // with pressure and point loads
    if (damped_) damp_irregular_nodes(rank);
    team_.barrier();

    if (record_) record_->add_fixed_force(rank);
    forces_.finish_fabric(rank, integrate);
    forces_.for_irregular_nodes(rank, [&](int begin, int end, int) { integrate_irregular(begin, end); });
    team_.barrier();

    forces_.follow_masters(rank, state_);
    team_.barrier();
    if (record_) record_->after_step(rank, n);
  }
  void finish(StepRecord* record);

 private:
  void kick(int rank, int n);
  void add_irregular_springs(int rank);
  void damp_irregular_nodes(int rank);
  void integrate_row(int row, const double* f);
  void guide_row(int row);
  void integrate_irregular(int begin, int end);

  ClothState& state_;
  const Cloth& cloth_;
  double dt_;
  int count_;
  ThreadTeam& team_;
  Forces forces_;
  bool damped_;                                 // by area
  AlignedDoubles inverse_mass_, area_;          // by slot; 0 for irregular nodes; no areas: no damping
  std::vector<double> irregular_inverse_mass_;  // 0: does not move
  Contact* contact_;                            // may be null
  int steps_per_kick_ = 0;
  struct GuidedSlot {
    int slot;
    Vec3 along;
  };
  std::vector<GuidedSlot> guided_;             // regular nodes, in the order of their slots
  std::vector<const Vec3*> irregular_guided_;  // axes of irregular nodes; null: they move freely
  std::optional<EnergyRecord> record_;
};

ExplicitStep::ExplicitStep(ClothState& state, const Cloth& cloth, const Loads& loads, double dt, int count,
                           ThreadTeam& team, StepRecord* record, StepMemory& memory)
    : state_(state),
      cloth_(cloth),
      dt_(dt),
      count_(count),
      team_(team),
      forces_(cloth, loads, true, team.size()),
      damped_(cloth.options.absolute_damping > 0 || cloth.options.quadratic_damping > 0),
      inverse_mass_(cloth.slots, 0.0),
      contact_(contact_of(cloth, team.size(), memory)) {
  const auto inverse = [&](int node) {
    return cloth.is_fixed[node] || !(cloth.total_mass[node] > 0) ? 0.0 : 1 / cloth.total_mass[node];
  };
  for (int node = 0; node < cloth.mesh.node_count(); ++node) inverse_mass_[cloth.slot[node]] = inverse(node);
  std::vector<const Vec3*> axis_of(cloth.mesh.node_count(), nullptr);
  for (const GuidedNode& guided : loads.guided) axis_of[guided.node] = &guided.along;
  for (const Cloth::IrregularNode& irregular : cloth.irregular) {
    irregular_inverse_mass_.push_back(inverse(irregular.node));
    irregular_guided_.push_back(axis_of[irregular.node]);
    inverse_mass_[irregular.slot] = 0;
  }
  for (const GuidedNode& guided : loads.guided)
    if (const int slot = cloth.slot[guided.node]; inverse_mass_[slot] > 0)
      guided_.push_back({slot, guided.along});
  std::ranges::sort(guided_, {}, &GuidedSlot::slot);
  if (damped_) {
    area_.assign(cloth.slots, 0.0);
    for (int node = 0; node < cloth.mesh.node_count(); ++node)
      if (const int slot = cloth.slot[node]; inverse_mass_[slot] > 0) area_[slot] = cloth.area[node];
  }
  if (contact_) steps_per_kick_ = contact_->steps_a_kick(dt);
  if (record) record_.emplace(*record, cloth, forces_, state, dt, count, team);
}

void ExplicitStep::finish(StepRecord* record) {
  if (!record_) return;
  record_->finish();
  if (contact_) record->damped += contact_->damped();
}

void ExplicitStep::kick(int rank, int n) {
  if (record_) record_->before_kick(rank);
  contact_->kick(rank, team_, state_, std::min(steps_per_kick_, count_ - n) * dt_);
  forces_.follow_masters(rank, state_);
  team_.barrier();
}

void ExplicitStep::add_irregular_springs(int rank) {
  forces_.add_irregular_springs(rank, state_, record_ ? record_->springs() : SpringRecord{});
  if (record_) record_->add_drawstring(rank);
}

void ExplicitStep::damp_irregular_nodes(int rank) {
  const IndexRange rows = forces_.rows(rank);
  const int end = cloth_.irregular_of_row[rows.end];
  for (int k = cloth_.irregular_of_row[rows.begin]; k < end; ++k) {
    const Cloth::IrregularNode& irregular = cloth_.irregular[k];
    const Vec3 v = get(state_.v.data(), irregular.slot);
    double per_area = cloth_.options.absolute_damping;
    if (cloth_.options.quadratic_damping > 0) per_area += cloth_.options.quadratic_damping * norm(v);
    const Vec3 drag = (cloth_.area[irregular.node] * per_area) * v;
    if (record_) record_->add_damping(k, drag, v);
    forces_.set_of_fabric(k, forces_.of_fabric(k) - drag);
  }
}

/// Damping, v' and x' of the other nodes.
void ExplicitStep::integrate_row(int row, const double* f) {
  const int first = cloth_.row_slot(row);
  const RowMotion motion{cloth_.patches[cloth_.row_patch[row]].vectors,
                         dt_,
                         inverse_mass_.data() + first,
                         damped_ ? area_.data() + first : nullptr,
                         cloth_.options.absolute_damping,
                         cloth_.options.quadratic_damping,
                         f,
                         state_.x.data() + at(first),
                         state_.v.data() + at(first)};
  const double damping = move_row(motion);
  if (record_) record_->add_row(row, damping);
  if (!guided_.empty()) guide_row(row);
}

/// Takes back the motion of guided nodes across their axes.
void ExplicitStep::guide_row(int row) {
  const int begin = cloth_.row_slot(row), end = begin + cloth_.patches[cloth_.row_patch[row]].row_slots();
  for (auto guided = std::ranges::lower_bound(guided_, begin, {}, &GuidedSlot::slot);
       guided != guided_.end() && guided->slot < end; ++guided) {
    const Vec3 x = get(state_.x.data(), guided->slot), v = get(state_.v.data(), guided->slot);
    const Vec3 kept = dot(v, guided->along) * guided->along;
    put(state_.x.data(), guided->slot, x - dt_ * (v - kept));
    put(state_.v.data(), guided->slot, kept);
  }
}

void ExplicitStep::integrate_irregular(int begin, int end) {
  for (int k = begin; k < end; ++k) {
    if (irregular_inverse_mass_[k] == 0) continue;
    const int slot = cloth_.irregular[k].slot;
    Vec3 v = get(state_.v.data(), slot) + (dt_ * irregular_inverse_mass_[k]) * forces_.on_irregular(k);
    if (const Vec3* along = irregular_guided_[k]) v = dot(v, *along) * *along;
    put(state_.v.data(), slot, v);
    put(state_.x.data(), slot, get(state_.x.data(), slot) + dt_ * v);
  }
}

}  // namespace

std::vector<GuidedNode> guided_along(Vec3 axis, const std::vector<int>& nodes) {
  std::vector<GuidedNode> guided;
  for (const int node : nodes) guided.push_back({node, axis});
  return guided;
}

void step(ClothState& state, const Cloth& cloth, const Loads& loads, double dt, int count, ThreadTeam& team,
          StepRecord* record) {
  StepMemory memory;
  step(state, cloth, loads, dt, count, team, record, memory);
}

void step(ClothState& state, const Cloth& cloth, const Loads& loads, double dt, int count, ThreadTeam& team,
          StepRecord* record, StepMemory& memory) {
  if (!(dt > 0) || !std::isfinite(dt))
    throw Error(ExitCode::usage, fmt::format("the time step {} s must be positive and finite", dt));
  if (count < 0)
    throw Error(ExitCode::usage, fmt::format("{} steps of the cloth: must be at least 0", count));
  ExplicitStep steps(state, cloth, loads, dt, count, team, record, memory);
  for (int done = 0; done < count;) {
    const long long since = state.steps % steps_between_checks;
    if (since == 0) check_step(cloth, state, dt);
    const int now = static_cast<int>(std::min<long long>(count - done, steps_between_checks - since));
    team.run([&](int rank) {
      for (int n = done; n < done + now; ++n) steps.take(rank, n);
    });
    done += now;
    state.steps += now;
    state.time += now * dt;
    check_health(cloth, state);
  }
  steps.finish(record);
}

}  // namespace ripstop::inline cloth
