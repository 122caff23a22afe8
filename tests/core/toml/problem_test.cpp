#include "ripstop/core/toml/problem.h"

#include <gtest/gtest.h>

namespace ripstop {
namespace {

TEST(Nearest, IsTheWordOfTheFewestChangedLetters) {
  EXPECT_EQ(nearest("speed", {"wind_speed", "spead"}), "spead");  // a part of a word is not near to it
  EXPECT_EQ(nearest("goers", {"gores", "lines"}), "gores");
  EXPECT_EQ(nearest("zebra", {"gores", "lines"}), "");
}

}  // namespace
}  // namespace ripstop
