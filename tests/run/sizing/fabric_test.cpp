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
      run_watched_fabric(canopy(), 240, 1, [&](const RelaxProgress&, const auto& positions) {
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
  EXPECT_THROW(run_watched_fabric(canopy(), 240, 1,
                                  [&](const RelaxProgress&, const auto&) {
                                    ++seen;
                                    throw Enough();
                                  }),
               Enough);
  EXPECT_EQ(seen, 1);
}

TEST(Fabric, IsTheSameWithAnyNumberOfThreads) {
  const FabricSolution one = run_fabric(canopy(), 240), three = run_watched_fabric(canopy(), 240, 3, {});
  EXPECT_EQ(three.shape, one.shape);
  EXPECT_EQ(three.result.inputs_hash, one.result.inputs_hash);
}

}  // namespace
}  // namespace ripstop
