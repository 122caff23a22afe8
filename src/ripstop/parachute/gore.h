// The flat pattern of a canopy made of equal gores: its pieces, and how they are connected.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ripstop/parachute/facts.h"

namespace ripstop {
class Fields;
}

namespace ripstop::inline parachute {

/// Across a gore at `height` above the lower edge of its strip, measured along the centre line. All [m].
struct Station {
  double height = 0;
  double width = 0;  // of the cloth as cut, from seam to seam
  double chord = 0;  // between the seams where they hold the cloth: width / (1 + fullness)
};

/// One piece of a gore, symmetric about its centre line. Rows at constant height are straight.
struct GoreStrip {
  std::string name;               // "gore", "sail 3"
  std::vector<Station> stations;  // from the lower edge (height 0) toward the vent; linear between
  double slot = 0;                // open height below it, to the strip before, spanned by the radials [m]
  bool joined = false;            // sewn to the strip before along the whole edge, else at the radials only
  bool whole = false;             // its mesh has one number of columns
  int crown = -1;  // the highest station, from which the meridian falls toward the vent; -1: it only rises

  double length() const { return stations.back().height; }
  double width(double height) const;
  double chord(double height) const;
};

struct GorePattern {
  int gores = 0;
  double nominal_area = 0;        // S0 by the definition of the type [m2]
  std::vector<GoreStrip> strips;  // of one gore, from the skirt toward the vent
  bool vent_lines = false;        // the lines continue across the vent
  int vertical_tapes = 0;         // in every gore, between its seams, over all strips and slots
  double apex_line_ratio = 0;     // lines from the confluence to the vent's edge, over the length of the
                                  // suspension lines; 0: there are none
};

/// q = sqrt(pi / (N tan(pi/N))): a regular polygon whose inscribed circle has q times a circle's radius has
/// the circle's area. Designs are written for a round canopy; that of N flat gores is q times as large along
/// the centre line, so that every area (S0, vent, slot) is kept.
double polygon_scale(int gores);

/// A strip of N gores on a round design surface: `radius` [m] at the distance s from the skirt along the
/// meridian, cut from s = `from` to `to`. `leading` and `trailing` are the fullness of its lower and upper
/// edge, linear between.
GoreStrip strip_on(const std::string& name, const std::function<double(double s)>& radius, double from,
                   double to, int gores, double leading = 0, double trailing = 0);

/// Where the radials hold the cloth in the start shape: distance from the axis to the middle of the chord,
/// and height above the skirt [m]. `strips[i][k]` belongs to station k of strip i.
struct ProfilePoint {
  double apothem = 0, z = 0;
};
using Profile = std::vector<std::vector<ProfilePoint>>;

/// The start shape is the flat pattern folded along its seams, an isometry where there is no fullness: every
/// gore a cylinder whose rulings lie across it, apothem = chord / (2 tan(pi/N)). Where the pattern widens
/// faster than a flat disk (no such shape exists) the profile is flat. Beyond its crown a strip is folded
/// downward.
Profile start_profile(const GorePattern& pattern);

/// Open length below strip `index` at `across` (-0.5 to 0.5) of the chord [m].
double slot_length(const GorePattern& pattern, int index, double across);
/// From the skirt to the vent over cloth as cut and slots, at `across` of the width: 0.5 is the seam. Radials
/// are as long as the sides of the cloth that is sewn to them, without easing [m].
double length_along(const GorePattern& pattern, double across);

CanopyFacts facts(const GorePattern& pattern);

}  // namespace ripstop::inline parachute
