// One process a folder, and nothing is removed that Ripstop did not write.
#include "ripstop/core/claimed_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "tests/refusal.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class ClaimedFolderTest : public testing::Test {
 protected:
  TemporaryFolder root{"claim"};
  fs::path folder = root.path / "run";
};

TEST_F(ClaimedFolderTest, ClearRemovesOnlyFilesOnTheList) {
  {
    ClaimedFolder claimed(folder);
    write_file(claimed.own("run.json"), "{}");
    make_folder(folder / "vtk");
    write_file(claimed.own("vtk/a.vtp"), "a");
    make_folder(claimed.own("checkpoint/") / "odd");
    write_file(folder / "checkpoint/odd/state", "s");
  }
  write_file(folder / "thesis.txt", "mine");
  write_file(folder / "vtk/mine.vtp", "mine");
  ClaimedFolder again(folder);
  EXPECT_EQ(again.names(), (std::vector<std::string>{"run.json", "vtk/a.vtp", "checkpoint/"}));
  EXPECT_EQ(foreign_files(folder).size(), 2u);
  again.clear();
  EXPECT_FALSE(fs::exists(folder / "run.json"));
  EXPECT_FALSE(fs::exists(folder / "vtk/a.vtp"));
  EXPECT_FALSE(fs::exists(folder / "checkpoint"));
  EXPECT_EQ(read_file(folder / "thesis.txt"), "mine");
  EXPECT_EQ(read_file(folder / "vtk/mine.vtp"), "mine");
  EXPECT_TRUE(again.names().empty());
}

/// flock() of a file system that answers with `reason`.
template <int reason>
int refusing_lock(int, int) {
  errno = reason;
  return -1;
}

TEST_F(ClaimedFolderTest, WarnsAndWorksOnAFileSystemWithoutLocks) {
  for (const ClaimedFolder::LockCall lock :
       {&refusing_lock<ENOLCK>, &refusing_lock<ENOSYS>, &refusing_lock<EOPNOTSUPP>}) {
    ClaimedFolder claimed(folder, lock);
    EXPECT_NE(claimed.warning().find("no other run uses this folder"), std::string::npos);
    write_file(claimed.own("run.json"), "{}");
    EXPECT_EQ(claimed.names(), std::vector<std::string>{"run.json"});
  }
  EXPECT_EQ(ClaimedFolder(folder).warning(), "");
}

TEST_F(ClaimedFolderTest, RefusesAnyOtherFailureOfTheLock) {
  EXPECT_THROW(ClaimedFolder(folder, &refusing_lock<EIO>), Error);
  EXPECT_THROW(ClaimedFolder(folder, &refusing_lock<EWOULDBLOCK>), Error);
}

TEST_F(ClaimedFolderTest, ResultsOfOtherCommandsDoNotReplaceThoseOfARun) {
  {
    ClaimedFolder claimed(folder);
    write_file(claimed.own("result.json"), "{}");
    claimed.seal();
  }
  EXPECT_THROW(make_results_folder(folder, "load"), Error);
  EXPECT_EQ(read_file(folder / "result.json"), "{}");
  write_file(root.path / "file", "");
  EXPECT_THROW(make_results_folder(root.path / "file", "load"), Error);
}

TEST_F(ClaimedFolderTest, ResultsOfACommandAreReplacedByTheSameCommandOnly) {
  const fs::path results = root.path / "new/results";
  make_results_folder(results, "pattern");
  make_results_folder(results, "load");  // nothing was written
  write_file(results / "result.json", "{}");
  make_results_folder(results, "load");
  EXPECT_NE(refusal_of([&] { make_results_folder(results, "recovery"); }, ExitCode::usage)
                .find("results of ripstop load"),
            std::string::npos);
  EXPECT_EQ(read_file(results / "result.json"), "{}");
}

TEST_F(ClaimedFolderTest, WhoLooksWhetherItIsClaimedDoesNotClaimIt) {
  { ClaimedFolder before(folder); }
  require_unclaimed(folder);
  require_unclaimed(folder);
  EXPECT_NO_THROW(ClaimedFolder again(folder));
}

TEST_F(ClaimedFolderTest, AFileThatIsThereAndNotOnTheListIsNotTaken) {
  make_folder(folder);
  write_file(folder / "result.json", "mine");
  make_folder(folder / "vtk");
  ClaimedFolder claimed(folder);
  EXPECT_THROW(claimed.own("result.json"), Error);
  EXPECT_THROW(claimed.own("vtk/"), Error);
  claimed.clear();
  EXPECT_EQ(read_file(folder / "result.json"), "mine");
  EXPECT_TRUE(fs::exists(folder / "vtk"));
}

TEST_F(ClaimedFolderTest, ALineOfTheListThatWasDamagedProvesNothing) {
  {
    ClaimedFolder claimed(folder);
    write_file(claimed.own("a.csv"), "a");
    write_file(claimed.own("b.csv"), "b");
  }
  std::string list = read_file(folder / ".ripstop/files");
  list.replace(list.find("a.csv"), 5, "x.csv");
  write_file(folder / ".ripstop/files", list.substr(0, list.size() - 3));  // and the last line cut
  write_file(folder / "x.csv", "mine");
  ClaimedFolder again(folder);
  EXPECT_TRUE(again.names().empty());
  again.clear();
  EXPECT_TRUE(fs::exists(folder / "a.csv") && fs::exists(folder / "b.csv") && fs::exists(folder / "x.csv"));
}

TEST_F(ClaimedFolderTest, NamesAfterAnIncompleteLineAreNotLost) {
  {
    ClaimedFolder claimed(folder);
    write_file(claimed.own("a.csv"), "a");
  }
  const fs::path list = folder / ".ripstop/files";
  const std::string whole = read_file(list);
  append_to_file(list, whole.substr(0, 11));  // the process was killed
  {
    ClaimedFolder next(folder);
    write_file(next.own("b.csv"), "b");
  }
  EXPECT_EQ(ClaimedFolder(folder).names(), (std::vector<std::string>{"a.csv", "b.csv"}));
}

TEST_F(ClaimedFolderTest, LossOrChangeOfKeptFilesIsDetectedUntilTheyAreWrittenAgain) {
  {
    ClaimedFolder claimed(folder);
    for (const char* name : {"a", "b", "c"}) write_file(claimed.own(name), name);
    claimed.keep();
    write_file(claimed.own("c"), "written again");
    EXPECT_TRUE(claimed.lost().empty());
  }
  write_file(folder / "a", "changed");
  fs::remove(folder / "b");
  append_to_file(folder / ".ripstop/kept", "half a line");
  ClaimedFolder again(folder);
  EXPECT_EQ(again.lost(), (std::vector<std::string>{"a", "b"}));
  for (const char* name : {"a", "b"}) write_file(again.own(name), name);
  EXPECT_TRUE(again.lost().empty());
  again.keep();
  EXPECT_TRUE(ClaimedFolder(root.path / "other").lost().empty());
  again.seal();
  EXPECT_FALSE(fs::exists(folder / ".ripstop/kept"));
  again.unseal();
  EXPECT_FALSE(is_sealed(folder));
}

TEST_F(ClaimedFolderTest, TheListOfAnInterruptedFolderIsRestoredFromTheKeptHashes) {
  {
    ClaimedFolder claimed(folder);
    for (const char* name : {"a", "b", "c"}) write_file(claimed.own(name), name);
    claimed.keep();
    claimed.own("c");  // and killed before it was written again
  }
  const fs::path list = folder / ".ripstop/files";
  write_file(list, read_file(list).substr(0, 40));  // which cuts b's line
  const std::vector<std::string> names = {"a", "b", "c"};
  EXPECT_EQ(ClaimedFolder(folder).names(), names);
  EXPECT_EQ(ClaimedFolder(folder).names(), names) << "as written";
}

// The process may be killed between the seal and the removal of the files that it replaces.
TEST_F(ClaimedFolderTest, ASealReplacesTheKeptHashes) {
  std::string kept;
  {
    ClaimedFolder claimed(folder);
    write_file(claimed.own("a"), "first");
    claimed.keep();
    kept = read_file(folder / ".ripstop/kept");
    write_file(claimed.own("a"), "second");
    claimed.seal();
  }
  write_file(folder / ".ripstop/kept", kept);
  const ClaimedFolder again(folder);
  EXPECT_TRUE(again.lost().empty());
  EXPECT_FALSE(fs::exists(folder / ".ripstop/kept"));
}

TEST_F(ClaimedFolderTest, TwoProcessesCannotClaimAFolderAndTheSecondNamesTheFirst) {
  ClaimedFolder claimed(folder);
  try {
    ClaimedFolder second(folder);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("process " + std::to_string(getpid())), std::string::npos)
        << error.what();
  }
}

TEST_F(ClaimedFolderTest, TheClaimEndsWithItsProcessHoweverThatEnds) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const ClaimedFolder claimed(folder);
    [[maybe_unused]] const auto sent = write(ready[1], "x", 1);
    pause();
    _exit(0);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_THROW(ClaimedFolder{folder}, Error);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(ClaimedFolder{folder});
  close(ready[0]), close(ready[1]);
}

TEST_F(ClaimedFolderTest, TemporaryFilesOfAKillAreRemovedAndSimilarNamesRemain) {
  {
    ClaimedFolder claimed(folder);
    write_file(claimed.own("a.csv"), "a");
  }
  write_file(folder / ".a.csv.4711-3.tmp", "half");
  write_file(folder / ".b.csv.4711-3.tmp", "of another program");
  write_file(folder / ".a.csv.old.tmp", "of another program");
  const ClaimedFolder again(folder);
  EXPECT_FALSE(fs::exists(folder / ".a.csv.4711-3.tmp"));
  EXPECT_TRUE(fs::exists(folder / ".b.csv.4711-3.tmp"));
  EXPECT_TRUE(fs::exists(folder / ".a.csv.old.tmp"));
}

TEST_F(ClaimedFolderTest, ASealNoticesEveryFileThatIsLostOrChanged) {
  ClaimedFolder claimed(folder);
  for (const char* name : {"a", "b", "c"}) write_file(claimed.own(name), name);
  EXPECT_FALSE(is_sealed(folder));
  claimed.seal();
  EXPECT_TRUE(is_sealed(folder));
  EXPECT_TRUE(damaged_files(folder).empty());
  write_file(folder / "a", "changed");
  fs::remove(folder / "b");
  EXPECT_EQ(damaged_files(folder), (std::vector<std::string>{"a", "b"}));
  write_file(folder / ".ripstop/seal", "{}");
  EXPECT_THROW(damaged_files(folder), Error);
}

TEST_F(ClaimedFolderTest, TheListOfASealedFolderIsRestoredFromItsSeal) {
  const std::vector<std::string> names = {"a", "checkpoint/", "b", "never written"};
  {
    ClaimedFolder claimed(folder);
    for (const std::string& name : names) claimed.own(name);
    for (const char* name : {"a", "b"}) write_file(folder / name, name);
    claimed.seal();
  }
  const fs::path list = folder / ".ripstop/files", seal = folder / ".ripstop/seal";
  const std::string whole = read_file(list), sealed = read_file(seal);
  std::string flipped = whole;
  flipped[1] ^= 1;
  for (const std::string& damaged : {std::string(), whole.substr(0, whole.size() / 2), flipped}) {
    write_file(list, damaged);
    ClaimedFolder claimed(folder);
    EXPECT_EQ(claimed.names(), names);
    EXPECT_EQ(read_file(list), whole);
    claimed.seal();  // as after a report: no file is left out
    EXPECT_EQ(read_file(seal), sealed);
    EXPECT_TRUE(damaged_files(folder).empty());
  }
  fs::remove(list);
  ClaimedFolder(folder).clear();
  EXPECT_FALSE(fs::exists(folder / "a") || fs::exists(folder / "b"));

  write_file(seal, "not a seal");  // which is reported by the function that checks for damage
  write_file(list, whole.substr(0, whole.find('\n') + 1));
  EXPECT_EQ(ClaimedFolder(folder).names(), std::vector<std::string>{"a"});
}

}  // namespace
}  // namespace ripstop
