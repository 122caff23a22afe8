// The shape of a design that changes: a first answer after a fixed time, the equilibrium when it is reached, and then
// that with the nodes of the case.
#pragma once

#include <condition_variable>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "ripstop/case/settings.h"

namespace ripstop::inline studio {

/// Computes the shape under a uniform pressure as `ripstop fabric` does, in one thread of its own. One computation at a
/// time: a new one ends that before it.
class LiveShape {
 public:
  /// `idle_s`: time without a new computation before the second stage begins [s].
  explicit LiveShape(double idle_s = 1);
  ~LiveShape();
  LiveShape(const LiveShape&) = delete;
  LiveShape& operator=(const LiveShape&) = delete;

  /// Number of the new computation. `stages`: the case with few nodes, then as it is; one or both. `pressure` [Pa];
  /// absent: the dynamic pressure of the case.
  unsigned begin(std::vector<Settings> stages, std::optional<double> pressure);
  /// JSON of a computation: {"number", "done", "result", "shape"}. The next equilibrium, or after `wait_s` [s] the
  /// shape that the relaxation has reached; the later stage has {"number", "done", "refining"} instead, its number of
  /// nodes. {"superseded": true} once another computation has begun. Throws Error of the computation.
  std::string answer(unsigned number, double wait_s);

 private:
  struct Request {
    std::vector<Settings> stages;
    std::optional<double> pressure;
  };
  struct Answer {
    unsigned number = 0;
    bool done = false;
    std::string json;
    std::optional<std::pair<ExitCode, std::string>> error;
  };
  void work();
  void compute(const Request& request, unsigned number);
  void refine(const Request& request, unsigned number);
  void publish(Answer answer);
  /// Whether the shape of the moment is waited for. Throws once the computation is to end.
  bool wanted(unsigned number);
  /// Until `idle_s` have passed, with `work` done whenever an answer is waited for.
  template <class Work>
  void rest(unsigned number, const Work& work);

  double idle_s_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Request> next_;
  unsigned newest_ = 0;
  bool wanted_ = false, closing_ = false;
  Answer answer_;
  std::thread worker_;
};

/// One LiveShape for each view that shows one. Of more than a few views the one that has asked least recently ends.
class LiveShapes {
 public:
  std::shared_ptr<LiveShape> of(const std::string& view);

 private:
  std::mutex mutex_;
  std::list<std::pair<std::string, std::shared_ptr<LiveShape>>> views_;  // the most recent first
};

}  // namespace ripstop::inline studio
