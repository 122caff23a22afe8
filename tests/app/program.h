// The program as a user starts it.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/core/process.h"

namespace ripstop {

inline const std::string examples = RIPSTOP_SOURCE_DIR "/examples/";
inline const std::string stratos = examples + "stratos-iv/case.toml";

/// Standard output goes into the file `output`, standard error into `error`, if one is given.
inline pid_t start(const std::vector<std::string>& arguments, const std::string& output = "",
                   const std::string& error = "") {
  const pid_t child = fork();
  if (child == 0) {
    if (!output.empty() && !freopen(output.c_str(), "w", stdout)) _exit(126);
    if (!error.empty() && !freopen(error.c_str(), "w", stderr)) _exit(126);
    std::vector<char*> argv{const_cast<char*>(RIPSTOP_PROGRAM)};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    execv(RIPSTOP_PROGRAM, argv.data());
    _exit(127);
  }
  return child;
}

inline int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

struct Finished {
  int code = -1;
  std::string output;  // and errors
  bool timed_out = false;
};

/// The whole of it, with its output and its errors in one text.
inline Finished ripstop_with(const std::vector<std::string>& arguments,
                             const std::filesystem::path& data = RIPSTOP_SOURCE_DIR,
                             double time_limit_s = 120) {
  Finished run;
  ProcessRequest request;
  request.arguments = {RIPSTOP_PROGRAM};
  request.arguments.insert(request.arguments.end(), arguments.begin(), arguments.end());
  request.environment = {{"RIPSTOP_DATA", data.string()}};
  request.time_limit_s = time_limit_s;
  request.on_line = [&](const std::string& line) {
    run.output += line + "\n";
    return true;
  };
  const ProcessResult result = run_process(request);
  run.code = result.signal != 0 ? 128 + result.signal : result.exit_code;
  run.timed_out = result.timed_out;
  return run;
}

}  // namespace ripstop
