#include "ripstop/flow/openfoam/hostfile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "ripstop/core/toml/document.h"
#include "ripstop/core/toml/problem.h"

namespace ripstop::inline flow::openfoam {
namespace {

constexpr int most_slots = 4096;
const std::vector<std::string> count_keys = {"slots", "cpu", "count"};
// Open MPI's limit above which it does not go however many ranks there are.
const std::vector<std::string> limit_keys = {"max_slots", "max-slots", "slots_max", "slots-max"};
const std::vector<std::string> other_keys = {"username", "user_name", "user-name", "port"};

bool is_one_of(const std::string& word, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Also user@host and addresses. One that begins with '-' would be an option of ssh.
bool is_name(const std::string& word) {
  return !word.empty() && std::isalnum(static_cast<unsigned char>(word.front())) &&
         std::all_of(word.begin(), word.end(), [](unsigned char c) {
           return c < 128 &&
                  (std::isalnum(c) || std::string_view("._-:@").find(char(c)) != std::string::npos);
         });
}

class HostLine {
 public:
  HostLine(std::string line, Origin origin) : line_(std::move(line)), origin_(std::move(origin)) {
    line_.resize(std::min(line_.find('#'), line_.size()));
  }

  std::optional<Host> read(std::vector<Problem>& problems) {
    std::istringstream words(line_);
    Host host;
    if (!(words >> host.name)) return {};
    if (!is_name(host.name)) {
      add(problems, host.name, "", "",
          "is not a name of a host: use letters, digits and . _ - : @, starting with a letter or a digit");
      return {};
    }
    std::string word;
    while (words >> word) {
      const std::size_t equals = word.find('=');
      const std::string key = word.substr(0, equals);
      const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
      if (is_one_of(key, count_keys) || is_one_of(key, limit_keys)) {
        const std::optional<int> slots = count(key, value, problems);
        if (slots && is_one_of(key, count_keys)) host.slots = host.slots.value_or(0) + *slots;
      } else if (!is_one_of(key, other_keys)) {
        const std::string near = nearest(key, {"slots", "max_slots", "count", "cpu", "username", "port"});
        add(problems, key, "", "",
            near.empty() ? "is not a word of a hostfile; write slots=N"
                         : fmt::format("is not a word of a hostfile; did you mean {}?", near));
      }
    }
    return host;
  }

 private:
  std::optional<int> count(const std::string& key, const std::string& value, std::vector<Problem>& problems) {
    int number = 0;
    const char* end = value.data() + value.size();
    const auto [stop, error] = std::from_chars(value.data(), end, number);
    if (error == std::errc() && stop == end && number >= 1 && number <= most_slots) return number;
    const std::string range = fmt::format("a whole number, at least 1 and at most {}", most_slots);
    add(problems, key, value.empty() ? "nothing" : value, range, "must be " + range);
    return {};
  }
  void add(std::vector<Problem>& problems, const std::string& key, const std::string& value,
           const std::string& allowed, const std::string& message) {
    origin_.column = static_cast<int>(line_.find(key)) + 1;
    problems.push_back({origin_, key, value, allowed, message});
  }

  std::string line_;
  Origin origin_;
};

}  // namespace

std::vector<Host> parse_hosts(const std::string& text, const std::string& file) {
  std::vector<Host> hosts;
  std::vector<Problem> problems;
  std::istringstream lines(text);
  Origin origin{file, 0, 1, ""};
  for (std::string line; std::getline(lines, line);) {
    ++origin.line;
    if (const auto host = HostLine(line, origin).read(problems)) hosts.push_back(*host);
  }
  if (hosts.empty() && problems.empty())
    problems.push_back(
        {{file, 0, 0, ""}, "", "", "", "contains no host; write one host per line: name slots=4"});
  if (!problems.empty()) throw InputError(ExitCode::usage, std::move(problems));
  return hosts;
}

void require_slots(const std::filesystem::path& file, int ranks) {
  if (!std::filesystem::exists(file))
    throw Error(ExitCode::usage, fmt::format("OpenFOAM: the hostfile {} does not exist", file.string()));
  const std::vector<Host> hosts = parse_hosts(read_text_file(file), file.string());
  long long slots = 0;
  for (const Host& host : hosts) {
    if (!host.slots) return;
    slots += *host.slots;
  }
  if (slots < ranks)
    throw Error(
        ExitCode::usage,
        fmt::format("{}: its {} host{} {} slot{} for {} ranks: give more (slots=N), or at most {} ranks",
                    file.string(), hosts.size(), hosts.size() == 1 ? " has" : "s have", slots,
                    slots == 1 ? "" : "s", ranks, slots));
}

}  // namespace ripstop::inline flow::openfoam
