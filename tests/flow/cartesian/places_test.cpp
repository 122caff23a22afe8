#include "ripstop/flow/cartesian/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ripstop {
namespace {

TEST(Places, AreFoundAsByHalving) {
  std::vector<double> sorted;
  for (int n = 0; n < 60; ++n)
    sorted.push_back(-0.7 + 0.013 * n + (n > 40 ? 0.001 * std::exp(0.4 * (n - 40)) : 0));
  const cartesian::Places places(sorted);
  const auto compare = [&](double x) {
    const auto below = std::lower_bound(sorted.begin(), sorted.end(), x) - sorted.begin();
    const auto up_to = std::upper_bound(sorted.begin(), sorted.end(), x) - sorted.begin();
    EXPECT_EQ(places.below(x), below) << x;
    EXPECT_EQ(places.up_to(x), up_to) << x;
  };
  for (const double x : sorted)
    for (const double at : {x, std::nextafter(x, -1e9), std::nextafter(x, 1e9)}) compare(at);
  for (double x = -2; x < 6; x += 0.00731) compare(x);
  for (const double far : {-1e300, 1e300}) compare(far);
}

}  // namespace
}  // namespace ripstop
