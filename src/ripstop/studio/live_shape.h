// The shape of a design that changes: a first answer after a fixed time, the equilibrium when it is reached.
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
#include "ripstop/run/sizing/fabric.h"

namespace ripstop::inline studio {

/// Computes the shape under a uniform pressure (run_fabric_from) in a thread of its own, from the last shape of a canopy
/// with the same nodes and springs. One computation at a time: a new one ends that before it.
class LiveShape {
 public:
  LiveShape();
  ~LiveShape();
  LiveShape(const LiveShape&) = delete;
  LiveShape& operator=(const LiveShape&) = delete;

  /// Number of the new computation. `pressure` [Pa]; absent: the dynamic pressure of the case.
  unsigned begin(Settings resolved, std::optional<double> pressure);
  /// JSON of a computation: {"number", "done", "result", "shape"}. The equilibrium, or after `wait_s` [s] the shape that
  /// the relaxation has reached; {"superseded": true} once another one has begun. Throws Error of the computation.
  std::string answer(unsigned number, double wait_s);

 private:
  struct Request {
    Settings resolved;
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
  void publish(Answer answer);
  /// Whether the computation is to end; `wanted` becomes whether its shape of the moment is waited for.
  bool ends(unsigned number, bool& wanted);
  static FabricSolution solved(const Request& request, const std::vector<Vec3>& start,
                               const RelaxWatch& watch);
  std::vector<Vec3> start_of(const CanopyMesh& mesh, double diameter) const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Request> next_;
  unsigned newest_ = 0;
  bool wanted_ = false, closing_ = false;
  Answer answer_;
  // Of the worker alone: the last equilibrium, and its nominal diameter [m].
  std::optional<FabricSolution> last_;
  double last_diameter_ = 0;
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
