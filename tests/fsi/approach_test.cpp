#include "ripstop/fsi/approach.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "../small_case.h"
#include "ripstop/canopy/shape.h"
#include "ripstop/case/assemble.h"
#include "ripstop/fsi/ledger.h"
#include "ripstop/fsi/transfer.h"

namespace ripstop {
namespace {

// Mean of a + b x + c (x^2 + y^2) over a disk of radius R about the axis: a + c R^2 / 2; interpolation adds at
// most c h^2 / 2.
TEST(Approach, IsTheMeanOverTheAreaOfADisk) {
  FlowField field;
  field.grid = {{-1, -1, 0}, {2, 2, 1}, 80, 80, 4};
  const FlowGrid& grid = field.grid;
  field.velocity.resize(grid.cells());
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        const Vec3 p = grid.centre(i, j, k);
        field.velocity[grid.index(i, j, k)] = {5, 6, 20 + 3 * p.x - 8 * (p.x * p.x + p.y * p.y)};
      }
  EXPECT_NEAR(mean_speed_over_disk(field, {0, 0, 0.5}, 1.2), 20 - 8 * 0.36 / 2, 8 * 0.025 * 0.025);
}

// In air whose speed rises with z the mean shows the position of the measurement.
TEST(Approach, IsOneProjectedDiameterBeforeTheCloth) {
  const Case given = checked(flat_circular_case(1, 800, 20));
  CanopyMesh mesh = parachute_mesh(resolve(given));
  FlowField field;
  field.grid = {{-1, -1, 0}, {2, 2, 8}, 8, 8, 160};
  for (int cell = 0; cell < field.grid.cells(); ++cell)
    field.velocity.push_back({0, 0, 2 * field.grid.centre(2, cell / 64)});
  double front = 8;
  for (const Triangle& t : surface_of(cells_of(mesh), mesh.start))
    front = std::min({front, t.a.z, t.b.z, t.c.z});
  const double diameter = canopy_size(mesh, mesh.start).projected_diameter;
  ASSERT_GT(front, diameter);
  EXPECT_NEAR(approach_speed(field, mesh, mesh.start), 2 * (front - diameter), 1e-9);
}

// Forces of rigid bodies upstream are not part of the canopy's row.
TEST(Ledger, HasTheForceAndTheMomentumDeficitOfTheCanopyAlone) {
  const Case given = checked(flat_circular_case(1, 800, 20));
  const CanopyMesh mesh = parachute_mesh(resolve(given));
  FlowField field;
  field.grid = {{-1, -1, 0}, {2, 2, 8}, 4, 4, 16};
  field.velocity.assign(field.grid.cells(), {0, 0, 20});
  field.bodies = {{{1, 0, 60}, {}}, {{0, 0, 12}, {}}, {{0, 2, 5}, {}}};
  field.porous_force = {1, 2, 77};
  field.momentum_deficit = {1, 2, 78};
  SteadyIteration now;
  enter_flow(now, {}, field, mesh, mesh.start);
  EXPECT_DOUBLE_EQ(now.fluid_force, 60);
  EXPECT_DOUBLE_EQ(now.momentum_deficit, 61);
}

}  // namespace
}  // namespace ripstop
