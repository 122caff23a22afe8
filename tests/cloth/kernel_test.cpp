// The vector kernels against the scalar one, and against themselves on other numbers of threads.
#include "ripstop/cloth/kernel.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <set>

#include "builders.h"
#include "ripstop/core/error.h"

namespace ripstop {
namespace {

using namespace testing;

struct Driven {
  Mesh mesh;
  ClothOptions options;
  Loads loads;
  std::vector<Vec3> x, v;
};

// As strong as the dampers of medley(), of every direction and cell its own.
void give_viscosity(Mesh& mesh) {
  for (Patch& patch : mesh.patches) {
    for (int d = 0; d < direction_count; ++d) patch.viscosity[d] = 0.005 * (1 + d);
    for (int i = 0; i < patch.rows * patch.columns; ++i)
      patch.viscosity_share.push_back(0.5 + 0.4 * std::sin(1.3 * i));
  }
}

Driven driven(int degree, double damping, bool pressed, bool fixed, const ClothOptions& options) {
  Driven d{medley(damping, fixed, degree), options, {}, {}, {}};
  if (damping > 0) give_viscosity(d.mesh);
  const ClothPtr cloth = make_cloth(d.mesh, d.options);
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, shaken(d.mesh.start, 0.0015, 1));
  set_velocities(state, *cloth, shaken(std::vector<Vec3>(d.mesh.node_count()), 0.5, 2));
  d.x = positions(state, *cloth);
  d.v = velocities(state, *cloth);
  if (pressed) {
    d.loads.cell_pressure.resize(d.mesh.cell_count());
    for (std::size_t i = 0; i < d.loads.cell_pressure.size(); ++i)
      d.loads.cell_pressure[i] = 300 + 50 * std::sin(0.1 * static_cast<double>(i));
    d.loads.node_force = shaken(std::vector<Vec3>(d.mesh.node_count()), 0.01, 3);
  }
  return d;
}

void expect_reference_forces() {
  for (int degree : {1, 2, 3, 4})
    for (double damping : {0.0, 0.02})
      for (bool pressed : {false, true})
        for (int variant = 0; variant < 4; ++variant) {
          ClothOptions options;
          options.linear = variant == 1;
          if (variant >= 2) options.absolute_damping = 0.41 * degree;
          if (variant == 3) options.quadratic_damping = 3.2;
          const Driven d = driven(degree, damping, pressed, variant != 0, options);
          const std::vector<Vec3> force = reference_forces(d.mesh, d.options, d.loads, d.x, d.v);
          const std::vector<double> mass = reference_masses(d.mesh);
          const ClothPtr cloth = make_cloth(d.mesh, d.options);
          ClothState state = start_state(*cloth);
          set_positions(state, *cloth, d.x);
          set_velocities(state, *cloth, d.v);
          ThreadTeam team(1);
          const double dt = 1e-7;
          step(state, *cloth, d.loads, dt, 1, team);
          const std::vector<Vec3> v = velocities(state, *cloth), x = positions(state, *cloth);
          std::vector<char> rests(d.mesh.node_count(), 0), tied(d.mesh.node_count(), 0);
          for (int node : d.mesh.fixed) rests[node] = 1;
          for (const Tie& tie : d.mesh.ties) tied[tie.node] = 1;
          double worst = 0, scale = 0;
          for (int node = 0; node < d.mesh.node_count(); ++node) {
            if (tied[node]) continue;
            const Vec3 expected = rests[node] ? d.v[node] : d.v[node] + (dt / mass[node]) * force[node];
            worst = std::max(worst, norm(v[node] - expected));
            scale = std::max(scale, norm(expected - d.v[node]));
            EXPECT_LT(norm(x[node] - (d.x[node] + dt * v[node])), 1e-15) << node;
          }
          EXPECT_LT(worst, 3e-13 * scale + 2e-16) << "degree " << degree << " variant " << variant;
          for (const Tie& tie : d.mesh.ties) {
            Vec3 mean, speed;
            for (const auto& m : tie.masters) mean += m.weight * x[m.node], speed += m.weight * v[m.node];
            EXPECT_LT(norm(x[tie.node] - mean), 1e-15);
            EXPECT_LT(norm(v[tie.node] - speed), 1e-13);
          }
        }
}

double work_of_pressure() {
  const Mesh mesh = rectangle(7, 21, 0.01);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  ThreadTeam team(1);
  StepRecord record;
  step(state, *cloth, {std::vector<double>(mesh.cell_count(), 400.0), {}}, 1e-6, 200, team, &record);
  return record.pressure_work;
}

TEST(ClothKernel, ForcesAndWorkAgreeWithTheScalarReferenceOnEveryInstructionSet) {
  std::set<std::string> tried;
  std::vector<double> works;
  for (const auto target : {HWY_AVX3, HWY_AVX2, HWY_SSE4, HWY_SCALAR}) {
    if ((hwy::SupportedTargets() & target) == 0 && target != HWY_SCALAR) continue;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    tried.insert(kernel_target());
    SCOPED_TRACE(kernel_target());
    expect_reference_forces();
    works.push_back(work_of_pressure());
    EXPECT_NEAR(works.back() / works.front(), 1, 1e-12);
    hwy::SetSupportedTargetsForTest(0);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GE(tried.size(), 2u);
  EXPECT_GT(works.front(), 0);
}

TEST(ClothKernel, TenThousandStepsAreTheSameToTheLastBitOnAnyNumberOfThreads) {
  const Driven d = driven(2, 0.001, true, true, {false, 8.2});
  const ClothPtr cloth = make_cloth(d.mesh, d.options);
  ClothState first;
  for (int threads : {1, 2, 3, 4, 7}) {
    ThreadTeam team(threads);
    ClothState state = start_state(*cloth);
    set_positions(state, *cloth, d.mesh.start);
    set_velocities(state, *cloth, d.v);
    const double dt = 0.5 * stability_limit(*cloth, state).stable_step;
    step(state, *cloth, d.loads, dt, threads <= 4 ? 10000 : 500, team);
    if (threads == 1) {
      first = state;
      continue;
    }
    ClothState compared = first;
    if (threads > 4) {
      ThreadTeam alone(1);
      compared = start_state(*cloth);
      set_velocities(compared, *cloth, d.v);
      step(compared, *cloth, d.loads, dt, 500, alone);
    }
    EXPECT_EQ(positions(state, *cloth), positions(compared, *cloth)) << threads << " threads";
    EXPECT_EQ(velocities(state, *cloth), velocities(compared, *cloth)) << threads << " threads";
  }
}

TEST(ClothKernel, StepsInOneCallOrInManyAreTheSame) {
  const Driven d = driven(2, 0.001, true, true, {});
  const ClothPtr cloth = make_cloth(d.mesh, d.options);
  ThreadTeam team(2);
  ClothState once = start_state(*cloth), often = once;
  step(once, *cloth, d.loads, 1e-6, 60, team);
  for (int i = 0; i < 20; ++i) step(often, *cloth, d.loads, 1e-6, 3, team);
  EXPECT_EQ(positions(once, *cloth), positions(often, *cloth));
  EXPECT_EQ(once.steps, often.steps);
  EXPECT_NEAR(once.time, often.time, 1e-18);
}

}  // namespace
}  // namespace ripstop
