// Whether tests can compare with OpenFOAM.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/openfoam/openfoam.h"

namespace ripstop {

/// Why not; empty if they can. Other failures than these two are not hidden.
inline std::string why_no_openfoam() {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path ? path : "");
  bool found = false;
  for (std::string folder; std::getline(folders, folder, ':');)
    found = found || std::filesystem::exists(std::filesystem::path(folder) / "rhoPorousSimpleFoam");
  if (!found) return "OpenFOAM is not installed";
  const TemporaryFolder temporary("openfoam-probe");
  OpenFoamSettings settings;
  settings.folder = temporary.path / "case";
  FlowProblem problem;
  problem.grid = {{0, 0, 0}, {1, 1, 1}, 4, 4, 4};
  problem.air.velocity = {0, 0, 10};
  problem.bodies = {porous_body({{21}, 65.98, 37.45})};
  try {
    make_openfoam(settings)->start(problem)->advance(1, 0);
  } catch (const Error& error) {
    if (std::string(error.what()).find("cannot run function objects") != std::string::npos)
      return error.what();
  }
  return "";
}

}  // namespace ripstop
