// Live progress of long work on standard error: one line that is rewritten on a terminal, a line
// now and then elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace ripstop::cli {

class Progress {
 public:
  Progress();
  ~Progress();
  /// Shows `text` unless the last one is too recent (0.2 s on a terminal, 10 s elsewhere). A terminal shows one line
  /// of it.
  void show(const std::string& text);
  /// A line that stays.
  void line(const std::string& text);

 private:
  bool terminal_;
  bool open_ = false;  // an unfinished line is on the terminal
  std::chrono::steady_clock::time_point last_;
};

/// "1:05", "2:03:20".
std::string duration_text(double seconds);
/// Of an estimate: "50 s", "12 min", "3.1 h".
std::string rough_duration(double seconds);

}  // namespace ripstop::cli
