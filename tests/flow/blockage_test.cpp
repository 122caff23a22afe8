#include "ripstop/flow/blockage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

TEST(Blockage, WithoutWallsAPorousDiskHasTaylorsDrag) {
  for (const double loss : {0.5, 1.0, 2.0}) {
    const double taylor = loss / std::pow(1 + loss / 4, 2);
    EXPECT_DOUBLE_EQ(porous_disk_drag(loss, 0), taylor);
    EXPECT_NEAR(porous_disk_drag(loss, 1e-5), taylor, 2e-5 * taylor);
  }
}

// A screen across the whole duct takes K q, whatever it does to the air.
TEST(Blockage, ADiskThatFillsTheTestSectionHasItsLoss) {
  for (const double loss : {0.5, 2.0}) EXPECT_NEAR(porous_disk_drag(loss, 1 - 1e-6), loss, 1e-4 * loss);
}

TEST(Blockage, DisksWithoutASteadyWakeAreRefused) {
  EXPECT_THROW(porous_disk_drag(50, 0.01), Error);
}

TEST(Blockage, ASphereHasHalfItsVolumeOfAddedMass) {
  EXPECT_NEAR(spheroid_effective_volume(1, 1), 1.5 * std::numbers::pi / 6, 1e-9);
  EXPECT_NEAR(spheroid_effective_volume(1.01, 1), 1.5 * std::numbers::pi / 6 * 1.01, 0.01);
  EXPECT_NEAR(spheroid_effective_volume(50, 1), 50 * std::numbers::pi / 6, 0.1);
}

// Glauert's tau is on (S / C)^(3/2), S a sphere's cross-section.
TEST(Blockage, OfASphereInAnOpenJetGlauertsTauIsLeft) {
  const double radius = 0.3, jet = 2.0;
  const double section = std::numbers::pi * radius * radius;
  EXPECT_NEAR(open_jet_speed_change(2 * std::numbers::pi * std::pow(radius, 3), jet),
              -0.206 * std::pow(section / jet, 1.5), 1e-5);
}

}  // namespace
}  // namespace ripstop
