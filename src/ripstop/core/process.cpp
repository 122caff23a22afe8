#include "ripstop/core/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <thread>

#include "ripstop/core/error.h"

extern char** environ;

namespace ripstop {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kGrace = std::chrono::seconds(5);              // between SIGTERM and SIGKILL
constexpr auto kLookAround = std::chrono::milliseconds(100);  // between two looks at the clock
constexpr std::size_t kLinesKept = 40;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_, O_CLOEXEC) != 0) {
      throw Error(ExitCode::io, fmt::format("no pipe to a child program: {}", std::strerror(errno)));
    }
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_end(int which) {
    if (ends_[which] >= 0) close(ends_[which]);
    ends_[which] = -1;
  }

 private:
  int ends_[2] = {-1, -1};
};

/// Leads the process group and does nothing but wait for the end of `alive`, which comes when this program
/// dies of whatever cause, SIGKILL included; then it ends the group. (PR_SET_PDEATHSIG would reach the first
/// child only, and fires when a thread ends.) It was forked without exec, so only async-signal-safe calls.
[[noreturn]] void watch_parent(int alive) {
  setpgid(0, 0);
  signal(SIGTERM, SIG_IGN);
  if (alive != 3) dup2(alive, 3);
  close_range(4, ~0U, 0);
  close(0);
  close(1);
  close(2);
  char byte;
  while (read(3, &byte, 1) < 0 && errno == EINTR) {
  }
  kill(0, SIGTERM);  // mpirun passes it on to ranks, which lead groups of their own
  sleep(static_cast<unsigned>(kGrace.count()));
  kill(0, SIGKILL);
  _exit(0);
}

class Group {
 public:
  Group() {
    leader_ = fork();
    if (leader_ < 0) throw Error(ExitCode::external, "cannot fork: " + std::string(std::strerror(errno)));
    if (leader_ == 0) watch_parent(alive_.read_end());
    setpgid(leader_, leader_);
    alive_.close_end(0);
  }
  ~Group() {
    if (child_ > 0) end_child();
    kill(-leader_, SIGKILL);
    waitpid(leader_, nullptr, 0);
  }
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  pid_t leader() const { return leader_; }
  void adopt(pid_t child) { child_ = child; }
  bool child_ended() {
    if (child_ > 0 && waitpid(child_, &status_, WNOHANG) == child_) child_ = -1;
    return child_ <= 0;
  }
  void end_child() {
    kill(-leader_, SIGTERM);
    const auto start = Clock::now();
    while (!child_ended() && Clock::now() - start < kGrace) std::this_thread::sleep_for(kLookAround / 10);
    kill(-leader_, SIGKILL);
    if (child_ > 0) waitpid(child_, &status_, 0);
    child_ = -1;
  }
  int status() const { return status_; }

 private:
  Pipe alive_;
  pid_t leader_ = -1;
  pid_t child_ = -1;
  int status_ = 0;
};

std::vector<std::string> merged_environment(const ProcessRequest& request) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('='));
    const bool moved = name == "PWD" && !request.working_folder.empty();
    const bool replaced = moved || std::any_of(request.environment.begin(), request.environment.end(),
                                               [&](const auto& added) { return added.first == name; });
    if (!replaced) all.push_back(text);
  }
  if (!request.working_folder.empty()) {
    all.push_back("PWD=" + std::filesystem::absolute(request.working_folder).string());
  }
  for (const auto& [name, value] : request.environment) all.push_back(name + "=" + value);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

/// Forks and replaces the child by the program. Everything is prepared before the fork: between fork and
/// exec a program with threads may only make async-signal-safe calls.
pid_t start(const ProcessRequest& request, const std::filesystem::path& program, pid_t group, int output) {
  std::vector<std::string> arguments = request.arguments;
  std::vector<std::string> environment = merged_environment(request);
  const std::vector<char*> argv = pointers(arguments);
  const std::vector<char*> envp = pointers(environment);
  const std::string folder = request.working_folder.string();
  const std::string path = program.string();
  Pipe failure;
  const pid_t child = fork();
  if (child < 0) throw Error(ExitCode::external, "cannot fork: " + std::string(std::strerror(errno)));
  if (child == 0) {
    setpgid(0, group);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    signal(SIGPIPE, SIG_DFL);
    const int null = open("/dev/null", O_RDONLY);
    dup2(null, 0);
    dup2(output, 1);
    dup2(output, 2);
    if (folder.empty() || chdir(folder.c_str()) == 0) execve(path.c_str(), argv.data(), envp.data());
    const int why = errno;
    [[maybe_unused]] const auto written = write(failure.write_end(), &why, sizeof why);
    _exit(127);
  }
  setpgid(child, group);
  failure.close_end(1);
  int why = 0;
  if (read(failure.read_end(), &why, sizeof why) == sizeof why) {
    waitpid(child, nullptr, 0);
    throw Error(ExitCode::external, fmt::format("cannot start {}: {}", path, std::strerror(why)));
  }
  return child;
}

/// Splits the output of the pipe into lines.
class LineReader {
 public:
  /// False when the pipe has ended.
  bool take(int from) {
    char buffer[1 << 14];
    const ssize_t count = read(from, buffer, sizeof buffer);
    if (count < 0) return errno == EINTR;
    pending_.append(buffer, static_cast<std::size_t>(count));
    return count > 0;
  }
  bool next(std::string& line) {
    const std::size_t end = pending_.find('\n', begin_);
    if (end == std::string::npos) {
      pending_.erase(0, begin_);
      begin_ = 0;
      return false;
    }
    line = pending_.substr(begin_, end - begin_);
    begin_ = end + 1;
    return true;
  }
  void finish() {
    if (!pending_.empty()) pending_ += '\n';
  }

 private:
  std::string pending_;
  std::size_t begin_ = 0;
};

}  // namespace

ProcessResult run_process(const ProcessRequest& request) {
  const std::string& name = request.arguments.at(0);
  const std::filesystem::path program =
      name.find('/') == std::string::npos ? find_program(name) : std::filesystem::absolute(name);
  if (program.empty()) throw Error(ExitCode::external, fmt::format("program '{}' is not in PATH", name));

  const auto began = Clock::now();
  ProcessResult result;
  std::deque<std::string> kept;
  LineReader reader;
  Pipe output;
  Group group;
  group.adopt(start(request, program, group.leader(), output.write_end()));
  output.close_end(1);

  const auto pass_lines = [&] {
    for (std::string line; !result.cancelled && reader.next(line);) {
      kept.push_back(line);
      if (kept.size() > kLinesKept) kept.pop_front();
      if (request.on_line && !request.on_line(line)) result.cancelled = true;
    }
  };
  for (bool open = true; open && !result.cancelled;) {
    pollfd waiting{output.read_end(), POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(kLookAround.count()));
    if (ready > 0) open = reader.take(output.read_end());
    pass_lines();
    if (request.keep_going && !request.keep_going()) result.cancelled = true;
    if (ready == 0 && group.child_ended()) open = false;  // a descendant may hold the pipe for ever
    if (request.time_limit_s > 0 && seconds_since(began) > request.time_limit_s && !group.child_ended()) {
      result.timed_out = true;
      break;
    }
  }
  if (!result.cancelled && !result.timed_out) {
    reader.finish();
    pass_lines();
    while (!group.child_ended()) {  // it closed its output but still runs
      if (request.keep_going && !request.keep_going()) {
        result.cancelled = true;
        break;
      }
      if (request.time_limit_s > 0 && seconds_since(began) > request.time_limit_s) {
        result.timed_out = true;
        break;
      }
      std::this_thread::sleep_for(kLookAround / 10);
    }
  }
  if (!group.child_ended()) group.end_child();
  if (WIFEXITED(group.status())) result.exit_code = WEXITSTATUS(group.status());
  if (WIFSIGNALED(group.status())) result.signal = WTERMSIG(group.status());
  result.last_lines.assign(kept.begin(), kept.end());
  result.wall_s = seconds_since(began);
  return result;
}

std::filesystem::path find_program(const std::string& name, const std::filesystem::path& folder) {
  const auto executable = [](const std::filesystem::path& path) {
    std::error_code unreadable;
    return std::filesystem::is_regular_file(path, unreadable) && access(path.c_str(), X_OK) == 0;
  };
  if (!folder.empty()) {
    const std::filesystem::path candidate = std::filesystem::absolute(folder) / name;
    return executable(candidate) ? candidate : std::filesystem::path();
  }
  const char* variable = std::getenv("PATH");
  std::string places = variable ? variable : "/usr/bin:/bin";
  for (std::size_t begin = 0; begin <= places.size();) {
    const std::size_t end = std::min(places.find(':', begin), places.size());
    const std::filesystem::path candidate = std::filesystem::path(places.substr(begin, end - begin)) / name;
    if (end > begin && executable(candidate)) return std::filesystem::absolute(candidate);
    begin = end + 1;
  }
  return {};
}

std::string describe(const ProcessResult& result) {
  if (result.timed_out) return fmt::format("not finished within {:.0f} s", result.wall_s);
  if (result.signal != 0) return fmt::format("signal {} ({})", result.signal, strsignal(result.signal));
  return fmt::format("exit code {}", result.exit_code);
}

}  // namespace ripstop
