#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "ripstop/core/utf8.h"
#include "ripstop/core/wrap.h"

namespace ripstop::cli {
namespace {

/// As much of a line as the terminal shows without a second line, which the next text could not replace.
std::string fitting(const std::string& text) {
  constexpr std::size_t usual = 80;
  const std::size_t known = terminal_columns(STDERR_FILENO);
  const std::size_t columns = (known > 0 ? known : usual) - 1;  // the cursor needs the last one
  std::size_t end = 0;
  for (std::size_t shown = 0; end < text.size() && shown < columns; ++shown)
    end += first_character(std::string_view(text).substr(end)).length;
  return text.substr(0, end);
}

}  // namespace

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0), last_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (open_) fmt::print(stderr, "\n");
}

void Progress::show(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (std::chrono::duration<double>(now - last_).count() < (terminal_ ? 0.2 : 10.0)) return;
  last_ = now;
  if (terminal_) {
    fmt::print(stderr, "\r\x1b[K{}", fitting(text));
    open_ = true;
  } else {
    fmt::print(stderr, "{}\n", text);
  }
  std::fflush(stderr);
}

void Progress::line(const std::string& text) {
  if (open_) fmt::print(stderr, "\r\x1b[K");
  open_ = false;
  fmt::print(stderr, "{}\n", text);
  std::fflush(stderr);
}

std::string duration_text(double seconds) {
  const long s = std::lround(std::max(0.0, seconds));
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

std::string rough_duration(double seconds) {
  const auto [value, unit] = seconds < 120    ? std::pair{seconds, "s"}
                             : seconds < 7200 ? std::pair{seconds / 60, "min"}
                                              : std::pair{seconds / 3600, "h"};
  if (value < 10) return fmt::format("{:.1f} {}", value, unit);
  const double digit = std::pow(10, std::floor(std::log10(value)) - 1);  // two of them
  return fmt::format("{:.0f} {}", digit * std::round(value / digit), unit);
}

}  // namespace ripstop::cli
