#include "number_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>

#include "ripstop/case/case.h"
#include "ripstop/core/error.h"
#include "ripstop/core/quantity.h"
#include "ripstop/core/visible.h"

namespace ripstop::cli {
namespace {

constexpr const char *number_type = "NUMBER", *integer_type = "INTEGER";

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& why) {
  throw Error(ExitCode::usage, fmt::format("{} = {}: {}", option, visible(text), why));
}

/// The unit of a number is in brackets in its help: "Height [m]". Empty when it has none.
std::string unit_in(const std::string& help) {
  const std::size_t open = help.rfind('['), close = help.rfind(']');
  return open == std::string::npos || close < open ? "" : help.substr(open + 1, close - open - 1);
}

double parsed(const std::string& option, const std::string& text, const std::string& unit) {
  const TypedNumber read = read_typed(text, unit);
  if (!read.refusal.empty()) refuse(option, text, "must be " + read.refusal);
  return read.value;
}

double in_range(const std::string& option, const std::string& text, Range range, const std::string& unit) {
  const double value = parsed(option, text, unit);
  if (!range.contains(value))
    refuse(option, text, fmt::format("must be {}{}{}", range.text(), unit.empty() ? "" : " ", unit));
  return value;
}

int whole(const std::string& option, const std::string& text, Range range) {
  const double value = in_range(option, text, range, "");
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
    refuse(option, text, "must be a whole number");
  return static_cast<int>(value);
}

std::string shown(double value) {
  return fmt::format("{:g}", value);
}

template <class Take>
CLI::Option* add(CLI::App& command, const std::string& option, const std::string& help, const char* type,
                 Take take) {
  return command.add_option_function<std::string>(option, take, help)->type_name(type);
}

/// `values` is an array or an optional one.
template <class Values>
CLI::Option* three(CLI::App& command, const std::string& option, Values& values, Range range,
                   const std::string& help) {
  return command
      .add_option_function<std::vector<std::string>>(
          option,
          [&values, option, range](const std::vector<std::string>& texts) {
            std::array<int, 3> read{};
            for (std::size_t i = 0; i < 3; ++i) read[i] = whole(option, texts.at(i), range);
            values = read;
          },
          with_range(help, range))
      ->delimiter(',')
      ->expected(3)
      ->type_name("INTEGERS");
}

/// Of one key, however deep its table lies.
std::optional<Field> find_key(const Fields& fields, const std::string& key) {
  const std::string first = key.substr(0, key.find('.'));
  for (const Field& field : fields.list()) {
    if (field.key != first) continue;
    if (first == key) return field;
    if (const auto* table = std::get_if<Subtable>(&field.value))
      return find_key(table->fields(), key.substr(first.size() + 1));
  }
  return {};
}

Field key_field(const std::string& key) {
  Case scratch;
  Fields fields;
  describe(fields, scratch);
  const std::optional<Field> found = find_key(fields, key);
  if (!found) throw std::logic_error("no key " + key);
  return *found;
}

}  // namespace

Range key_range(const std::string& key) {
  return key_field(key).range;
}

std::string key_type(const std::string& key) {
  const Field field = key_field(key);
  const bool integer =
      std::holds_alternative<int*>(field.value) || std::holds_alternative<std::optional<int>*>(field.value);
  return integer ? integer_type : number_type;
}

std::string with_key(const std::string& help, const std::string& key) {
  return with_range(help + " (case key " + key + ")", key_range(key));
}

std::string with_range(const std::string& help, Range range) {
  return range.text().empty() ? help : help + "; " + range.text();
}

CLI::Option* add_number(CLI::App& command, const std::string& option, double& value, Range range,
                        const std::string& help) {
  return add(command, option, with_range(help, range), number_type,
             [&value, option, range, unit = unit_in(help)](const std::string& text) {
               value = in_range(option, text, range, unit);
             })
      ->default_str(shown(value));
}

CLI::Option* add_number(CLI::App& command, const std::string& option, std::optional<double>& value,
                        Range range, const std::string& help) {
  return add(command, option, with_range(help, range), number_type,
             [&value, option, range, unit = unit_in(help)](const std::string& text) {
               value = in_range(option, text, range, unit);
             });
}

CLI::Option* add_number(CLI::App& command, const std::string& option, int& value, Range range,
                        const std::string& help) {
  return add(command, option, with_range(help, range), integer_type,
             [&value, option, range](const std::string& text) { value = whole(option, text, range); })
      ->default_str(shown(value));
}

CLI::Option* add_number(CLI::App& command, const std::string& option, std::optional<int>& value, Range range,
                        const std::string& help) {
  return add(command, option, with_range(help, range), integer_type,
             [&value, option, range](const std::string& text) { value = whole(option, text, range); });
}

CLI::Option* add_numbers(CLI::App& command, const std::string& option, std::vector<double>& values,
                         Range range, const std::string& help) {
  return command
      .add_option_function<std::vector<std::string>>(
          option,
          [&values, option, range, unit = unit_in(help)](const std::vector<std::string>& texts) {
            values.clear();
            for (const std::string& text : texts) values.push_back(in_range(option, text, range, unit));
          },
          with_range(help, range))
      ->delimiter(',')
      ->type_name("NUMBERS")
      ->default_str(fmt::format("{}", fmt::join(values, ",")));
}

CLI::Option* add_three(CLI::App& command, const std::string& option, std::array<int, 3>& values, Range range,
                       const std::string& help) {
  return three(command, option, values, range, help)->default_str(fmt::format("{}", fmt::join(values, ",")));
}

CLI::Option* add_three(CLI::App& command, const std::string& option,
                       std::optional<std::array<int, 3>>& values, Range range, const std::string& help) {
  return three(command, option, values, range, help);
}

CLI::Option* add_key_number(CLI::App& command, const std::string& option, const std::string& key,
                            std::optional<double>& value, const std::string& help) {
  return add(command, option, with_key(help, key), number_type,
             [&value, option, unit = unit_of_key(key)](const std::string& text) {
               value = parsed(option, text, unit);
             });
}

CLI::Option* add_key_number(CLI::App& command, const std::string& option, const std::string& key,
                            std::optional<int>& value, const std::string& help) {
  return add(command, option, with_key(help, key), integer_type,
             [&value, option, range = key_range(key)](const std::string& text) {
               const double number = parsed(option, text, "");
               const bool fits = std::abs(number) <= std::numeric_limits<int>::max();
               value = whole(option, text, fits ? Range{} : range);
             });
}

}  // namespace ripstop::cli
