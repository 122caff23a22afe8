#include "ripstop/run/material/photogrammetry.h"

#include <cmath>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cluster.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/file.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/json.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {
namespace {

std::vector<SeenSize> seen_sizes(const std::vector<CorrectedSize>& sizes,
                                 const std::optional<ComputedCanopy>& canopy) {
  std::vector<SeenSize> seen;
  for (const CorrectedSize& size : sizes) {
    seen.push_back({size.name, size.apparent, size.corrected, size.known, {}});
    if (canopy && canopy->sizes.contains(size.name)) seen.back().computed = canopy->sizes.at(size.name);
  }
  return seen;
}

void add(PlotSeries& series, double z, double r) {
  series.x.push_back(z);
  series.y.push_back(r);
}

std::vector<PlotSeries> computed_series(const std::vector<ProfileRing>& profile) {
  PlotSeries mean{"computed, circle of the same area", {}, {}, true, false, false};
  PlotSeries range{"computed, smallest and largest radius", {}, {}, true, false, true};
  for (auto first = profile.begin(); first != profile.end();) {
    auto last = first;
    while (last != profile.end() && last->patch == first->patch) ++last;
    for (auto ring = first; ring != last; ++ring) add(mean, ring->z, ring->diameter / 2);
    for (auto ring = first; ring != last; ++ring) add(range, ring->z, ring->smallest_radius);
    add(range, NAN, NAN);
    for (auto ring = first; ring != last; ++ring) add(range, ring->z, ring->largest_radius);
    add(mean, NAN, NAN);
    add(range, NAN, NAN);
    first = last;
  }
  return {mean, range};
}

/// For names with a known position: the edges and the middle of the band.
PlotSeries seen_series(const Photogrammetry& result) {
  std::map<std::string, double> size;
  for (const SeenSize& s : *result.diameters) size[s.name] = s.corrected;
  for (const SeenSize& s : *result.lengths) size[s.name] = s.corrected;
  PlotSeries seen{"images, corrected", {}, {}, false, true, false};
  if (size.contains("D_st")) add(seen, 0, size["D_st"] / 2);
  if (size.contains("L_band") && size.contains("D_mid")) add(seen, size["L_band"] / 2, size["D_mid"] / 2);
  if (size.contains("L_band") && size.contains("D_end")) add(seen, size["L_band"], size["D_end"] / 2);
  if (size.contains("L_tot")) add(seen, size["L_tot"], 0);
  return seen;
}

}  // namespace

ComputedCanopy computed_canopy(const Settings& resolved, const std::vector<Vec3>& shape) {
  require_one_canopy(resolved, "a comparison with photographs");
  const CanopyMesh mesh = parachute_mesh(resolved);
  return {resolved.title(), "", canopy_profile(mesh, shape), image_sizes(mesh, shape)};
}

ComputedCanopy computed_canopy(const std::filesystem::path& run) {
  const std::vector<std::string> warnings = warnings_of_used({run});  // throws where anything of it was lost
  ComputedCanopy canopy = computed_canopy(settings_of_run(run), final_state(run).shape);
  canopy.run = run.string(), canopy.warnings = warnings;
  return canopy;
}

std::string to_json(const Photogrammetry& result) {
  return json_text(result);
}

Photogrammetry run_photogrammetry(const std::optional<Image>& image,
                                  const std::optional<ComputedCanopy>& canopy) {
  Photogrammetry result;
  result.title = "Profile";
  if (image) {
    const CorrectedImage seen = correct(*image);
    result.camera_distance = seen.distance;
    result.distance_given = seen.distance_given;
    result.root_mean_square = seen.root_mean_square;
    result.diameters = seen_sizes(seen.diameters, canopy);
    result.lengths = seen_sizes(seen.lengths, canopy);
  }
  if (canopy) {
    result.title = canopy->title;
    if (!canopy->run.empty()) result.run = canopy->run;
    result.computed = canopy->sizes;
    result.profile = canopy->profile, result.warnings = canopy->warnings;
  }
  return result;
}

void write_photogrammetry(const std::filesystem::path& folder, const Photogrammetry& result) {
  make_results_folder(folder, "photogrammetry");
  Plot plot{result.title, {"distance from the skirt [m]"}, {"radius [m]", false, 0.0}, {}};
  if (result.profile) plot.series = computed_series(*result.profile);
  if (result.diameters) {
    const PlotSeries seen = seen_series(result);
    if (!seen.x.empty()) plot.series.push_back(seen);
  }
  if (!plot.series.empty())
    for (const char* name : {"profile.svg", "profile.png"}) write_plot(folder / name, plot);
  write_file(folder / "result.json", to_json(result));
}

}  // namespace ripstop::inline run
