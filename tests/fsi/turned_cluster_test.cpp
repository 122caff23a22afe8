// Equilibrium of the canopies of a cluster under loads that would change the spread angle.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../small_case.h"
#include "ripstop/case/assemble.h"
#include "ripstop/fsi/equilibrium.h"

namespace ripstop {
namespace {

TEST(ClusterEquilibrium, KeepsTheAngleByARestraintThatBalancesTheLineLoad) {
  Case given = flat_circular_case(1, 500, 20);
  given.parachute.riser.length_m = 0.5;
  given.parachute.mesh.line_segment_m = 0.25;
  given.cluster = ClusterKeys{2, 30, false, {}};
  const Cluster cluster = cluster_of(resolve(checked(given))).value();
  const CanopyMesh mesh = cluster.mesh();
  std::vector<ClothPtr> each;
  each.push_back(make_cloth(cluster.one()));
  const Cloth* one = each.front().get();
  const ClothPtr all = make_cloth(mesh);
  // A pressure, and a force on every node away from the axis of the cluster.
  Loads loads;
  loads.cell_pressure.assign(cells_of(mesh).size(), 50);
  for (int node = 0; node < mesh.node_count(); ++node)
    loads.node_force.push_back({node < mesh.node_count() / 2 ? 4e-3 : -4e-3, 0, 0});
  for (const int node : mesh.fixed) loads.node_force[node] = {};
  ThreadTeam team(1);
  EquilibriumOptions options;
  options.shape_is_loaded = false;
  const Equilibrium found = find_equilibrium(cluster, each, *all, mesh.start, loads, options, team);
  ASSERT_TRUE(found.converged);
  ASSERT_EQ(found.restraint.size(), mesh.start.size());
  const std::vector<Vec3> shape = positions(found.cloth, *all);
  // Force on the first riser: load and restraint of its canopy.
  const Vec3 riser = force_on(*all, found.cloth, {mesh.fixed.front()});
  Vec3 load =
      pressure_force(*one, cloth_at(*one, cluster.own(0, shape)), {cluster.part(0, loads.cell_pressure), {}});
  load = cluster.frame(0).out(load);
  Vec3 restraint;
  for (const Vec3& force : cluster.part(0, loads.node_force)) load += force;
  for (const Vec3& force : cluster.part(0, found.restraint)) restraint += force;
  EXPECT_LT(norm(riser - load - restraint), 0.01 * norm(load));
  EXPECT_GT(norm(restraint), 0.05 * norm(load));
  // The riser is inclined by the spread angle, and both canopies are alike.
  EXPECT_NEAR(std::atan2(riser.x, riser.z), std::numbers::pi / 6, 0.01);
  const std::vector<Vec3> first = cluster.own(0, shape), second = cluster.own(1, shape);
  for (std::size_t node = 0; node < first.size(); ++node) EXPECT_LT(norm(first[node] - second[node]), 1e-6);
}

}  // namespace
}  // namespace ripstop
