#include "ripstop/core/toml/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <fstream>
#include <string_view>
#include <system_error>

#include "ripstop/core/toml/problem.h"
#include "ripstop/core/wsl_path.h"

namespace ripstop {
namespace {

constexpr std::size_t max_file_bytes = 1 << 20;
// The parser nests a table for every dot of a key: a bound on the line bounds the depth of its recursion.
constexpr std::size_t max_line_bytes = 4000;

Place place_at(const toml::source_position& position) {
  return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

Node converted(const toml::node& source) {
  Node node;
  node.place = place_at(source.source().begin);
  if (const auto* table = source.as_table()) {
    node.type = Node::Type::table;
    for (const auto& [key, value] : *table) {
      Node member = converted(value);
      member.key = key.str();
      member.key_place = place_at(key.source().begin);
      node.items.push_back(std::move(member));
    }
  } else if (const auto* array = source.as_array()) {
    node.type = Node::Type::array;
    for (const toml::node& item : *array) node.items.push_back(converted(item));
  } else if (const auto* text = source.as_string()) {
    node.type = Node::Type::text;
    node.text = text->get();
  } else if (const auto* integer = source.as_integer()) {
    node.type = Node::Type::integer;
    node.integer = integer->get();
    node.number = static_cast<double>(integer->get());
  } else if (const auto* number = source.as_floating_point()) {
    node.type = Node::Type::number;
    node.number = number->get();
  } else if (const auto* boolean = source.as_boolean()) {
    node.type = Node::Type::boolean;
    node.boolean = boolean->get();
  } else {
    node.type = Node::Type::date;
  }
  return node;
}

[[noreturn]] void refuse(const std::string& name, Place place, const std::string& message) {
  throw InputError(ExitCode::usage, {{{name, place.line, place.column, ""}, "", "", "", message}});
}

void check_lines(const std::string& text, const std::string& name) {
  int line = 1;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    if (end - start > max_line_bytes)
      refuse(name, {line, 1},
             fmt::format("a line of {} characters; at most {} are read", end - start, max_line_bytes));
    start = end + 1;
    ++line;
  }
}

}  // namespace

const Node* Node::find(const std::string& wanted) const {
  for (const Node& item : items)
    if (item.key == wanted) return &item;
  return nullptr;
}

Document parse_toml(const std::string& text, const std::string& name) {
  if (text.size() > max_file_bytes)
    refuse(name, {}, fmt::format("{} bytes; at most {} are read", text.size(), max_file_bytes));
  check_lines(text, name);
  try {
    return {name, converted(toml::parse(text, name))};
  } catch (const toml::parse_error& error) {
    refuse(name, place_at(error.source().begin),
           "not valid TOML: " + std::string(error.description()) +
               "; keys are KEY = VALUE, tables [NAME], text is in quotes");
  }
}

std::string read_text_file(const std::filesystem::path& file) {
  std::error_code failure;
  if (std::filesystem::is_directory(file, failure))
    throw Error(ExitCode::io, fmt::format("{}: is a folder; give the path of a file", file.string()));
  if (std::filesystem::exists(file, failure) && !std::filesystem::is_regular_file(file, failure))
    throw Error(
        ExitCode::io,
        fmt::format("{}: is a pipe or a device, not a file; write its content into a file", file.string()));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    const std::string name = path_in_wsl(file);
    throw Error(
        ExitCode::io,
        fmt::format("{}: cannot be opened; {}", file.string(),
                    name.empty() ? "check the path"
                                 : fmt::format("it is a path of Windows, and within WSL it is {}", name)));
  }
  std::string text(max_file_bytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) throw Error(ExitCode::io, fmt::format("{}: cannot be read", file.string()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > max_file_bytes)
    throw Error(ExitCode::io, fmt::format("{}: larger than {} bytes", file.string(), max_file_bytes));
  return text;
}

}  // namespace ripstop
