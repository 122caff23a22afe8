#include "option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "ripstop/core/toml/problem.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string near = nearest(word, candidates);
  return near.size() < 2 ? "" : fmt::format("; did you mean {}?", near);
}

/// The check without a name, which the help would show.
CLI::Validator unnamed(std::function<std::string(std::string&)> check) {
  return CLI::Validator(std::move(check), "");
}

CLI::Option* of_run_folder(CLI::Option* option) {
  return option
      ->check(unnamed([](std::string& folder) {
        if (fs::is_directory(folder)) return std::string();
        return fmt::format("folder \"{}\" {}; give the folder of a finished run", folder,
                           fs::exists(folder) ? "is a file" : "does not exist");
      }))
      ->type_name("FOLDER");
}

/// "--drogue, --drogue-speed", in alphabetical order: the option library sorts them by their addresses in memory.
std::string names_of(const std::set<CLI::Option*>& options) {
  std::set<std::string> names;
  for (const CLI::Option* one : options) names.insert(one->get_name());
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The help of an option begins with its description. The options that it needs or excludes come after it.
class DescriptionFirst : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string text = CLI::Formatter::make_option_opts(option);
    return text.substr(
        0, std::min(text.find(" " + get_label("Needs") + ":"), text.find(" " + get_label("Excludes") + ":")));
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    std::string text = CLI::Formatter::make_option_desc(option);
    if (!option->get_needs().empty()) text += "; needs " + names_of(option->get_needs());
    if (!option->get_excludes().empty()) text += "; excludes " + names_of(option->get_excludes());
    return text;
  }
};

/// The words before the first option: a command, and a word that is none of its commands.
struct Called {
  const CLI::App* command = nullptr;
  std::string words = "ripstop", unknown = {};
};

Called called(const CLI::App& app, int argc, char** argv) {
  Called so_far{&app};
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    const auto commands = so_far.command->get_subcommands({});
    const auto next = std::find_if(commands.begin(), commands.end(),
                                   [&](const CLI::App* one) { return one->get_name() == argv[i]; });
    if (commands.empty()) break;
    if (next == commands.end()) {
      so_far.unknown = argv[i];
      break;
    }
    so_far.command = *next;
    so_far.words += std::string(" ") + argv[i];
  }
  return so_far;
}

std::vector<std::string> command_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* one : command.get_subcommands({})) names.push_back(one->get_name());
  return names;
}

/// The option or argument whose name is at the beginning of a message of the option library.
const CLI::Option* named_first(const CLI::App& command, const std::string& text) {
  const std::string name = text.substr(0, text.find_first_of(": "));
  for (const CLI::Option* one : command.get_options())
    if (one->get_name() == name) return one;
  return nullptr;
}

/// "--mass (Mass of the payload [kg])"
std::string with_meaning(const CLI::Option& option) {
  const bool positional = option.get_lnames().empty();
  return fmt::format("{}{} ({})", positional ? "argument " : "", option.get_name(), option.get_description());
}

std::string unknown_argument(const CLI::App& app, const Called& at) {
  std::vector<std::string> options;
  for (const CLI::Option* one : at.command->get_options())
    for (const std::string& name : one->get_lnames()) options.push_back("--" + name);
  const std::vector<std::string> rest = app.remaining(true);
  const auto word = std::find_if(rest.begin(), rest.end(), [](const auto& w) { return w.starts_with("-"); });
  const std::string option = word == rest.end() ? "" : word->substr(0, word->find('='));
  if (option.empty())
    return fmt::format("unexpected argument \"{}\" of {}", rest.empty() ? "" : rest.front(), at.words);
  return fmt::format("{} is not an option of {}{}", option, at.words, suggestion(option, options));
}

/// The two names of a message such as "--a excludes --b".
std::string pair_message(const std::string& text, const std::string& word, const char* form) {
  const std::size_t middle = text.find(word);
  return fmt::format(fmt::runtime(form), text.substr(0, middle), text.substr(middle + word.size()));
}

std::string wrong_number_of_values(const CLI::Option& option, const std::string& text) {
  if (text.find("flag override") != std::string::npos)
    return fmt::format("{} takes no value: it is given or omitted", option.get_name());
  if (text.find("At Most") != std::string::npos)
    return fmt::format("{} is given more than once", option.get_name());
  const int needed = option.get_expected_min() * option.get_type_size_min();
  return fmt::format("{} needs {}", with_meaning(option),
                     needed > 1 ? fmt::format("{} values", needed) : std::string("a value"));
}

std::string not_a_command(const Called& at) {
  return fmt::format("\"{}\" is not a command{}", at.unknown,
                     suggestion(at.unknown, command_names(*at.command)));
}

std::string with_help(const std::string& message, const Called& at) {
  return fmt::format("{} (see {} --help)", message, at.words);
}

std::string mistake(const CLI::App& app, const CLI::ParseError& error, const Called& at) {
  const std::string text = error.what();
  const std::vector<std::string> commands = command_names(*at.command);
  if (!at.unknown.empty()) return not_a_command(at);
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return unknown_argument(app, at);
  if (dynamic_cast<const CLI::ExcludesError*>(&error))
    return pair_message(text, " excludes ", "{} and {} exclude each other: give one of them");
  if (dynamic_cast<const CLI::RequiresError*>(&error))
    return pair_message(text, " requires ", "{0} needs {1}: give both, or omit {0}");
  const CLI::Option* option = named_first(*at.command, text);
  if (dynamic_cast<const CLI::RequiredError*>(&error)) {
    if (option) return with_meaning(*option) + " is missing";
    if (!commands.empty() && commands.size() < 5)
      return fmt::format("the command after {} is missing: {}", at.words, fmt::join(commands, " or "));
    return "the command is missing, for example size, check or steady";
  }
  if (option && dynamic_cast<const CLI::ArgumentMismatch*>(&error))
    return wrong_number_of_values(*option, text);
  return text;
}

/// The first example at the end of the help, in one line; or nothing.
std::string example_of(const CLI::App& command) {
  const std::string footer = command.get_footer(), start = "ripstop ";
  const std::size_t begin = footer.find(start, std::min(footer.find("Example"), footer.size()));
  if (begin == std::string::npos) return "";
  std::string line;
  for (const char c : footer.substr(begin)) {
    const bool continued = line.ends_with('\\');
    if (c == '\n' && !continued) break;
    if (c == '\n')
      line.pop_back();
    else if (c != ' ' || !line.ends_with(' '))
      line += c;
  }
  return "\nExample: " + line;
}

}  // namespace

CLI::Option* accept_words(CLI::Option* option, const std::vector<std::string>& words) {
  return option
      ->check(unnamed([words](std::string& given) {
        if (std::find(words.begin(), words.end(), given) != words.end()) return std::string();
        return fmt::format("\"{}\" must be {}{}{}", given, words.size() > 2 ? "one of " : "",
                           fmt::join(words, words.size() > 2 ? ", " : " or "), suggestion(given, words));
      }))
      ->option_text(fmt::format("{}", fmt::join(words, "|")));
}

CLI::Option* add_run_folder(CLI::App& command, const std::string& option, fs::path& folder,
                            const std::string& help) {
  return of_run_folder(command.add_option(option, folder, help));
}

CLI::Option* add_run_folders(CLI::App& command, const std::string& option, std::vector<fs::path>& folders,
                             const std::string& help) {
  return of_run_folder(command.add_option(option, folders, help));
}

CLI::Option* add_existing_file(CLI::App& command, const std::string& option, fs::path& file,
                               const std::string& help) {
  return command.add_option(option, file, help)
      ->check(unnamed([](std::string& given) {
        return fs::exists(given) && !fs::is_directory(given)
                   ? std::string()
                   : fmt::format("file \"{}\" does not exist", given);
      }))
      ->type_name("FILE");
}

std::shared_ptr<CLI::FormatterBase> help_format() {
  return std::make_shared<DescriptionFirst>();
}

void show_defaults(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    const std::string value = option->get_default_str();
    option->default_str("");
    if (!value.empty() && value != "{}" && value != "[]" && !option->get_required())
      option->description(fmt::format("{} (default: {})", option->get_description(), value));
  }
  for (CLI::App* command : app.get_subcommands({})) show_defaults(*command);
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const Called at = called(app, argc, argv);
  return with_help(mistake(app, error, at), at) + (at.unknown.empty() ? example_of(*at.command) : "");
}

std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  const Called at = called(app, argc, argv);
  return at.unknown.empty() ? "" : with_help(not_a_command(at), at);
}

}  // namespace ripstop::cli
