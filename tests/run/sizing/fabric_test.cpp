#include "ripstop/run/sizing/fabric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "../../small_case.h"

namespace ripstop {
namespace {

struct Enough {};

Settings canopy() {
  Case given = flat_circular_case(1, 1000, 20);
  given.parachute.canopy_material = "f-111";
  given.coupling.threads = 1;
  apply({}, given);
  return resolve(given);
}

TEST(Fabric, AWatchSeesAllNodesAndChangesNothing) {
  const FabricSolution plain = run_fabric(canopy(), 240);
  std::size_t seen = 0;
  std::vector<Vec3> last;
  const FabricSolution watched =
      run_fabric_from(canopy(), 240, {}, [&](const RelaxProgress&, const auto& positions) {
        ++seen;
        last = positions();
        ASSERT_EQ(last.size(), plain.shape.size());
      });
  EXPECT_GT(seen, 1U);
  EXPECT_EQ(watched.shape, plain.shape);
  double most = 0;
  for (std::size_t i = 0; i < last.size(); ++i) most = std::max(most, norm(last[i] - plain.shape[i]));
  EXPECT_LT(most, 1e-2);
}

TEST(Fabric, AnExceptionOfTheWatchEndsTheRelaxation) {
  int seen = 0;
  EXPECT_THROW(run_fabric_from(canopy(), 240, {},
                               [&](const RelaxProgress&, const auto&) {
                                 ++seen;
                                 throw Enough();
                               }),
               Enough);
  EXPECT_EQ(seen, 1);
}

TEST(Fabric, FromItsOwnEquilibriumItIsThereAtOnce) {
  const FabricSolution cold = run_fabric(canopy(), 240);
  const FabricSolution again = run_fabric_from(canopy(), 240, cold.shape, {});
  EXPECT_TRUE(again.result.converged);
  EXPECT_LT(again.result.steps, 100);
  EXPECT_NEAR(again.result.size.projected_diameter / cold.result.size.projected_diameter, 1, 1e-3);
}

}  // namespace
}  // namespace ripstop
