// Formulas mean what the language they come from says, and mistakes are told with their place.
#include "ripstop/core/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

const std::map<std::string, double> names = {{"a", 3}, {"b", 4}, {"pi", std::numbers::pi}, {"radius", 0.5}};

double value(const std::string& formula) {
  return evaluate(formula, names).value;
}

TEST(Expression, PrecedenceFallsFromPowerOverSignAndProductToSum) {
  EXPECT_EQ(value("1+2*3"), 7);
  EXPECT_EQ(value("(1+2)*3"), 9);
  EXPECT_EQ(value("-a^2"), -9);
  EXPECT_EQ(value("2*a^2"), 18);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("-2*-a"), 6);
  EXPECT_EQ(value("- a * b - a * 2.0"), -18);
}

TEST(Expression, EqualOperatorsAreTakenFromTheLeft) {
  EXPECT_EQ(value("10-3-2"), 5);
  EXPECT_EQ(value("16.0/4/2"), 2);
  EXPECT_EQ(value("2^3^2"), 64);
  EXPECT_EQ(value("7.5 % 4 * 2"), 7);
}

TEST(Expression, IntegersDivideAsIntegersAndThatIsNoted) {
  EXPECT_EQ(value("1/2*pi"), 0);
  EXPECT_EQ(evaluate("1/2*pi", names).notes.size(), 1u);
  EXPECT_NEAR(value("1.0/2*pi"), std::numbers::pi / 2, 1e-15);
  EXPECT_TRUE(evaluate("4/2*pi", names).notes.empty());
  EXPECT_TRUE(evaluate("a/2", names).notes.empty());
  EXPECT_EQ(value("a/2"), 1.5);
  EXPECT_EQ(value("-7/2"), -3);
  EXPECT_EQ(value("2^2/8"), 0.5);  // a power is no integer
  EXPECT_EQ(value("round(1)/2"), 0.5);
  EXPECT_EQ(value("max(1, 2)/4"), 0);
}

TEST(Expression, FunctionsHaveTheirValues) {
  EXPECT_NEAR(value("math::acos(1-0.25*2)"), std::numbers::pi / 3, 1e-15);
  EXPECT_NEAR(value("math::sin(pi/6) + math::atan2(1, 1)"), 0.5 + std::numbers::pi / 4, 1e-15);
  EXPECT_EQ(value("min(a, b, -1)"), -1);
  EXPECT_EQ(value("round(6.5) + floor(-0.5) + ceil(0.1)"), 7);
  EXPECT_NEAR(value("math::log(8, 2)"), 3, 1e-14);
  EXPECT_EQ(value("math::hypot(a,b)"), 5);
}

void expect_refused(const std::string& formula, const std::string& message) {
  try {
    evaluate(formula, names);
    FAIL() << formula << " was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
}

TEST(Expression, MistakesAreToldWithTheirPlace) {
  expect_refused("1 + foo", "character 5: unknown name \"foo\"");
  expect_refused("2*radus", "character 3: unknown name \"radus\"; did you mean \"radius\"?");
  expect_refused("a / (b - 4)", "character 3: division by zero");
  expect_refused("1/0", "character 2: division by zero");
  expect_refused("5 % 0", "character 3: division by zero");
  expect_refused("sin(1)", "character 1: unknown function \"sin\"; did you mean \"math::sin\"?");
  expect_refused("1 + math::asin(1.5)", "character 5: math::asin(1.5) has no finite value");
  expect_refused("math::sqrt(0-1)", "has no finite value");
  expect_refused("0.0^-1", "the power has no finite value");
  expect_refused("1e300*1e300", "not a finite number");
  expect_refused("1 + 1e999", "character 5: this is not a number");
  expect_refused(".", "character 1: this is not a number");
  expect_refused("math::hypot(1)", "takes 2 number(s), not 1");
  expect_refused("min()", "takes at least one number, not 0");
  expect_refused("math::sin 1", "is a function");
  expect_refused("(1+2", "this bracket is not closed");
  expect_refused("1+2)", "character 4: unexpected ')'");
  expect_refused("2 3", "character 3: unexpected '3'");
  expect_refused("2radius", "character 2: an operator is missing");
  expect_refused("1 +", "character 4: a number, a name or a bracket is missing");
  expect_refused("", "the formula is empty");
  expect_refused("a < b", "unexpected '<'");
  expect_refused("\"a\"", "formulas consist of");
  expect_refused("1..2", "unexpected");
  expect_refused(std::string(1000, '('), "too many nested brackets");
  std::string deep(1000, '-');
  deep += '1';
  expect_refused(deep, "too many nested brackets");
}

TEST(Expression, NamesAreFoundWithoutTheirValues) {
  EXPECT_EQ(names_in("x/(y-y) + math::sin(z)*2"), (std::vector<std::string>{"x", "y", "y", "z"}));
}

}  // namespace
}  // namespace ripstop
