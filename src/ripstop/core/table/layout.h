// Where the header, the units and the rows of numbers of a table are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/core/table/rows.h"
#include "ripstop/core/table/table.h"

namespace ripstop::table {

/// A header and the rows below it.
struct Block {
  int header_line = 0;
  std::string name;                     // of the specimen, if a line above gives it
  std::vector<Column> columns;          // with a quantity; without values
  std::size_t width = 0;                // columns of the header
  std::vector<int> specimen_of;         // for each of `columns`, side by side: from 0; -1: of all of them
  std::vector<std::string> side_names;  // one for each specimen side by side; empty: there is one
  std::vector<const Row*> rows;
};

struct Layout {
  std::vector<Block> blocks;
  std::vector<std::string> notes;
};

/// "file:7: reason"; without the line where it is 0.
[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& reason);

/// Throws Error(bad_data).
Layout find_layout(const std::vector<Row>& rows, const Format& format, const std::filesystem::path& file);

/// Whether a cell is written like a number or a clock time.
bool is_value(const std::string& cell);
/// Headings of known quantities in a row, and those that the user named; 0 where a cell is a value.
std::size_t recognised(const Row& row, const Format& format);

/// "Specimen 2", "Probe: 3", "Test No. 4": a line above the numbers of a specimen.
bool is_marker(const Row& row);
/// Places of these headings in a row, from 0.
std::vector<std::size_t> known_places(const Row& row, const Format& format);

/// A row of headings and the first row of numbers below it.
struct Header {
  std::size_t header = 0, data = 0;
  std::size_t headings = 0;
  bool consistent = false;  // no more numbers than headings, and one for each known one
};
struct HeaderSearch {
  std::size_t fewest = 2;  // known headings
  bool comments = false;   // look into comments
};
/// False: there is none from this row on.
bool find_header(const std::vector<Row>& rows, std::size_t from, const Format& format,
                 const HeaderSearch& search, Header& found);

/// The columns of a header, their units from its cells or from the rows below it, and who they belong to.
Block make_block(const std::vector<Row>& rows, const Header& header, const Format& format,
                 const std::filesystem::path& file, std::vector<std::string>& notes);

}  // namespace ripstop::table
