// Options with which a command line changes a case.
#pragma once

#include "ripstop/case/case.h"

namespace CLI {
class App;
}

namespace ripstop {

/// --set KEY=VALUE, repeatable.
void add_set_option(CLI::App& command, Overrides& overrides);
/// --grid, --flow and --ranks.
void add_flow_options(CLI::App& command, Overrides& overrides);
/// --speed, --linear, --set.
void add_case_options(CLI::App& command, Overrides& overrides);

}  // namespace ripstop
