// Paths of Windows, which users of WSL (Windows Subsystem for Linux) may give.
#pragma once

#include <filesystem>
#include <string>

namespace ripstop {

/// "/mnt/c/runs" for "C:\\runs" or "C:/runs", also after a folder of Linux; empty for any other path.
std::string path_in_wsl(const std::filesystem::path& path);

}  // namespace ripstop
