#include "ripstop/parachute/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/gored.h"

namespace ripstop::inline parachute {
namespace {

using std::numbers::pi;

constexpr double touching = 1e-6;  // of the largest radius: closer pieces have no gap between them
// The mesh has as many columns at the skirt as where the canopy is widest.
constexpr double narrowest_skirt = 0.7;

/// Distance from the axis to the middle of a gore over the meridian's radius.
double apothem_share(int gores) {
  return pi / gores / std::tan(pi / gores);
}

double widest_of(const ProfileCanopy& canopy) {
  double widest = 0;
  for (const ProfilePiece& piece : canopy.pieces)
    for (const double r : piece.radius_m) widest = std::max(widest, r);
  return widest;
}

/// Open height between piece `index` and the one before; 0 where they touch.
double gap_below(const ProfileCanopy& canopy, std::size_t index, int gores) {
  if (index == 0) return 0;
  const ProfilePiece &below = canopy.pieces[index - 1], &above = canopy.pieces[index];
  const double gap = std::hypot(apothem_share(gores) * (above.radius_m.front() - below.radius_m.back()),
                                above.height_m.front() - below.height_m.back());
  return gap > touching * widest_of(canopy) ? gap : 0;
}

GoreStrip strip_of(const ProfilePiece& piece, int number, int gores) {
  GoreStrip strip;
  strip.name = fmt::format("piece {}", number);
  double height = 0;
  for (std::size_t i = 0; i < piece.radius_m.size(); ++i) {
    if (i > 0)
      height += std::hypot(apothem_share(gores) * (piece.radius_m[i] - piece.radius_m[i - 1]),
                           piece.height_m[i] - piece.height_m[i - 1]);
    const double chord = 2 * pi * piece.radius_m[i] / gores;
    strip.stations.push_back({height, chord, chord});
  }
  for (Station& station : strip.stations)
    station.width *= 1 + piece.leading_fullness +
                     (piece.trailing_fullness - piece.leading_fullness) * station.height / height;
  strip.whole = piece.leading_fullness > 0 || piece.trailing_fullness > 0;
  return strip;
}

/// Lattices narrow upward: a strip that is widest in between becomes two.
GorePattern split_where_widest(const GorePattern& pattern) {
  GorePattern split = pattern;
  split.strips.clear();
  for (const GoreStrip& strip : pattern.strips) {
    const auto widest =
        std::max_element(strip.stations.begin(), strip.stations.end(),
                         [](const Station& a, const Station& b) { return a.width < b.width; });
    if (widest == strip.stations.begin() || widest == strip.stations.end() - 1) {
      split.strips.push_back(strip);
      continue;
    }
    GoreStrip lower = strip, upper = strip;
    lower.stations.assign(strip.stations.begin(), widest + 1);
    upper.stations.assign(widest, strip.stations.end());
    for (Station& station : upper.stations) station.height -= widest->height;
    lower.whole = true;
    upper.slot = 0;
    upper.joined = true;
    split.strips.push_back(lower);
    split.strips.push_back(upper);
  }
  return split;
}

void check_piece(const ProfilePiece& piece, const std::string& key, Findings& findings) {
  if (piece.radius_m.size() != piece.height_m.size()) {
    findings.add(key + ".height_m", static_cast<double>(piece.height_m.size()),
                 fmt::format("{} numbers", piece.radius_m.size()),
                 fmt::format("there are {} radii and {} heights; every point of the meridian requires both",
                             piece.radius_m.size(), piece.height_m.size()));
    return;
  }
  for (std::size_t i = 1; i < piece.radius_m.size(); ++i)
    if (piece.radius_m[i] == piece.radius_m[i - 1] && piece.height_m[i] == piece.height_m[i - 1])
      findings.add(fmt::format("{}.radius_m[{}]", key, i), piece.radius_m[i], "",
                   "this point of the meridian equals the previous one; remove it");
}

}  // namespace

void describe(Fields& fields, ProfilePiece& piece) {
  fields
      .numbers("radius_m", piece.radius_m, 2, 1000, above(0).up_to(100),
               "Radii of the points of the meridian, from the lower edge of the piece towards the vent. The "
               "circumference is the total width of all gores.")
      .required();
  fields
      .numbers("height_m", piece.height_m, 2, 1000, from(-1000).up_to(1000),
               "Heights of the same points, increasing towards the vent. Only differences are used.")
      .required();
  fields.number("leading_fullness", piece.leading_fullness, from(0).up_to(0.5),
                "Fullness of the lower edge: its length over the chord between the radials, minus 1.");
  fields.number("trailing_fullness", piece.trailing_fullness, from(0).up_to(0.5),
                "Fullness of the upper edge.");
  fields.toggle("sewn", piece.sewn,
                "Sewn to the previous piece along the whole edge; false: attached at the radials only.");
}

void describe(Fields& fields, ProfileCanopy& canopy) {
  fields
      .rows("pieces", canopy.pieces,
            "Pieces of a gore from the skirt upwards. The distance between two pieces is an open gap.")
      .required();
  fields.toggle(
      "vent_lines", canopy.vent_lines,
      "The lines continue across the vent to the opposite radial, if they reach the vent (assumed).");
}

void check_shape(const ProfileCanopy& canopy, const Design& design, Findings& findings) {
  const std::string pieces = "parachute.pieces";
  if (!findings.sound(shape_keys(design))) return;
  if (canopy.pieces.empty()) {
    findings.add(pieces, 0, "at least 1", "a canopy needs at least one table [[parachute.pieces]]");
    return;
  }
  for (std::size_t i = 0; i < canopy.pieces.size(); ++i)
    check_piece(canopy.pieces[i], fmt::format("{}[{}]", pieces, i), findings);
  if (!findings.sound(shape_keys(design))) return;
  const int gores = std::max(3, design.gores);
  const double widest = widest_of(canopy), skirt = canopy.pieces.front().radius_m.front();
  if (skirt < narrowest_skirt * widest)
    findings.add(pieces + "[0].radius_m[0]", skirt, fmt::format("at least {:.6g}", narrowest_skirt * widest),
                 fmt::format("the radius of the skirt must be at least {} of the largest radius, {:.6g} m",
                             narrowest_skirt, widest));
  bool narrows = false;
  double last = 0;
  for (std::size_t i = 0; i < canopy.pieces.size(); ++i) {
    const ProfilePiece& piece = canopy.pieces[i];
    for (std::size_t k = 0; k < piece.radius_m.size(); ++k) {
      const double r = piece.radius_m[k];
      if (narrows && r > last + touching * widest) {
        findings.add(fmt::format("{}[{}].radius_m[{}]", pieces, i, k), r, fmt::format("at most {:.6g}", last),
                     "the radius increases again towards the vent; a waist is not supported");
        return;
      }
      narrows |= r < last - touching * widest;
      last = r;
    }
    if (piece.sewn && (i == 0 || gap_below(canopy, i, gores) > 0))
      findings.add(fmt::format("{}[{}].sewn", pieces, i), "true", "false",
                   i == 0 ? "there is no piece below the first one"
                          : fmt::format("it does not touch the previous piece: the gap is {:.3g} m",
                                        gap_below(canopy, i, gores)));
    if (piece.sewn && i > 0 &&
        std::abs(canopy.pieces[i - 1].trailing_fullness - piece.leading_fullness) > 1e-9)
      findings.add(fmt::format("{}[{}].sewn", pieces, i), "true", "false",
                   "edges of unequal fullness cannot be sewn together along their whole length");
  }
  if (last >= widest)
    findings.add(fmt::format("{}[{}].radius_m", pieces, canopy.pieces.size() - 1), last,
                 fmt::format("below {:.6g}", widest), "the radius does not decrease towards the vent");
  check_vent_cells(2 * last,
                   fmt::format("{}[{}].radius_m[{}]", pieces, canopy.pieces.size() - 1,
                               canopy.pieces.back().radius_m.size() - 1),
                   design, findings, 0.5);
  check_vent_lines(canopy.vent_lines, design, findings);
}

GorePattern gore_pattern(const ProfileCanopy& canopy, int gores) {
  GorePattern pattern{gores, 0, {}, canopy.vent_lines};
  for (std::size_t i = 0; i < canopy.pieces.size(); ++i) {
    GoreStrip strip = strip_of(canopy.pieces[i], static_cast<int>(i + 1), gores);
    strip.slot = gap_below(canopy, i, gores);
    strip.joined = canopy.pieces[i].sewn;
    for (std::size_t k = 1; k < strip.stations.size(); ++k) {
      const Station &a = strip.stations[k - 1], &b = strip.stations[k];
      pattern.nominal_area += gores * (b.height - a.height) * 0.5 * (a.chord + b.chord);
    }
    if (i > 0)
      pattern.nominal_area += gores * strip.slot * 0.5 *
                              (pattern.strips.back().stations.back().chord + strip.stations.front().chord);
    pattern.strips.push_back(std::move(strip));
  }
  const double vent = pattern.strips.back().stations.back().chord;
  pattern.nominal_area += 0.25 * gores * vent * vent / std::tan(pi / gores);
  return pattern;
}

CanopyMesh build_canopy(const ProfileCanopy& canopy, const Design& design, const PartMaterials& materials) {
  return build_gored(split_where_widest(gore_pattern(canopy, design.gores)), design, materials);
}

Experience experience(const ProfileCanopy&) {
  // The number of nodes is that of half an ellipsoid; flatter ones need more.
  return untabulated(1500, 0.1);
}

constinit const CanopyFamily ProfileCanopy::family = family_of<ProfileCanopy>("profile", "elliptical");

}  // namespace ripstop::inline parachute
