// Lines that would pass through a rigid body.
#include "ripstop/fsi/lines_apart.h"

#include <gtest/gtest.h>

#include "../refusal.h"
#include "../small_case.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/resolve.h"
#include "ripstop/flow/bodies.h"

namespace ripstop {
namespace {

class LinesApart : public testing::Test {
 protected:
  static Case with_riser() {
    Case given = flat_circular_case(1, 600, 20);
    given.parachute.riser.length_m = 0.5;
    given.parachute.riser.material = given.parachute.lines.material;
    return checked(given);
  }
  const CanopyMesh mesh = parachute_mesh(resolve(with_riser()));
  const double end = mesh.start[mesh.springs[mesh.rigging.riser_springs.front()].a].z;
  const double skirt = skirt_centroid(mesh, mesh.start).z;

  static std::vector<FlowBody> block_at(Vec3 aft) {
    return {sheet_body({}, {0, 1}), sheet_body(block({0.1, 0.1, 0.2}, aft), impermeable, "rocket")};
  }
  void require(Vec3 aft) const { require_lines_apart(mesh, mesh.start, block_at(aft)); }
};

TEST_F(LinesApart, ABodyAtTheEndOfTheRiserOrOutsideOfTheLinesIsAccepted) {
  EXPECT_NO_THROW(require({0, 0, end}));
  EXPECT_NO_THROW(require({0, 0, end + 0.04 * (skirt - end)})) << "approximate position";
  EXPECT_NO_THROW(require({0.6, 0, end + 0.5}));
}

TEST_F(LinesApart, ABodyAroundTheRiserOrAcrossALineIsRefusedWithItsName) {
  for (const Vec3 aft :
       {Vec3{0, 0, end + 0.06 * (skirt - end)}, Vec3{0, 0, end + 0.4}, Vec3{0.4, 0, skirt - 0.1}}) {
    const std::string why = refusal_of([&] { require(aft); }, ExitCode::usage);
    EXPECT_NE(why.find("pass through the body \"rocket\""), std::string::npos)
        << aft.x << ' ' << aft.z << why;
  }
}

}  // namespace
}  // namespace ripstop
