// Text of files and of the command line as a terminal may show it.
#pragma once

#include <string>
#include <string_view>

namespace ripstop {

/// Control characters but line break and tab, what turns the direction of writing, and bytes that are no UTF-8 as
/// \xNN: nothing of it moves a cursor, clears a screen or hides what stands there.
std::string visible(std::string_view text);
/// The same in one line: line breaks and tabs are blanks.
std::string visible_line(std::string_view text);
/// Whether `text` holds such a character, or a line break or tab.
bool has_control(std::string_view text);

}  // namespace ripstop
