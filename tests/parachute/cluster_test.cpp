// Clusters: the canopies of one mesh, and their frames.
#include "ripstop/parachute/cluster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "../refusal.h"
#include "../small_case.h"
#include "ripstop/canopy/mirror.h"
#include "ripstop/case/assemble.h"
#include "ripstop/parachute/scale.h"

namespace ripstop {
namespace {

constexpr double one_degree = std::numbers::pi / 180;

CanopyMesh small_canopy(double ratio = 1) {
  Case given = flat_circular_case(1, 500, 20);
  given.parachute.riser.length_m = 1;
  given.parachute.mesh.line_segment_m = 0.25;
  given.parachute = in_size(given.parachute, ratio);
  return parachute_mesh(resolve(checked(given)));
}

TEST(Cluster, TheMeshHasTheNodesSpringsAndCellsOfEveryCanopy) {
  const CanopyMesh one = small_canopy();
  const Cluster cluster(one, {3, 20 * one_degree});
  const CanopyMesh all = cluster.mesh();
  EXPECT_EQ(all.node_count(), 3 * one.node_count());
  EXPECT_EQ(all.springs.size(), 3 * one.springs.size());
  EXPECT_EQ(all.cell_count(), 3 * one.cell_count());
  EXPECT_EQ(all.rigging.lines.size(), 3 * one.rigging.lines.size());
  ASSERT_EQ(all.fixed.size(), 3u);
  for (const int node : all.fixed) EXPECT_LT(norm(all.start[node] - cluster.confluence()), 1e-12);
  // The geometry is that of one canopy: lengths between the nodes of every spring.
  for (std::size_t s = 0; s < all.springs.size(); ++s) {
    const Spring &spring = all.springs[s], &of_one = one.springs[s % one.springs.size()];
    EXPECT_NEAR(norm(all.start[spring.b] - all.start[spring.a]),
                norm(one.start[of_one.b] - one.start[of_one.a]), 1e-12);
  }
  const auto sum = [](const std::vector<double>& mass) {
    return std::accumulate(mass.begin(), mass.end(), 0.0);
  };
  EXPECT_NEAR(sum(all.mass), 3 * sum(one.mass), 1e-12);
}

TEST(Cluster, EveryAxisIsInclinedByTheSpreadAngleAtTheHeightOfOneCanopy) {
  const CanopyMesh one = small_canopy();
  const auto skirt = [](const CanopyMesh& mesh, int k, int canopies) {
    const std::vector<int>& nodes = mesh.rigging.skirt_nodes;
    const std::size_t count = nodes.size() / static_cast<std::size_t>(canopies);
    Vec3 centre;
    for (std::size_t n = 0; n < count; ++n)
      centre += mesh.start[nodes[static_cast<std::size_t>(k) * count + n]] / double(count);
    return centre;
  };
  for (int canopies = fewest_in_cluster; canopies <= most_in_cluster; ++canopies) {
    const Cluster cluster(one, {canopies, 25 * one_degree});
    const CanopyMesh all = cluster.mesh();
    for (int k = 0; k < canopies; ++k) {
      const Vec3 centre = skirt(all, k, canopies), axis = centre - cluster.confluence();
      EXPECT_NEAR(std::acos(axis.z / norm(axis)), 25 * one_degree, 1e-9);
      EXPECT_NEAR(
          std::remainder(std::atan2(axis.y, axis.x) - cluster.layout().azimuth(k), 2 * std::numbers::pi), 0,
          1e-9);
      EXPECT_NEAR(centre.z, skirt(one, 0, 1).z, 1e-9);
    }
  }
}

TEST(Cluster, OfTwoAndFourHasPlanesOfSymmetryAndOfThreeHasNot) {
  const CanopyMesh one = small_canopy();
  EXPECT_TRUE(mirror_images(Cluster(one, {2, 20 * one_degree}).mesh()));
  EXPECT_FALSE(mirror_images(Cluster(one, {3, 20 * one_degree}).mesh()));
  EXPECT_TRUE(mirror_images(Cluster(one, {4, 20 * one_degree}).mesh()));
}

TEST(Cluster, ACanopyThatTurnedAboutTheConfluenceIsTurnedBack) {
  const CanopyMesh one = small_canopy();
  const Cluster cluster(one, {3, 20 * one_degree});
  const std::vector<Vec3> start = cluster.own(1, cluster.mesh().start);
  std::vector<Vec3> turned = start;
  const Vec3 end = one.start[one.fixed.front()];
  for (Vec3& p : turned) {
    const Vec3 r = p - end;
    const double c = std::cos(0.1), s = std::sin(0.1);
    p = end + Vec3{c * r.x + s * r.z, r.y, c * r.z - s * r.x};
  }
  const std::vector<Vec3> back = cluster.upright(1, turned);
  for (std::size_t n = 0; n < back.size(); ++n) EXPECT_LT(norm(back[n] - start[n]), 1e-9);
}

TEST(Cluster, TheGapIsTwiceTheDistanceFromThePlaneBetweenNeighbours) {
  const Cluster cluster(small_canopy(), {2, 30 * one_degree});
  const CanopyMesh all = cluster.mesh();
  double nearest = 1e300;
  for (const Cell& cell : cells_of(all))
    for (const int node : cell.corner)
      if (node >= 0) nearest = std::min(nearest, std::abs(all.start[node].x));
  EXPECT_NEAR(cluster.gap(all.start), 2 * nearest, 1e-12);
  EXPECT_LT(Cluster(small_canopy(), {2, 2 * one_degree})
                .gap(Cluster(small_canopy(), {2, 2 * one_degree}).mesh().start),
            0);
}

TEST(Cluster, JoinedAtTheRisersHasOneFixedNodeWithTheMassOfAll) {
  for (const double riser : {1.0, 0.0}) {
    Case given = flat_circular_case(1, 500, 20);
    given.parachute.riser.length_m = riser;
    const CanopyMesh one = parachute_mesh(resolve(checked(given)));
    const CanopyMesh all = Cluster(one, {3, 40 * one_degree}).mesh();
    const JoinedCluster cluster = join_risers(all);
    const CanopyMesh& mesh = cluster.mesh;
    EXPECT_EQ(mesh.node_count(), all.node_count() - 2);
    ASSERT_EQ(mesh.fixed.size(), 1u);
    EXPECT_EQ(mesh.rigging.canopies, 3);
    const auto sum = [](const std::vector<double>& mass) {
      return std::accumulate(mass.begin(), mass.end(), 0.0);
    };
    EXPECT_NEAR(sum(mesh.mass), sum(all.mass), 1e-12);
    EXPECT_NEAR(mesh.mass[mesh.fixed[0]], 3 * one.mass[one.fixed[0]], 1e-12);
    // Springs, cells and skirts have the same ends in the same places.
    for (std::size_t s = 0; s < all.springs.size(); ++s) {
      EXPECT_LT(norm(mesh.start[mesh.springs[s].a] - all.start[all.springs[s].a]), 1e-12);
      EXPECT_LT(norm(mesh.start[mesh.springs[s].b] - all.start[all.springs[s].b]), 1e-12);
    }
    const std::vector<Cell> cells = cells_of(mesh), before = cells_of(all);
    ASSERT_EQ(cells.size(), before.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (int k = 0; k < 4 && cells[c].corner[0] >= 0; ++k)
        EXPECT_EQ(mesh.start[cells[c].corner[k]], all.start[before[c].corner[k]]);
    EXPECT_LT(norm(skirt_centroid(mesh, mesh.start) - skirt_centroid(all, all.start)), 1e-12);
    std::vector<Vec3> moved = all.start;
    for (Vec3& p : moved) p.z += 1;
    EXPECT_EQ(cluster.joined(moved)[mesh.fixed[0]].z, mesh.start[mesh.fixed[0]].z + 1);
    EXPECT_EQ(mesh.patches.back().piece, 2);
  }
}

TEST(Cluster, OfTwoSizesHasEachMeshOnARiserToTheSameConfluence) {
  constexpr double ratio = 0.6, tilt = 25 * one_degree;
  const std::vector<CanopyMesh> meshes{small_canopy(ratio), small_canopy()};
  const Cluster cluster(meshes, {2, tilt});
  const CanopyMesh all = cluster.mesh();
  EXPECT_FALSE(cluster.equal());
  for (const int node : all.fixed) EXPECT_LT(norm(all.start[node] - cluster.confluence()), 1e-12);
  const std::size_t springs = meshes[0].springs.size();
  for (std::size_t s = 0; s < all.springs.size(); ++s) {
    const Spring &spring = all.springs[s], &own = meshes[s / springs].springs[s % springs];
    const std::vector<Vec3>& x = meshes[s / springs].start;
    EXPECT_NEAR(norm(all.start[spring.b] - all.start[spring.a]), norm(x[own.b] - x[own.a]), 1e-12);
    EXPECT_EQ(spring.rest_length, own.rest_length);
    EXPECT_EQ(all.laws[spring.law].coefficients, meshes[s / springs].laws[own.law].coefficients);
  }
  // The skirt of the larger one has the height of its own mesh, the other one is nearer to the confluence.
  const auto arm = [&](int k) {
    const std::vector<int> skirt = of_canopy(all.rigging.skirt_nodes, k, 2);
    Vec3 centre;
    for (const int node : skirt) centre += all.start[node] / double(skirt.size());
    return centre - cluster.confluence();
  };
  EXPECT_NEAR(arm(1).z + cluster.confluence().z, skirt_centroid(meshes[1], meshes[1].start).z, 1e-9);
  EXPECT_NEAR(norm(arm(0)) / norm(arm(1)), ratio, 1e-9);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(std::acos(arm(k).z / norm(arm(k))), tilt, 1e-9);
    const std::vector<Vec3> own = cluster.own(k, all.start), back = cluster.upright(k, own);
    for (std::size_t n = 0; n < own.size(); ++n) {
      EXPECT_LT(norm(own[n] - meshes[static_cast<std::size_t>(k)].start[n]), 1e-9);
      EXPECT_LT(norm(back[n] - own[n]), 1e-9);
    }
  }
  // Laid over each other they coincide, to the rounding of a start shape that is found by iterations.
  const std::vector<Vec3> overlaid = cluster.overlaid(all.start), first = of_canopy(overlaid, 0, 2),
                          second = of_canopy(overlaid, 1, 2);
  for (std::size_t n = 0; n < first.size(); ++n) EXPECT_LT(norm(first[n] - second[n]), 1e-8);
  EXPECT_FALSE(mirror_images(all)) << "the plane x = 0 is no plane of symmetry";
}

TEST(Cluster, RefusesMeshesOfOtherTopology) {
  Case other = flat_circular_case(1, 900, 20);
  other.parachute.riser.length_m = 1;
  const std::string text = refusal_of(
      [&] {
        Cluster(std::vector<CanopyMesh>{small_canopy(), parachute_mesh(resolve(checked(other)))}, {2, 0.3});
      },
      ExitCode::usage);
  EXPECT_NE(text.find("differ in more than their size"), std::string::npos) << text;
}

TEST(Cluster, RefusesACanopyThatIsHeldAtSeveralPoints) {
  CanopyMesh one = small_canopy();
  one.fixed.push_back(0);
  EXPECT_NE(refusal_of(
                [&] {
                  Cluster(one, {3, 0.3});
                },
                ExitCode::usage)
                .find("2 fixed nodes"),
            std::string::npos);
}

}  // namespace
}  // namespace ripstop
