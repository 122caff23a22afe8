#include "ripstop/canopy/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "ripstop/canopy/stress.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/case.h"
#include "ripstop/core/error.h"

namespace ripstop {
namespace {

Case stratos(int cloth_nodes) {
  Overrides overrides;
  overrides.set = {{"parachute.mesh.cloth_nodes", std::to_string(cloth_nodes)}};
  return read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml", overrides);
}

TEST(Profile, OfTheStartShapeIsTheFlatDiskOverTheCylindricalBand) {
  const CanopyMesh mesh = parachute_mesh(resolve(stratos(6000)));
  const auto sizes = image_sizes(mesh, mesh.start);
  for (const char* name : {"D_st", "D_mid", "D_end"}) EXPECT_NEAR(sizes.at(name), 1.0, 5e-3) << name;
  EXPECT_NEAR(sizes.at("L_band"), 0.30, 1e-9);
  EXPECT_NEAR(sizes.at("L_disk"), 0, 1e-9);
  EXPECT_NEAR(sizes.at("L_tot"), 0.37, 1e-9);
  const std::vector<ProfileRing> rings = canopy_profile(mesh, mesh.start);
  EXPECT_NEAR(rings.back().diameter, 0.09, 2e-3);  // the vent
}

TEST(Profile, OfABandThatWidensHasItsSizesFromTheSkirtUp) {
  const CanopyMesh mesh = parachute_mesh(resolve(stratos(6000)));
  std::vector<Vec3> x = mesh.start;
  const Patch& band = mesh.patches[mesh.rigging.band_patches.front()];
  double lowest = 1e9;
  for (int i = 0; i < band.rows * band.columns; ++i) lowest = std::min(lowest, x[band.first_node + i].z);
  for (Vec3& p : x) {
    const double wider = 1 + std::clamp(p.z - lowest, 0.0, 0.30);
    p.x *= wider, p.y *= wider;
  }
  std::map<std::string, double> sizes = image_sizes(mesh, x);
  EXPECT_NEAR(sizes.at("D_st"), 1.0, 5e-3);
  EXPECT_NEAR(sizes.at("D_mid"), 1.15, 0.03);
  EXPECT_NEAR(sizes.at("D_end"), 1.3, 7e-3);
  for (Vec3& p : x) p.z = -p.z;  // whichever of its rows is the first
  sizes = image_sizes(mesh, x);
  EXPECT_NEAR(sizes.at("D_st"), 1.3, 7e-3);
  EXPECT_NEAR(sizes.at("D_end"), 1.0, 5e-3);
}

TEST(Profile, OfACanopyWithoutABandHasTheSizesOfSkirtWidestRowAndLength) {
  const CanopyMesh mesh = parachute_mesh(
      resolve(read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml", {})));
  std::vector<Vec3> x = mesh.start;
  const std::vector<ProfileRing> flat = canopy_profile(mesh, x);
  double skirt = 0, vent = 1e9;
  for (const ProfileRing& ring : flat)
    skirt = std::max(skirt, ring.diameter), vent = std::min(vent, ring.diameter);
  // A cup with its widest row at a quarter of its height, and a narrower skirt.
  for (Vec3& p : x) {
    const double share = 2 * std::hypot(p.x, p.y) / skirt, in = share > 0.75 ? 1 - 1.5 * (share - 0.75) : 1;
    p = {in * p.x, in * p.y, 2 - share};
  }
  const std::vector<ProfileRing> rings = canopy_profile(mesh, x);
  double lowest = 1e9, widest = 0, at_skirt = 0;
  for (const ProfileRing& ring : rings) {
    if (ring.z < lowest) lowest = ring.z, at_skirt = ring.diameter;
    widest = std::max(widest, ring.diameter);
  }
  const auto sizes = image_sizes(mesh, x);
  EXPECT_EQ(sizes.size(), 3u);
  EXPECT_EQ(sizes.at("D_st"), at_skirt);
  EXPECT_NEAR(at_skirt, 0.625 * skirt, 1e-3 * skirt);
  EXPECT_EQ(sizes.at("D_mid"), widest);
  EXPECT_GT(widest, at_skirt);
  EXPECT_NEAR(sizes.at("L_tot"), 1 - vent / skirt, 1e-3);
}

TEST(Profile, OfTheOutlineDoesNotDependOnTheNumberOfColumns) {
  const CanopyMesh coarse = parachute_mesh(resolve(stratos(1500))),
                   fine = parachute_mesh(resolve(stratos(12000)));
  const double few = canopy_size(coarse, coarse.start).projected_diameter;
  const double many = canopy_size(fine, fine.start).projected_diameter;
  EXPECT_NEAR(few / many, 1, 5e-3);
  EXPECT_NEAR(many, 1.0, 5e-3);
}

TEST(Asymmetry, IsHowFarANodeLiesFromWhereItsLikeIsTurnedTo) {
  const CanopyMesh mesh = parachute_mesh(resolve(stratos(3000)));
  std::vector<Vec3> x = mesh.start;
  EXPECT_LT(asymmetry(mesh, x, 18), 1e-12);
  x[mesh.rigging.skirt_nodes[5]] += Vec3{0, 0, 1e-3};
  EXPECT_NEAR(asymmetry(mesh, x, 18), 1e-3, 1e-12);
}

TEST(LineTensions, AreTheSumOfAxialAndBendingSprings) {
  const CanopyMesh mesh = parachute_mesh(resolve(stratos(3000)));
  std::vector<double> tension(mesh.springs.size(), 0.0);
  const LineRun& line = mesh.rigging.lines[3];
  tension[line.springs[line.free_springs / 2]] = 10;
  tension[line.springs.back()] = 12;
  const std::vector<LineTension> tensions = line_tensions(mesh, tension);
  ASSERT_EQ(tensions.size(), 18u);
  EXPECT_EQ(tensions[3].number, 4);
  EXPECT_NEAR(tensions[3].free_tension * line.axial_share, 10, 1e-12);
  EXPECT_NEAR(tensions[3].largest_tension * line.axial_share, 12, 1e-12);
  EXPECT_EQ(tensions[4].largest_tension, 0);
}

TEST(PartStrains, OfAnEvenlyStretchedCanopyAreTheStretch) {
  const CanopyMesh mesh = parachute_mesh(resolve(stratos(3000)));
  std::vector<Vec3> larger = mesh.start;
  for (Vec3& p : larger) p = 1.02 * p;
  const auto before = part_strains(mesh, mesh.start), after = part_strains(mesh, larger);
  for (const char* part : {"lines", "tape", "cloth"}) {
    EXPECT_NEAR(after.at(part).mean, 1.02 * (1 + before.at(part).mean) - 1, 1e-12) << part;
    EXPECT_NEAR(after.at(part).largest, 1.02 * (1 + before.at(part).largest) - 1, 1e-12) << part;
    EXPECT_GE(before.at(part).largest, before.at(part).mean) << part;
  }
  EXPECT_NEAR(before.at("cloth").mean, 0, 1e-3);
  EXPECT_NEAR(before.at("lines").mean, 0, 1e-6);
}

TEST(CanopySize, OfAPositionThatIsNotFiniteIsRefused) {
  const CanopyMesh mesh = parachute_mesh(resolve(stratos(3000)));
  std::vector<Vec3> x = mesh.start;
  EXPECT_GT(canopy_size(mesh, x).projected_area, 0);
  x[10].x = NAN;
  EXPECT_THROW(canopy_size(mesh, x), Error);
}

}  // namespace
}  // namespace ripstop
