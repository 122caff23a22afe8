// Version and compiler of this program, and the location of its shipped data.
#pragma once

#include <filesystem>
#include <string>

namespace ripstop {

std::string version();
std::string compiler();   // name, version and build type
std::string processor();  // model name as the kernel reports it
/// Folder that contains `materials/` and `examples/`: $RIPSTOP_DATA, else the result of find_data() for this
/// program. Throws Error(io) when none exists.
std::filesystem::path data_directory();

struct DataFolders {
  std::filesystem::path build;      // with the programs that are not installed
  std::filesystem::path source;     // their data
  std::filesystem::path installed;  // data of installed programs
};
/// Data of the program, or Python module, in this file: the source tree's for one in the build tree. Else
/// `share/ripstop` in a folder above the file, else the configured installed data, else the source tree. Empty: none.
std::filesystem::path find_data(const std::filesystem::path& program, const DataFolders& folders);

}  // namespace ripstop
