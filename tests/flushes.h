// Flushes of a test program to the disk, in order: the library's calls of fsync and fdatasync come here
// first. For one source of a test program.
#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string>
#include <vector>

namespace ripstop {

/// Records flushes during its life, and fails for given names.
class Flushes {
 public:
  Flushes() { living() = this; }
  ~Flushes() { living() = nullptr; }
  Flushes(const Flushes&) = delete;
  Flushes& operator=(const Flushes&) = delete;

  static Flushes*& living() {
    static Flushes* flushes = nullptr;
    return flushes;
  }
  int flushed(int file) {
    paths.push_back(std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file)));
    if (failing.empty() || paths.back().filename().string().find(failing) == std::string::npos) return 0;
    errno = EIO;
    return -1;
  }
  /// Where in the order something of this name was flushed; how many there were if never.
  std::size_t place_of(const std::filesystem::path& path) const {
    return static_cast<std::size_t>(std::find(paths.begin(), paths.end(), path) - paths.begin());
  }

  std::vector<std::filesystem::path> paths;
  std::string failing;  // in the names of files that cannot be flushed
};

}  // namespace ripstop

extern "C" int fsync(int file) {
  ripstop::Flushes* flushes = ripstop::Flushes::living();
  return flushes && flushes->flushed(file) != 0 ? -1 : static_cast<int>(syscall(SYS_fsync, file));
}

extern "C" int fdatasync(int file) {
  ripstop::Flushes* flushes = ripstop::Flushes::living();
  return flushes && flushes->flushed(file) != 0 ? -1 : static_cast<int>(syscall(SYS_fdatasync, file));
}
