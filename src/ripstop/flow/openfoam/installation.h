// Finds OpenFOAM on this machine and starts its programs.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ripstop::inline flow::openfoam {

struct Installation {
  std::filesystem::path folder;   // of the programs; empty: PATH
  std::filesystem::path project;  // WM_PROJECT_DIR
  std::string version;            // "1912"
  std::string solver;             // name of its program
};

/// rhoPorousSimpleFoam or porousSimpleFoam; of sheets simpleFoam.
const char* solver_name(bool incompressible, bool sheets = false);

/// Throws Error(external): program missing (with the package to install), not of the openfoam.com line, or
/// without its etc/controlDict.
Installation find_installation(const std::filesystem::path& program_folder, bool parallel,
                               bool incompressible = false);

/// Path of one of its programs; throws Error(external) with the package's name when it is missing.
std::filesystem::path program(const Installation& installation, const std::string& name);

/// Environment of its programs.
std::vector<std::pair<std::string, std::string>> environment(const Installation& installation);

}  // namespace ripstop::inline flow::openfoam
