#include "ripstop/core/thread_team.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <atomic>
#include <vector>

namespace ripstop {
namespace {

TEST(ThreadTeam, EveryRankRunsOnceAndPartsCoverTheRange) {
  for (int threads : {1, 2, 3, 4}) {
    ThreadTeam team(threads);
    std::vector<int> hits(1003);
    team.run([&](int rank) {
      const IndexRange part = part_of(static_cast<int>(hits.size()), rank, team.size());
      for (int i = part.begin; i < part.end; ++i) ++hits[i];
    });
    EXPECT_EQ(hits, std::vector<int>(1003, 1)) << threads << " threads";
  }
}

TEST(ThreadTeam, TheBarrierKeepsPhasesApartAlsoWithMoreThreadsThanCores) {
  ThreadTeam team(5);
  std::atomic<int> count{0};
  std::atomic<int> wrong{0};
  team.run([&](int) {
    for (int phase = 1; phase <= 2000; ++phase) {
      ++count;
      team.barrier();
      if (count.load() != 5 * phase) ++wrong;
      team.barrier();
    }
  });
  EXPECT_EQ(count.load(), 10000);
  EXPECT_EQ(wrong.load(), 0);
}

TEST(ThreadTeam, TakesNoMoreOfANodeThanSlurmGaveTheJob) {
  const int all = ThreadTeam().size();
  setenv("SLURM_CPUS_ON_NODE", "1", 1);
  EXPECT_EQ(ThreadTeam().size(), 1);
  EXPECT_EQ(ThreadTeam(2).size(), 2);  // as asked for
  for (const char* nonsense : {"100000", "0", "-1", "many", ""}) {
    setenv("SLURM_CPUS_ON_NODE", nonsense, 1);
    EXPECT_EQ(ThreadTeam().size(), all) << nonsense;
  }
  unsetenv("SLURM_CPUS_ON_NODE");
}

}  // namespace
}  // namespace ripstop
