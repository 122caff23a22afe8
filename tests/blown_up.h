// A canopy at rest under a uniform pressure.
#pragma once

#include <gtest/gtest.h>

#include "ripstop/cloth/cloth.h"

namespace ripstop {

struct BlownUp {
  ClothPtr cloth;
  ClothState state;
  Loads loads;

  std::vector<Vec3> positions() const { return ripstop::positions(state, *cloth); }
  /// Reaction of the fixed nodes over the force of the pressure, along the axis.
  double held_share() const {
    return force_on_fixed(*cloth, state).z / pressure_force(*cloth, state, loads).z;
  }
};

/// `pressure` [Pa]; relaxed until the forces that are left are `tolerance` of those that act.
inline BlownUp blown_up(const Mesh& mesh, double pressure, double tolerance) {
  BlownUp canopy{make_cloth(mesh), {}, {std::vector<double>(mesh.cell_count(), pressure), {}}};
  canopy.state = start_state(*canopy.cloth);
  ThreadTeam team(1);
  RelaxOptions options;
  options.tolerance = tolerance;
  const RelaxResult result = relax(canopy.state, *canopy.cloth, canopy.loads, options, team);
  EXPECT_TRUE(result.converged) << result.residual;
  return canopy;
}

}  // namespace ripstop
