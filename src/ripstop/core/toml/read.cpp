#include "ripstop/core/toml/read.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>

#include "ripstop/core/quantity.h"
#include "ripstop/core/visible.h"

namespace ripstop {
namespace {

constexpr const char* not_a_table_name =
    "a key here must be a name of at most 64 letters, digits, '.', '_' and '-'";

std::string joined(const std::string& prefix, const std::string& key) {
  return prefix.empty() ? key : prefix + "." + key;
}

/// "above 0 and at most 100 m/s", with the unit in the name of the key.
std::string with_unit(const std::string& range, const std::string& key) {
  const std::string unit = unit_of_key(key);
  return unit.empty() ? range : range + " " + unit;
}

std::string element(const std::string& name, std::size_t index) {
  return fmt::format("{}[{}]", name, index);
}

bool is_number(const Node& node) {
  return node.type == Node::Type::number || node.type == Node::Type::integer;
}

/// TOML distinguishes 3.0 and 3, JSON does not; both are accepted as the integer.
bool is_integral(const Node& node) {
  return is_number(node) && std::isfinite(node.number) && node.number == std::floor(node.number);
}

std::string type_name(const Node& node) {
  switch (node.type) {
    case Node::Type::table:
      return "a table";
    case Node::Type::array:
      return "a list";
    case Node::Type::text:
      return "text";
    case Node::Type::integer:
      return "an integer";
    case Node::Type::number:
      return "a number";
    case Node::Type::boolean:
      return "true/false";
    case Node::Type::date:
      return "a date";
  }
  return "";
}

std::string value_text(const Node& node) {
  switch (node.type) {
    case Node::Type::text:
      return quoted(node.text);
    case Node::Type::integer:
      return fmt::format("{}", node.integer);
    case Node::Type::number:
      return fmt::format("{}", node.number);
    case Node::Type::boolean:
      return node.boolean ? "true" : "false";
    case Node::Type::array: {
      std::vector<std::string> items;
      for (const Node& item : node.items) {
        if (items.size() == 6) {
          items.push_back("...");
          break;
        }
        items.push_back(is_number(item) ? value_text(item) : type_name(item));
      }
      return fmt::format("[{}]", fmt::join(items, ", "));
    }
    case Node::Type::table:
    case Node::Type::date:
      return "";
  }
  return "";
}

/// One key while it is read: its place, and where its origin and problems are recorded.
class Reader {
 public:
  Reader(const Document& document, Origins& origins, std::vector<Problem>& problems)
      : file_(document.name), origins_(origins), problems_(problems) {}

  void table(const Fields& fields, const Node& node, const std::string& prefix);

 private:
  void value(const Field& field, const Node& node, const std::string& name);

  void set(double& target, const Node& node, const std::string& name);
  void set_typed(double& target, const Node& node, const std::string& name);
  template <class T>
  void set(std::optional<T>& target, const Node& node, const std::string& name);
  void set(int& target, const Node& node, const std::string& name);
  void set(bool& target, const Node& node, const std::string& name);
  void set(Vec3& target, const Node& node, const std::string& name);
  void set(std::array<int, 3>& target, const Node& node, const std::string& name);
  void set(const NumberList& target, const Node& node, const std::string& name);
  void set(std::string& target, const Node& node, const std::string& name);
  void set(const Text& target, const Node& node, const std::string& name);
  void set(const Choice& target, const Node& node, const std::string& name);
  void set(const Subtable& target, const Node& node, const std::string& name);
  void set(const Rows& target, const Node& node, const std::string& name);
  void set(const NamedTables& target, const Node& node, const std::string& name);
  template <class T>
  void set(T* target, const Node& node, const std::string& name) {
    set(*target, node, name);
  }
  // Both come before the other keys of their table, see table().
  void set(const Kind&, const Node&, const std::string&) {}
  void set(const Base&, const Node&, const std::string&) {}

  bool is_a(Node::Type type, const Node& node, const std::string& name, const std::string& expected);
  bool word(const std::vector<std::string>& words, const Node& node, const std::string& name,
            std::size_t& chosen);
  bool list(const Node& node, const std::string& name, std::size_t min_count, std::size_t max_count);
  void unknown(const Node& node, const std::string& prefix, const std::vector<std::string>& known);
  void accept(const Node& node, const std::string& name) { origins_[name] = origin(node.place); }
  void report(const Node& node, const std::string& name, std::string allowed, std::string message) {
    problems_.push_back({origin(node.place), name, value_text(node), std::move(allowed), std::move(message)});
  }
  Origin origin(Place place) const { return {file_, place.line, place.column, ""}; }

  const std::string& file_;
  Origins& origins_;
  std::vector<Problem>& problems_;
  Range range_;  // of the key that is read
};

bool Reader::is_a(Node::Type type, const Node& node, const std::string& name, const std::string& expected) {
  if (node.type == type) return true;
  report(node, name, expected, fmt::format("must be {}, not {}", expected, type_name(node)));
  return false;
}

bool Reader::list(const Node& node, const std::string& name, std::size_t min_count, std::size_t max_count) {
  const std::string count =
      min_count == max_count ? std::to_string(min_count) : fmt::format("{} to {}", min_count, max_count);
  if (!is_a(Node::Type::array, node, name, fmt::format("a list of {} numbers", count))) return false;
  if (node.items.size() >= min_count && node.items.size() <= max_count) return true;
  report(node, name, count + " numbers",
         fmt::format("must have {} numbers, not {}", count, node.items.size()));
  return false;
}

bool Reader::word(const std::vector<std::string>& words, const Node& node, const std::string& name,
                  std::size_t& chosen) {
  std::vector<std::string> shown;
  for (const std::string& candidate : words) shown.push_back(quoted(candidate));
  const std::string allowed = fmt::format("{}", fmt::join(shown, ", "));
  if (node.type == Node::Type::text) {
    const auto found = std::find(words.begin(), words.end(), node.text);
    if (found != words.end()) {
      chosen = static_cast<std::size_t>(found - words.begin());
      return true;
    }
  }
  const std::string near = node.type == Node::Type::text ? nearest(node.text, words) : "";
  report(node, name, allowed,
         fmt::format("must be {}{}{}", words.size() > 1 ? "one of " : "", allowed,
                     near.empty() ? "" : fmt::format("; did you mean {}?", quoted(near))));
  return false;
}

/// A text is a number with a unit: "5 lb" for mass_kg.
void Reader::set_typed(double& target, const Node& node, const std::string& name) {
  const TypedNumber read = read_typed(node.text, unit_of_key(name));
  if (!read.has_unit) return report(node, name, "a number", "must be a number, not text");
  if (!read.refusal.empty()) return report(node, name, read.refusal, "must be " + read.refusal);
  target = read.value;
  accept(node, name);
}

void Reader::set(double& target, const Node& node, const std::string& name) {
  if (node.type == Node::Type::text) return set_typed(target, node, name);
  if (!is_number(node)) return report(node, name, "a number", "must be a number, not " + type_name(node));
  if (!std::isfinite(node.number)) return report(node, name, "a finite number", "must be a finite number");
  target = node.number;
  accept(node, name);
}

template <class T>
void Reader::set(std::optional<T>& target, const Node& node, const std::string& name) {
  const std::size_t before = problems_.size();
  T read{};
  set(read, node, name);
  if (problems_.size() == before) target = read;
}

void Reader::set(int& target, const Node& node, const std::string& name) {
  if (!is_integral(node))
    return report(node, name, "an integer",
                  is_number(node) ? "must be a whole number" : "must be an integer, not " + type_name(node));
  // A number beyond int is beyond every range: reported here, as the number that was given.
  constexpr double limit = std::numeric_limits<int>::max();
  if (std::abs(node.number) > limit) {
    const std::string allowed = range_.text().empty() ? fmt::format("at most {}", limit) : range_.text();
    return report(node, name, allowed, "must be " + allowed);
  }
  target = static_cast<int>(node.number);
  accept(node, name);
}

void Reader::set(bool& target, const Node& node, const std::string& name) {
  if (!is_a(Node::Type::boolean, node, name, "true or false")) return;
  target = node.boolean;
  accept(node, name);
}

void Reader::set(Vec3& target, const Node& node, const std::string& name) {
  if (!list(node, name, 3, 3)) return;
  double* const parts[3] = {&target.x, &target.y, &target.z};
  for (std::size_t i = 0; i < 3; ++i) set(*parts[i], node.items[i], element(name, i));
  accept(node, name);
}

void Reader::set(std::array<int, 3>& target, const Node& node, const std::string& name) {
  if (!list(node, name, 3, 3)) return;
  for (std::size_t i = 0; i < 3; ++i) set(target[i], node.items[i], element(name, i));
  accept(node, name);
}

void Reader::set(const NumberList& target, const Node& node, const std::string& name) {
  if (!list(node, name, static_cast<std::size_t>(target.min_count),
            static_cast<std::size_t>(target.max_count)))
    return;
  target.value->assign(node.items.size(), 0.0);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    set((*target.value)[i], node.items[i], element(name, i));
  accept(node, name);
}

void Reader::set(std::string& target, const Node& node, const std::string& name) {
  if (!is_a(Node::Type::text, node, name, "text")) return;
  target = node.text;
  accept(node, name);
}

void Reader::set(const Text& target, const Node& node, const std::string& name) {
  set(*target.value, node, name);
}

void Reader::set(const Choice& target, const Node& node, const std::string& name) {
  std::size_t chosen = 0;
  if (!word(target.words, node, name, chosen)) return;
  target.set(chosen);
  accept(node, name);
}

void Reader::set(const Subtable& target, const Node& node, const std::string& name) {
  if (is_a(Node::Type::table, node, name, "a table")) table(target.fields(), node, name);
}

void Reader::set(const Rows& target, const Node& node, const std::string& name) {
  if (!is_a(Node::Type::array, node, name, fmt::format("a list of tables, [[{}]]", name))) return;
  target.resize(node.items.size());
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (is_a(Node::Type::table, node.items[i], element(name, i), "a table"))
      table(target.row(i), node.items[i], element(name, i));
  }
  accept(node, name);
}

void Reader::set(const NamedTables& target, const Node& node, const std::string& name) {
  if (!is_a(Node::Type::table, node, name, "a table of tables")) return;
  for (const Node& item : node.items) {
    const std::string entry = joined(name, item.key);
    if (!is_name(item.key)) {
      problems_.push_back({origin(item.key_place), name, quoted(item.key), "a name", not_a_table_name});
    } else if (is_a(Node::Type::table, item, entry, "a table")) {
      table(target.entry(item.key), item, entry);
    }
  }
  accept(node, name);
}

void Reader::unknown(const Node& node, const std::string& prefix, const std::vector<std::string>& known) {
  const std::string what = node.type == Node::Type::table ? "table" : "key";
  const std::string near = nearest(node.key, known);
  const std::string where = prefix.empty() ? "a case" : "[" + prefix + "]";
  std::string shown = quoted(node.key);
  shown = shown.substr(1, shown.size() - 2);
  problems_.push_back({origin(node.key_place), joined(prefix, shown), "",
                       fmt::format("{}", fmt::join(known, ", ")),
                       near.empty() ? fmt::format("unknown {}; valid here: {}", what, fmt::join(known, ", "))
                                    : fmt::format("unknown {}; did you mean {}?", what, quoted(near))});
}

void Reader::value(const Field& field, const Node& node, const std::string& name) {
  range_ = field.range;
  std::visit([&](const auto& target) { set(target, node, name); }, field.value);
}

void Reader::table(const Fields& fields, const Node& node, const std::string& prefix) {
  origins_[prefix] = origin(node.place);
  bool has_base = false, names_base = false;  // the key that was meant may be the missing one
  bool kind_is_open = false;
  std::vector<Field> all = fields.list();
  for (const Field& field : fields.list()) {
    const Node* given = node.find(field.key);
    const std::string name = joined(prefix, field.key);
    if (const auto* base = std::get_if<Base>(&field.value); base && given) {
      names_base = true;
      if (!is_a(Node::Type::text, *given, name, "text")) continue;
      const std::string refusal = base->load(given->text);
      if (!refusal.empty()) report(*given, name, "", refusal);
      has_base = true;
    }
    if (const auto* kind = std::get_if<Kind>(&field.value)) {
      std::size_t chosen = kind->get();
      if (given && word(kind->words, *given, name, chosen)) {
        if (has_base && chosen != kind->get())
          report(*given, name, quoted(kind->words[kind->get()]),
                 "differs from the kind of `base`, " + quoted(kind->words[kind->get()]));
        accept(*given, name);
      }
      // Without the word of the kind the further valid keys are unknown.
      kind_is_open = !has_base && kind->words.size() > 1 && !origins_.contains(name);
      if (!kind_is_open) {
        const Fields further = kind->select(chosen);
        all.insert(all.end(), further.list().begin(), further.list().end());
      }
    }
  }

  std::vector<std::string> known;
  for (const Field& field : all) known.push_back(field.key);
  for (const Node& member : node.items) {
    const auto field =
        std::find_if(all.begin(), all.end(), [&](const Field& f) { return f.key == member.key; });
    if (field != all.end())
      value(*field, member, joined(prefix, member.key));
    else if (!kind_is_open)
      unknown(member, prefix, known);
  }
  for (const Field& field : all) {
    if (!field.is_required || names_base || node.find(field.key)) continue;
    std::string message = "is missing";
    if (const std::string range = field.range.text(); !range.empty())
      message += "; give a number " + with_unit(range, field.key);
    if (std::holds_alternative<Subtable>(field.value))
      message = "the table is missing; write [" + joined(prefix, field.key) + "]";
    if (const auto* kind = std::get_if<Kind>(&field.value))
      message += fmt::format("; give one of \"{}\"", fmt::join(kind->words, "\", \""));
    problems_.push_back({origin(node.place), joined(prefix, field.key), "", field.range.text(), message});
  }
}

/// Requirement and fault of a text, as Problem::allowed and Problem::message; both empty for a valid text.
std::pair<std::string, std::string> refusal(const Text& target) {
  const std::string& text = *target.value;
  const auto starts_character = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  if (target.is_name && !is_name(text))
    return {"a name", "must be a name of at most 64 letters, digits, '.', '_' and '-'"};
  if (has_control(text))
    return {"text without control characters", "must not have line breaks or control characters"};
  if (std::count_if(text.begin(), text.end(), starts_character) > target.max_length) {
    const std::string allowed = fmt::format("at most {} characters", target.max_length);
    return {allowed, "must have " + allowed};
  }
  return {};
}

/// Ranges over the tree of described values.
class Checker {
 public:
  Checker(const Origins& origins, std::vector<Problem>& problems) : findings_(origins, problems) {}

  void table(const Fields& fields, const std::string& prefix) {
    // A table without a base has no inherited values.
    for (const Field& field : fields.list())
      if (std::holds_alternative<Base>(field.value) && !findings_.sound({joined(prefix, field.key)})) return;
    for (const Field& field : fields.list()) {
      const std::string name = joined(prefix, field.key);
      std::visit([&](const auto& value) { check(field, value, name, prefix); }, field.value);
    }
  }

 private:
  void number(const Field& field, double value, const std::string& name) {
    if (field.range.contains(value) || !findings_.sound({name})) return;
    const std::string allowed = field.range.text();
    findings_.add(name, value, allowed, "must be " + with_unit(allowed, field.key));
  }
  void check(const Field& field, const double* value, const std::string& name, const std::string&) {
    number(field, *value, name);
  }
  template <class T>
  void check(const Field& field, std::optional<T>* value, const std::string& name,
             const std::string& prefix) {
    if (*value) check(field, &**value, name, prefix);
  }
  void check(const Field& field, const int* value, const std::string& name, const std::string&) {
    number(field, *value, name);
  }
  void check(const Field& field, Vec3* value, const std::string& name, const std::string&) {
    number(field, value->x, element(name, 0));
    number(field, value->y, element(name, 1));
    number(field, value->z, element(name, 2));
  }
  void check(const Field& field, std::array<int, 3>* value, const std::string& name, const std::string&) {
    for (std::size_t i = 0; i < 3; ++i) number(field, (*value)[i], element(name, i));
  }
  void check(const Field& field, const NumberList& list, const std::string& name, const std::string&) {
    const int count = static_cast<int>(list.value->size());
    if ((count < list.min_count || count > list.max_count) && findings_.sound({name}))
      findings_.add(name, fmt::format("[{}]", fmt::join(*list.value, ", ")),
                    fmt::format("{} to {} numbers", list.min_count, list.max_count),
                    fmt::format("must have {} to {} numbers, not {}", list.min_count, list.max_count, count));
    for (std::size_t i = 0; i < list.value->size(); ++i) number(field, (*list.value)[i], element(name, i));
  }
  void check(const Field&, const Subtable& sub, const std::string& name, const std::string&) {
    if (sub.is_there()) table(sub.fields(), name);
  }
  void check(const Field&, const Rows& rows, const std::string& name, const std::string&) {
    for (std::size_t i = 0; i < rows.count(); ++i) table(rows.row(i), element(name, i));
  }
  void check(const Field&, const NamedTables& tables, const std::string& name, const std::string&) {
    for (const std::string& entry : tables.names()) {
      if (!is_name(entry)) findings_.add(name, quoted(entry), "a name", not_a_table_name);
      table(tables.entry(entry), joined(name, entry));
    }
  }
  void check(const Field&, const Kind& kind, const std::string& name, const std::string& prefix) {
    if (findings_.sound({name})) table(kind.select(kind.get()), prefix);
  }
  void check(const Field& field, std::string* text, const std::string& name, const std::string& prefix) {
    check(field, Text{text, true, 64}, name, prefix);
  }
  void check(const Field&, const Text& text, const std::string& name, const std::string&) {
    const auto [allowed, message] = refusal(text);
    if (!message.empty() && findings_.sound({name}))
      findings_.add(name, ripstop::quoted(*text.value), allowed, message);
  }
  void check(const Field&, const bool*, const std::string&, const std::string&) {}
  void check(const Field&, const Choice&, const std::string&, const std::string&) {}
  void check(const Field&, const Base&, const std::string&, const std::string&) {}

  Findings findings_;
};

}  // namespace

void read_table(const Fields& fields, const Document& document, Origins& origins,
                std::vector<Problem>& problems) {
  Reader(document, origins, problems).table(fields, document.root, "");
}

void check_values(const Fields& fields, const Origins& origins, std::vector<Problem>& problems) {
  Checker(origins, problems).table(fields, "");
}

void read_and_check(const std::function<void(Fields&)>& describe, const Document& document, Origins& origins,
                    std::vector<Problem>& problems) {
  Fields empty;
  describe(empty);
  read_table(empty, document, origins, problems);
  Fields filled;
  describe(filled);
  check_values(filled, origins, problems);
}

bool is_name(const std::string& text) {
  const auto allowed = [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) || c == '.' || c == '_' || c == '-');
  };
  return !text.empty() && text.size() <= 64 && std::isalnum(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), allowed);
}

std::string quoted(const std::string& text) {
  std::size_t end = std::min<std::size_t>(text.size(), 60);
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
    --end;  // whole characters
  std::string result = "\"";
  for (const char c : visible(text.substr(0, end)))
    result += c == '\n' ? "\\x0a" : c == '\t' ? "\\x09" : std::string(1, c);
  return result + (end < text.size() ? "...\"" : "\"");
}

}  // namespace ripstop
