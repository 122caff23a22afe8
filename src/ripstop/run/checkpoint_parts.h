// Parts of the checkpoints of runs: when one is due, and where its flow goes.
#pragma once

#include <array>
#include <chrono>

namespace ripstop::inline run {

/// Folders that are written alternately, so that the last checkpoint remains whole until the next one is.
inline constexpr std::array<const char*, 2> alternating_folders{"even", "odd"};

/// Wall time since the last checkpoint.
class CheckpointTimer {
 public:
  explicit CheckpointTimer(double every_s) : every_(every_s) {}
  bool due(double times = 1) const {
    return std::chrono::duration<double>(Clock::now() - saved_).count() > times * every_;
  }
  void restart() { saved_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  double every_;  // [s]
  Clock::time_point saved_ = Clock::now();
};

}  // namespace ripstop::inline run
