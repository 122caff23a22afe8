// Lines of a text as rows of cells.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ripstop::table {

struct Row {
  int line = 0;  // of the file, where the row begins
  std::vector<std::string> cells;
  std::size_t written = 0;  // cells, with the empty ones at the end
  bool comment = false;     // began with '#', which is taken off
  std::string text;         // of a comment

  bool blank() const;  // no cell has text
};

/// A separator of its own: one blank or more; two blanks or more.
inline constexpr char blanks = ' ', wide_blanks = '\v';

/// Cells without blanks at their ends and without their quotes ("", '' or as in RFC 4180, then with line breaks and
/// separators inside). Empty cells at the end of a row are left out. Throws Error(bad_data) for a quote that does not
/// end.
std::vector<Row> split_rows(std::string_view text, char separator, const std::filesystem::path& file);

/// For messages and explanations: "semicolon".
std::string name_of_separator(char separator);

}  // namespace ripstop::table
