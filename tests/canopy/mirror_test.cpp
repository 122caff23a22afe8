#include "ripstop/canopy/mirror.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ripstop/case/assemble.h"

namespace ripstop {
namespace {

Settings small_example(const std::string& name, std::vector<Setting> set = {}) {
  Overrides overrides;
  overrides.set = std::move(set);
  overrides.set.push_back({"parachute.mesh.cloth_nodes", "1500"});
  return resolve(
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / name / "case.toml", overrides));
}

TEST(Mirror, EveryExampleWithAnEvenNumberOfGoresIsItsOwnImageInBothPlanes) {
  for (const char* name :
       {"flat-circular", "conical", "hemispherical", "stratos-iv", "ringslot", "annular", "cross"})
    EXPECT_TRUE(mirror_images(parachute_mesh(small_example(name)))) << name;
}

TEST(Mirror, AnOddNumberOfGoresHasOnePlaneOnly) {
  EXPECT_FALSE(mirror_images(parachute_mesh(small_example(
      "flat-circular",
      {{"parachute.gores", "9"}, {"parachute.lines.count", "9"}, {"parachute.vent_lines", "false"}}))));
}

TEST(Mirror, AMovedNodeAHeavierNodeAnotherSpringAndSlantedYarnsBreakIt) {
  const CanopyMesh mesh = parachute_mesh(small_example("flat-circular"));
  CanopyMesh moved = mesh, heavier = mesh, stiffer = mesh, slanted = mesh;
  moved.start[7].x += 1e-3;
  heavier.mass[7] *= 1.01;
  stiffer.springs[0].rest_length *= 1.01;
  slanted.patches[0].law[shear_up].coefficients.front() *= 1.1;
  for (const CanopyMesh* broken : {&moved, &heavier, &stiffer, &slanted})
    EXPECT_FALSE(mirror_images(*broken));
}

TEST(Mirror, TheGapIsTheDistanceOfANodeFromTheImageOfItsImage) {
  const CanopyMesh mesh = parachute_mesh(small_example("flat-circular"));
  const auto images = mirror_images(mesh);
  ASSERT_TRUE(images);
  EXPECT_LT(mirror_gap(mesh, *images, mesh.start), 1e-9);
  std::vector<Vec3> lifted = mesh.start;
  lifted[static_cast<std::size_t>(mesh.patches[0].node(1, 3))].z += 0.01;
  EXPECT_NEAR(mirror_gap(mesh, *images, lifted), 0.01, 1e-9);
}

}  // namespace
}  // namespace ripstop
