// ripstop photogrammetry: sizes measured on camera images, corrected for perspective, compared with the
// computed canopy.

#include "ripstop/run/material/photogrammetry.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "commands.h"
#include "json_option.h"
#include "number_option.h"
#include "option.h"
#include "ripstop/core/error.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct PhotogrammetryArguments {
  fs::path image, run, out = "runs/photogrammetry";
  std::optional<double> distance;
  bool json = false;
};

void print_size(const SeenSize& size) {
  const auto cell = [](std::optional<double> value) { return value ? fmt::format("{:.4f}", *value) : "-"; };
  fmt::print("{:>8} {:>10.4f} {:>10.4f} {:>10} {:>10} {:>9}\n", size.name, size.apparent, size.corrected,
             cell(size.known), cell(size.computed),
             size.computed ? fmt::format("{:+.1f} %", 100 * (*size.computed / size.corrected - 1)) : "");
}

void print_result(const Photogrammetry& result) {
  if (!result.camera_distance) {
    for (const auto& [name, size] : *result.computed) fmt::print("{:>8} {:.4f} m\n", name, size);
    return;
  }
  fmt::print("camera at {:.4f} m ({}", *result.camera_distance,
             *result.distance_given ? "given" : "from the known diameters");
  if (*result.root_mean_square > 0) fmt::print(", residual {:.1f} mm rms", 1000 * *result.root_mean_square);
  fmt::print(")\n{:>8} {:>10} {:>10} {:>10} {:>10} {:>9}\n", "size, m", "apparent", "corrected", "known",
             "computed", "error");
  for (const auto* sizes : {&*result.diameters, &*result.lengths})
    for (const SeenSize& size : *sizes) print_size(size);
}

int photogrammetry(const PhotogrammetryArguments& options) {
  if (options.image.empty() && options.run.empty())
    throw Error(ExitCode::usage, "give an image file, --run RUN, or both");
  std::optional<Image> image;
  std::optional<ComputedCanopy> canopy;
  if (!options.image.empty()) {
    image = read_image(options.image);
    if (options.distance) image->distance_m = options.distance;
  }
  if (!options.run.empty()) canopy = computed_canopy(options.run);
  const Photogrammetry result = run_photogrammetry(image, canopy);
  write_photogrammetry(options.out, result);
  return show(result, options.json, [&] {
    print_result(result);
    fmt::print("{} (profile.svg, profile.png)\n", (options.out / "result.json").string());
  });
}

}  // namespace

void add_photogrammetry(CLI::App& app, int& status) {
  auto options = std::make_shared<PhotogrammetryArguments>();
  CLI::App* command = app.add_subcommand(
      "photogrammetry",
      "Correct sizes from camera images for perspective and compare them with the computed canopy");
  command->footer(
      "The image file (TOML) has [[diameter]] and [[length]] tables with name, apparent_m and, where it is "
      "known,\n"
      "known_m. The distance of the camera is distance_m, or is computed from the known diameters.\n"
      "Example: ripstop photogrammetry validation/ojf/stratos-iv-images.toml --run runs/stratos-iv");
  add_existing_file(*command, "image", options->image, "Sizes measured on an image (TOML)");
  add_run_folder(*command, "--run", options->run, "Run folder of ripstop steady to compare with");
  add_number(*command, "--distance", options->distance, above(0).up_to(1e4), "Distance of the camera [m]")
      ->default_str("as in the file");
  command->add_option("--out", options->out, "Folder");
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = photogrammetry(*options); });
}

}  // namespace ripstop::cli
