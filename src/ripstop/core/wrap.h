// Long lines of printed text, broken for a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace ripstop {

/// Lines longer than `width` are broken at blanks. The next lines are indented as the text after the name of the first,
/// "  name    text", else by two more than the first. A word longer than a line is not broken. 0: unchanged.
std::string wrapped(const std::string& text, std::size_t width);
/// Columns of the terminal behind a file descriptor; 0: it is no terminal, or its width is not known.
std::size_t terminal_columns(int descriptor);
/// The width for wrapped(): those columns, but at least 60; 0 where they are 0.
std::size_t wrap_width(int descriptor);

}  // namespace ripstop
