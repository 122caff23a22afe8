#include "ripstop/core/thread_team.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace ripstop
