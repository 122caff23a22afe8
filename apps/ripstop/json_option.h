// --json of every command that computes.
#pragma once

#include <CLI/CLI.hpp>

namespace ripstop {

inline void add_json_option(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "Print only the result, as JSON with the content of result.json");
}

}  // namespace ripstop
