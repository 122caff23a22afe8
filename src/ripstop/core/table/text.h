// The bytes of a table as text, whatever program wrote them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ripstop::table {

struct Text {
  std::string utf8;      // without byte-order mark; lines end with '\n'
  std::string encoding;  // "UTF-8", "UTF-16", "Windows-1252"
};

/// UTF-8 or UTF-16 by their mark; without one UTF-16 where every other byte is mostly 0, UTF-8 where the bytes are
/// valid,
/// else Windows-1252, which includes Latin-1. Throws Error(bad_data) for workbooks and other binary files.
Text decode(const std::string& bytes, const std::filesystem::path& file);

/// Lower case without accents, "Prüfkraft" -> "prufkraft"; blanks of any kind are ' '.
std::string folded(std::string_view text);
/// Letters and digits of folded(), with one blank for all that lies between them. Greek letters stay.
std::string words_of(std::string_view text);
/// Without blanks at both ends, also those that do not break a line.
std::string trimmed(std::string_view text);

}  // namespace ripstop::table
