// Steady runs of clusters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../../refusal.h"
#include "../../small_case.h"
#include "ripstop/case/quantity_keys.h"
#include "ripstop/core/file.h"
#include "ripstop/run/descent/descent.h"
#include "ripstop/run/steady/finished_steady.h"
#include "ripstop/run/steady/steady_folder.h"

namespace ripstop {
namespace {

Case two_canopies(double spread_angle_deg) {
  Case given = flat_circular_case(0.6, 500, 20);
  given.parachute.riser.length_m = 0.6;
  given.parachute.mesh.line_segment_m = 0.2;
  given.cluster = ClusterKeys{2, spread_angle_deg, false, 0.7};
  given.flow.box_m = Vec3{2.8, 1.8, 2.8};
  given.flow.cells = {40, 26, 32};
  given.flow.canopy_position_m = 1.2;
  given.flow.core.size_m = Vec3{};
  given.flow.symmetry = FlowSymmetry::quarter;
  given.flow.max_iterations = 150;
  given.flow.average_over = 30;
  given.coupling.load = CanopyLoad::uniform;
  given.coupling.drag_tolerance = 0.02;
  given.coupling.max_iterations = 6;
  given.coupling.threads = 1;
  return given;
}

TEST(SteadyCluster, CanopiesShareTheDragAndTheForcesBalance) {
  const TemporaryFolder folder("cluster");
  SteadyObserver silent;
  const SteadyFolderSettings settings{{folder.path / "run", false}, 1, {}, {}, false};
  const SteadyResult r = run_steady_in(settings, resolve(checked(two_canopies(24))), silent).result;
  EXPECT_TRUE(r.converged);
  EXPECT_EQ(r.domain->part, "quarter");
  EXPECT_NEAR(r.reference_area, 2 * std::acos(-1.0) * 0.09, 0.01);
  ASSERT_TRUE(r.cluster);
  ASSERT_EQ(r.cluster->canopies.size(), 2u);
  const ClusterCanopy &a = r.cluster->canopies[0], &b = r.cluster->canopies[1];
  EXPECT_NEAR(a.drag + b.drag, r.drag, 1e-6 * r.drag);
  EXPECT_NEAR(a.force / b.force, 1, 1e-3);
  EXPECT_NEAR(a.spreading_moment, b.spreading_moment, 0.02 * a.force);
  EXPECT_NEAR(r.ledger.line_tension / r.drag, 1, 0.01);
  EXPECT_NEAR(r.ledger.momentum_deficit / r.drag, 1, 0.02);
  EXPECT_GT(r.cluster->gap, 0.1);
  EXPECT_NEAR(r.cluster->cluster_factor.value(), r.drag_coefficient / 0.7, 1e-12);
  // The riser carries the force of its canopy, and twice that when the other one fails.
  const auto riser = [](const Margins& margins) {
    return std::find_if(margins.members.begin(), margins.members.end(),
                        [](const Margin& m) { return m.member == "riser"; })
        ->load;
  };
  EXPECT_NEAR(riser(*r.margins) / a.force, 1, 0.05);
  EXPECT_NEAR(riser(r.cluster->one_failed), 2 * riser(*r.margins), 1e-9 * a.force);
  // Its drag area is not that of one canopy.
  EXPECT_NE(refusal_of([&] { carrying_run(finished_steady(folder.path / "run")); }, ExitCode::usage)
                .find("cluster.canopies = 2"),
            std::string::npos);
}

TEST(SteadyCluster, CanopiesThatTouchWhenInflatedAreRefusedWithBothRemedies) {
  Case given = two_canopies(9);
  SteadyObserver silent;
  Settings resolved = resolve(checked(given));
  const std::string text = refusal_of(
      [&] {
        try {
          run_steady(resolved, silent);
        } catch (const Error& error) {
          throw Error(error.code(), message_of(error));
        }
      },
      ExitCode::usage);
  EXPECT_NE(text.find("cluster.spread_angle_deg"), std::string::npos) << text;
  EXPECT_NE(text.find("parachute.riser.length_m"), std::string::npos) << text;
}

}  // namespace
}  // namespace ripstop
