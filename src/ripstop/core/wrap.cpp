#include "ripstop/core/wrap.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace ripstop {
namespace {

std::size_t indent_of(const std::string& line, std::size_t width) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find("  ", begin);
  const std::size_t text = gap == std::string::npos ? gap : line.find_first_not_of(' ', gap);
  return text <= width / 2 ? text : begin + 2;
}

std::string wrapped_line(std::string line, std::size_t width) {
  const std::size_t indent = indent_of(line, width);
  std::string done;
  while (line.size() > width) {
    std::size_t blank = line.rfind(' ', width);
    if (blank == std::string::npos || blank <= indent) blank = line.find(' ', indent + 1);
    if (blank == std::string::npos) break;
    done += line.substr(0, blank) + "\n";
    line = std::string(indent, ' ') + line.substr(blank + 1);
  }
  return done + line;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width) {
  if (width == 0) return text;
  std::string done;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    done += wrapped_line(text.substr(begin, end - begin), width);
    if (end < text.size()) done += '\n';
    begin = end + 1;
  }
  return done;
}

std::size_t terminal_columns(int descriptor) {
  winsize size{};
  const bool known = isatty(descriptor) != 0 && ioctl(descriptor, TIOCGWINSZ, &size) == 0;
  return known ? size.ws_col : 0;
}

std::size_t wrap_width(int descriptor) {
  constexpr std::size_t least = 60;
  const std::size_t columns = terminal_columns(descriptor);
  return columns > 0 ? std::max(columns, least) : 0;
}

}  // namespace ripstop
