// --json of every command that computes.
#pragma once

#include <CLI/CLI.hpp>

namespace ripstop {

inline void add_json_option(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "Print the result as JSON, as result.json has it, and nothing else");
}

}  // namespace ripstop
