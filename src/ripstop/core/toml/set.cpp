#include "ripstop/core/toml/set.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "ripstop/core/toml/problem.h"
#include "ripstop/core/toml/read.h"

namespace ripstop {
namespace {

[[noreturn]] void refuse(const Setting& setting, const std::string& message) {
  throw InputError(ExitCode::usage, {{{"", 0, 0, setting.option}, setting.key, setting.value, "", message}});
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// A part of a key: a name and the places in lists after it.
struct Step {
  std::string name;
  std::vector<std::size_t> places;
};

std::vector<Step> steps_of(const Setting& setting) {
  std::vector<Step> steps;
  std::size_t at = 0;
  const std::string& key = setting.key;
  do {
    const std::size_t end = std::min(key.find('.', at), key.size());
    std::string part = key.substr(at, end - at);
    at = end + 1;
    Step step;
    step.name = part.substr(0, part.find('['));
    if (!is_name(step.name)) refuse(setting, "is not a name of a key; write it as in flow.speed_m_s");
    part.erase(0, step.name.size());
    while (!part.empty()) {
      std::size_t place = 0;
      const char* last = part.data() + part.size();
      const auto [stop, error] = std::from_chars(part.data() + 1, last, place);
      if (part[0] != '[' || error != std::errc() || stop == last || *stop != ']')
        refuse(setting, "is not a name of a key; write an element of a list as in flow.cells[2]");
      step.places.push_back(place);
      part.erase(0, static_cast<std::size_t>(stop - part.data()) + 1);
    }
    steps.push_back(step);
  } while (at <= key.size());
  return steps;
}

Node value_of(const Setting& setting) {
  try {
    Document one = parse_toml("value = " + setting.value + "\n", setting.option);
    if (one.root.items.size() == 1 && one.root.items[0].key == "value") return one.root.items[0];
  } catch (const InputError&) {
    // no TOML: a word, or a mistake
  }
  const bool word = std::none_of(setting.value.begin(), setting.value.end(), [](unsigned char c) {
    return c < ' ' || c == '[' || c == ']' || c == '{' || c == '}' || c == '"' || c == '\'' || c == '=';
  });
  if (!word) refuse(setting, "cannot be read as a TOML value");
  Node node;
  node.type = Node::Type::text;
  node.text = setting.value;
  return node;
}

}  // namespace

Setting parse_setting(const std::string& text, const std::string& option) {
  const std::size_t equal = text.find('=');
  Setting setting{trimmed(text.substr(0, equal)),
                  equal == std::string::npos ? "" : trimmed(text.substr(equal + 1)), option};
  if (setting.key.empty() || setting.value.empty())
    throw Error(ExitCode::usage,
                fmt::format("{} {}: write KEY=VALUE, as in {} flow.speed_m_s=20", option, text, option));
  return setting;
}

std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[') {
      ++depth;
    } else if (c == ']') {
      --depth;
    } else if (c == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += c;
  }
  for (std::string& value : values) {
    value = trimmed(value);
    if (value.empty())
      throw Error(ExitCode::usage, fmt::format("\"{}\": a value between commas is empty", text));
  }
  return values;
}

namespace {

void remove_value(Document& document, const Setting& setting, const std::vector<Step>& steps) {
  Node* node = &document.root;
  for (const Step& step : steps) {
    const auto found = std::find_if(node->items.begin(), node->items.end(),
                                    [&](const Node& item) { return item.key == step.name; });
    if (node->type != Node::Type::table || found == node->items.end())
      refuse(setting, "is not in the case; only keys and tables that the file gives can be removed");
    if (!step.places.empty())
      refuse(setting, "an element of a list cannot be removed; set the whole list instead");
    if (&step == &steps.back())
      node->items.erase(found);
    else
      node = &*found;
  }
}

}  // namespace

void set_value(Document& document, const Setting& setting) {
  const std::vector<Step> steps = steps_of(setting);
  if (setting.remove) return remove_value(document, setting, steps);
  Node* node = &document.root;
  for (const Step& step : steps) {
    if (node->type != Node::Type::table) refuse(setting, "does not exist: a key before it is not a table");
    auto found = std::find_if(node->items.begin(), node->items.end(),
                              [&](const Node& item) { return item.key == step.name; });
    if (found == node->items.end()) {
      Node table;
      table.key = step.name;
      found = node->items.insert(node->items.end(), table);
    }
    node = &*found;
    for (const std::size_t place : step.places) {
      if (node->type != Node::Type::array || place >= node->items.size())
        refuse(setting, "the file gives no list with this element; give the whole list");
      node = &node->items[place];
    }
  }
  Node value = value_of(setting);
  value.key = node->key;
  value.place = {};
  value.key_place = {};
  *node = value;
}

}  // namespace ripstop
