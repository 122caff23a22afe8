#include "warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/visible.h"
#include "ripstop/core/wrap.h"
#include "ripstop/run/quality.h"
#include "units_option.h"

namespace ripstop::cli {

void print_warnings(const std::vector<std::string>& warnings) {
  std::fflush(stdout);
  const std::string word = "warning";
  const std::size_t width = wrap_width(STDERR_FILENO);
  for (const std::string& warning : warnings) {
    const std::string text = wrapped(word + ": " + visible(in_units(warning)), width);
    fmt::print(stderr, "{}{}\n", isatty(STDERR_FILENO) ? "\x1b[31m" + word + "\x1b[0m" : word,
               text.substr(word.size()));
  }
}

int print_result_warnings(const std::optional<std::vector<std::string>>& warnings,
                          const std::optional<bool>& usable) {
  const std::vector<std::string> all = warnings.value_or(std::vector<std::string>{});
  print_warnings(all);
  if (usable.value_or(true)) return 0;
  std::vector<std::string> reasons;
  for (const std::string& text : all)
    if (const std::string reason = reason_of_refusal(text); !reason.empty()) reasons.push_back(reason);
  if (reasons.empty()) reasons.emplace_back("see the warnings above");
  fmt::print(
      stderr, "{}\n",
      wrapped(visible(fmt::format("the result {} (exit code {}): {}", refused_text,
                                  static_cast<int>(ExitCode::not_converged), fmt::join(reasons, "; "))),
              wrap_width(STDERR_FILENO)));
  return static_cast<int>(ExitCode::not_converged);
}

void print_deprecations(const std::vector<std::string>& deprecations) {
  print_warnings(deprecations);
}

}  // namespace ripstop::cli
