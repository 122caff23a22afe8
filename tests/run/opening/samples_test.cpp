#include "ripstop/run/opening/samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/small_case.h"

namespace ripstop {
namespace {

TEST(Samples, StatisticIsThatOfTheValuesThatAreThere) {
  const auto s = statistic_of({2.0, std::nullopt, 4.0, 9.0});
  ASSERT_TRUE(s);
  EXPECT_DOUBLE_EQ(s->mean, 5);
  EXPECT_DOUBLE_EQ(s->standard_deviation, std::sqrt(13.0));
  EXPECT_EQ(s->lowest, 2);
  EXPECT_EQ(s->highest, 9);
  EXPECT_FALSE(statistic_of({std::nullopt}));
}

TEST(Samples, SeedPerturbsTheFoldsByAHundredthOfTheirRadius) {
  Case given = checked(flat_circular_case(2, 600, 10));
  given.inflation.initial_radius_m = 0.2;
  const Settings resolved = resolve(given);
  const Settings first = with_seed(resolved, 1), third = with_seed(resolved, 3);
  EXPECT_EQ(first.inflation().imperfection_seed, 1);
  EXPECT_EQ(third.inflation().imperfection_seed, 3);
  EXPECT_DOUBLE_EQ(first.inflation().imperfection_m, 0.002);
  EXPECT_EQ(resolved.inflation().imperfection_seed, 0);
}

}  // namespace
}  // namespace ripstop
