// The stress field against the load, family by family: what a cut across the axis carries is what the air
// does beyond it, and the air of a straight flow turns no canopy about its axis.
#include "ripstop/canopy/cut_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "ripstop/case/assemble.h"
#include "ripstop/case/case.h"
#include "ripstop/coupling/sheet_transfer.h"

namespace ripstop {
namespace {

class CutBalanceOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, CutBalanceOf,
                         testing::Values("stratos-iv", "walrus", "flat-circular", "conical", "hemispherical",
                                         "quarter-spherical", "extended-skirt", "ringslot", "adept", "cross",
                                         "elliptical"),
                         [](const auto& family) {
                           std::string name = family.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

struct Extent {
  double low = 1e300, high = -1e300;
};

/// Of the cloth along z, where it is now.
Extent extent_of(const std::vector<Cell>& cells, const std::vector<Vec3>& x) {
  Extent z;
  for (const Cell& cell : cells) {
    if (cell.corner[0] < 0) continue;
    for (const int node : cell.corner) z = {std::min(z.low, x[node].z), std::max(z.high, x[node].z)};
  }
  return z;
}

TEST_P(CutBalanceOf, ACutCarriesTheLoadBeyondItAndNoMomentAboutTheAxis) {
  Overrides coarse;
  coarse.set = {{"parachute.mesh.cloth_nodes", "6000"}};
  const Mesh mesh = parachute_mesh(
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / GetParam() / "case.toml", coarse));
  const std::vector<Cell> cells = cells_of(mesh);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  ThreadTeam team(2);
  RelaxOptions options;
  options.tolerance = 1e-3;
  std::vector<double> pressure(cells.size(), 240.0);
  for (const bool uniform : {true, false}) {
    if (!uniform) {
      // As a flow loads a canopy: most at the crown, less toward the skirt.
      const std::vector<Vec3> x = positions(state, *cloth);
      const auto [low, high] = extent_of(cells, x);
      for (std::size_t c = 0; c < cells.size(); ++c) {
        if (cells[c].corner[0] < 0) continue;
        const double up = (x[cells[c].corner[0]].z - low) / (high - low);
        pressure[c] = 240 * (0.6 + 0.6 * up);
      }
    }
    ASSERT_TRUE(relax(state, *cloth, {pressure, {}}, options, team).converged);
    const std::vector<Vec3> x = positions(state, *cloth);
    const std::vector<Vec3> load = node_forces({pressure, {}}, cells, x);
    const std::vector<CellStress> stress = cell_stress(*cloth, state);
    const std::vector<double> tensions = spring_tensions(*cloth, state);
    const auto [low, high] = extent_of(cells, x);
    double whole = 0;
    for (const Vec3& f : load) whole += f.z;
    for (const double share : {-0.2, 0.15, 0.3, 0.45, 0.6, 0.75}) {
      const CutBalance cut = cut_balance(mesh, x, stress, tensions, load, low + share * (high - low));
      EXPECT_NEAR((cut.cloth_force + cut.cord_force) / cut.air_force, 1, 0.02)
          << share << ": cloth " << cut.cloth_force << " cords " << cut.cord_force << " whole " << whole;
      EXPECT_NEAR(cut.moment / (whole * 0.5 * (high - low)), 0, 2e-3) << share;
      EXPECT_NEAR(cut.air_moment / (whole * 0.5 * (high - low)), 0, 2e-3) << share;
    }
  }
}

}  // namespace
}  // namespace ripstop
