// Options that take numbers. Each has a range, as a key of a case: not-a-number, infinity and values outside are
// refused before the command begins, and the help shows the range and, of a variable that is not optional, the default.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/toml/fields.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ripstop::cli {

CLI::Option* add_number(CLI::App& command, const std::string& option, double& value, Range range,
                        const std::string& help);
CLI::Option* add_number(CLI::App& command, const std::string& option, std::optional<double>& value,
                        Range range, const std::string& help);
CLI::Option* add_number(CLI::App& command, const std::string& option, int& value, Range range,
                        const std::string& help);
CLI::Option* add_number(CLI::App& command, const std::string& option, std::optional<int>& value, Range range,
                        const std::string& help);
/// Numbers parted by commas.
CLI::Option* add_numbers(CLI::App& command, const std::string& option, std::vector<double>& values,
                         Range range, const std::string& help);
/// Three whole numbers, parted by commas or blanks.
CLI::Option* add_three(CLI::App& command, const std::string& option, std::array<int, 3>& values, Range range,
                       const std::string& help);
CLI::Option* add_three(CLI::App& command, const std::string& option,
                       std::optional<std::array<int, 3>>& values, Range range, const std::string& help);

/// A key of the case: the help shows its range, and reading the case checks the value.
CLI::Option* add_key_number(CLI::App& command, const std::string& option, const std::string& key,
                            std::optional<double>& value, const std::string& help);
CLI::Option* add_key_number(CLI::App& command, const std::string& option, const std::string& key,
                            std::optional<int>& value, const std::string& help);

/// Range of a number of the case by its full name, "flow.speed_m_s".
Range key_range(const std::string& key);
/// Name of the type of that key in the help.
std::string key_type(const std::string& key);
/// "Airspeed [m/s] (case key flow.speed_m_s); above 0 and at most 100".
std::string with_key(const std::string& help, const std::string& key);
/// "Airspeed at line stretch [m/s]; above 0 and at most 1000".
std::string with_range(const std::string& help, Range range);

}  // namespace ripstop::cli
