#include "ripstop/core/checked_int.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../diverges.h"

namespace ripstop {
namespace {

const auto too_many = [] { return std::string("too many"); };

TEST(CheckedInt, TruncatesNumbersInItsRange) {
  EXPECT_EQ(checked_int(0.0, 0, 10, too_many), 0);
  EXPECT_EQ(checked_int(9.9, 0, 10, too_many), 9);
  EXPECT_EQ(checked_int(10.0, 0, 10, too_many), 10);
  EXPECT_EQ(checked_int(-3.5, -4, 10, too_many), -3);
  EXPECT_EQ(checked_int(2147483647.0, 0, 1e300, too_many), std::numeric_limits<int>::max());
  EXPECT_EQ(checked_int(-2147483648.0, -1e300, 0, too_many), std::numeric_limits<int>::min());
}

TEST(CheckedInt, RefusesNumbersOutsideInt) {
  for (const double value : {-1.0, 10.5, double(NAN), double(INFINITY), -double(INFINITY), 1e300})
    EXPECT_EQ(divergence([&] { checked_int(value, 0, 10, too_many); }), "too many") << value;
  for (const double value : {2147483648.0, -2147483649.0, 1e300, double(NAN)})
    EXPECT_EQ(divergence([&] { checked_int(value, -1e300, 1e300, too_many); }), "too many") << value;
}

}  // namespace
}  // namespace ripstop
