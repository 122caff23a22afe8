#include "ripstop/core/file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "../flushes.h"
#include "../refusal.h"
#include "ripstop/core/error.h"
#include "ripstop/core/hash.h"
#include "ripstop/core/toml/document.h"

namespace ripstop {
namespace {

/// Without waiting for the disk, for tests that damage a file many times.
void overwrite(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(WriteFile, BytesComeBackAndNothingElseIsLeft) {
  const TemporaryFolder folder("file");
  std::string bytes(300000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i / 7);
  for (const std::string& content : {bytes, std::string(), std::string("\0\r\n", 3)}) {
    write_file(folder.path / "a", content);
    EXPECT_TRUE(read_file(folder.path / "a") == content);
  }
  EXPECT_EQ(files_in(folder.path), 1u);
}

TEST(File, APathOfWindowsIsRefusedWithItsNameInWsl) {
  const TemporaryFolder folder("file-windows");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path);
  for (const auto& [path, name] :
       {std::pair{"C:\\Users\\me\\first", "/mnt/c/Users/me/first"}, {"d:/runs/first", "/mnt/d/runs/first"}}) {
    for (const std::function<void()>& make : std::vector<std::function<void()>>{
             [&, path = path] { make_folder(path); }, [&, path = path] { write_file(path, "text"); }})
      EXPECT_EQ(refusal_of(make, ExitCode::usage),
                std::string(path) + ": is a path of Windows; within WSL it is " + name);
    const std::string advice = refusal_of([&, path = path] { read_file(path); }, ExitCode::io);
    EXPECT_NE(advice.find(std::string("within WSL it is ") + name), std::string::npos) << advice;
    const std::string case_file = refusal_of([&, path = path] { read_text_file(path); }, ExitCode::io);
    EXPECT_NE(case_file.find(std::string("within WSL it is ") + name), std::string::npos) << case_file;
    const std::string of_a_case =  // a file named by a case, next to which it is looked for
        refusal_of([&, path = path] { read_file(folder.path / path); }, ExitCode::io);
    EXPECT_NE(of_a_case.find(std::string("within WSL it is ") + name), std::string::npos) << of_a_case;
  }
  EXPECT_EQ(files_in(folder.path), 0u);
  make_folder("a:b");  // a name of Linux
  EXPECT_TRUE(std::filesystem::is_directory(folder.path / "a:b"));
  std::filesystem::current_path(before);
}

TEST(WriteFile, FilesOfAKilledWriterAreRemovedAndThoseOfALivingOneRemain) {
  const TemporaryFolder folder("file-left");
  overwrite(folder.path / ".a.4711-3.tmp", "half");
  overwrite(folder.path / ".b.4711-3.tmp", "of another file");
  overwrite(folder.path / ".a.4712-0.tmp", "of a writer that lives");
  const int living = ::open((folder.path / ".a.4712-0.tmp").c_str(), O_RDWR);
  ASSERT_EQ(::flock(living, LOCK_EX), 0);
  write_file(folder.path / "a", "whole");
  EXPECT_FALSE(std::filesystem::exists(folder.path / ".a.4711-3.tmp"));
  EXPECT_TRUE(std::filesystem::exists(folder.path / ".b.4711-3.tmp"));
  EXPECT_TRUE(std::filesystem::exists(folder.path / ".a.4712-0.tmp"));
  EXPECT_EQ(read_file(folder.path / "a"), "whole");
  ::close(living);
}

TEST(WriteFile, AFailedWriteLeavesTheOldFileAndNoRubbish) {
  const TemporaryFolder folder("file-full");
  write_file(folder.path / "a", "old");
  struct rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit limited = before;
  limited.rlim_cur = 10000;
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
  std::string message;
  try {
    write_file(folder.path / "a", std::string(20000, 'x'));
  } catch (const Error& error) {
    message = error.what();
  }
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(message.find((folder.path / "a").string()), std::string::npos) << message;
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  EXPECT_EQ(read_file(folder.path / "a"), "old");
  EXPECT_EQ(files_in(folder.path), 1u);
}

TEST(WriteFile, AFullDiskIsNamedAsTheReason) {
  const std::string message = refusal_of([] { append_to_file("/dev/full", "x"); }, ExitCode::io);
  EXPECT_EQ(message,
            "cannot append to /dev/full: No space left on device; free some space, or use another folder");
}

// A name that is on the disk before its bytes would be an empty file after a power cut.
TEST(WriteFile, TheBytesAreOnTheDiskBeforeTheNameAndThatIsBeforeItReturns) {
  const TemporaryFolder folder("file-flushed");
  write_file(folder.path / "a", "old");
  Flushes flushes;
  write_file(folder.path / "a", "new");
  ASSERT_EQ(flushes.paths.size(), 2u);
  EXPECT_EQ(written_as(flushes.paths[0].filename()), "a");  // not yet renamed
  EXPECT_EQ(flushes.paths[1], folder.path);
  append_to_file(folder.path / "a", "er");
  ASSERT_EQ(flushes.paths.size(), 3u);
  EXPECT_EQ(flushes.paths[2], folder.path / "a");
  EXPECT_EQ(read_file(folder.path / "a"), "newer");
}

TEST(WriteFile, AFailedFlushIsNoSuccess) {
  const TemporaryFolder folder("file-unflushed");
  write_file(folder.path / "a", "old");
  Flushes flushes;
  const auto refused = [&](const std::string& failing, const std::function<void()>& what) {
    flushes.failing = failing;
    const std::string message = refusal_of(what, ExitCode::io);
    EXPECT_NE(message.find("Input/output error"), std::string::npos) << message;
    EXPECT_NE(message.find(folder.path.string()), std::string::npos) << message;
  };
  refused(".a.", [&] { write_file(folder.path / "a", "new"); });
  EXPECT_EQ(read_file(folder.path / "a"), "old");
  EXPECT_EQ(files_in(folder.path), 1u);
  refused("file-unflushed", [&] { write_file(folder.path / "a", "new"); });
  refused("a", [&] { append_to_file(folder.path / "a", "er"); });
}

TEST(WriteFile, AReaderSeesOneOfTheTwoContentsNeverAMixture) {
  const TemporaryFolder folder("file-race");
  const std::string contents[2] = {std::string(100000, 'a'), std::string(50000, 'b')};
  write_file(folder.path / "f", contents[0]);
  std::jthread writer([&] {
    for (int i = 0; i < 60; ++i) write_file(folder.path / "f", contents[i % 2]);
  });
  for (int i = 0; i < 300; ++i) {
    const std::string read = read_file(folder.path / "f");
    ASSERT_TRUE(read == contents[0] || read == contents[1]) << read.size();
  }
}

TEST(Files, EveryFailureNamesThePathAndTheReason) {
  const TemporaryFolder folder("file-errors");
  write_file(folder.path / "file", "x");
  const auto expect = [](const std::string& message, const std::string& path, const std::string& reason) {
    EXPECT_NE(message.find(path), std::string::npos) << message;
    EXPECT_NE(message.find(reason), std::string::npos) << message;
  };
  const std::string missing = (folder.path / "none/a").string(), below = (folder.path / "file/a").string();
  expect(refusal_of([&] { write_file(missing, "x"); }, ExitCode::io), missing, "No such file");
  expect(refusal_of([&] { read_file(missing); }, ExitCode::io), missing, "No such file");
  expect(refusal_of([&] { read_file(folder.path); }, ExitCode::io), folder.path.string(), "Is a directory");
  expect(refusal_of([&] { write_file(folder.path, "x"); }, ExitCode::io), folder.path.string(), "directory");
  expect(refusal_of([&] { make_folder(below); }, ExitCode::io), below, "Not a directory");
  expect(refusal_of([&] { make_folder(folder.path / "file"); }, ExitCode::io), "file", "Not a directory");
  expect(refusal_of([&] { hash_folder(missing); }, ExitCode::io), missing, "No such file");
  const std::string kernels = "/proc/self/comm";  // nobody's to remove
  expect(refusal_of([&] { remove_path(kernels); }, ExitCode::io), kernels, "cannot remove");
  remove_path(missing);
  EXPECT_EQ(read_file(folder.path / "file"), "x");
}

TEST(Hash, IsTheXxh3OfThePublishedVectors) {
  // XXH3_128bits of no input, seed 0: the specification's first test vector.
  EXPECT_EQ(hash_bytes(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_NE(hash_bytes("a"), hash_bytes("b"));
}

TEST(Hash, OfAFolderIsThatOfItsNamesAndContentsWhereverItLies) {
  const TemporaryFolder folder("hash");
  for (const char* copy : {"one", "two"}) {
    make_folder(folder.path / copy / "sub");
    write_file(folder.path / copy / "b", "1");
    write_file(folder.path / copy / "sub/a", "2");
  }
  const std::string hash = hash_folder(folder.path / "one");
  EXPECT_EQ(hash_folder(folder.path / "two"), hash);
  EXPECT_EQ(hash_file(folder.path / "one/b"), hash_bytes("1"));
  std::filesystem::rename(folder.path / "two/b", folder.path / "two/c");
  EXPECT_NE(hash_folder(folder.path / "two"), hash);
  std::filesystem::rename(folder.path / "two/c", folder.path / "two/b");
  EXPECT_EQ(hash_folder(folder.path / "two"), hash);
  write_file(folder.path / "two/sub/a", "3");
  EXPECT_NE(hash_folder(folder.path / "two"), hash);
}

TEST(Hash, OfAFolderWithADeviceInItIsRefused) {
  const TemporaryFolder folder("hash");
  write_file(folder.path / "a", "1");
  std::filesystem::create_symlink("/dev/null", folder.path / "b");  // a pipe there would not end
  const std::string message = refusal_of([&] { hash_folder(folder.path); }, ExitCode::io);
  EXPECT_NE(message.find((folder.path / "b").string()), std::string::npos) << message;
  refusal_of([&] { seal_folder(folder.path); }, ExitCode::io);
}

TEST(Sealed, EveryTruncationAndEveryChangedByteIsNoticed) {
  const TemporaryFolder folder("sealed");
  const std::filesystem::path path = folder.path / "state";
  const std::string content("x = 1.5\0\n\nend", 13);
  write_sealed(path, content);
  EXPECT_EQ(read_sealed(path), content);
  const std::string sealed = read_file(path);
  const std::filesystem::path damaged = folder.path / "damaged";
  for (std::size_t length = 0; length < sealed.size(); ++length) {
    overwrite(damaged, sealed.substr(0, length));
    refusal_of([&] { read_sealed(damaged); }, ExitCode::bad_data);
  }
  overwrite(damaged, sealed + "x");
  refusal_of([&] { read_sealed(damaged); }, ExitCode::bad_data);
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    for (int flip : {0x01, 0x20, 0x80, 0xff}) {
      std::string changed = sealed;
      changed[i] = static_cast<char>(changed[i] ^ flip);
      overwrite(damaged, changed);
      refusal_of([&] { read_sealed(damaged); }, ExitCode::bad_data);
    }
  }
  write_sealed(path, "");
  EXPECT_EQ(read_sealed(path), "");
}

TEST(Sealed, PiecesMakeTheFileOfTheWhole) {
  const TemporaryFolder folder("sealed-pieces");
  const std::vector<std::string_view> pieces{"x = ", "", "1.5\n", {}};
  write_sealed(folder.path / "pieces", pieces);
  write_sealed(folder.path / "whole", "x = 1.5\n");
  EXPECT_EQ(read_file(folder.path / "pieces"), read_file(folder.path / "whole"));
  EXPECT_EQ(read_sealed(folder.path / "pieces"), "x = 1.5\n");
}

TEST(SealedFolder, NamesTheFileThatIsMissingNewOrChanged) {
  const TemporaryFolder folder("sealed-folder");
  make_folder(folder.path / "sub");
  write_file(folder.path / "shape", "1");
  write_file(folder.path / "sub/flow", "2");
  refusal_of([&] { check_folder(folder.path); }, ExitCode::bad_data);  // not sealed yet
  seal_folder(folder.path);
  EXPECT_NO_THROW(check_folder(folder.path));
  const auto expect_named = [&](const std::string& name) {
    const std::string message = refusal_of([&] { check_folder(folder.path); }, ExitCode::bad_data);
    EXPECT_NE(message.find(name), std::string::npos) << message;
  };
  write_file(folder.path / "sub/flow", "3");
  expect_named("sub/flow");
  write_file(folder.path / "sub/flow", "2");
  EXPECT_NO_THROW(check_folder(folder.path));
  write_file(folder.path / "sub/extra", "");
  expect_named("sub/extra");
  std::filesystem::remove(folder.path / "sub/extra");
  std::filesystem::remove(folder.path / "shape");
  expect_named("shape");
  write_file(folder.path / "shape", "1");
  write_file(folder.path / seal_name, read_file(folder.path / seal_name).substr(0, 50));
  expect_named(seal_name);
}

}  // namespace
}  // namespace ripstop
