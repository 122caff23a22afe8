#pragma once

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

namespace ripstop {

inline bool openfoam_is_installed() {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (std::filesystem::exists(std::filesystem::path(folder) / "rhoPorousSimpleFoam")) return true;
  }
  return false;
}

}  // namespace ripstop
