#include "ripstop/core/table/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "ripstop/core/error.h"
#include "ripstop/core/utf8.h"

namespace ripstop::table {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  throw Error(ExitCode::bad_data, fmt::format("{}: {}", file.string(), reason));
}

/// Share of zeros among every other byte of the first thousands.
double zeros(std::string_view bytes, std::size_t first) {
  std::size_t count = 0, zero = 0;
  for (std::size_t i = first; i < std::min<std::size_t>(bytes.size(), 4096); i += 2, ++count)
    zero += bytes[i] == '\0';
  return count > 0 ? static_cast<double>(zero) / static_cast<double>(count) : 0.0;
}

std::string from_utf16(std::string_view bytes, bool big, const std::filesystem::path& file) {
  if (bytes.size() % 2 != 0)
    refuse(file, "UTF-16 with an incomplete character at its end: use the complete file");
  const auto unit = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(bytes[i]), b = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<std::uint32_t>(big ? a << 8 | b : b << 8 | a);
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (code >= 0xd800 && code < 0xdc00 && i + 3 < bytes.size()) {
      const std::uint32_t low = unit(i + 2);
      if (low >= 0xdc00 && low < 0xe000) {
        code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
        i += 2;
      }
    }
    append_utf8(text, code);
  }
  return text;
}

std::string from_windows_1252(std::string_view bytes) {
  constexpr std::array<std::uint32_t, 32> upper{
      0x20ac, 0x81,   0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
      0x2039, 0x0152, 0x8d,   0x017d, 0x8f,   0x90,   0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
      0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0x9d,   0x017e, 0x0178};
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 8);
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    append_utf8(text, byte >= 0x80 && byte < 0xa0 ? upper[byte - 0x80] : byte);
  }
  return text;
}

/// CR LF and CR become LF.
void unify_line_ends(std::string& text) {
  std::size_t to = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (pair) continue;
    text[to++] = text[i] == '\r' ? '\n' : text[i];
  }
  text.resize(to);
}

/// The letter without its accent; U+00C0 to U+017F, '?' where there is none.
std::string_view plain_letter(std::uint32_t code) {
  constexpr std::string_view latin_1 =
      "aaaaaaaceeeeiiiidnooooo?ouuuuyts"
      "aaaaaaaceeeeiiiidnooooo?ouuuuyty";
  constexpr std::string_view extended =
      "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkkllllllllllnnnnnnnnnoooooooorrrrrrssssssss"
      "ttttttuuuuuuuuuuuuwwyyyzzzzzzs";
  static_assert(latin_1.size() == 64 && extended.size() == 128);
  if (code == 0xc6 || code == 0xe6) return "ae";
  if (code == 0xdf) return "ss";
  if (code == 0x152 || code == 0x153) return "oe";
  if (code >= 0xc0 && code < 0x100) return latin_1.substr(code - 0xc0, 1);
  if (code >= 0x100 && code < 0x180) return extended.substr(code - 0x100, 1);
  return {};
}

bool is_blank(std::uint32_t code) {
  return code == 0x20 || (code >= 0x09 && code <= 0x0d) || code == 0xa0 ||
         (code >= 0x2000 && code <= 0x200b) || code == 0x202f || code == 0x205f || code == 0x3000 ||
         code == 0xfeff;
}

}  // namespace

Text decode(const std::string& bytes, const std::filesystem::path& file) {
  if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("\xd0\xcf\x11\xe0"))
    refuse(file, "this is an Excel workbook: save its sheet as CSV");
  std::string_view rest = bytes;
  Text text;
  if (rest.starts_with("\xff\xfe") || rest.starts_with("\xfe\xff")) {
    text = {from_utf16(rest.substr(2), rest.front() == '\xfe', file), "UTF-16"};
  } else if (rest.starts_with("\xef\xbb\xbf")) {
    rest.remove_prefix(3);
    if (!is_utf8(rest))
      refuse(file, "the file is marked as UTF-8, but has other bytes: save it as UTF-8 again");
    text = {std::string(rest), "UTF-8"};
  } else if (const double even = zeros(rest, 0), odd = zeros(rest, 1); std::max(even, odd) > 0.5) {
    text = {from_utf16(rest, even > odd, file), "UTF-16"};
  } else if (is_utf8(rest)) {
    text = {bytes, "UTF-8"};
  } else {
    text = {from_windows_1252(rest), "Windows-1252"};
  }
  if (const std::size_t at = text.utf8.find('\0'); at != std::string::npos)
    refuse(file,
           fmt::format("line {} has a character with the code 0: this is not a text file; export the "
                       "table as CSV",
                       std::count(text.utf8.begin(), text.utf8.begin() + static_cast<long>(at), '\n') + 1));
  constexpr char end_of_file = '\x1a';  // of DOS
  while (text.utf8.ends_with(end_of_file)) text.utf8.pop_back();
  unify_line_ends(text.utf8);
  return text;
}

std::string folded(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    if (const char c = text.front(); static_cast<unsigned char>(c) < 0x80) {
      result += is_blank(static_cast<unsigned char>(c)) ? ' '
                : c >= 'A' && c <= 'Z'                  ? static_cast<char>(c - 'A' + 'a')
                                                        : c;
      text.remove_prefix(1);
      continue;
    }
    const Character c = first_character(text);
    const std::string_view letter = plain_letter(c.code);
    if (is_blank(c.code) && c.whole)
      result += ' ';
    else if (c.code >= 0x391 && c.code <= 0x3a9)  // Greek capitals
      append_utf8(result, c.code + 0x20);
    else if (!letter.empty())
      result += letter;
    else
      result += text.substr(0, c.length);
    text.remove_prefix(c.length);
  }
  return result;
}

std::string words_of(std::string_view text) {
  std::string result;
  bool apart = false;
  for (const char c : folded(text)) {
    const bool part =
        (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
    if (part && apart && !result.empty()) result += ' ';
    apart = !part;
    if (part) result += c;
  }
  return result;
}

std::string trimmed(std::string_view text) {
  const auto is_plain = [](char c) { return c > ' ' && static_cast<unsigned char>(c) < 0x80; };
  while (!text.empty() && !is_plain(text.front())) {
    const Character c = first_character(text);
    if (!c.whole || !is_blank(c.code)) break;
    text.remove_prefix(c.length);
  }
  while (!text.empty() && !is_plain(text.back())) {
    std::size_t from = text.size() - 1;
    while (from > 0 && (static_cast<unsigned char>(text[from]) & 0xc0) == 0x80) --from;
    const Character c = first_character(text.substr(from));
    if (!c.whole || !is_blank(c.code)) break;
    text.remove_suffix(text.size() - from);
  }
  return std::string(text);
}

}  // namespace ripstop::table
