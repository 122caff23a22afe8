#include "ripstop/core/build_info.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

/// The file that this code was loaded from: a program, or a module of Python.
fs::path this_program() {
  Dl_info info = {};
  std::error_code error;
  if (::dladdr(reinterpret_cast<const void*>(&data_directory), &info) != 0 && info.dli_fname) {
    const fs::path file = fs::path(info.dli_fname);
    if (file.is_absolute()) return fs::weakly_canonical(file, error);
  }
  return fs::read_symlink("/proc/self/exe", error);
}

}  // namespace

std::string version() {
  return RIPSTOP_VERSION;
}

std::string compiler() {
  return RIPSTOP_COMPILER " " RIPSTOP_BUILD_TYPE;
}

std::string processor() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

std::filesystem::path find_data(const fs::path& program, const DataFolders& folders) {
  const auto has_data = [](const fs::path& folder) { return fs::is_directory(folder / "materials"); };
  const fs::path from_build = program.lexically_relative(folders.build);
  std::vector<fs::path> candidates;
  if (!from_build.empty() && *from_build.begin() != "..") candidates.push_back(folders.source);
  for (fs::path above = program.parent_path(); above.has_relative_path(); above = above.parent_path())
    candidates.push_back(above / "share/ripstop");
  candidates.push_back(folders.installed);
  candidates.push_back(folders.source);
  const auto found = std::find_if(candidates.begin(), candidates.end(), has_data);
  return found == candidates.end() ? fs::path() : *found;
}

fs::path data_directory() {
  if (const char* chosen = std::getenv("RIPSTOP_DATA")) return chosen;
  static const fs::path found =
      find_data(this_program(), {RIPSTOP_BUILD_DIR, RIPSTOP_SOURCE_DATA_DIR, RIPSTOP_INSTALLED_DATA_DIR});
  if (!found.empty()) return found;
  throw Error(ExitCode::io,
              "the folder with the materials of Ripstop was not found in share/ripstop near the program, "
              "in " RIPSTOP_INSTALLED_DATA_DIR " and in " RIPSTOP_SOURCE_DATA_DIR
              "; set RIPSTOP_DATA to its path");
}

}  // namespace ripstop
