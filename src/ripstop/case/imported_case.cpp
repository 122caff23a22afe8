#include "ripstop/case/imported_case.h"

#include "ripstop/core/visible.h"

namespace ripstop::inline cases {

std::string toml_quoted(const std::string& text, std::size_t longest) {
  std::string whole = visible_line(text);
  if (whole.size() > longest) {
    whole.resize(longest);
    // A cut inside a character of several bytes would not be UTF-8.
    while (!whole.empty() && (static_cast<unsigned char>(whole.back()) & 0x80)) whole.pop_back();
  }
  std::string result;
  for (const char c : whole) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return '"' + result + '"';
}

}  // namespace ripstop::inline cases
