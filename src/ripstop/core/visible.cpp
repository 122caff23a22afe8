#include "ripstop/core/visible.h"

#include <fmt/format.h>

#include "ripstop/core/utf8.h"

namespace ripstop {
namespace {

/// Also characters that change the direction of writing, so that the displayed text differs from the text in
/// memory.
bool is_control(const Character& c) {
  return !c.whole || c.code < 0x20 || (c.code >= 0x7f && c.code <= 0x9f) ||
         (c.code >= 0x202a && c.code <= 0x202e) || (c.code >= 0x2066 && c.code <= 0x2069);
}

}  // namespace

std::string visible(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const Character c = first_character(text);
    if (!is_control(c) || c.code == '\n' || c.code == '\t')
      shown += text.substr(0, c.length);
    else
      for (const char byte : text.substr(0, c.length))
        shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    text.remove_prefix(c.length);
  }
  return shown;
}

std::string visible_line(std::string_view text) {
  std::string line = visible(text);
  for (char& c : line)
    if (c == '\n' || c == '\t') c = ' ';
  return line;
}

bool has_control(std::string_view text) {
  while (!text.empty()) {
    const Character c = first_character(text);
    if (is_control(c)) return true;
    text.remove_prefix(c.length);
  }
  return false;
}

}  // namespace ripstop
