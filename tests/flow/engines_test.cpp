// The table of engines.
#include "ripstop/flow/engines.h"

#include <gtest/gtest.h>

#include <set>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

TEST(Engines, EachHasAWordOfItsOwnAndTheFirstIsBuiltIn) {
  std::set<std::string> words;
  for (const EngineRecord& engine : engines()) {
    EXPECT_TRUE(words.insert(engine.word).second) << engine.word;
    EXPECT_FALSE(engine.meaning.empty());
    EXPECT_TRUE(engine.name && engine.make);
  }
  EXPECT_EQ(engines().front().word, "builtin");
  EXPECT_TRUE(words.count("openfoam"));
}

TEST(Engines, AnUnknownWordIsReportedWithTheValidOnes) {
  try {
    engine_of("opnfoam");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("builtin, openfoam"), std::string::npos);
  }
}

TEST(Engines, UnsupportedFeaturesAreReportedByTheKeysOfACase) {
  EXPECT_TRUE(
      lacks(engine_of("builtin"), {.sheets = true, .averages = true, .boundaries = {"entraining"}}).empty());
  const auto lack = lacks(engine_of("openfoam"),
                          {.sheets = true, .averages = true, .ranks = true, .boundaries = {"entraining"}});
  std::set<std::string> keys;
  for (const Lack& one : lack) keys.insert(one.key);
  EXPECT_EQ(keys, (std::set<std::string>{"flow.sides", "flow.average_over"}));
}

}  // namespace
}  // namespace ripstop
