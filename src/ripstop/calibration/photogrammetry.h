// Sizes read off a camera image corrected for perspective, and the camera's distance from known sizes
// ([NFM] Eq. 21 and 22, mended).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/toml/fields.h"

namespace ripstop::inline calibration {

/// Eq. 21: D_P = D_AP + L tan(asin(D_AP / L)) - D_AP = D_AP / sqrt(1 - (D_AP / L)^2): the camera at distance
/// L sees the tangents to the canopy, not its diameter. Throws Error(bad_data) unless 0 < D_AP < L.
double corrected_diameter(double apparent, double distance);
/// Eq. 22, which is printed upside down: L_P = L_AP (2 L - D_P) / (2 L), for a length along the canopy's near
/// side, half a diameter before the plane that the scale was set in. Throws Error(bad_data) unless D_P < 2 L.
double corrected_length(double apparent, double distance, double diameter);

/// The distance at which one apparent diameter belongs to a known one. Throws Error(bad_data) unless
/// 0 < apparent < known.
double camera_distance(double apparent, double known);

struct KnownDiameter {
  double apparent = 0, known = 0;  // [m]
};
/// The distance with the least sum of squared errors of the corrected diameters. Throws as above.
double camera_distance(const std::vector<KnownDiameter>& diameters);

/// A file of sizes read off one image.
struct ImageSize {
  std::string name;  // "D_mid"
  double apparent_m = 0;
  std::optional<double> known_m;  // true size, or the one a source gives for it
};
struct Image {
  std::string title;
  std::optional<double> distance_m;  // absent: from the known diameters
  std::vector<ImageSize> diameters, lengths;
};
void describe(Fields& fields, ImageSize& size);
void describe(Fields& fields, Image& image);
/// Throws InputError(usage) with every problem found, Error(io).
Image read_image(const std::filesystem::path& file);

struct CorrectedSize {
  std::string name;
  double apparent = 0, corrected = 0;  // [m]
  std::optional<double> known;         // [m]
};
struct CorrectedImage {
  double distance = 0;          // [m]
  bool distance_given = false;  // else found from the known diameters
  double root_mean_square = 0;  // error of the corrected diameters against the known ones [m]
  std::vector<CorrectedSize> diameters, lengths;
};
/// Lengths are corrected with the largest corrected diameter.
CorrectedImage correct(const Image& image);

}  // namespace ripstop::inline calibration
