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

TEST(Fabric, HasTheMarginOfItsWeakestMemberAndAWarningBelowZero) {
  const FabricResult strong = run_fabric(canopy(), 240).result;
  ASSERT_TRUE(strong.margins);
  EXPECT_GT(*weakest(*strong.margins)->margin, 0);
  EXPECT_EQ(strong.margins->members.front().load, std::max(strong.stress.warp, strong.stress.weft));
  Case given = canopy().written();
  Line line = suspension_line(given);
  line.break_load_n = 1;
  given.materials.insert_or_assign(line.name, line);
  const FabricResult weak = run_fabric(resolve(given), 240).result;
  EXPECT_EQ(weak.margins->weakest.find("line "), 0u) << weak.margins->weakest;
  EXPECT_TRUE(std::any_of(weak.warnings.begin(), weak.warnings.end(), [](const std::string& text) {
    return text.find("exceeds its allowable load") != std::string::npos;
  }));
}

}  // namespace
}  // namespace ripstop
