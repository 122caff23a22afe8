// ripstop photogrammetry: sizes read off camera images, corrected for perspective, beside the computed
// canopy's.

#include "ripstop/calibration/photogrammetry.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "ripstop/canopy/shape.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/steady_run.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct Options {
  fs::path image, run, out = "runs/photogrammetry";
  std::optional<double> distance;
};

struct Computed {
  std::string title;
  std::vector<std::vector<ProfileRing>> patches;
  std::map<std::string, double> sizes;
};

Computed computed_canopy(const fs::path& run) {
  const Case value = case_of_run(run);
  const SteadyState state = final_state(run);
  const CanopyMesh mesh = parachute_mesh(value);
  Computed canopy{value.title, {}, image_sizes(mesh, state.shape)};
  for (const ProfileRing& ring : canopy_profile(mesh, state.shape)) {
    if (canopy.patches.empty() || canopy.patches.back().back().patch != ring.patch)
      canopy.patches.emplace_back();
    canopy.patches.back().push_back(ring);
  }
  return canopy;
}

/// The half profile: radius over the distance from the skirt.
void write_profile(const fs::path& folder, const CorrectedImage* image, const Computed* canopy) {
  PlotSeries mean{"computed, circle of the same area", {}, {}, true, false, false};
  PlotSeries range{"computed, least and largest radius", {}, {}, true, false, true};
  const auto add = [](PlotSeries& series, double z, double r) {
    series.x.push_back(z);
    series.y.push_back(r);
  };
  Plot plot{"Profile", {"distance from the skirt [m]"}, {"radius [m]", false, 0.0}, {}};
  if (canopy) {
    plot.title = canopy->title;
    for (const auto& rings : canopy->patches) {
      for (const ProfileRing& ring : rings) add(mean, ring.z, ring.diameter / 2);
      for (const ProfileRing& ring : rings) add(range, ring.z, ring.smallest_radius);
      add(range, NAN, NAN);
      for (const ProfileRing& ring : rings) add(range, ring.z, ring.largest_radius);
      add(mean, NAN, NAN);
      add(range, NAN, NAN);
    }
    plot.series = {mean, range};
  }
  if (image) {
    // Where a name says where it lies: the band's edges and middle.
    std::map<std::string, double> size;
    for (const CorrectedSize& s : image->diameters) size[s.name] = s.corrected;
    for (const CorrectedSize& s : image->lengths) size[s.name] = s.corrected;
    PlotSeries seen{"images, corrected", {}, {}, false, true, false};
    if (size.contains("D_st")) add(seen, 0, size["D_st"] / 2);
    if (size.contains("L_band") && size.contains("D_mid")) add(seen, size["L_band"] / 2, size["D_mid"] / 2);
    if (size.contains("L_band") && size.contains("D_end")) add(seen, size["L_band"], size["D_end"] / 2);
    if (size.contains("L_tot")) add(seen, size["L_tot"], 0);
    if (!seen.x.empty()) plot.series.push_back(seen);
  }
  if (plot.series.empty()) return;
  for (const char* name : {"profile.svg", "profile.png"}) write_plot(folder / name, plot);
}

ordered_json size_json(const CorrectedSize& size, const Computed* canopy) {
  ordered_json j{{"name", size.name}, {"apparent_m", size.apparent}, {"corrected_m", size.corrected}};
  if (size.known) j["known_m"] = *size.known;
  if (canopy && canopy->sizes.contains(size.name)) j["computed_m"] = canopy->sizes.at(size.name);
  return j;
}

void print_size(const CorrectedSize& size, const Computed* canopy) {
  const auto cell = [](std::optional<double> value) { return value ? fmt::format("{:.4f}", *value) : "-"; };
  std::optional<double> computed;
  if (canopy && canopy->sizes.contains(size.name)) computed = canopy->sizes.at(size.name);
  fmt::print("{:>8} {:>10.4f} {:>10.4f} {:>10} {:>10} {:>9}\n", size.name, size.apparent, size.corrected,
             cell(size.known), cell(computed),
             computed ? fmt::format("{:+.1f} %", 100 * (*computed / size.corrected - 1)) : "");
}

int photogrammetry(const Options& options) {
  if (options.image.empty() && options.run.empty())
    throw Error(ExitCode::usage, "give an image file, --run RUN, or both");
  std::optional<CorrectedImage> image;
  std::optional<Computed> canopy;
  if (!options.image.empty()) {
    Image read = read_image(options.image);
    if (options.distance) read.distance_m = options.distance;
    image = correct(read);
  }
  if (!options.run.empty()) canopy = computed_canopy(options.run);
  const Computed* shape = canopy ? &*canopy : nullptr;
  make_folder(options.out);
  ordered_json j;
  if (image) {
    fmt::print("camera at {:.4f} m ({}", image->distance,
               image->distance_given ? "given" : "from the known diameters");
    if (image->root_mean_square > 0)
      fmt::print(", which it meets within {:.1f} mm rms", 1000 * image->root_mean_square);
    fmt::print(")\n{:>8} {:>10} {:>10} {:>10} {:>10}\n", "m", "apparent", "corrected", "known", "computed");
    j["camera_distance_m"] = image->distance;
    j["camera_distance_given"] = image->distance_given;
    j["root_mean_square_m"] = image->root_mean_square;
    for (const auto& [key, sizes] :
         {std::pair{"diameters", &image->diameters}, std::pair{"lengths", &image->lengths}}) {
      j[key] = ordered_json::array();
      for (const CorrectedSize& size : *sizes) {
        print_size(size, shape);
        j[key].push_back(size_json(size, shape));
      }
    }
  }
  if (shape) {
    if (!image)
      for (const auto& [name, size] : shape->sizes) fmt::print("{:>8} {:.4f} m\n", name, size);
    j["run"] = options.run.string();
    j["computed_m"] = shape->sizes;
    ordered_json profile = ordered_json::array();
    for (const auto& rings : shape->patches)
      for (const ProfileRing& ring : rings)
        profile.push_back({{"z_m", ring.z},
                           {"diameter_m", ring.diameter},
                           {"smallest_radius_m", ring.smallest_radius},
                           {"largest_radius_m", ring.largest_radius}});
    j["profile"] = profile;
  }
  write_profile(options.out, image ? &*image : nullptr, shape);
  write_file(options.out / "result.json", j.dump(2) + "\n");
  fmt::print("{} (profile.svg, profile.png)\n", (options.out / "result.json").string());
  return 0;
}

}  // namespace

void add_photogrammetry(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("photogrammetry",
                                         "Sizes from camera images, corrected, beside the computed canopy's");
  command->footer(
      "The image file (TOML) has [[diameter]] and [[length]] tables with name, apparent_m and, where it is "
      "known,\n"
      "known_m; the camera's distance is distance_m, or follows from the known diameters.\n"
      "Example: ripstop photogrammetry validation/ojf/stratos-iv-images.toml --run runs/stratos-iv");
  command->add_option("image", options->image, "Sizes read off an image (TOML)")->check(CLI::ExistingFile);
  command->add_option("--run", options->run, "Run folder of ripstop steady to compare with")
      ->check(CLI::ExistingDirectory);
  command->add_option("--distance", options->distance, "Distance of the camera [m]; default: as in the file")
      ->check(CLI::PositiveNumber);
  command->add_option("--out", options->out, "Folder (default: runs/photogrammetry)");
  command->callback([options, &status] { status = photogrammetry(*options); });
}

}  // namespace ripstop
