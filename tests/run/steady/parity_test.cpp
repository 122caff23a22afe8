#include "ripstop/run/steady/parity.h"

#include <gtest/gtest.h>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "tests/flow/cartesian/openfoam_installed.h"

namespace ripstop {
namespace {

// The box reaches from (-1, -1, 0) to (1, 1, 4) m.
TEST(FlowParity, ASurfaceThatLeavesTheBoxOnAnySideIsRefused) {
  const Vec3 beyond[] = {{-1.1, 0, 2}, {1.1, 0, 2}, {0, -1.1, 2}, {0, 1.1, 2}, {0, 0, -0.1}, {0, 0, 4.1}};
  for (const Vec3 corner : beyond) {
    ParitySettings settings;
    settings.surface = {{{0.1, 0, 2}, {0, 0.1, 2.1}, corner}};
    try {
      flow_parity(settings);
      ADD_FAILURE() << corner.x << ", " << corner.y << ", " << corner.z << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(std::string(error.what()).find("inside the domain"), std::string::npos) << error.what();
    }
  }
}

// At 60 m/s air gives by 1.5 % of its density: engines of different air would differ by more than they do.
TEST(FlowParity, OfTheSameAirTheEnginesHaveTheSameDrag) {
  if (!openfoam_is_installed()) GTEST_SKIP() << "OpenFOAM is not installed";
  for (const bool incompressible : {false, true}) {
    const TemporaryFolder folder("parity");
    ParitySettings settings;
    settings.cells = {12, 12, 18};
    settings.speed = 60;
    settings.threads = 1;
    settings.folder = folder.path / "flow";
    settings.incompressible = incompressible;
    settings.canopies = {"printed"};
    const std::vector<ParityRow> rows = flow_parity(settings).rows;
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].canopy, "printed");
    EXPECT_TRUE(rows[0].openfoam.converged && rows[0].builtin.converged);
    EXPECT_LT(std::abs(rows[0].drag), 1e-3) << incompressible;
    EXPECT_TRUE(rows[0].within);
  }
}

// In the stream's speed and dynamic pressure, as root mean square over the cells.
TEST(FlowParity, FieldsThatDifferInAQuarterOfTheCellsDifferByHalfOfThat) {
  Freestream air;
  air.velocity = {0, 0, 10}, air.density = 1.2;
  FlowField a, b;
  for (int cell = 0; cell < 8; ++cell) {
    a.pressure.push_back(5), b.pressure.push_back(cell < 2 ? 5 + 0.04 * 60 : 5);
    a.velocity.push_back({0, 1, 9}), b.velocity.push_back({cell < 2 ? 0.3 : 0, 1, 9});
  }
  ParityRow row;
  compare_fields(a, b, air, row);
  EXPECT_NEAR(row.pressure, 0.02, 1e-12);
  EXPECT_NEAR(row.largest_pressure, 0.04, 1e-12);
  EXPECT_NEAR(row.velocity, 0.015, 1e-12);
  EXPECT_NEAR(row.largest_velocity, 0.03, 1e-12);
}

}  // namespace
}  // namespace ripstop
