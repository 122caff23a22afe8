// Every failure that a user can meet is an Error; its code is the program's exit status.
#pragma once

#include <stdexcept>
#include <string>

namespace ripstop {

enum class ExitCode {
  done = 0,
  usage = 2,          // command line or case file
  bad_data = 3,       // input data that are inconsistent
  not_converged = 4,  // a result exists, but not to the stated tolerance
  diverged = 5,       // NaN, runaway stretch, unstable step
  external = 6,       // OpenFOAM or another child program
  io = 7,             // a file could not be read or written
  resources = 8,      // this machine has not the memory or the threads for it
};

class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace ripstop
