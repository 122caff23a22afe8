// Characters of UTF-8.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ripstop {

struct Character {
  std::size_t length = 1;  // bytes
  std::uint32_t code = 0;
  bool whole = false;  // valid UTF-8
};

/// The first character of a text that is not empty.
Character first_character(std::string_view text);
bool is_utf8(std::string_view text);
/// Adds a character; an invalid character becomes U+FFFD.
void append_utf8(std::string& text, std::uint32_t code);

}  // namespace ripstop
