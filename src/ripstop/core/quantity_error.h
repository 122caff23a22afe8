// An error about given quantities: a solver names the quantity and is independent of files and keys that set
// it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ripstop/core/error.h"

namespace ripstop {

class QuantityError : public Error {
 public:
  /// `message` contains the name of each of the quantities, as "low-pass cutoff".
  QuantityError(ExitCode code, const std::string& message, std::vector<std::string> quantities)
      : Error(code, message), quantities_(std::move(quantities)) {}
  const std::vector<std::string>& quantities() const { return quantities_; }

 private:
  std::vector<std::string> quantities_;
};

/// An error with another message about the same quantities, and more of them; those that the message does not contain
/// do no harm.
inline QuantityError restated(const Error& error, const std::string& message,
                              std::vector<std::string> more = {}) {
  if (const auto* named = dynamic_cast<const QuantityError*>(&error))
    more.insert(more.end(), named->quantities().begin(), named->quantities().end());
  return {error.code(), message, std::move(more)};
}

}  // namespace ripstop
