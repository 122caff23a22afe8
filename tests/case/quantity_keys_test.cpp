// Errors of solvers name quantities; people who wrote a case read the keys.
#include "ripstop/case/quantity_keys.h"

#include <gtest/gtest.h>

#include "ripstop/case/case.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/fsi/summary.h"

namespace ripstop {
namespace {

TEST(QuantityKeys, ASolversErrorIsToldWithTheKeysOfTheCase) {
  try {
    low_pass({1, 2, 3}, 1e-3, 900);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "low-pass cutoff = 900: must be above 0 and below half the rate of the history, 500 Hz; "
              "increase the history rate");
    EXPECT_EQ(message_of(error),
              "inflation.low_pass_hz = 900: must be above 0 and below half the rate of the history, 500 Hz; "
              "increase inflation.history_hz");
  }
}

TEST(QuantityKeys, AnErrorWithoutQuantitiesStaysAsItIs) {
  EXPECT_EQ(message_of(Error(ExitCode::io, "no low-pass cutoff here")), "no low-pass cutoff here");
}

TEST(QuantityKeys, AQuantityWithoutAKeyIsABug) {
  EXPECT_THROW(message_of(QuantityError(ExitCode::usage, "the weather is bad", {"the weather"})),
               std::out_of_range);
}

TEST(QuantityKeys, AreKeysOfTheSchema) {
  const std::string schema = case_schema();
  for (const auto& [quantity, key] : quantity_keys()) {
    const std::size_t dot = key.rfind('.') + 1, end = key.find_first_of(") ", dot);
    EXPECT_NE(schema.find('"' + key.substr(dot, end - dot) + '"'), std::string::npos) << quantity;
  }
}

}  // namespace
}  // namespace ripstop
