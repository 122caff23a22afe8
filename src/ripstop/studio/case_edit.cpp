#include "ripstop/studio/case_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/toml/document.h"

namespace ripstop::inline studio {
namespace {

/// A part of the text: [begin, end).
struct Span {
  std::size_t begin = 0, end = 0;
};

/// Columns count characters, not bytes.
std::size_t offset_of(const std::string& text, Place place) {
  std::size_t at = 0;
  for (int line = 1; line < place.line; ++line) {
    const std::size_t next = text.find('\n', at);
    if (next == std::string::npos) return text.size();
    at = next + 1;
  }
  for (int column = 1; column < place.column && at < text.size(); ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) ++at;
  }
  return at;
}

std::size_t line_begin(const std::string& text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return before == std::string::npos ? 0 : before + 1;
}

/// Behind the line break, or the end of the text.
std::size_t line_end(const std::string& text, std::size_t at) {
  const std::size_t next = text.find('\n', at);
  return next == std::string::npos ? text.size() : next + 1;
}

std::size_t string_end(const std::string& text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool is_long = text.compare(at, 3, three) == 0;
  std::size_t i = at + (is_long ? 3 : 1);
  for (; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (is_long ? text.compare(i, 3, three) == 0 : text[i] == quote) {
      i += is_long ? 3 : 1;
      for (int more = 0; is_long && more < 2 && i < text.size() && text[i] == quote; ++more) ++i;
      return i;
    }
  }
  return text.size();
}

/// Behind the value that begins at `at` of a text that is valid TOML.
std::size_t value_end(const std::string& text, std::size_t at) {
  if (at >= text.size()) return text.size();
  if (text[at] == '"' || text[at] == '\'') return string_end(text, at);
  if (text[at] == '[' || text[at] == '{') {
    int depth = 0;
    for (std::size_t i = at; i < text.size();) {
      const char c = text[i];
      if (c == '"' || c == '\'') {
        i = string_end(text, i);
        continue;
      }
      if (c == '#') {
        i = line_end(text, i);
        continue;
      }
      if (c == '[' || c == '{') ++depth;
      if ((c == ']' || c == '}') && --depth == 0) return i + 1;
      ++i;
    }
    return text.size();
  }
  std::size_t end = text.find_first_of(",]}#\r\n", at);
  if (end == std::string::npos) end = text.size();
  while (end > at && (text[end - 1] == ' ' || text[end - 1] == '\t')) --end;
  return end;
}

/// Whether the node is written as `key = value`; else it has a header, or its members are dotted keys.
bool is_value(const Node& node, const std::string& text) {
  const Place key = node.key_place, value = node.place;
  if (node.type != Node::Type::table && node.type != Node::Type::array) return true;
  const char first = text[std::min(offset_of(text, value), text.size() - 1)];
  const bool behind = key.line < value.line || (key.line == value.line && key.column < value.column);
  return behind && first == (node.type == Node::Type::table ? '{' : '[');
}

void collect(const Node& table, const std::string& text, const std::string& prefix,
             std::map<std::string, Span>& spans) {
  for (const Node& item : table.items) {
    const std::string name = prefix.empty() ? item.key : prefix + "." + item.key;
    if (is_value(item, text) && item.type != Node::Type::table) {
      const std::size_t begin = offset_of(text, item.place);
      spans[name] = {begin, value_end(text, begin)};
    } else if (item.type == Node::Type::table) {
      collect(item, text, name, spans);
    } else {
      for (std::size_t i = 0; i < item.items.size(); ++i)
        collect(item.items[i], text, fmt::format("{}[{}]", name, i), spans);
    }
  }
}

std::map<std::string, Span> spans_of(const std::string& text, const Document& document) {
  std::map<std::string, Span> spans;
  if (!text.empty()) collect(document.root, text, "", spans);
  return spans;
}

struct ListMember {
  std::string list;
  std::optional<std::size_t> index;  // absent: the table is of no list
};

/// "measured[1]" is the member 1 of "measured".
ListMember list_member(const std::string& table) {
  const std::size_t open = table.rfind('[');
  if (!table.ends_with(']') || open == std::string::npos || table.size() - open > 8) return {table, {}};
  const std::string digits = table.substr(open + 1, table.size() - open - 2);
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos) return {table, {}};
  return {table.substr(0, open), std::stoul(digits)};
}

struct Header {
  std::string name;  // "parachute.lines"; of a list of tables with its brackets: "[measured]"
  std::size_t line = 0;
};

/// The headers of tables: lines that begin with '[' outside of values.
std::vector<Header> headers_of(const std::string& text, const std::map<std::string, Span>& spans) {
  std::vector<Header> headers;
  for (std::size_t line = 0; line < text.size(); line = line_end(text, line)) {
    const std::size_t first = text.find_first_not_of(" \t", line);
    if (first == std::string::npos || text[first] != '[') continue;
    const bool inside = std::any_of(spans.begin(), spans.end(), [&](const auto& entry) {
      return entry.second.begin <= first && first < entry.second.end;
    });
    if (inside) continue;
    std::string name;
    for (std::size_t i = first + 1; i < text.size() && text[i] != '\n' && text[i] != '#'; ++i)
      if (text[i] != ' ' && text[i] != '\t' && text[i] != '\r' && text[i] != '"' && text[i] != '\'')
        name += text[i];
    if (name.ends_with(']')) name.pop_back();
    headers.push_back({name, line});
  }
  return headers;
}

/// The header of a table, or of the member "measured[1]" of a list of tables; the number of headers if there is none.
std::size_t header_of(const std::vector<Header>& headers, const std::string& table) {
  const ListMember member = list_member(table);
  const std::string name = member.index ? "[" + member.list + "]" : table;
  std::size_t left = member.index.value_or(0);
  for (std::size_t i = 0; i < headers.size(); ++i)
    if (headers[i].name == name && left-- == 0) return i;
  return headers.size();
}

const Node* find_path(const Node& root, const std::string& path) {
  const Node* node = &root;
  for (std::size_t begin = 0; node && begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    node = node->find(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return node;
}

std::string with_line_break(std::string text) {
  if (!text.empty() && !text.ends_with('\n')) text += '\n';
  return text;
}

/// Behind the last line of a section of the file that has a value, else behind its first line.
std::size_t end_of_values(const std::string& text, const std::map<std::string, Span>& spans, Span section,
                          std::size_t otherwise) {
  std::size_t end = otherwise;
  for (const auto& [name, span] : spans)
    if (span.begin >= section.begin && span.begin < section.end)
      end = std::max(end, line_end(text, span.end));
  return end;
}

std::string with_new_key(std::string text, const std::string& key, const std::string& literal) {
  text = with_line_break(std::move(text));
  const Document document = parse_toml(text, "case");
  const auto spans = spans_of(text, document);
  const auto headers = headers_of(text, spans);
  const std::size_t dot = key.rfind('.');
  const std::string table = dot == std::string::npos ? "" : key.substr(0, dot);
  const std::string line =
      fmt::format("{} = {}\n", key.substr(dot == std::string::npos ? 0 : dot + 1), literal);
  const std::size_t first = headers.empty() ? text.size() : headers.front().line;
  if (table.empty()) {
    const std::size_t at = end_of_values(text, spans, {0, first}, 0);
    if (at > 0) return text.insert(at, line);
    return text.insert(first, headers.empty() ? line : line + "\n");
  }
  if (const std::size_t i = header_of(headers, table); i < headers.size()) {
    const std::size_t next = i + 1 < headers.size() ? headers[i + 1].line : text.size();
    const std::size_t begin = headers[i].line;
    return text.insert(end_of_values(text, spans, {begin, next}, line_end(text, begin)), line);
  }
  const Node* parent = find_path(document.root, table);
  if (parent && is_value(*parent, text)) {  // an inline table
    const std::string member = line.substr(0, line.size() - 1);
    return text.insert(offset_of(text, parent->place) + 1, parent->items.empty() ? member : member + ", ");
  }
  const ListMember member = list_member(table);
  const std::string name = member.index ? "[" + member.list + "]" : table;
  return text + fmt::format("{}[{}]\n{}", text.empty() ? "" : "\n", name, line);
}

/// The change must concern no other value, whatever the layout of the file.
std::string verified(std::string after, const std::map<std::string, std::string>& expected,
                     const std::string& key) {
  std::map<std::string, std::string> found;
  try {
    found = written_values(after);
  } catch (const Error&) {
    found = {{"", ""}};
  }
  if (found != expected)
    throw Error(
        ExitCode::usage,
        fmt::format("{} cannot be changed in this layout of the file; edit the text of the file", key));
  return after;
}

/// The values without those of a table; later members of its list follow on.
std::map<std::string, std::string> without_members(const std::map<std::string, std::string>& values,
                                                   const std::string& table) {
  const ListMember member = list_member(table);
  std::map<std::string, std::string> rest;
  for (const auto& [name, literal] : values) {
    if (name.starts_with(table + ".")) continue;
    const std::size_t close = name.find(']', member.list.size());
    const ListMember of = member.index && name.starts_with(member.list + "[") && close != std::string::npos
                              ? list_member(name.substr(0, close + 1))
                              : ListMember{};
    if (of.index && *of.index > *member.index)
      rest[fmt::format("{}[{}]{}", of.list, *of.index - 1, name.substr(close + 1))] = literal;
    else
      rest[name] = literal;
  }
  return rest;
}

std::string without_table(const std::string& text, const std::string& table) {
  const auto spans = spans_of(text, parse_toml(text, "case"));
  const auto headers = headers_of(text, spans);
  const std::size_t first = header_of(headers, table);
  if (first == headers.size()) throw Error(ExitCode::usage, fmt::format("{} is not in the file", table));
  std::size_t last = first + 1;
  while (last < headers.size() && headers[last].name.starts_with(table + ".")) ++last;
  const std::size_t next = last < headers.size() ? headers[last].line : text.size();
  std::size_t begin = headers[first].line;
  const std::size_t end = end_of_values(text, spans, {begin, next}, line_end(text, headers[last - 1].line));
  if (begin >= 2 && text.compare(begin - 2, 2, "\n\n") == 0) --begin;
  std::string changed = text;
  changed.erase(begin, end - begin);
  return verified(std::move(changed), without_members(written_values(text), table), table);
}

}  // namespace

std::map<std::string, std::string> written_values(const std::string& text) {
  std::map<std::string, std::string> values;
  for (const auto& [name, span] : spans_of(text, parse_toml(text, "case")))
    values[name] = text.substr(span.begin, span.end - span.begin);
  return values;
}

std::string with_key(const std::string& text, const std::string& key, const std::string& literal) {
  const auto spans = spans_of(text, parse_toml(text, "case"));
  const auto found = spans.find(key);
  std::string changed = text;
  if (found == spans.end())
    changed = with_new_key(std::move(changed), key, literal);
  else
    changed.replace(found->second.begin, found->second.end - found->second.begin, literal);
  auto expected = written_values(text);
  expected[key] = literal;
  return verified(std::move(changed), expected, key);
}

std::string without_key(const std::string& text, const std::string& key) {
  const auto spans = spans_of(text, parse_toml(text, "case"));
  const auto found = spans.find(key);
  if (found == spans.end()) return without_table(text, key);
  std::string changed = text;
  const std::size_t begin = line_begin(text, found->second.begin), end = line_end(text, found->second.end);
  changed.erase(begin, end - begin);
  auto expected = written_values(text);
  expected.erase(key);
  return verified(std::move(changed), expected, key);
}

}  // namespace ripstop::inline studio
