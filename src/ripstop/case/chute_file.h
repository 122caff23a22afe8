// A .chute file of the public design program openchute (github.com/ElvinC/openchute): JSON with named inputs,
// formulas over them, and sections whose meridians are lines, arcs of ellipses and lists of points.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ripstop::inline cases {

/// In the meridian's plane [m]: distance from the axis, and height (toward the vent).
struct MeridianPoint {
  double r = 0, y = 0;
};

struct ChuteSection {
  std::string place;      // in the file: "chute_sections[2]"
  bool circular = false;  // one straight line turned about the axis, with round edges; else
                          // polygonal: any meridian, straight edges
  int gores = 0;
  std::vector<MeridianPoint> points;  // in the order of the file
  double first_fullness = 0;          // of the edge at the first point
  double last_fullness = 0;
  std::string fabric;
  double areal_density = 0;       // [kg/m2]
  double seam_allowance[4] = {};  // right, top, left, bottom [m]
};

struct ChuteFile {
  std::string name;
  std::vector<std::pair<std::string, double>> inputs, parameters;
  std::vector<ChuteSection> sections;
  std::vector<std::string>
      not_mapped;                    // content of the file that Ripstop does not support, one sentence each
  std::vector<std::string> remarks;  // results that the author may not have intended
  std::vector<std::string> instructions;
};

/// Formulas are evaluated anew, in the file's order, as openchute does; a remark reports a result that differs from
/// the number in the file. Throws Error(bad_data) with file, place and character for JSON that cannot be read,
/// missing or wrong values, unknown names, formulas that refer to each other or to a later one, and formulas without
/// a value.
ChuteFile read_chute(std::string_view text, const std::string& file);

}  // namespace ripstop::inline cases
