#include "case_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "number_option.h"
#include "option.h"
#include "ripstop/core/error.h"
#include "ripstop/core/toml/problem.h"
#include "warnings.h"

namespace ripstop::cli {

void require_one_option(const Overrides& overrides) {
  std::map<std::string, std::string> options;  // by key
  if (overrides.speed) options["flow.speed_m_s"] = "--speed";
  if (overrides.grid) options["flow.cells"] = "--grid";
  if (overrides.engine) options["flow.engine"] = "--flow";
  if (overrides.ranks) options["flow.ranks"] = "--ranks";
  for (const Setting& setting : overrides.set) {
    if (setting.remove) continue;
    const auto [known, first] = options.try_emplace(setting.key, setting.option);
    if (!first && known->second != setting.option)
      throw InputError(ExitCode::usage,
                       {{{"", 0, 0, setting.option},
                         setting.key,
                         setting.value,
                         "",
                         fmt::format("is also given by {}: give one of them", known->second)}});
  }
}

Case read_given(const std::filesystem::path& file, const Overrides& overrides) {
  require_one_option(overrides);
  Case given = read_case(file, overrides);
  print_deprecations(given.deprecations);
  return given;
}

Settings read_settings(const std::filesystem::path& file, const Overrides& overrides) {
  return resolve(read_given(file, overrides));
}

void add_set_option(CLI::App& command, Overrides& overrides) {
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&overrides](const std::vector<std::string>& settings) {
            for (const std::string& text : settings) overrides.set.push_back(parse_setting(text, "--set"));
          },
          "Set any key of the case, for example --set flow.box_m=[3,3,5]; repeatable")
      ->expected(1)
      ->take_all();
  command
      .add_option_function<std::vector<std::string>>(
          "--unset",
          [&overrides](const std::vector<std::string>& keys) {
            for (const std::string& key : keys) overrides.set.push_back({key, "", "--unset", true});
          },
          "Remove a key or table from the case, for example --unset payload; repeatable")
      ->expected(1)
      ->take_all();
}

void add_key_option(CLI::App& command, const std::string& option, const std::string& key,
                    const std::string& help, Overrides& overrides) {
  command
      .add_option_function<std::string>(
          option,
          [&overrides, option, key](const std::string& value) {
            overrides.set.push_back({key, value, option});
          },
          with_key(help, key))
      ->type_name(key_type(key));
}

void add_flow_options(CLI::App& command, Overrides& overrides) {
  std::vector<std::string> words;
  for (const EngineRecord& engine : engines()) words.push_back(engine.word);
  add_three(command, "--grid", overrides.grid, key_range("flow.cells"),
            "Cells NX,NY,NZ of the flow domain, for example 40,40,50 (case key flow.cells)");
  CLI::Option* flow = command.add_option_function<std::string>(
      "--flow", [&overrides](const std::string& engine) { overrides.engine = engine; },
      "Flow engine (case key flow.engine)");
  accept_words(flow, words);
  add_key_number(command, "--ranks", "flow.ranks", overrides.ranks, "MPI processes of one flow solution");
}

void add_case_options(CLI::App& command, Overrides& overrides) {
  add_key_number(command, "--speed", "flow.speed_m_s", overrides.speed,
                 "Airspeed [m/s]; in a wind tunnel the nominal speed");
  command.add_flag("--linear", overrides.linear,
                   "Linear material model: only the stiffness coefficient K_1 of every material");
  add_set_option(command, overrides);
}

}  // namespace ripstop::cli
