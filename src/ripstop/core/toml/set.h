// Replacement of one value of a parsed file by its full name, for --set and --vary.
#pragma once

#include <string>
#include <vector>

#include "ripstop/core/toml/document.h"

namespace ripstop {

/// A key by its full name ("flow.speed_m_s", "flow.cells[2]") and its value as TOML. A word that is no TOML
/// is taken as text, so that flow.engine=openfoam needs no quotes.
struct Setting {
  std::string key, value;
  std::string option = "--set";  // that gave it, for messages
  bool remove = false;           // the key, or the table, in place of a value
};

/// "KEY=VALUE" as typed. Throws Error(usage) when there is no '=' or nothing on one side of it.
Setting parse_setting(const std::string& text, const std::string& option);

/// Values parted by commas outside brackets and quotes: "[1, 2],[3, 4]" are two. Throws
/// Error(usage) for an empty one.
std::vector<std::string> split_values(const std::string& text);

/// Sets the value; missing tables are made. Removes the key of a setting with `remove`. Throws
/// InputError(usage) for a name that cannot be one, a value that cannot be read, a place in a list that the file does
/// not give, or a key to remove that is not there.
void set_value(Document& document, const Setting& setting);

}  // namespace ripstop
