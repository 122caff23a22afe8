// How far a steady run is, on standard error.
#pragma once

#include <chrono>
#include <filesystem>

#include "progress.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop::cli {

class SteadyTerminal : public SteadyObserver {
 public:
  explicit SteadyTerminal(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void begin(const SteadyRun& run, SteadyState& state) override;
  void solved_coarse(const SteadyRun& run, const SteadyResult& result) override;
  void warned(const std::string& text) override;
  void progress(const SteadyProgress& p, const SteadyState& state) override;
  void iterated(const SteadyRun& run, const SteadyState& state, const FlowField& field) override;
  void turned(const SteadyTurn& turn) override;

 private:
  using Clock = std::chrono::steady_clock;
  double elapsed() const;

  std::filesystem::path folder_;
  CouplingSettings settings_;
  Progress progress_;
  Clock::time_point begin_ = Clock::now();
  double before_ = 0;       // elapsed at the end of the last iteration [s]
  bool estimated_ = false;  // the first estimate has been shown
};

}  // namespace ripstop::cli
