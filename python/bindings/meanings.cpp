#include "meanings.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "meanings_of_design.h"
#include "meanings_of_runs.h"
#include "ripstop/core/words.h"

namespace ripstop::python {
namespace {

std::map<std::string_view, std::string_view> parsed() {
  std::map<std::string_view, std::string_view> meanings;
  for (std::string_view rest : {meanings_of_runs, meanings_of_design}) {
    while (!rest.empty()) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(line.size() + 1, rest.size()));
      if (const std::size_t colon = line.find(": "); colon != std::string_view::npos && line[0] != '#')
        meanings.emplace(line.substr(0, colon), line.substr(colon + 2));
    }
  }
  return meanings;
}

}  // namespace

std::string meaning_of(const std::string& type, const std::string& name) {
  static const std::map<std::string_view, std::string_view> meanings = parsed();
  Wording wording = in_words(name);
  for (const std::string& key : {(type == "SweepRun" ? "Steady" : type) + "." + name, name})
    if (const auto found = meanings.find(key); found != meanings.end()) {
      wording.text = found->second;
      break;
    }
  return wording.with_unit();
}

}  // namespace ripstop::python
