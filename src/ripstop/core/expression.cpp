#include "ripstop/core/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>

#include "ripstop/core/error.h"
#include "ripstop/core/toml/problem.h"

namespace ripstop {
namespace {

struct Number {
  double value = 0;
  bool whole = false;  // an integer of the language
};

struct Function {
  int arguments;  // -1: one or more
  std::function<double(const std::vector<double>&)> value;
};

using Numbers = std::vector<double>;

const std::map<std::string, Function>& functions() {
  const auto one = [](double (*f)(double)) { return Function{1, [f](const Numbers& x) { return f(x[0]); }}; };
  const auto two = [](double (*f)(double, double)) {
    return Function{2, [f](const Numbers& x) { return f(x[0], x[1]); }};
  };
  static const std::map<std::string, Function> table = {
      {"min", {-1, [](const Numbers& x) { return *std::min_element(x.begin(), x.end()); }}},
      {"max", {-1, [](const Numbers& x) { return *std::max_element(x.begin(), x.end()); }}},
      {"floor", one(std::floor)},
      {"ceil", one(std::ceil)},
      {"round", one(std::round)},
      {"math::abs", one(std::fabs)},
      {"math::sqrt", one(std::sqrt)},
      {"math::cbrt", one(std::cbrt)},
      {"math::exp", one(std::exp)},
      {"math::exp2", one(std::exp2)},
      {"math::ln", one(std::log)},
      {"math::log2", one(std::log2)},
      {"math::log10", one(std::log10)},
      {"math::log", {2, [](const Numbers& x) { return std::log(x[0]) / std::log(x[1]); }}},
      {"math::sin", one(std::sin)},
      {"math::cos", one(std::cos)},
      {"math::tan", one(std::tan)},
      {"math::asin", one(std::asin)},
      {"math::acos", one(std::acos)},
      {"math::atan", one(std::atan)},
      {"math::sinh", one(std::sinh)},
      {"math::cosh", one(std::cosh)},
      {"math::tanh", one(std::tanh)},
      {"math::asinh", one(std::asinh)},
      {"math::acosh", one(std::acosh)},
      {"math::atanh", one(std::atanh)},
      {"math::atan2", two(std::atan2)},
      {"math::hypot", two(std::hypot)},
      {"math::pow", two(std::pow)},
  };
  return table;
}

bool begins_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}
bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

class Reader {
 public:
  Reader(std::string_view text, const std::map<std::string, double>* names) : text_(text), names_(names) {}

  Number all() {
    if (text_.size() > longest) fail(0, "the formula is longer than 10,000 characters");
    if (skip_blanks(); at_end()) fail(0, "the formula is empty");
    const Number result = sum();
    if (!at_end()) fail(place_, fmt::format("unexpected '{}'", text_[place_]));
    return result;
  }

  std::vector<std::string> notes;
  std::vector<std::string> met;  // names of numbers

 private:
  static constexpr std::size_t longest = 10000;
  static constexpr int deepest = 200;  // of brackets and signs

  [[noreturn]] void fail(std::size_t place, const std::string& what) const {
    throw Error(ExitCode::bad_data, fmt::format("character {}: {}", place + 1, what));
  }
  bool at_end() const { return place_ >= text_.size(); }
  void skip_blanks() {
    while (!at_end() && std::isspace(static_cast<unsigned char>(text_[place_]))) ++place_;
  }
  bool take(char c) {
    skip_blanks();
    if (at_end() || text_[place_] != c) return false;
    ++place_;
    skip_blanks();
    return true;
  }

  Number sum() {
    Number left = product();
    while (true) {
      if (take('+')) {
        const Number right = product();
        left = {left.value + right.value, left.whole && right.whole};
      } else if (take('-')) {
        const Number right = product();
        left = {left.value - right.value, left.whole && right.whole};
      } else {
        return left;
      }
    }
  }

  Number product() {
    Number left = signed_power();
    while (true) {
      skip_blanks();
      const std::size_t place = place_;
      if (take('*')) {
        const Number right = signed_power();
        left = {left.value * right.value, left.whole && right.whole};
      } else if (take('/')) {
        left = quotient(left, signed_power(), place);
      } else if (take('%')) {
        const Number right = signed_power();
        if (right.value == 0 && names_) fail(place, "division by zero");
        left = {std::fmod(left.value, right.value), left.whole && right.whole};
      } else {
        return left;
      }
    }
  }

  Number quotient(Number left, Number right, std::size_t place) {
    if (right.value == 0 && names_) fail(place, "division by zero");
    const double value = left.value / right.value;
    if (!left.whole || !right.whole) return {value, false};
    if (std::trunc(value) != value)
      notes.push_back(fmt::format("character {}: {} / {} of integers is {}; write {}.0 for {}", place + 1,
                                  left.value, right.value, std::trunc(value), left.value, value));
    return {std::trunc(value), true};
  }

  Number signed_power() {
    if (++depth_ > deepest) fail(place_, "too many nested brackets or signs");
    Number result;
    if (take('-')) {
      result = signed_power();
      result.value = -result.value;
    } else {
      result = primary();
      while (true) {
        skip_blanks();
        const std::size_t place = place_;
        if (!take('^')) break;
        const bool negative = take('-');
        const double exponent = primary().value;
        result = {std::pow(result.value, negative ? -exponent : exponent), false};
        if (!std::isfinite(result.value) && names_) fail(place, "the power has no finite value");
      }
    }
    --depth_;
    return result;
  }

  Number primary() {
    skip_blanks();
    if (at_end()) fail(place_, "a number, a name or a bracket is missing at the end");
    if (take('(')) {
      const std::size_t opened = place_;
      const Number inside = sum();
      if (!take(')')) fail(opened, "this bracket is not closed");
      return inside;
    }
    const char c = text_[place_];
    if (is_digit(c) || c == '.') return literal();
    if (begins_name(c)) return name();
    fail(
        place_,
        fmt::format("unexpected '{}'; formulas consist of numbers, names, + - * / % ^ ( ) and functions", c));
  }

  Number literal() {
    const std::size_t start = place_;
    Number number{0, true};
    const char* begin = text_.data() + start;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), number.value);
    if (error != std::errc() || !std::isfinite(number.value)) fail(start, "this is not a number");
    for (const char* c = begin; c != end; ++c) number.whole &= is_digit(*c);
    place_ += static_cast<std::size_t>(end - begin);
    if (!at_end() && begins_name(text_[place_])) fail(place_, "an operator is missing after the number");
    skip_blanks();
    return number;
  }

  Number name() {
    const std::size_t start = place_;
    while (!at_end() && (begins_name(text_[place_]) || is_digit(text_[place_]) || text_[place_] == ':'))
      ++place_;
    const std::string word(text_.substr(start, place_ - start));
    skip_blanks();
    if (take('(')) return call(word, start);
    met.push_back(word);
    if (!names_) return {1, false};
    const auto found = names_->find(word);
    if (found != names_->end()) return {found->second, false};
    if (functions().contains(word)) fail(start, fmt::format("{} is a function: write {}(...)", word, word));
    std::vector<std::string> known;
    for (const auto& entry : *names_) known.push_back(entry.first);
    const std::string meant = nearest(word, known);
    fail(start, fmt::format("unknown name \"{}\"{}", word,
                            meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)));
  }

  Number call(const std::string& word, std::size_t start) {
    const auto found = functions().find(word);
    if (found == functions().end()) {
      std::vector<std::string> known;
      for (const auto& entry : functions()) known.push_back(entry.first);
      std::string meant = functions().contains("math::" + word) ? "math::" + word : nearest(word, known);
      fail(start, fmt::format("unknown function \"{}\"{}", word,
                              meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)));
    }
    Numbers arguments;
    bool whole = true;
    if (!take(')')) {
      do {
        const Number argument = sum();
        arguments.push_back(argument.value);
        whole &= argument.whole;
      } while (take(','));
      if (!take(')')) fail(start, fmt::format("the bracket of {} is not closed", word));
    }
    const Function& function = found->second;
    const int count = static_cast<int>(arguments.size());
    if (function.arguments < 0 ? count == 0 : count != function.arguments)
      fail(start, fmt::format("{} takes {}, not {}", word,
                              function.arguments < 0 ? "at least one number"
                                                     : fmt::format("{} number(s)", function.arguments),
                              count));
    const double value = function.value(arguments);
    if (!std::isfinite(value) && names_) {
      std::string given;
      for (const double x : arguments) given += fmt::format("{}{:.9g}", given.empty() ? "" : ", ", x);
      fail(start, fmt::format("{}({}) has no finite value", word, given));
    }
    return {value, function.arguments < 0 && whole};
  }

  std::string_view text_;
  const std::map<std::string, double>* names_;  // null: only the names that are met are wanted
  std::size_t place_ = 0;
  int depth_ = 0;
};

}  // namespace

Evaluation evaluate(std::string_view formula, const std::map<std::string, double>& names) {
  Reader reader(formula, &names);
  const double value = reader.all().value;
  if (!std::isfinite(value))
    throw Error(ExitCode::bad_data, "character 1: the result is not a finite number");
  return {value, reader.notes};
}

std::vector<std::string> names_in(std::string_view formula) {
  Reader reader(formula, nullptr);
  reader.all();
  return reader.met;
}

}  // namespace ripstop
