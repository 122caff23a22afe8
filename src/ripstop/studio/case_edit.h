// Changes of single keys of a case file as text: comments, order and layout of all other lines remain.
#pragma once

#include <map>
#include <string>

namespace ripstop::inline studio {

/// Every value of the file by its full name ("parachute.lines.count"), as it is written there. Throws
/// InputError(usage) for a mistake in the syntax.
std::map<std::string, std::string> written_values(const std::string& text);

/// The text with the key set to `literal`, a value in TOML. A new key follows the last one of its table. A new table,
/// or a new member of a list of tables ("measured[2].speed_m_s"), follows the end of the file. Throws Error(usage)
/// where any other value would change.
std::string with_key(const std::string& text, const std::string& key, const std::string& literal);

/// The text without the lines of the key, or of the table with its header ("body.rocket", "measured[0]"). Throws
/// Error(usage) for a key that is not there, or that shares its line with others.
std::string without_key(const std::string& text, const std::string& key);

}  // namespace ripstop::inline studio
