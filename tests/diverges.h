// What a computation says that has lost its stability.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "ripstop/core/error.h"

namespace ripstop::testing {

/// The message of the Error(diverged) that work() throws.
template <class Work>
std::string divergence(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::diverged) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

inline bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

}  // namespace ripstop::testing
