// Child programs: started from a list of arguments (never a shell), watched line by line, ended as a whole.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace ripstop {

struct ProcessRequest {
  std::vector<std::string> arguments;    // [0]: a path, or a name that is looked up in PATH
  std::filesystem::path working_folder;  // empty: the present one
  std::vector<std::pair<std::string, std::string>> environment;  // added to this process's own, or replacing
  double time_limit_s = 0;                                       // 0: none
  /// Standard output and error together, a line at a time; false ends the program and all it started.
  std::function<bool(const std::string& line)> on_line;
  /// Called ten times a second at least; false ends the program and all it started.
  std::function<bool()> keep_going = {};
};

struct ProcessResult {
  int exit_code = -1;  // -1 when a signal ended it
  int signal = 0;      // 0 when it ended by itself
  bool timed_out = false;
  bool cancelled = false;
  std::vector<std::string> last_lines;  // at most 40
  double wall_s = 0;

  bool succeeded() const { return exit_code == 0 && !timed_out && !cancelled; }
};

/// Runs a program in a process group of its own and waits for it. Whatever is left of the group ends when the
/// program does, when it is cancelled or late, when on_line throws, and when this process dies of any cause.
/// Throws Error(external) when the program cannot be started.
ProcessResult run_process(const ProcessRequest& request);

/// Path of an executable in `folder`, or in PATH when `folder` is empty; empty path when there is none.
std::filesystem::path find_program(const std::string& name, const std::filesystem::path& folder = {});

/// "exit code 3", "signal 9 (Killed)", "no end within 60 s".
std::string describe(const ProcessResult& result);

}  // namespace ripstop
