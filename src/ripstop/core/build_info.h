// What this program is: version, compiler, and where its shipped data lie.
#pragma once

#include <filesystem>
#include <string>

namespace ripstop {

std::string version();
std::string compiler();   // name, version and build type
std::string processor();  // model name as the kernel reports it
/// Folder that holds `materials/` and `examples/`: $RIPSTOP_DATA, else the source tree, else the installed
/// one. Throws Error(io) when none exists.
std::filesystem::path data_directory();

}  // namespace ripstop
