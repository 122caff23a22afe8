// Records of a tensile bench: force against displacement as the bench wrote them, in SI units.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ripstop {

/// What the record says about its coupon, and what a file beside it may add. 0 or negative: not said.
struct Coupon {
  double length = 0;        // [m] between the clamps
  double width = 0;         // [m]; a line has none
  double orientation = -1;  // angle of the pull from the warp: 0, 45 or 90 [deg]
};

/// How to read a record that does not explain itself; an empty text means: find it in the header.
struct RecordFormat {
  std::string force_column, displacement_column;
  std::string force_unit, displacement_unit;
};

struct TensileRecord {
  std::filesystem::path file;
  Coupon coupon;
  std::vector<double> displacement;  // [m], in the order of the file
  std::vector<double> force;         // [N]
  std::vector<double> time;          // [s]; empty: the file has none
  std::vector<int> line;             // of the file, for messages
};

/// Reads a CSV record. Columns may be in any order, separated by comma, semicolon (then with decimal commas
/// too) or tab; the header names quantity and unit as in "force [N]", "Load (lbf)", "extension_mm", or the
/// line after it has the units. Comment lines such as "# length: 200 mm", "# width: 50 mm", "# orientation:
/// 45 deg" describe the coupon; what `given` says must agree with them. Throws Error(bad_data) with file,
/// line and reason, Error(io).
TensileRecord read_record(const std::filesystem::path& file, const Coupon& given = {},
                          const RecordFormat& format = {});

/// The same for a record's text; `file` is its name in messages.
TensileRecord parse_record(const std::string& text, const std::filesystem::path& file,
                           const Coupon& given = {}, const RecordFormat& format = {});

}  // namespace ripstop
