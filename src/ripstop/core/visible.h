// Text of files and of the command line as a terminal may show it.
#pragma once

#include <string>
#include <string_view>

namespace ripstop {

/// Shows control characters except line break and tab, characters that change the direction of writing, and
/// bytes that are not UTF-8 as \xNN: no part of the result moves a cursor, clears a screen or hides text.
std::string visible(std::string_view text);
/// The same in one line: line breaks and tabs are blanks.
std::string visible_line(std::string_view text);
/// Whether `text` contains such a character, or a line break or tab.
bool has_control(std::string_view text);

}  // namespace ripstop
