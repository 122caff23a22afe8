#include "ripstop/calibration/photogrammetry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/core/toml/read.h"

namespace ripstop::inline calibration {
namespace {

double squares(const std::vector<KnownDiameter>& diameters, double distance) {
  double sum = 0;
  for (const KnownDiameter& d : diameters) {
    const double miss = corrected_diameter(d.apparent, distance) - d.known;
    sum += miss * miss;
  }
  return sum;
}

}  // namespace

double corrected_diameter(double apparent, double distance) {
  if (!(apparent > 0) || !(apparent < distance))
    throw Error(
        ExitCode::bad_data,
        fmt::format("a camera at {} m cannot see an apparent diameter of {} m; the distance must be larger",
                    distance, apparent));
  const double s = apparent / distance;
  return apparent / std::sqrt(1 - s * s);
}

double corrected_length(double apparent, double distance, double diameter) {
  if (!(diameter < 2 * distance) || !(apparent > 0))
    throw Error(ExitCode::bad_data, fmt::format("a camera at {} m would be inside a canopy of {} m diameter",
                                                distance, diameter));
  return apparent * (2 * distance - diameter) / (2 * distance);
}

double camera_distance(double apparent, double known) {
  if (!(apparent > 0) || !(apparent < known))
    throw Error(ExitCode::bad_data,
                fmt::format("an apparent diameter of {} m and a true one of {} m determine no camera "
                            "distance: the apparent diameter must be smaller",
                            apparent, known));
  const double ratio = apparent / known;
  return apparent / std::sqrt(1 - ratio * ratio);
}

double camera_distance(const std::vector<KnownDiameter>& diameters) {
  if (diameters.empty())
    throw Error(ExitCode::usage,
                "the distance of the camera is missing: give distance_m, or known_m of a diameter");
  double low = INFINITY, high = 0;
  for (const KnownDiameter& d : diameters) {
    const double distance = camera_distance(d.apparent, d.known);
    low = std::min(low, distance);
    high = std::max(high, distance);
  }
  // The best lies between the distances of the single diameters, where the sum has one least point.
  constexpr double golden = 0.6180339887498949;
  double a = low, b = high;
  while (b - a > 1e-12 * b) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    if (c >= d) break;
    (squares(diameters, c) < squares(diameters, d) ? b : a) =
        squares(diameters, c) < squares(diameters, d) ? d : c;
  }
  return 0.5 * (a + b);
}

void describe(Fields& fields, ImageSize& size) {
  fields.name("name", size.name, "Name: D_st, D_mid, D_end, L_tot, L_disk, L_band are also computed.")
      .required();
  fields
      .number("apparent_m", size.apparent_m, above(0).up_to(1000),
              "Size measured on the image with its scale.")
      .required();
  fields.number("known_m", size.known_m, above(0).up_to(1000), "True size, or size given by a source.")
      .absent("unknown");
}

void describe(Fields& fields, Image& image) {
  fields.text("title", image.title, 200, "Title for reports.");
  fields
      .number("distance_m", image.distance_m, above(0).up_to(10000),
              "Distance from the camera to the axis of the canopy.")
      .absent("from the diameters with known_m");
  fields.rows("diameter", image.diameters, "Diameter perpendicular to the line of sight.");
  fields.rows("length", image.lengths, "Length along the axis of the canopy.");
}

Image read_image(const std::filesystem::path& file) {
  const Document document = parse_toml(read_text_file(file), file.string());
  Image image;
  Origins origins;
  std::vector<Problem> problems;
  read_and_check([&](Fields& fields) { describe(fields, image); }, document, origins, problems);
  Findings findings(origins, problems);
  if (image.diameters.empty() && findings.sound({"diameter"}))
    findings.add("diameter", "", "", "is missing: write a [[diameter]] with name and apparent_m for each");
  if (!problems.empty()) throw InputError(ExitCode::usage, problems);
  return image;
}

CorrectedImage correct(const Image& image) {
  std::vector<KnownDiameter> known;
  for (const ImageSize& d : image.diameters)
    if (d.known_m) known.push_back({d.apparent_m, *d.known_m});
  CorrectedImage result;
  result.distance_given = image.distance_m.has_value();
  result.distance = image.distance_m ? *image.distance_m : camera_distance(known);
  double largest = 0;
  for (const ImageSize& d : image.diameters) {
    result.diameters.push_back(
        {d.name, d.apparent_m, corrected_diameter(d.apparent_m, result.distance), d.known_m});
    largest = std::max(largest, result.diameters.back().corrected);
  }
  for (const ImageSize& l : image.lengths)
    result.lengths.push_back(
        {l.name, l.apparent_m, corrected_length(l.apparent_m, result.distance, largest), l.known_m});
  if (!known.empty())
    result.root_mean_square = std::sqrt(squares(known, result.distance) / double(known.size()));
  return result;
}

}  // namespace ripstop::inline calibration
