// Parts of the options of all commands: words of a list, folders and files that exist, and defaults in the help.
//
// The help shows the default of an option as "(default: VALUE)". show_defaults() takes it from the variable of the
// option before the command line is read. The default of an optional variable, which the command derives later, is
// described with ->default_str("coupling.threads").
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ripstop::cli {

/// Refuses other words, and names the nearest one.
CLI::Option* accept_words(CLI::Option* option, const std::vector<std::string>& words);

inline CLI::Option* add_choice(CLI::App& command, const std::string& option, std::string& value,
                               const std::vector<std::string>& words, const std::string& help) {
  return accept_words(command.add_option(option, value, help), words);
}

/// Each word has its value.
template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& option, Value& value,
                        const std::vector<std::pair<std::string, Value>>& choices, const std::string& help) {
  std::vector<std::string> words;
  std::string at_first;
  for (const auto& [word, meaning] : choices) {
    words.push_back(word);
    if (meaning == value) at_first = word;
  }
  CLI::Option* added = command.add_option_function<std::string>(
      option,
      [&value, choices](const std::string& given) {
        for (const auto& [word, meaning] : choices)
          if (word == given) value = meaning;
      },
      help);
  return accept_words(added->default_str(at_first), words);
}

/// Folder of a finished run.
CLI::Option* add_run_folder(CLI::App& command, const std::string& option, std::filesystem::path& folder,
                            const std::string& help);
CLI::Option* add_run_folders(CLI::App& command, const std::string& option,
                             std::vector<std::filesystem::path>& folders, const std::string& help);
CLI::Option* add_existing_file(CLI::App& command, const std::string& option, std::filesystem::path& file,
                               const std::string& help);

/// Of the help of the program; to be set before commands are added, which inherit it.
std::shared_ptr<CLI::FormatterBase> help_format();

/// In the description of every option of the command and its subcommands. Required ones have no default.
void show_defaults(CLI::App& app);

/// A mistake of the command line: the option with its meaning, the nearest valid name, and an example.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv);
/// Message for a word that is not a command, which a --help after it would hide; empty: there is none.
std::string unknown_command(const CLI::App& app, int argc, char** argv);

}  // namespace ripstop::cli
