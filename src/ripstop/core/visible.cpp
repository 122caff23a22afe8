#include "ripstop/core/visible.h"

#include <fmt/format.h>

#include <cstdint>

namespace ripstop {
namespace {

struct Character {
  std::size_t length = 1;
  std::uint32_t code = 0;
  bool whole = false;  // valid UTF-8
};

Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {1, lead, true};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
  std::uint32_t code = lead & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < least[length] || code > 0x10ffff || surrogate) return {};
  return {length, code, true};
}

/// Also what turns the direction of writing: what is read is then not what stands there.
bool is_control(const Character& c) {
  return !c.whole || c.code < 0x20 || (c.code >= 0x7f && c.code <= 0x9f) ||
         (c.code >= 0x202a && c.code <= 0x202e) || (c.code >= 0x2066 && c.code <= 0x2069);
}

}  // namespace

std::string visible(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const Character c = first_of(text);
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
    const Character c = first_of(text);
    if (is_control(c)) return true;
    text.remove_prefix(c.length);
  }
  return false;
}

}  // namespace ripstop
