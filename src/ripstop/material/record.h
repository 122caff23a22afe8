// Records of a tensile bench: force against displacement as the bench wrote them, in SI units.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/core/table/table.h"

namespace ripstop::inline material {

/// Coupon data that a record contains or the campaign file adds. 0 or negative: not given.
struct Coupon {
  double length = 0;        // [m] between the clamps
  double width = 0;         // [m]; a line has none
  double orientation = -1;  // angle of the pull from the warp: 0, 45 or 90 [deg]
};

/// How to read a record that does not explain itself; an empty text means: find it in the header.
struct RecordFormat {
  std::string force_column, displacement_column;
  std::string force_unit, displacement_unit;
  std::vector<table::ColumnChoice> columns{};  // of --columns; the four above come before them
  table::Decimal decimal = table::Decimal::automatic;
};

struct TensileRecord {
  std::filesystem::path file;
  std::string specimen;  // its name where the file has several; else empty
  Coupon coupon;
  std::vector<double> displacement;     // [m], in the order of the file
  std::vector<double> force;            // [N]
  std::vector<double> time;             // [s]; empty: the file has none
  std::vector<int> line;                // of the file, for messages
  std::vector<std::string> understood;  // one sentence for each column that is used

  std::string name() const;  // of the file, with the specimen
};

/// Reads the records of a table, one for each specimen in it: docs/guide/tables.md describes the forms. Comment lines
/// such as "# length: 200 mm", "# width: 50 mm", "# orientation: 45 deg" describe the coupon; the values in `given`
/// must agree with them. Throws Error(bad_data) with file, line and reason, Error(io).
std::vector<TensileRecord> read_records(const std::filesystem::path& file, const Coupon& given = {},
                                        const RecordFormat& format = {});
/// The same for a record's text; `file` is its name in messages.
std::vector<TensileRecord> parse_records(const std::string& text, const std::filesystem::path& file,
                                         const Coupon& given = {}, const RecordFormat& format = {});

/// The same for files with one specimen; others are refused.
TensileRecord read_record(const std::filesystem::path& file, const Coupon& given = {},
                          const RecordFormat& format = {});
TensileRecord parse_record(const std::string& text, const std::filesystem::path& file,
                           const Coupon& given = {}, const RecordFormat& format = {});

}  // namespace ripstop::inline material
