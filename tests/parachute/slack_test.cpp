// Canopies that hang in hardly any wind: slack cloth of stiff threads.
#include <gtest/gtest.h>

#include <filesystem>

#include "ripstop/case/assemble.h"
#include "ripstop/case/case.h"
#include "ripstop/cloth/cloth.h"

namespace ripstop {
namespace {

// Cloth that moved by its nodes alone took 12,362 steps here, and on 25,000 nodes under 5 Pa found no rest in 200,000.
TEST(SlackCanopy, ACrossUnderTwentyPascalComesToRest) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / "cross" / "case.toml");
  given.parachute.mesh.cloth_nodes = 3000;
  given.flow.porosity_model = PorosityModel::sheet;
  const CanopyMesh mesh = parachute_mesh(resolve(given));
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  const Loads loads{std::vector<double>(mesh.cell_count(), 20.0), {}};
  ThreadTeam team(1);
  RelaxOptions options;
  options.tolerance = 5e-4;
  const RelaxResult result = relax(state, *cloth, loads, options, team);
  EXPECT_TRUE(result.converged) << result.residual;
  EXPECT_LT(result.steps, 10000);
}

}  // namespace
}  // namespace ripstop
