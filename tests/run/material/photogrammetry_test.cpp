// Sizes from an image compared with those of a computed canopy: the numbers in memory and in the files.
#include "ripstop/run/material/photogrammetry.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/output/plot.h"
#include "tests/output/read_png.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

/// As seen from 4 m; "D_st" is known too.
Image seen_from_four_metres() {
  Image image;
  image.title = "Tunnel";
  image.distance_m = 4;
  image.diameters = {{"D_st", 0.9, 0.95}, {"D_mid", 1.0, {}}};
  image.lengths = {{"L_band", 0.3, {}}, {"L_tot", 0.6, {}}};
  return image;
}

/// Two patches of two rings each.
ComputedCanopy two_patches() {
  return {"A canopy",
          "",
          {{0, 0, 0.0, 1.0, 0.4, 0.6},
           {0, 1, 0.3, 0.9, 0.35, 0.55},
           {1, 0, 0.4, 0.8, 0.3, 0.5},
           {1, 1, 0.6, 0.1, 0.04, 0.06}},
          {{"D_st", 1.0}, {"L_tot", 0.6}, {"L_disk", 0.2}}};
}

TEST(PhotogrammetryRun, AnImageAloneIsCorrectedAndNothingIsComputed) {
  const Photogrammetry r = run_photogrammetry(seen_from_four_metres(), {});
  EXPECT_EQ(r.title, "Profile");
  EXPECT_EQ(r.camera_distance, 4);
  EXPECT_EQ(r.distance_given, true);
  EXPECT_NEAR(r.root_mean_square.value(), std::abs(corrected_diameter(0.9, 4) - 0.95), 1e-12);
  ASSERT_TRUE(r.diameters && r.lengths);
  ASSERT_EQ(r.diameters->size(), 2u);
  EXPECT_EQ(r.diameters->at(0).name, "D_st");
  EXPECT_EQ(r.diameters->at(0).apparent, 0.9);
  EXPECT_EQ(r.diameters->at(0).corrected, corrected_diameter(0.9, 4));
  EXPECT_EQ(r.diameters->at(0).known, 0.95);
  EXPECT_FALSE(r.diameters->at(0).computed || r.diameters->at(1).known);
  EXPECT_EQ(r.lengths->at(1).corrected, corrected_length(0.6, 4, corrected_diameter(1.0, 4)));
  EXPECT_FALSE(r.computed || r.profile || r.run);
}

TEST(PhotogrammetryRun, ACanopyAloneHasItsSizesAndNoCamera) {
  const Photogrammetry r = run_photogrammetry({}, two_patches());
  EXPECT_EQ(r.title, "A canopy");
  EXPECT_FALSE(r.camera_distance || r.distance_given || r.root_mean_square || r.diameters || r.lengths ||
               r.run);
  EXPECT_EQ(r.computed, two_patches().sizes);
  ASSERT_TRUE(r.profile);
  EXPECT_EQ(r.profile->size(), 4u);
  const auto json = nlohmann::json::parse(to_json(r));
  EXPECT_EQ(json.at("computed_m").at("L_disk"), 0.2);
  EXPECT_EQ(json.at("profile")[3].at("largest_radius_m"), 0.06);
  EXPECT_FALSE(json.contains("diameters"));
}

TEST(PhotogrammetryRun, OfBothTheComputedSizeIsNextToTheMeasuredOneOfItsName) {
  ComputedCanopy canopy = two_patches();
  canopy.run = "runs/hemi";
  const Photogrammetry r = run_photogrammetry(seen_from_four_metres(), canopy);
  EXPECT_EQ(r.title, "A canopy");
  EXPECT_EQ(r.run, "runs/hemi");
  EXPECT_EQ(r.diameters->at(0).computed, 1.0);
  EXPECT_FALSE(r.diameters->at(1).computed);
  EXPECT_FALSE(r.lengths->at(0).computed);
  EXPECT_EQ(r.lengths->at(1).computed, 0.6);
}

TEST(PhotogrammetryRun, TakesTheCanopyOfAFinishedRunAndNamesItsFolder) {
  const TemporaryFolder folder("photogrammetry");
  const SteadyResult flown = fly_square_law(folder.path / "run");
  const ComputedCanopy canopy = computed_canopy(folder.path / "run");
  EXPECT_EQ(canopy.run, (folder.path / "run").string());
  EXPECT_EQ(canopy.title, flown.title);
  const Settings resolved = settings_of_run(folder.path / "run");
  const std::vector<Vec3> shape = final_state(folder.path / "run").shape;
  EXPECT_EQ(canopy.sizes, image_sizes(parachute_mesh(resolved), shape));
  EXPECT_EQ(canopy.sizes, computed_canopy(resolved, shape).sizes);
  EXPECT_EQ(computed_canopy(resolved, shape).run, "");
  write_file(folder.path / "run/lines.csv", "line\n1\n");
  EXPECT_THROW(computed_canopy(folder.path / "run"), Error);
}

/// Pixels of a series in profile.png, but for its sample in the legend.
int pixels_of(const std::filesystem::path& folder, std::size_t series) {
  const Png plot = read_png(folder / "profile.png");
  int pixels = 0;
  for (int y = 0; y < plot.height; ++y)
    for (int x = 0; x < plot.width; ++x) pixels += plot.shows(x, y, series_colour(series));
  return pixels;
}

TEST(PhotogrammetryRun, ItsPictureHasTheComputedProfileAndTheSeenPoints) {
  const TemporaryFolder root("photogrammetry");
  const auto written = [&](const char* name, const Photogrammetry& result) {
    write_photogrammetry(root.path / name, result);
    EXPECT_EQ(read_file(root.path / name / "result.json"), to_json(result)) << name;
    return root.path / name;
  };
  const auto both = written("both", run_photogrammetry(seen_from_four_metres(), two_patches()));
  const auto canopy = written("canopy", run_photogrammetry({}, two_patches()));
  const auto image = written("image", run_photogrammetry(seen_from_four_metres(), {}));
  EXPECT_TRUE(std::filesystem::exists(both / "profile.svg"));
  for (const std::size_t series : {0, 1}) {
    EXPECT_GT(pixels_of(canopy, series), 100) << series;
    EXPECT_GT(pixels_of(both, series), 100) << series;
  }
  EXPECT_EQ(pixels_of(canopy, 2), 0);
  EXPECT_GT(pixels_of(both, 2), 20);
  EXPECT_EQ(pixels_of(image, 1), 0);

  Image nameless = seen_from_four_metres();
  nameless.diameters = {{"D", 1.0, {}}};
  nameless.lengths.clear();
  EXPECT_FALSE(
      std::filesystem::exists(written("nameless", run_photogrammetry(nameless, {})) / "profile.png"));
}

}  // namespace
}  // namespace ripstop
