// Refusals and their messages.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "ripstop/core/error.h"

namespace ripstop {

/// The message of the Error thrown by `what`, with the expected exit code.
inline std::string refusal_of(const std::function<void()>& what, ExitCode code) {
  try {
    what();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

}  // namespace ripstop
