#include "ripstop/core/process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

ProcessRequest shell(const std::string& script) {
  ProcessRequest request;
  request.arguments = {"/bin/sh", "-c", script};
  return request;
}

bool alive(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return stat >> number >> name >> state && state != "Z";
}

bool ends_within(pid_t process, double seconds) {
  for (int i = 0; i < seconds * 50; ++i) {
    if (!alive(process)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

TEST(Process, LinesOfBothStreamsArriveInOrderAndTheLastOneWithoutNewline) {
  std::vector<std::string> lines;
  ProcessRequest request = shell("echo one; echo two >&2; printf 'three'");
  request.on_line = [&](const std::string& line) {
    lines.push_back(line);
    return true;
  };
  const ProcessResult result = run_process(request);
  EXPECT_TRUE(result.succeeded());
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "two", "three"}));
  EXPECT_EQ(result.last_lines, lines);
}

TEST(Process, ArgumentsPassUnchanged) {
  std::string seen;
  ProcessRequest request;
  request.arguments = {"printf", "%s", "a b; $(echo no) '\""};
  request.on_line = [&](const std::string& line) {
    seen = line;
    return true;
  };
  run_process(request);
  EXPECT_EQ(seen, "a b; $(echo no) '\"");
}

TEST(Process, ExitCodeAndSignalAreReported) {
  EXPECT_EQ(run_process(shell("exit 3")).exit_code, 3);
  const ProcessResult killed = run_process(shell("kill -9 $$"));
  EXPECT_EQ(killed.signal, SIGKILL);
  EXPECT_EQ(describe(killed), "signal 9 (Killed)");
}

TEST(Process, FolderAndEnvironmentAreTheChildsOwn) {
  std::string seen;
  ASSERT_NE(std::getenv("PATH"), nullptr);
  ProcessRequest request = shell("echo $PWD $RIPSTOP_WORD $PATH");
  request.working_folder = "/usr";
  request.environment = {{"RIPSTOP_WORD", "yes"}};
  request.on_line = [&](const std::string& line) {
    seen = line;
    return true;
  };
  run_process(request);
  EXPECT_EQ(seen, std::string("/usr yes ") + std::getenv("PATH"));  // unset variables are inherited
  EXPECT_EQ(std::getenv("RIPSTOP_WORD"), nullptr);
}

TEST(Process, AMissingProgramOrFolderIsAnError) {
  ProcessRequest request;
  for (const char* name : {"/nowhere/program", "ripstop-no-such-program"}) {
    request.arguments = {name};
    try {
      run_process(request);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::external);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
    }
  }
  request = shell("true");
  request.working_folder = "/nowhere";
  EXPECT_THROW(run_process(request), Error);
}

TEST(Process, TheTimeLimitEndsTheProgramAndItsChildren) {
  pid_t grandchild = 0;
  ProcessRequest request = shell("sleep 60 & echo $!; wait");
  request.time_limit_s = 0.3;
  request.on_line = [&](const std::string& line) {
    grandchild = std::stoi(line);
    return true;
  };
  const ProcessResult result = run_process(request);
  EXPECT_TRUE(result.timed_out);
  EXPECT_LT(result.wall_s, 5);
  ASSERT_GT(grandchild, 0);
  EXPECT_TRUE(ends_within(grandchild, 2));
}

TEST(Process, AProgramThatIgnoresTheRequestToEndIsKilled) {
  ProcessRequest request = shell("trap '' TERM; echo ready; while true; do sleep 0.1; done");
  request.on_line = [](const std::string&) { return false; };
  const ProcessResult result = run_process(request);
  EXPECT_TRUE(result.cancelled);
  EXPECT_EQ(result.signal, SIGKILL);
}

TEST(Process, ChildrenOfAProgramEndWithIt) {
  pid_t left = 0;
  ProcessRequest request = shell("sleep 60 & echo $!");  // sleep keeps the output open
  request.on_line = [&](const std::string& line) {
    left = std::stoi(line);
    return true;
  };
  const ProcessResult result = run_process(request);
  EXPECT_TRUE(result.succeeded());
  EXPECT_LT(result.wall_s, 5);
  EXPECT_TRUE(ends_within(left, 2));
}

TEST(Process, AnExceptionFromTheWatcherEndsTheProgram) {
  pid_t child = 0;
  ProcessRequest request = shell("echo $$; sleep 60");
  request.on_line = [&](const std::string& line) -> bool {
    child = std::stoi(line);
    throw std::runtime_error("seen enough");
  };
  EXPECT_THROW(run_process(request), std::runtime_error);
  EXPECT_TRUE(ends_within(child, 2));
}

TEST(Process, TheGroupEndsWhenThisProgramIsKilled) {
  int report[2];
  ASSERT_EQ(pipe(report), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    ProcessRequest request = shell("sleep 60 & echo $!; wait");
    request.on_line = [&](const std::string& line) {
      const pid_t grandchild = std::stoi(line);
      return write(report[1], &grandchild, sizeof grandchild) == sizeof grandchild;
    };
    run_process(request);
    _exit(0);
  }
  pid_t grandchild = 0;
  ASSERT_EQ(read(report[0], &grandchild, sizeof grandchild), static_cast<ssize_t>(sizeof grandchild));
  EXPECT_TRUE(alive(grandchild));
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  EXPECT_TRUE(ends_within(grandchild, 4));
  close(report[0]);
  close(report[1]);
}

TEST(Process, ProgramsAreFoundInPathAndInAFolder) {
  EXPECT_TRUE(find_program("sh").is_absolute());
  EXPECT_EQ(find_program("sh", "/bin"), fs::path("/bin/sh"));
  EXPECT_TRUE(find_program("sh", "/nowhere").empty());
  EXPECT_TRUE(find_program("ripstop-no-such-program").empty());
}

}  // namespace
}  // namespace ripstop
