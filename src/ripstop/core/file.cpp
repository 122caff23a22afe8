#include "ripstop/core/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/core/wsl_path.h"

namespace ripstop {
namespace {

/// Linux would make a file or folder with this name in the current folder.
void refuse_path_of_windows(const std::filesystem::path& path) {
  const std::string name = path_in_wsl(path);
  if (!name.empty() && !path.is_absolute())
    throw Error(ExitCode::usage,
                fmt::format("{}: is a path of Windows; within WSL it is {}", path.string(), name));
}

[[noreturn]] void fail(const char* task, const std::filesystem::path& path, int reason) {
  std::string advice;
  if (reason == ENOSPC || reason == EDQUOT) advice = "; free some space, or use another folder";
  if (reason == EACCES || reason == EPERM || reason == EROFS)
    advice = "; choose a folder with write permission";
  if (const std::string name = path_in_wsl(path); reason == ENOENT && !name.empty())
    advice = fmt::format("; it is a path of Windows, and within WSL it is {}", name);
  throw Error(ExitCode::io, fmt::format("cannot {} {}: {}{}", task, path.string(),
                                        std::generic_category().message(reason), advice));
}

/// Closes on scope exit; close() reports, since a full disk may only show there.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

/// 0, or errno.
int write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd, bytes.data(), bytes.size());
    if (count < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return 0;
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// The rename is only on the disk when the folder is.
void sync_folder(const std::filesystem::path& folder) {
  const Descriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fd.get() < 0) fail("open folder", folder, errno);
  // EINVAL: a file system that cannot sync folders has nothing to wait for.
  if (::fsync(fd.get()) != 0 && errno != EINVAL) fail("save folder", folder, errno);
}

/// A name in the folder of `path` that no other process or thread uses.
std::filesystem::path temporary_name(const std::filesystem::path& path) {
  static std::atomic<unsigned> counter{0};
  return folder_of(path) / fmt::format(".{}.{}-{}.tmp", path.filename().string(), ::getpid(), counter++);
}

/// A temporary file of this process alone: its lock shows that its writer is alive, on any machine.
int open_temporary(const std::filesystem::path& path, std::filesystem::path& temporary) {
  for (;;) {
    temporary = temporary_name(path);
    const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0 && errno == EEXIST) continue;  // left by a killed process with the same number
    if (fd < 0) return fd;
    const bool own =
        ::flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;  // some file systems have no locks
    struct stat status = {};
    if (own && ::fstat(fd, &status) == 0 && status.st_nlink > 0) return fd;
    ::close(fd);  // somebody took it for a leftover before it was locked
  }
}

void drop_leftovers(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::directory_iterator entry(folder_of(path), error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (written_as(entry->path().filename()) != path.filename()) continue;
    const Descriptor fd(::open(entry->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (fd.get() >= 0 && ::flock(fd.get(), LOCK_EX | LOCK_NB) == 0) ::unlink(entry->path().c_str());
  }
}

}  // namespace

std::string written_as(const std::string& file) {
  if (!file.starts_with('.') || !file.ends_with(".tmp") || file.size() < 6) return {};
  const std::string body = file.substr(1, file.size() - 5);
  const std::size_t dot = body.rfind('.');
  if (dot == std::string::npos || dot == 0) return {};
  const std::string number = body.substr(dot + 1);
  const bool numbers = !number.empty() && number.find_first_not_of("0123456789-") == std::string::npos;
  return numbers ? body.substr(0, dot) : std::string{};
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  write_file(path, std::span(&bytes, 1));
}

void write_file(const std::filesystem::path& path, std::span<const std::string_view> pieces) {
  refuse_path_of_windows(path);
  drop_leftovers(path);
  std::filesystem::path temporary;
  const int opened = open_temporary(path, temporary);
  if (opened < 0) fail("write", path, errno);
  Descriptor fd(opened);
  int reason = 0;
  for (const std::string_view piece : pieces)
    if (reason == 0) reason = write_all(fd.get(), piece);
  if (reason == 0 && ::fsync(fd.get()) != 0) reason = errno;
  if (!fd.close() && reason == 0) reason = errno;
  if (reason == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) reason = errno;
  if (reason != 0) {
    ::unlink(temporary.c_str());
    fail("write", path, reason);
  }
  sync_folder(folder_of(path));
}

std::string read_file(const std::filesystem::path& path) {
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));  // a pipe would block
  if (fd.get() < 0) fail("read", path, errno);
  struct stat status = {};
  if (::fstat(fd.get(), &status) != 0) fail("read", path, errno);
  if (S_ISDIR(status.st_mode)) fail("read", path, EISDIR);
  if (!S_ISREG(status.st_mode))
    throw Error(
        ExitCode::io,
        fmt::format("cannot read {}: it is a pipe or a device, not a file; write its content into a file",
                    path.string()));
  // One byte more, so that it need not grow before the end is seen.
  std::string bytes(static_cast<size_t>(status.st_size) + 1, '\0');
  size_t done = 0;
  for (;;) {  // the size is a hint only: a file can grow, and /proc gives 0
    if (done == bytes.size()) bytes.resize(bytes.size() + 4096);
    const ssize_t count = ::read(fd.get(), bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("read", path, errno);
    if (count == 0) break;
    done += static_cast<size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

void make_folder(const std::filesystem::path& folder) {
  refuse_path_of_windows(folder);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail("create folder", folder, error.value());
  if (!std::filesystem::is_directory(folder, error)) fail("create folder", folder, ENOTDIR);
}

void append_to_file(const std::filesystem::path& path, std::string_view bytes) {
  Descriptor fd(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (fd.get() < 0) fail("append to", path, errno);
  int reason = write_all(fd.get(), bytes);
  if (reason == 0 && ::fdatasync(fd.get()) != 0) reason = errno;
  if (!fd.close() && reason == 0) reason = errno;
  if (reason != 0) fail("append to", path, reason);
}

void remove_path(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove_all(path, error);
  if (error) fail("remove", path, error.value());
}

TemporaryFolder::TemporaryFolder(const std::string& name) {
  std::string pattern =
      (std::filesystem::temp_directory_path() / ("ripstop-" + name + "-" + std::string(6, 'X'))).string();
  if (!::mkdtemp(pattern.data())) fail("create folder", pattern, errno);
  path = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
}

}  // namespace ripstop
