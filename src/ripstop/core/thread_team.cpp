#include "ripstop/core/thread_team.h"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "ripstop/core/cgroup.h"
#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"

namespace ripstop {
namespace {

// About 20 us of spinning: longer than the imbalance of one cloth step, shorter than a scheduler's slice.
constexpr int spins = 2000;

void wait_while(const std::atomic<unsigned>& word, unsigned old, bool may_spin) {
  if (may_spin) {
    for (int i = 0; i < spins; ++i) {
      if (word.load(std::memory_order_acquire) != old) return;
      __builtin_ia32_pause();
    }
  }
  while (word.load(std::memory_order_acquire) == old) word.wait(old, std::memory_order_acquire);
}

/// Of this process: its affinity, the CPU quota of its control group, and in a job of Slurm the processors that it was
/// given of its node, to which not every Slurm binds it.
int usable_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  int count = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (sched_getaffinity(0, sizeof set, &set) == 0) count = std::max(1, CPU_COUNT(&set));
  count = std::min(count, cgroup_processors().value_or(count));
  const char* of_job = std::getenv("SLURM_CPUS_ON_NODE");
  const int share = of_job ? std::atoi(of_job) : 0;
  return share > 0 ? std::min(count, share) : count;
}

}  // namespace

ThreadTeam::ThreadTeam(int threads)
    : size_(threads > 0 ? threads : usable_processors()), may_spin_(size_ <= usable_processors()) {
  try {
    for (int rank = 1; rank < size_; ++rank) threads_.emplace_back([this, rank] { worker(rank); });
  } catch (const std::system_error& error) {
    const std::size_t started = threads_.size() + 1;
    stop();
    throw QuantityError(
        ExitCode::resources,
        fmt::format("only {} of {} threads could be started ({}): use a smaller number of threads", started,
                    size_, error.code().message()),
        {"number of threads"});
  }
}

ThreadTeam::~ThreadTeam() {
  stop();
}

void ThreadTeam::stop() {
  stop_.store(true, std::memory_order_release);
  job_.fetch_add(1, std::memory_order_release);
  job_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::run(const std::function<void(int)>& work) {
  if (size_ == 1) return work(0);
  work_ = &work;
  job_.fetch_add(1, std::memory_order_release);
  job_.notify_all();
  work(0);
  barrier();
}

void ThreadTeam::barrier() {
  if (size_ == 1) return;
  const unsigned phase = phase_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
    arrived_.store(0, std::memory_order_relaxed);
    phase_.fetch_add(1, std::memory_order_release);
    phase_.notify_all();
  } else {
    wait_while(phase_, phase, may_spin_);
  }
}

void ThreadTeam::worker(int rank) {
  unsigned seen = 0;
  for (;;) {
    wait_while(job_, seen, false);
    ++seen;
    if (stop_.load(std::memory_order_acquire)) return;
    (*work_)(rank);
    barrier();
  }
}

}  // namespace ripstop
