// One persistent team of threads: started once, woken for each piece of work, with a barrier inside.
#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace ripstop {

/// A half-open range of indices.
struct IndexRange {
  int begin = 0;
  int end = 0;
};

/// Part `rank` of `count` items split into `parts` nearly equal, contiguous pieces.
constexpr IndexRange part_of(int count, int rank, int parts) {
  const auto edge = [&](int r) { return static_cast<int>(static_cast<long long>(count) * r / parts); };
  return {edge(rank), edge(rank + 1)};
}

class ThreadTeam {
 public:
  /// `threads` >= 1; the calling thread is rank 0. 0 means: as many as the process may run on. Throws
  /// Error(resources) when so many cannot be started.
  explicit ThreadTeam(int threads = 0);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return size_; }

  /// Runs work(rank) on every thread and returns when all have ended. `work` must not throw.
  void run(const std::function<void(int rank)>& work);

  /// Inside run(): waits until every rank has arrived. Spins briefly, then sleeps, so that more threads than
  /// cores still make progress.
  void barrier();

 private:
  void worker(int rank);
  void stop();

  int size_;
  bool may_spin_;  // no more threads than processors
  std::vector<std::thread> threads_;
  const std::function<void(int)>* work_ = nullptr;
  std::atomic<unsigned> job_{0};
  std::atomic<int> arrived_{0};
  std::atomic<unsigned> phase_{0};
  std::atomic<bool> stop_{false};
};

}  // namespace ripstop
