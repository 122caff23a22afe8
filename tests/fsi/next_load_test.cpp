// The load of the next iteration of the steady loop.
#include "ripstop/fsi/next_load.h"

#include <gtest/gtest.h>

namespace ripstop {
namespace {

ClothLoad of_pressure(double p) {
  ClothLoad load;
  load.pressure = {p};
  return load;
}

// The first window sees a developing wake and is replaced by the second. From then on the weight of each is its number.
TEST(NextLoad, WindowsFromTheFirstIterationOnAreAveragedWithoutTheFirst) {
  CouplingSettings settings;
  settings.relaxation = 1;
  SteadyState state;
  state.pressure = {100};
  begin_windows(state, settings);
  const double answers[] = {40, 10, 20, 30};
  const double expected[] = {40, 10, (10 + 2 * 20) / 3.0, (10 + 2 * 20 + 3 * 30) / 6.0};
  for (int n = 0; n < 4; ++n) {
    update_load(state, of_pressure(answers[n]), 0, {1}, settings);
    EXPECT_NEAR(state.pressure[0], expected[n], 1e-12) << n;
    SteadyIteration done;
    done.in_time = true;
    state.iterations.push_back(done);
  }
}

}  // namespace
}  // namespace ripstop
