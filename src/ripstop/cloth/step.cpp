#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "ripstop/cloth/bound.h"
#include "ripstop/cloth/contact.h"
#include "ripstop/cloth/stepper.h"
#include "ripstop/core/error.h"

namespace ripstop {
namespace {

constexpr long long steps_between_checks = 2048;  // of the bound, which costs about as much as 40 steps
// For the work of the pressure: the cloth moves a fraction of a cell meanwhile.
constexpr int steps_between_looks = 16;
constexpr int steps_between_dampers = 64;  // a look costs as much as three steps
constexpr double runaway_strain = 10;      // no fabric comes near: the cloth flies apart

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
  const StepBound bound = step_bound(cloth, state, stiffness);
  if (dt > bound.stable_step)
    throw Error(
        ExitCode::diverged,
        fmt::format("step {} (t = {:.6g} s): the time step {:.4g} s is above the stable {:.4g} s that node "
                    "{} ({}) allows at its present strain; lower the time step",
                    state.steps, state.time, dt, bound.stable_step, bound.node, bound.part));
}

}  // namespace

void step(ClothState& state, const Cloth& cloth, const Loads& loads, double dt, int count, ThreadTeam& team,
          StepRecord* record) {
  if (!(dt > 0)) throw Error(ExitCode::usage, fmt::format("the time step {} s must be positive", dt));
  Stepper stepper(cloth, loads, state, dt, team.size());
  if (record) {
    record->fixed_force.clear();
    record->fixed_force.reserve(count);
    record->drawstring.clear();
    if (cloth.mesh.drawstring) record->drawstring.reserve(count);
    record->peak_tension.resize(cloth.mesh.springs.size(), 0.0);
    stepper.start_record(*record);
  }
  std::optional<Contact> contact;
  if (cloth.contact) contact.emplace(*cloth.contact, team.size());
  const int a_kick = contact ? contact->steps_a_kick(dt) : 0;
  const int all = count;
  int done = 0;
  while (count > 0) {
    const long long since = state.steps % steps_between_checks;
    if (since == 0) check_step(cloth, state, dt);
    const int now = static_cast<int>(std::min<long long>(count, steps_between_checks - since));
    team.run([&](int rank) {
      for (int i = 0; i < now; ++i) {
        if (contact && (done + i) % a_kick == 0) {
          if (record) {
            stepper.close_dampers(rank);
            team.barrier();
          }
          contact->kick(rank, team, state, std::min(a_kick, all - done - i) * dt);
          stepper.follow_masters(rank);
          team.barrier();
        }
        const bool looked = stepper.looks_at_dampers() && (state.steps + i) % steps_between_dampers == 0;
        if (looked) {
          stepper.remember_step(rank);
          team.barrier();
        }
        stepper.add_forces(rank);
        team.barrier();
        stepper.move_kept(rank);
        team.barrier();
        stepper.follow_masters(rank);
        team.barrier();
        if (looked) {
          stepper.change_of_step(rank);
          team.barrier();
          stepper.look_at_dampers(rank, steps_between_dampers);
          team.barrier();
        }
        if (!record || ((done + i + 1) % steps_between_looks != 0 && done + i + 1 != all)) continue;
        stepper.add_pressure_work(rank);
        team.barrier();
        stepper.remember_positions(rank);
      }
    });
    done += now;
    state.steps += now;
    state.time += now * dt;
    count -= now;
    check_health(cloth, state);
  }
  if (record) stepper.finish_record();
  if (record && contact) record->damped += contact->damped();
}

}  // namespace ripstop
