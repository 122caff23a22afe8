// Records of step().
#include <gtest/gtest.h>

#include <cmath>

#include "builders.h"

namespace ripstop {
namespace {

using namespace testing;

Loads pressed(const Mesh& mesh) {
  return {std::vector<double>(mesh.cell_count(), 400.0), {}};
}

struct Balance {
  double work, kinetic, elastic, damped;
  double residual() const {
    return std::abs(work - kinetic - elastic - damped) / (work + std::abs(elastic) + kinetic);
  }
};

Balance balance(const Mesh& mesh, const ClothOptions& options, double share_of_stable, double until) {
  const ClothPtr cloth = make_cloth(mesh, options);
  ClothState state = start_state(*cloth);
  const double before = elastic_energy(*cloth, state);
  const int count = static_cast<int>(until / (share_of_stable * stability_limit(*cloth, state).stable_step));
  ThreadTeam team(2);
  StepRecord record;
  step(state, *cloth, pressed(mesh), until / count, count, team, &record);
  return {record.pressure_work, kinetic_energy(*cloth, state), elastic_energy(*cloth, state) - before,
          record.damped};
}

// The kinetic energy is that of half a step ago: first order. Dampers have the mean velocity of a step, those of the
// lattice in one step of many.
TEST(StepRecord, TheWorkOfThePressureIsKineticElasticAndDampedEnergyToFirstOrderInTheStep) {
  for (const double spring_damping : {0.0, 0.02})
    for (const ClothOptions& options : {ClothOptions{false, 8.2, 0}, {false, 2.0, 0.3}}) {
      const Mesh mesh = medley(spring_damping, true);
      const Balance coarse = balance(mesh, options, 0.2, 2e-3), fine = balance(mesh, options, 0.02, 2e-3);
      EXPECT_LT(fine.residual(), 2e-4) << coarse.residual() << " " << spring_damping;
      if (spring_damping > 0)
        EXPECT_LT(coarse.residual(), 1e-3);  // 3.2e-3 with the velocities before a step
      else
        EXPECT_LT(fine.residual(), 0.2 * coarse.residual());
    }
}

TEST(StepRecord, TheForceOnFixedNodesIsThatOfEveryStepsStart) {
  const Mesh mesh = medley(0.0, true);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  ThreadTeam team(2);
  set_positions(state, *cloth, shaken(mesh.start, 0.0015, 1));
  StepRecord record;
  for (int i = 0; i < 20; ++i) {
    const Vec3 expected = force_on_fixed(*cloth, state);
    step(state, *cloth, {}, 1e-6, 1, team, &record);
    ASSERT_EQ(record.fixed_force.size(), 1u);
    EXPECT_LT(norm(record.fixed_force[0] - expected), 1e-9 * norm(expected) + 1e-12);
  }
}

TEST(StepRecord, ARecordChangesNothingAndIsTheSameForAnyTeamAndAnyCutOfTheRun) {
  const Mesh mesh = medley(0.001, true);
  const ClothPtr cloth = make_cloth(mesh, {false, 8.2, 0.1});
  const auto run = [&](int threads, StepRecord* record) {
    ClothState state = start_state(*cloth);
    ThreadTeam team(threads);
    step(state, *cloth, pressed(mesh), 1e-6, 300, team, record);
    return state;
  };
  StepRecord one, three;
  const ClothState plain = run(1, nullptr), recorded = run(1, &one);
  run(3, &three);
  EXPECT_EQ(plain.x, recorded.x);
  EXPECT_EQ(plain.v, recorded.v);
  EXPECT_EQ(one.pressure_work, three.pressure_work);
  EXPECT_EQ(one.damped, three.damped);
  EXPECT_EQ(one.fixed_force, three.fixed_force);
  EXPECT_EQ(one.peak_tension, three.peak_tension);
}

}  // namespace
}  // namespace ripstop
