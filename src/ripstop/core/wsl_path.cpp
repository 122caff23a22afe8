#include "ripstop/core/wsl_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace ripstop {

std::string path_in_wsl(const std::filesystem::path& path) {
  const std::string text = path.string();
  for (std::size_t i = 0; i + 2 < text.size(); ++i) {
    const auto letter = static_cast<unsigned char>(text[i]);
    const bool begins = i == 0 || text[i - 1] == '/';
    if (!begins || std::isalpha(letter) == 0 || text[i + 1] != ':' ||
        (text[i + 2] != '\\' && text[i + 2] != '/'))
      continue;
    std::string name = fmt::format("/mnt/{}{}", static_cast<char>(std::tolower(letter)), text.substr(i + 2));
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
  }
  return {};
}

}  // namespace ripstop
