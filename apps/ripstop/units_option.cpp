#include "units_option.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstddef>

#include "option.h"
#include "ripstop/core/us_units.h"
#include "ripstop/core/wrap.h"

namespace ripstop::cli {
namespace {

std::string chosen_units = "si";

}  // namespace

void add_units_option(CLI::App& command) {
  add_choice(command, "--units", chosen_units, {"si", "us"},
             "Units of printed results: SI, or both SI and US customary units; files are in SI");
}

bool both_units() {
  return chosen_units == "us";
}

std::string in_units(const std::string& text) {
  return both_units() ? with_us_units(text) : text;
}

void print_plain(const std::string& text) {
  static const std::size_t width = wrap_width(STDOUT_FILENO);
  fmt::print("{}", wrapped(in_units(text), width));
}

std::string length_text(double length) {
  return length < 0.1 ? fmt::format("{:.3g} mm", 1000 * length) : fmt::format("{:.3g} m", length);
}

void print_row(const char* name, const std::string& text) {
  print_text("  {:<26} {}\n", name, text);
}

}  // namespace ripstop::cli
