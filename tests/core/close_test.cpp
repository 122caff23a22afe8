// A file system can report a failed write as late as at the close of the file (NFS, quotas).
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace {
bool closing_fails = false;
}

/// In place of the C library's, for everything in this program.
extern "C" int close(int file) {
  const long closed = syscall(SYS_close, file);
  if (!closing_fails) return static_cast<int>(closed);
  errno = EDQUOT;
  return -1;
}

namespace ripstop {
namespace {

template <class Action>
std::string refused(Action action) {
  closing_fails = true;
  std::string why;
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    why = error.what();
  }
  closing_fails = false;
  return why;
}

TEST(Files, AFailedCloseIsAFailedWrite) {
  const TemporaryFolder folder("close");
  const std::filesystem::path file = folder.path / "a";
  write_file(file, "old");
  const std::string why = refused([&] { write_file(file, "new"); });
  EXPECT_NE(why.find("cannot write " + file.string()), std::string::npos) << why;
  EXPECT_EQ(read_file(file), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1);
  EXPECT_NE(refused([&] { append_to_file(file, "more"); }).find("cannot append"), std::string::npos);
}

}  // namespace
}  // namespace ripstop
