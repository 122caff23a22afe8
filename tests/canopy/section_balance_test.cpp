// The stress field against the load, family by family: the force through a section across the axis equals the
// air load beyond it.
#include "ripstop/canopy/section_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../blown_up.h"
#include "../parachute/examples.h"
#include "ripstop/case/assemble.h"
#include "ripstop/fsi/sheet_transfer.h"

namespace ripstop {
namespace {

class SectionBalanceOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, SectionBalanceOf, testing::ValuesIn(family_examples()), name_of_example);

TEST_P(SectionBalanceOf, TheStressFieldCarriesTheLoadBeyondEverySection) {
  const Mesh mesh = parachute_mesh(resolve(example(GetParam(), 6000)));
  const BlownUp canopy = blown_up(mesh, 240, 1e-3);
  const std::vector<Vec3> load =
      node_forces({canopy.loads.cell_pressure, {}}, cells_of(mesh), canopy.positions());
  EXPECT_LT(largest_section_gap(mesh, *canopy.cloth, canopy.state, load), 0.02);

  // A tenth of the load that is missing in the stress is detected.
  std::vector<Vec3> more = load;
  for (Vec3& force : more) force = 1.1 * force;
  EXPECT_GT(largest_section_gap(mesh, *canopy.cloth, canopy.state, more), 0.05);
}

// A cord that hangs with a load at its end: every section carries it.
TEST(SectionBalance, ACordCarriesTheWeightBelowIt) {
  Mesh mesh;
  mesh.start = {{0, 0, 0}, {0.1, 0, 1}};
  mesh.mass = {1, 1};
  mesh.laws = {SpringLaw{.coefficients = {1000}}};
  mesh.parts = {"cord"};
  mesh.springs = {{.a = 0, .b = 1, .rest_length = 1}};
  mesh.fixed = {0};
  const ClothPtr cloth = make_cloth(mesh);
  const ClothState state = start_state(*cloth);
  const double length = std::sqrt(1.01), tension = 1000 * (length - 1);
  const SectionBalance balance = section_balance(mesh, *cloth, state, {{}, {0, 0, 3}}, 0.5, 0.2);
  EXPECT_NEAR(balance.cord_force, tension / length, 1e-12);
  EXPECT_EQ(balance.cloth_force, 0);
  EXPECT_EQ(balance.seam_force, 0);
  EXPECT_NEAR(balance.air_force, 3, 1e-12);
  EXPECT_NEAR(balance.gap(), tension / length - 3, 1e-12);
}

}  // namespace
}  // namespace ripstop
