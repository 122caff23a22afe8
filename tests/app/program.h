// The program as a user starts it.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

namespace ripstop {

/// Its standard output goes into the file `output`, what it says on standard error into `error`, where one is given.
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

}  // namespace ripstop
