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

TEST(Engines, UnsupportedFeaturesAreReportedByTheirQuantities) {
  EXPECT_TRUE(
      lacks(engine_of("builtin"), {.sheets = true, .averages = true, .boundaries = {"entraining"}}).empty());
  const auto lack = lacks(engine_of("openfoam"),
                          {.sheets = true, .averages = true, .ranks = true, .boundaries = {"entraining"}});
  std::set<std::string> quantities;
  for (const Lack& one : lack) quantities.insert(one.quantity);
  EXPECT_EQ(quantities, (std::set<std::string>{"sides", "iterations of the mean"}));
}

}  // namespace
}  // namespace ripstop
