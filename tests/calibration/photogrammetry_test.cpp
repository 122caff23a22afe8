#include "ripstop/calibration/photogrammetry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

// [NFM], Stratos IV at 30 m/s: apparent and corrected [m].
struct Row {
  const char* name;
  double apparent, corrected;
};
constexpr Row diameters[] = {{"D_st", 0.967, 1.0}, {"D_mid", 0.9962, 1.0327}, {"D_end", 0.9304, 0.956}};
constexpr Row lengths[] = {{"L_tot", 0.603, 0.516}, {"L_disk", 0.188, 0.161}, {"L_band", 0.332, 0.285}};

Image printed() {
  Image image;
  for (const Row& row : diameters) image.diameters.push_back({row.name, row.apparent, row.corrected});
  for (const Row& row : lengths) image.lengths.push_back({row.name, row.apparent, row.corrected});
  return image;
}

TEST(Photogrammetry, AtThePrintedDistanceGivesThePrintedDiametersButTheThird) {
  EXPECT_NEAR(corrected_diameter(0.967, 3.79), 1.0, 5e-4);
  EXPECT_NEAR(corrected_diameter(0.9962, 3.79), 1.0327, 5e-4);
  // The third printed one is 0.4 % smaller than its own equation gives: it corresponds to a camera at 4.05 m.
  EXPECT_NEAR(corrected_diameter(0.9304, 3.79), 0.9598, 1e-4);
  EXPECT_NEAR(camera_distance(0.9304, 0.956), 4.05, 0.01);
}

TEST(Photogrammetry, FindsTheCameraOfThePrintedTableNear379) {
  EXPECT_NEAR(camera_distance(0.967, 1.0), 3.79, 0.01);
  EXPECT_NEAR(camera_distance(0.9962, 1.0327), 3.79, 0.01);
  const CorrectedImage image = correct(printed());
  EXPECT_NEAR(image.distance, 3.79, 0.1);
  EXPECT_LT(image.root_mean_square, 0.0025);
}

TEST(Photogrammetry, ShrinksLengthsAsThePrintedTableDoesWithinOnePercent) {
  Image image = printed();
  image.distance_m = 3.79;
  const CorrectedImage corrected = correct(image);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(corrected.lengths[i].corrected, lengths[i].apparent);
    EXPECT_NEAR(corrected.lengths[i].corrected / lengths[i].corrected, 1, 0.01) << lengths[i].name;
  }
}

TEST(Photogrammetry, TheInverseUndoesTheCorrection) {
  for (const double distance : {1.5, 3.79, 20.0})
    for (const double apparent : {0.2, 0.9, 1.3})
      EXPECT_NEAR(camera_distance(apparent, corrected_diameter(apparent, distance)), distance,
                  1e-9 * distance);
  const double distance = 5.2;
  EXPECT_NEAR(
      camera_distance({{0.9, corrected_diameter(0.9, distance)}, {1.1, corrected_diameter(1.1, distance)}}),
      distance, 1e-7);
}

TEST(Photogrammetry, IsTheTangentConeOfASphereExactly) {
  // A sphere of diameter D at distance L is seen under the half angle asin(D / 2L); Eq. 21 is the like
  // relation with D_AP / L for the sine: the corrected diameter is L times the tangent of the same angle.
  const double angle = std::asin(0.967 / 3.79);
  EXPECT_NEAR(corrected_diameter(0.967, 3.79), 3.79 * std::tan(angle), 1e-12);
}

TEST(Photogrammetry, RefusesImpossibleSizesAndDistances) {
  EXPECT_THROW(corrected_diameter(2, 1.5), Error);
  EXPECT_THROW(camera_distance(1.0, 0.9), Error);
  EXPECT_THROW(corrected_length(0.5, 1, 3), Error);
  Image image;
  image.diameters = {{"D", 1.0, {}}};
  EXPECT_THROW(correct(image), Error);
}

}  // namespace
}  // namespace ripstop
