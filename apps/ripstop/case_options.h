// Options with which a command line changes a case.
#pragma once

#include "ripstop/case/settings.h"

namespace CLI {
class App;
}

namespace ripstop::cli {

/// A case file with the changes of the command line. Reports its deprecated keys on standard error.
Case read_given(const std::filesystem::path& file, const Overrides& overrides = {});
/// Throws InputError if two different options give one key: neither silently replaces the other.
void require_one_option(const Overrides& overrides);
/// The settings of that case.
Settings read_settings(const std::filesystem::path& file, const Overrides& overrides = {});

/// --set KEY=VALUE and --unset KEY, repeatable.
void add_set_option(CLI::App& command, Overrides& overrides);
/// An option for one key: its value goes where --set would put it, and messages name the option.
void add_key_option(CLI::App& command, const std::string& option, const std::string& key,
                    const std::string& help, Overrides& overrides);
/// --grid, --flow and --ranks.
void add_flow_options(CLI::App& command, Overrides& overrides);
/// --speed, --linear, --set, --unset.
void add_case_options(CLI::App& command, Overrides& overrides);

}  // namespace ripstop::cli
