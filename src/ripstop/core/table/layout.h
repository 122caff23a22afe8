// Where the header, the units and the rows of numbers of a table are.
#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
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

/// Whether a cell is written like a number or a clock time.
bool is_value(const std::string& cell);

/// Headings of known quantities, and those that the user named. Rows are examined several times, with different
/// separators: the class remembers cells.
class KnownHeadings {
 public:
  explicit KnownHeadings(const Format& format);
  const Format& format() const { return format_; }

  /// Places of such headings in a row, from 0.
  std::vector<std::size_t> places(const Row& row);
  /// How many there are; 0 where a cell is a value.
  std::size_t count(const Row& row);

 private:
  bool contains(const std::string& cell);
  bool read(const std::string& cell) const;

  const Format& format_;
  std::vector<std::string> named_;  // words of the user's headings
  std::unordered_map<std::string, bool> cells_;
};

/// Throws Error(bad_data).
Layout find_layout(const std::vector<Row>& rows, KnownHeadings& known, const std::filesystem::path& file);

/// "Specimen 2", "Probe: 3", "Test No. 4": a line above the numbers of a specimen.
bool is_marker(const Row& row);
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
bool find_header(const std::vector<Row>& rows, std::size_t from, KnownHeadings& known,
                 const HeaderSearch& search, Header& found);

/// The columns of a header, their units from its cells or from the rows below it, and who they belong to.
Block make_block(const std::vector<Row>& rows, const Header& header, const Format& format,
                 const std::filesystem::path& file, std::vector<std::string>& notes);

}  // namespace ripstop::table
