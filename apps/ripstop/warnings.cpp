#include "warnings.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/visible.h"
#include "ripstop/core/wrap.h"

namespace ripstop::cli {

void print_warnings(const std::vector<std::string>& warnings) {
  std::fflush(stdout);
  const std::string word = "warning";
  const std::size_t width = wrap_width(STDERR_FILENO);
  for (const std::string& warning : warnings) {
    const std::string text = wrapped(word + ": " + visible(warning), width);
    fmt::print(stderr, "{}{}\n", isatty(STDERR_FILENO) ? "\x1b[31m" + word + "\x1b[0m" : word,
               text.substr(word.size()));
  }
}

int print_result_warnings(const std::optional<std::vector<std::string>>& warnings,
                          const std::optional<bool>& usable) {
  print_warnings(warnings.value_or(std::vector<std::string>{}));
  return usable.value_or(true) ? 0 : static_cast<int>(ExitCode::not_converged);
}

void print_deprecations(const std::vector<std::string>& deprecations) {
  print_warnings(deprecations);
}

}  // namespace ripstop::cli
