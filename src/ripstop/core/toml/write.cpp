#include "ripstop/core/toml/write.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

namespace ripstop {
namespace {

using Json = nlohmann::ordered_json;

/// Shortest text that reads back as the same number; TOML wants digits around the point, JSON too.
std::string number_text(double value) {
  return fmt::format("{}", value + 0.0);  // a file has no -0: it reads as an integer
}

std::string text_literal(const std::string& text) {
  std::string result = "\"";
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (result += '\\') += c;
    else if (byte < 0x20 || byte == 0x7f)
      result += fmt::format("\\u{:04X}", byte);
    else
      result += c;
  }
  return result + "\"";
}

template <class List>
std::string list_literal(const List& values) {
  std::vector<std::string> texts;
  for (const auto value : values) texts.push_back(number_text(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

/// The literal of a field that is no table; empty when there is nothing to write.
struct Literal {
  std::string operator()(const double* value) const { return number_text(*value); }
  template <class T>
  std::string operator()(const std::optional<T>* value) const {
    return *value ? (*this)(&**value) : "";
  }
  std::string operator()(const int* value) const { return fmt::format("{}", *value); }
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const Vec3* value) const {
    return list_literal(std::array<double, 3>{value->x, value->y, value->z});
  }
  std::string operator()(const std::array<int, 3>* value) const { return list_literal(*value); }
  std::string operator()(const NumberList& list) const { return list_literal(*list.value); }
  std::string operator()(const std::string* name) const { return text_literal(*name); }
  std::string operator()(const Text& text) const { return text_literal(*text.value); }
  std::string operator()(const Choice& choice) const {
    const auto chosen = choice.get();
    return chosen ? text_literal(choice.words[*chosen]) : "";
  }
  std::string operator()(const Kind& kind) const { return text_literal(kind.words[kind.get()]); }
  std::string operator()(const Subtable&) const { return ""; }
  std::string operator()(const Rows&) const { return ""; }
  std::string operator()(const NamedTables&) const { return ""; }
  std::string operator()(const Base&) const { return ""; }
};

std::string key_literal(const std::string& key) {
  const auto bare = key.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-");
  return bare == std::string::npos ? key : text_literal(key);
}

std::string dotted(const std::string& prefix, const std::string& key) {
  return prefix.empty() ? key_literal(key) : prefix + "." + key_literal(key);
}

/// The keys of a table with those of its kind in their place.
std::vector<Field> flat(const Fields& fields) {
  std::vector<Field> all;
  for (const Field& field : fields.list()) {
    all.push_back(field);
    if (const auto* kind = std::get_if<Kind>(&field.value)) {
      const std::vector<Field> further = flat(kind->select(kind->get()));
      all.insert(all.end(), further.begin(), further.end());
    }
  }
  return all;
}

void write_toml(const Fields& fields, const std::string& prefix, std::string& out) {
  const std::vector<Field> all = flat(fields);
  for (const Field& field : all) {
    const std::string literal = std::visit(Literal{}, field.value);
    if (!literal.empty()) out += field.key + " = " + literal + "\n";
  }
  for (const Field& field : all) {
    const std::string name = dotted(prefix, field.key);
    if (const auto* sub = std::get_if<Subtable>(&field.value)) {
      if (!sub->is_there()) continue;
      out += "\n[" + name + "]\n";
      write_toml(sub->fields(), name, out);
    } else if (const auto* rows = std::get_if<Rows>(&field.value)) {
      for (std::size_t i = 0; i < rows->count(); ++i) {
        out += "\n[[" + name + "]]\n";
        write_toml(rows->row(i), name, out);
      }
    } else if (const auto* tables = std::get_if<NamedTables>(&field.value)) {
      for (const std::string& entry : tables->names()) {
        out += "\n[" + dotted(name, entry) + "]\n";
        write_toml(tables->entry(entry), dotted(name, entry), out);
      }
    }
  }
}

Json json_of(const Fields& fields) {
  Json object = Json::object();
  for (const Field& field : flat(fields)) {
    if (const auto* sub = std::get_if<Subtable>(&field.value)) {
      if (!sub->is_there()) continue;
      object[field.key] = json_of(sub->fields());
    } else if (const auto* rows = std::get_if<Rows>(&field.value)) {
      object[field.key] = Json::array();
      for (std::size_t i = 0; i < rows->count(); ++i) object[field.key].push_back(json_of(rows->row(i)));
    } else if (const auto* tables = std::get_if<NamedTables>(&field.value)) {
      object[field.key] = Json::object();
      for (const std::string& entry : tables->names())
        object[field.key][entry] = json_of(tables->entry(entry));
    } else if (const std::string literal = std::visit(Literal{}, field.value); !literal.empty()) {
      object[field.key] = Json::parse(literal);
    }
  }
  return object;
}

}  // namespace

std::string to_toml(const Fields& fields) {
  std::string out;
  write_toml(fields, "", out);
  return out;
}

std::string to_json(const Fields& fields) {
  return json_of(fields).dump(2) + "\n";
}

}  // namespace ripstop
