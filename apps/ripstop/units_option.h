// --units of the commands that print results: the one place where values are printed with their unit.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

namespace CLI {
class App;
}

namespace ripstop::cli {

/// --units si|us: with us, every printed value in SI is followed by that in US customary units.
void add_units_option(CLI::App& command);
/// Whether --units us is given.
bool both_units();

/// One cell of a table, with --units us by with_us_units().
std::string in_units(const std::string& text);
/// Prints on standard output; with --units us by with_us_units(). On a terminal long lines are wrapped.
void print_plain(const std::string& text);
template <class... Args>
void print_text(fmt::format_string<Args...> format, Args&&... args) {
  print_plain(fmt::format(format, std::forward<Args>(args)...));
}

/// A length of a part: in mm below 0.1 m, else in m; three digits [m].
std::string length_text(double length);

/// A row of a summary: a name and its text.
void print_row(const char* name, const std::string& text);

}  // namespace ripstop::cli
