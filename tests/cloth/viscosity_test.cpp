// The viscosity of the cloth: its energy loss, and its effect on the stable step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "builders.h"
#include "ripstop/fsi/opening.h"

namespace ripstop {
namespace {

using namespace testing;

constexpr double tau = 1e-5;  // [s]

Mesh viscous_rectangle(int rows, int columns, double spacing, double viscosity_time = tau) {
  Mesh mesh = rectangle(rows, columns, spacing);
  damp_springs(mesh, 0, viscosity_time);
  return mesh;
}

// The power that dampers take from cloth pulled along its rows at the rate r is tau K_axial r^2 a unit of
// area, up to the springs over two cells that the two edges lack: an error of first order in the spacing.
TEST(Viscosity, UniformStretchingLosesTauTimesKWhateverTheMesh) {
  const double rate = 3, edge = 0.2;
  std::vector<double> error;
  for (int cells : {20, 40, 80}) {
    Mesh mesh = viscous_rectangle(cells + 1, cells + 1, edge / cells);
    Patch& patch = mesh.patches[0];
    patch.viscosity[shear_up] = patch.viscosity[shear_down] = 0;
    const double own_bending = tau * patch.law[bend_row].tangent(0);
    patch.viscosity[bend_row] -= own_bending;
    const ClothPtr cloth = make_cloth(mesh);
    ClothState state = start_state(*cloth);
    std::vector<Vec3> v;
    for (const Vec3 x : positions(state, *cloth)) v.push_back({rate * x.x, 0, 0});
    set_velocities(state, *cloth, v);
    const double before = kinetic_energy(*cloth, state), dt = 1e-10;
    ThreadTeam team(1);
    step(state, *cloth, {}, dt, 1, team);
    const double power = (before - kinetic_energy(*cloth, state)) / dt;
    error.push_back(power / (tau * patch.law[along_row].tangent(0) * rate * rate * edge * edge) - 1);
  }
  EXPECT_LT(std::abs(error[2]), 0.02);
  EXPECT_NEAR(error[0] / error[1], 2, 0.1);
  EXPECT_NEAR(error[1] / error[2], 2, 0.1);
}

// A tenth of the cells are a third as large, as at the vent: there the dampers would make the step smaller.
Mesh with_small_cells(double viscosity_time) {
  Mesh mesh;
  const auto position = [](int row, int column) {
    const double y = row < 18 ? 0.01 * row : 0.18 + 0.0033 * (row - 18);
    return Vec3{0.01 * column, y, 0};
  };
  add_patch(mesh, {.rows = 20, .columns = 20, .position = position, .rest = position}, {});
  damp_springs(mesh, 0, viscosity_time);
  return mesh;
}

double stable_step_of(const Mesh& mesh) {
  const ClothPtr cloth = make_cloth(mesh);
  return stability_limit(*cloth, start_state(*cloth)).stable_step;
}

TEST(Viscosity, ALimitedOneLeavesTheStepItsShare) {
  const double without = stable_step_of(with_small_cells(0));
  for (const double time : {1e-6, 1e-5, 1e-3}) {
    Mesh mesh = with_small_cells(time);
    limit_viscosity(mesh, {}, mesh.start, 0.97);
    const double limited = stable_step_of(mesh);
    EXPECT_GT(limited / (0.97 * without) - 1, -2e-8) << time;  // the eigenvalues hold to sqrt(2e-16)
    EXPECT_LE(limited, without) << time;
  }
  EXPECT_LT(stable_step_of(with_small_cells(1e-5)), 0.5 * without);
}

TEST(Viscosity, OnlyCellsWhoseDampersWouldSetTheStepLoseSomeOfTheirs) {
  Mesh mesh = with_small_cells(1e-6);
  const ViscosityLimit limit = limit_viscosity(mesh, {}, mesh.start, 0.97);
  EXPECT_GT(limit.least_share, 0);
  EXPECT_LT(limit.least_share, 1);
  EXPECT_GT(limit.reduced_cells, 0.05);
  EXPECT_LT(limit.reduced_cells, 0.3);
  const Patch& patch = mesh.patches[0];
  for (int column = 0; column < patch.columns; ++column)
    EXPECT_EQ(patch.viscosity_share[patch.share_index(along_row, 5, column)], 1) << column;

  Mesh weak = with_small_cells(1e-9);
  EXPECT_EQ(limit_viscosity(weak, {}, weak.start, 0.97).least_share, 1);
}

TEST(Viscosity, ClothWithoutDampersIsNotAmongTheCellsThatAreReduced) {
  const ViscosityLimit alone = [] {
    Mesh mesh = with_small_cells(1e-6);
    return limit_viscosity(mesh, {}, mesh.start, 0.97);
  }();
  Mesh mesh = with_small_cells(1e-6);
  const auto position = [](int row, int column) { return Vec3{0.01 * column, 1 + 0.01 * row, 0}; };
  add_patch(mesh, {.rows = 20, .columns = 20, .position = position, .rest = position}, {});
  const ViscosityLimit beside = limit_viscosity(mesh, {}, mesh.start, 0.97);
  EXPECT_EQ(beside.reduced_cells, alone.reduced_cells);
  EXPECT_TRUE(mesh.patches[1].viscosity_share.empty());
}

TEST(Viscosity, ARepeatedLimitChangesNothing) {
  Mesh once = with_small_cells(1e-5);
  limit_viscosity(once, {}, once.start, 0.97);
  Mesh twice = once;
  limit_viscosity(twice, {}, twice.start, 0.97);
  const std::vector<double>& a = once.patches[0].viscosity_share;
  const std::vector<double>& b = twice.patches[0].viscosity_share;
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12) << i;
}

TEST(Viscosity, TheRemainingShareOfACellIsReducedFurther) {
  Mesh half = with_small_cells(50 * tau);
  half.patches[0].viscosity_share.assign(std::size_t(half.patches[0].rows * half.patches[0].columns), 0.5);
  const ClothOptions options;
  const ViscosityLimit limit = limit_viscosity(half, options, half.start, 0.9);
  ASSERT_LT(limit.least_share, 1);
  double least = 1;
  for (const double share : half.patches[0].viscosity_share) least = std::min(least, share);
  EXPECT_NEAR(least, 0.5 * limit.least_share, 1e-12);
}

}  // namespace
}  // namespace ripstop
