// The closed mouth of an opening whose case gives no radius.
#include "ripstop/case/deployment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <string>

#include "ripstop/case/assemble.h"
#include "ripstop/case/case.h"
#include "ripstop/case/opening.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/fsi/folded_start.h"
#include "ripstop/parachute/fold.h"

namespace ripstop {
namespace {

class ClosedMouth : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Examples, ClosedMouth,
                         testing::Values("annular", "conical", "elliptical", "extended-skirt",
                                         "flat-circular", "hemispherical", "hexagon", "quarter-spherical",
                                         "ringslot"),
                         [](const auto& example) {
                           std::string name = example.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(ClosedMouth, FoldsWithoutStrainAndPiercedEdges) {
  Overrides overrides;
  overrides.set = {{"parachute.mesh.cloth_nodes", "2000"}};
  Case given =
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / GetParam() / "case.toml", overrides);
  given.inflation.initial_radius_m.reset(), given.inflation.folds = 0;
  close_mouth(given.parachute, given.inflation);
  const Settings resolved = resolve(opening_case(given));
  const CanopyMesh mesh = parachute_mesh(resolved);
  const Design& design = resolved.parachute();
  const double radius = *resolved.inflation().initial_radius_m;
  EXPECT_LT(radius, 0.15 * nominal_diameter(design));
  ThreadTeam team(1);
  const FoldedStart start = folded_start(mesh, {radius, resolved.inflation().folds, 0},
                                         std::gcd(design.gores, design.lines.count), team);
  EXPECT_NEAR(0.5 * (start.inner_radius + start.outer_radius) / radius, 1, 0.02);
  EXPECT_EQ(pierced_share(mesh, start.positions), 0);
  const StartStrain strain = start_strain(with_creases(mesh, start), start.positions);
  EXPECT_LT(strain.largest, 1e-3) << strain.part;
}

}  // namespace
}  // namespace ripstop
