#include "ripstop/core/build_info.h"

#include <cstdlib>
#include <fstream>

#include "ripstop/core/error.h"

namespace ripstop {

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

std::filesystem::path data_directory() {
  if (const char* chosen = std::getenv("RIPSTOP_DATA")) return chosen;
  for (const char* candidate : {RIPSTOP_SOURCE_DATA_DIR, RIPSTOP_INSTALLED_DATA_DIR}) {
    if (std::filesystem::is_directory(std::filesystem::path(candidate) / "materials")) return candidate;
  }
  throw Error(ExitCode::io,
              "the folder with Ripstop's materials was not found: looked in " RIPSTOP_SOURCE_DATA_DIR
              " and " RIPSTOP_INSTALLED_DATA_DIR "; set RIPSTOP_DATA to it");
}

}  // namespace ripstop
