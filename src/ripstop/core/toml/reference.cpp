// The reference of a case file, in Markdown, from the tables' descriptions.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ripstop/core/toml/write.h"

namespace ripstop {
namespace {

/// Type, default and range of one field, as columns.
struct Columns {
  std::string type, standard, range;
};

template <class... Args>
std::string code(fmt::format_string<Args...> format, Args&&... args) {
  return fmt::format("`{}`", fmt::format(format, std::forward<Args>(args)...));
}

struct Describe {
  const Field& field;

  std::string range() const { return field.range.text(); }
  std::string listed(const std::vector<std::string>& words) const {
    return fmt::format("`\"{}\"`", fmt::join(words, "\"`, `\""));
  }
  Columns operator()(const double* value) const { return {"number", code("{}", *value), range()}; }
  template <class T>
  Columns operator()(const std::optional<T>*) const {
    const T any{};
    Columns columns = (*this)(&any);
    columns.standard = field.if_absent;
    return columns;
  }
  Columns operator()(const int* value) const { return {"integer", code("{}", *value), range()}; }
  Columns operator()(const bool* value) const { return {"boolean", code("{}", *value), ""}; }
  Columns operator()(const Vec3* v) const {
    return {"3 numbers", code("[{}, {}, {}]", v->x, v->y, v->z), range()};
  }
  Columns operator()(const std::array<int, 3>* value) const {
    return {"3 integers", code("[{}]", fmt::join(*value, ", ")), range()};
  }
  Columns operator()(const NumberList& list) const {
    return {fmt::format("{} to {} numbers", list.min_count, list.max_count), "", range()};
  }
  Columns operator()(const std::string*) const { return {"name", "", ""}; }
  Columns operator()(const Text& text) const {
    return {text.is_name ? "name" : "text", text.value->empty() ? "" : code("\"{}\"", *text.value),
            text.is_name ? "" : fmt::format("at most {} characters", text.max_length)};
  }
  Columns operator()(const Choice& choice) const {
    const auto standard = choice.get();
    return {"word", standard ? code("\"{}\"", choice.words[*standard]) : field.if_absent,
            listed(choice.words)};
  }
  Columns operator()(const Kind& kind) const { return {"word", "", listed(kind.words)}; }
  Columns operator()(const Base&) const { return {"name", "", ""}; }
  Columns operator()(const Subtable&) const { return {}; }
  Columns operator()(const Rows&) const { return {}; }
  Columns operator()(const NamedTables&) const { return {}; }
};

bool is_table(const Field& field) {
  return std::holds_alternative<Subtable>(field.value) || std::holds_alternative<Rows>(field.value) ||
         std::holds_alternative<NamedTables>(field.value);
}

/// A bar would end the column.
std::string escaped(const std::string& text) {
  std::string result;
  for (char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string row(const Field& field) {
  Columns columns = std::visit(Describe{field}, field.value);
  if (field.is_required) columns.standard = "*required*";
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", field.key, columns.type, columns.standard,
                     columns.range, escaped(field.doc));
}

std::string rows_of(const Fields& fields) {
  std::string rows;
  for (const Field& field : fields.list())
    if (!is_table(field)) rows += row(field);
  return rows;
}

void add_table(const Fields& fields, const std::string& name, const std::string& heading,
               const std::string& doc, std::string& out);

/// The tables of the field, if it has any, as separate sections; `when` gives the word of the Kind to which
/// they belong.
void add_inner_tables(const Field& field, const std::string& name, const std::string& when,
                      std::string& out) {
  const std::string inner = name.empty() ? field.key : name + "." + field.key;
  if (const auto* sub = std::get_if<Subtable>(&field.value)) {
    add_table(sub->fields(), inner, code("[{}]", inner), when + field.doc, out);
  } else if (const auto* rows = std::get_if<Rows>(&field.value)) {
    rows->resize(1);
    add_table(rows->row(0), inner, code("[[{}]]", inner), when + field.doc, out);
  } else if (const auto* tables = std::get_if<NamedTables>(&field.value)) {
    add_table(tables->entry("name"), inner, code("[{}.<name>]", inner), when + field.doc, out);
  }
}

void add_table(const Fields& fields, const std::string& name, const std::string& heading,
               const std::string& doc, std::string& out) {
  const std::string head = "| key | type | default | range | meaning |\n| --- | --- | --- | --- | --- |\n";
  out += fmt::format("## {}\n\n{}{}", heading, doc, doc.empty() ? "" : "\n\n");
  if (const std::string rows = rows_of(fields); !rows.empty()) out += head + rows + "\n";
  const auto each_word = [&](const auto& visit) {
    for (const Field& field : fields.list()) {
      const auto* kind = std::get_if<Kind>(&field.value);
      for (std::size_t i = 0; kind && i < kind->words.size(); ++i)
        visit(fmt::format("With `{} = \"{}\"`:", field.key, kind->words[i]), kind->select(i));
    }
  };
  each_word([&](const std::string& when, const Fields& further) {
    if (const std::string rows = rows_of(further); !rows.empty()) out += when + "\n\n" + head + rows + "\n";
  });
  each_word([&](const std::string& when, const Fields& further) {
    for (const Field& field : further.list()) add_inner_tables(field, name, when + " ", out);
  });
  for (const Field& field : fields.list()) add_inner_tables(field, name, "", out);
}

}  // namespace

std::string reference_tables(const Fields& fields) {
  std::string out;
  add_table(fields, "", "Top of the file", "", out);
  out.pop_back();
  return out;
}

}  // namespace ripstop
