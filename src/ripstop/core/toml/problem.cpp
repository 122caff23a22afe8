#include "ripstop/core/toml/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <tuple>

namespace ripstop {
namespace {

std::string place(const Origin& origin) {
  if (!origin.option.empty()) return origin.option + ": ";
  if (origin.file.empty()) return "";
  if (origin.line == 0) return origin.file + ": ";
  return fmt::format("{}:{}:{}: ", origin.file, origin.line, origin.column);
}

std::vector<Problem> sorted(std::vector<Problem> problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return std::tie(a.origin.option, a.origin.file, a.origin.line, a.origin.column) <
           std::tie(b.origin.option, b.origin.file, b.origin.line, b.origin.column);
  });
  return problems;
}

std::string listed(const std::vector<Problem>& problems) {
  if (problems.size() == 1) return to_text(problems.front());
  std::string text = fmt::format("{} problems:", problems.size());
  for (const Problem& problem : sorted(problems)) text += "\n  " + to_text(problem);
  return text;
}

/// Levenshtein's distance: insertions, deletions and substitutions of one character.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t above = row[j + 1];
      row[j + 1] = std::min({above + 1, row[j] + 1, diagonal + (a[i] != b[j])});
      diagonal = above;
    }
  }
  return row.back();
}

std::string plain(const std::string& word) {
  std::string result;
  for (char c : word.substr(0, 100))
    result += c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

}  // namespace

std::string to_text(const Problem& problem) {
  std::string text = place(problem.origin) + problem.key;
  if (!problem.value.empty()) text += " = " + problem.value;
  if (!problem.key.empty()) text += ": ";
  return text + problem.message;
}

InputError::InputError(ExitCode code, std::vector<Problem> problems)
    : Error(code, listed(problems)), problems_(sorted(std::move(problems))) {}

bool Findings::sound(const std::vector<std::string>& keys) const {
  const auto touches = [](const std::string& problem, const std::string& key) {
    if (problem == key || key.starts_with(problem + ".")) return true;
    if (!key.ends_with(".*")) return problem.starts_with(key + "[") || problem.starts_with(key + ".");
    const std::string table = key.substr(0, key.size() - 1);
    return problem.starts_with(table) && problem.find('.', table.size()) == std::string::npos;
  };
  return std::none_of(problems_.begin(), problems_.end(), [&](const Problem& problem) {
    return std::any_of(keys.begin(), keys.end(),
                       [&](const std::string& key) { return touches(problem.key, key); });
  });
}

void Findings::add(const std::string& key, std::string value, std::string allowed, std::string message) {
  Origin origin;
  for (std::string name = key;; name.resize(name.find_last_of(".["))) {
    const auto found = origins_.find(name);
    if (found != origins_.end()) origin = found->second;
    if (found != origins_.end() || name.find_last_of(".[") == std::string::npos) break;
  }
  problems_.push_back({origin, key, std::move(value), std::move(allowed), std::move(message)});
}

void Findings::add(const std::string& key, double value, std::string allowed, std::string message) {
  add(key, fmt::format("{}", value), std::move(allowed), std::move(message));
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string wanted = plain(word);
  if (wanted.size() < 2) return "";
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, wanted.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::string other = plain(candidate);
    std::size_t d = distance(wanted, other);
    // A key without its unit, "speed" for "speed_m_s", is far in letters but surely meant.
    if (wanted.size() >= 3 && (other.starts_with(wanted) || wanted.starts_with(other)))
      d = std::min<std::size_t>(d, 1);
    if (d < best_distance) best = candidate, best_distance = d;
  }
  return best;
}

}  // namespace ripstop
