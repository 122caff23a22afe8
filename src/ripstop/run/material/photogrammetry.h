// Sizes from camera images compared with the computed canopy, with the files of both.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/calibration/photogrammetry.h"
#include "ripstop/canopy/shape.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"

namespace ripstop::inline run {

template <Of<ProfileRing> T, class Visit>
void each_member(T& ring, Visit&& visit) {
  visit("z_m", ring.z);
  visit("diameter_m", ring.diameter);
  visit("smallest_radius_m", ring.smallest_radius);
  visit("largest_radius_m", ring.largest_radius);
}

/// A computed canopy as a camera would see it.
struct ComputedCanopy {
  std::string title, run;                  // where it was computed; empty: in memory
  std::vector<ProfileRing> profile;        // patch after patch
  std::map<std::string, double> sizes;     // [m]
  std::vector<std::string> warnings = {};  // of its run
};
ComputedCanopy computed_canopy(const Settings& resolved, const std::vector<Vec3>& shape);
/// Of the folder of a finished steady run. Throws Error(usage).
ComputedCanopy computed_canopy(const std::filesystem::path& run);

/// A size off an image [m].
struct SeenSize {
  std::string name;
  double apparent = 0, corrected = 0;
  std::optional<double> known, computed;
};
template <Of<SeenSize> T, class Visit>
void each_member(T& size, Visit&& visit) {
  visit("name", size.name);
  visit("apparent_m", size.apparent);
  visit("corrected_m", size.corrected);
  visit("known_m", size.known);
  visit("computed_m", size.computed);
}

/// result.json of `ripstop photogrammetry`; values that were not given are absent.
struct Photogrammetry {
  std::string title;
  std::optional<double> camera_distance;   // [m]
  std::optional<bool> distance_given;      // else found from the known diameters
  std::optional<double> root_mean_square;  // [m]
  std::optional<std::vector<SeenSize>> diameters, lengths;
  std::optional<std::string> run;
  std::optional<std::map<std::string, double>> computed;  // [m]
  std::optional<std::vector<ProfileRing>> profile;
  std::vector<std::string> warnings;
};
template <Of<Photogrammetry> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("camera_distance_m", p.camera_distance);
  visit("camera_distance_given", p.distance_given);
  visit("root_mean_square_m", p.root_mean_square);
  visit("diameters", p.diameters);
  visit("lengths", p.lengths);
  visit("run", p.run);
  visit("computed_m", p.computed);
  visit("profile", p.profile);
  visit("warnings", p.warnings);
}
std::string to_json(const Photogrammetry& result);

/// At least one of both.
Photogrammetry run_photogrammetry(const std::optional<Image>& image,
                                  const std::optional<ComputedCanopy>& canopy);

/// profile.svg and profile.png (the half profile: radius over the distance from the skirt), and result.json.
void write_photogrammetry(const std::filesystem::path& folder, const Photogrammetry& result);

}  // namespace ripstop::inline run
