// Openings of the canopies of a cluster, from the rows of canopies.csv.
#include "ripstop/fsi/cluster_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ripstop/fsi/summary.h"

namespace ripstop {
namespace {

constexpr double block_length = 2e-3, last_row = 0.4;  // [s]

/// Of a canopy that is folded until `begin`, is largest at `begin` + 0.1 s, and then contracts by `contracts` in 0.1 s.
double mouth_at(double time, double begin, double contracts = 0) {
  const double t = (time - begin) / 0.1;
  if (t < 0) return 0.02;
  if (t < 1) return 0.02 + 0.98 * t * t;
  return 1 - contracts * std::min(1.0, t - 1);
}

std::vector<CanopyRow> rows_of_two(double delay, double contracts = 0) {
  std::vector<CanopyRow> rows;
  for (int i = 1; i * block_length < last_row * (1 + 1e-9); ++i) {
    const double time = i * block_length;
    for (int k = 0; k < 2; ++k) {
      const double mouth = mouth_at(time, k == 0 ? 0 : delay, k == 0 ? 0 : contracts);
      rows.push_back({time, k + 1.0, 20, 180.0 * k, 100 * mouth * (k + 1), mouth, 0.3});
    }
  }
  return rows;
}

TEST(ClusterOpenings, ADelayedCanopyFillsLaterAndAllTimesAreFromTheStart) {
  const ClusterOpening both = summarise_openings(rows_of_two(0.05), 2, 0.005, {0, 0.05});
  ASSERT_EQ(both.canopies.size(), 2u);
  EXPECT_NEAR(both.canopies[0].filling_time.value(), 0.1, 1e-6);
  EXPECT_NEAR(both.canopies[1].filling_time.value(), 0.15, 1e-6);
  EXPECT_NEAR(both.filling_difference.value(), 0.05, 1e-6);
  EXPECT_NEAR(both.peak_difference, 0.05, 1.01 * block_length);
  EXPECT_EQ(both.canopies[0].delay.value(), 0);
  EXPECT_EQ(both.canopies[1].delay.value(), 0.05);
  EXPECT_FALSE(summarise_openings(rows_of_two(0), 2, 0.005).canopies[0].delay);
}

TEST(ClusterOpenings, FillingIsByTheRuleOfOneCanopy) {
  // Largest in the last fifth, then smaller by a fifth: the mean over the last fifth is not that of the full canopy.
  const std::vector<CanopyRow> rows = rows_of_two(0.24, 0.2);
  std::vector<AreaAt> second;
  for (const CanopyRow& row : rows)
    if (row.canopy == 2) second.push_back({row.time, row.mouth_area});
  const ClusterOpening both = summarise_openings(rows, 2, 0.005);
  EXPECT_EQ(both.canopies[1].filling_time.value(), filling_of(second)->time);
  double mean = 0;
  for (const AreaAt& at : second)
    if (at.time > 0.34 + 1e-9) mean += at.area / 30;
  EXPECT_NEAR(mouth_at(both.canopies[1].filling_time.value(), 0.24, 0.2), mean, 0.01);
}

TEST(ClusterOpenings, ACanopyThatStillGrowsHasNotFilled) {
  const ClusterOpening both = summarise_openings(rows_of_two(0.35), 2, 0.005);
  EXPECT_TRUE(both.canopies[0].filling_time);
  EXPECT_FALSE(both.canopies[1].filling_time);
  EXPECT_FALSE(both.filling_difference);
}

}  // namespace
}  // namespace ripstop
