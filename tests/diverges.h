// Messages of a computation that has become unstable.
#pragma once

#include <functional>
#include <string>

#include "refusal.h"

namespace ripstop {

/// The message of the Error(diverged) that work() throws.
inline std::string divergence(const std::function<void()>& work) {
  return refusal_of(work, ExitCode::diverged);
}

inline bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

}  // namespace ripstop
