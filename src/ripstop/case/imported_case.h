// A case that was converted from the file of another program, and a report on every part of that file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ripstop::inline cases {

/// Every sentence of the report belongs to one list; the content of the file is in the first three.
struct ImportedCase {
  std::string case_text;
  std::string type;                     // of [parachute]
  std::vector<std::string> mapped;      // as the file has it
  std::vector<std::string> changed;     // in the case, but not as the file has it, and why
  std::vector<std::string> not_mapped;  // not in the case, and why
  std::vector<std::string> assumed;     // in the case, but not in the file
};

/// Quoted as TOML has it, without control characters, and cut at `longest` bytes.
std::string toml_quoted(const std::string& text, std::size_t longest);

}  // namespace ripstop::inline cases
