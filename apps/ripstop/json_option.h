// --json of every command that computes.
#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "warnings.h"

namespace ripstop::cli {

inline void add_json_option(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "Print only the result, as JSON with the content of result.json");
}

/// The result as JSON, or as `print` shows it; then its warnings. Returns the exit code.
template <class Result, class Print>
int show(const Result& result, bool json, Print&& print) {
  if (json)
    fmt::print("{}", to_json(result));
  else
    print();
  print_warnings(result.warnings);
  return 0;
}

}  // namespace ripstop::cli
