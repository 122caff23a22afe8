// JSON Schema of described tables. It says what read_table() and check_values() say, except for what JSON has
// no words for (NaN) and for the keys beside `base`, which it takes from every kind.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "ripstop/core/quantity.h"
#include "ripstop/core/toml/write.h"

namespace ripstop {
namespace {

using Json = nlohmann::ordered_json;

Json object_schema(const Fields& fields);

constexpr std::string_view number_type = "number";

Json number_schema(const Field& field, std::string_view type) {
  const Range& range = field.range;
  Json schema = {{"type", type}};
  if (type == number_type) {
    // "5 lb" is read too; what the number is, read_typed() says.
    schema["type"] = {type, "string"};
    schema["pattern"] = "^[ \\t]*[+-]?[0-9.]+([eE][+-]?[0-9]+)?[ \\t]*[^0-9.,+ \\t-]";
    if (const std::string unit = unit_of_key(field.key); !unit.empty()) schema["unit"] = unit;
  }
  if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) schema[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
  return schema;
}

Json list_schema(const Json& item, int min_count, int max_count) {
  return {{"type", "array"}, {"items", item}, {"minItems", min_count}, {"maxItems", max_count}};
}

/// Python's and JavaScript's `$` disagree about a last line break, so characters are excluded one by one.
Json name_schema() {
  return {{"type", "string"},
          {"minLength", 1},
          {"maxLength", 64},
          {"pattern", "^[A-Za-z0-9]"},
          {"not", {{"pattern", "[^A-Za-z0-9._-]"}}}};
}

struct ValueSchema {
  const Field& field;

  Json with_default(Json schema, const Json& value) const {
    if (!field.is_required) schema["default"] = value;
    return schema;
  }
  Json operator()(const double* value) const { return with_default(number_schema(field, "number"), *value); }
  template <class T>
  Json operator()(const std::optional<T>*) const {
    const T any{};
    Json schema = (*this)(&any);
    schema.erase("default");
    return schema;
  }
  Json operator()(const int* value) const { return with_default(number_schema(field, "integer"), *value); }
  Json operator()(const bool* value) const { return with_default({{"type", "boolean"}}, *value); }
  Json operator()(const Vec3* v) const {
    return with_default(list_schema(number_schema(field, "number"), 3, 3), {v->x, v->y, v->z});
  }
  Json operator()(const std::array<int, 3>* value) const {
    return with_default(list_schema(number_schema(field, "integer"), 3, 3), *value);
  }
  Json operator()(const NumberList& list) const {
    return list_schema(number_schema(field, "number"), list.min_count, list.max_count);
  }
  Json operator()(const std::string*) const { return name_schema(); }
  Json operator()(const Text& text) const {
    Json schema = text.is_name ? name_schema()
                               : Json{{"type", "string"},
                                      {"maxLength", text.max_length},
                                      {"not", {{"pattern", "[\\u0000-\\u001f\\u007f]"}}}};
    return with_default(schema, *text.value);
  }
  Json operator()(const Choice& choice) const {
    const Json schema = {{"enum", choice.words}};
    const auto standard = choice.get();
    return standard ? with_default(schema, choice.words[*standard]) : schema;
  }
  Json operator()(const Kind& kind) const { return {{"enum", kind.words}}; }
  Json operator()(const Base&) const { return name_schema(); }
  Json operator()(const Subtable& sub) const { return object_schema(sub.fields()); }
  Json operator()(const Rows& rows) const {
    rows.resize(1);
    return {{"type", "array"}, {"items", object_schema(rows.row(0))}};
  }
  Json operator()(const NamedTables& tables) const {
    return {{"type", "object"},
            {"propertyNames", name_schema()},
            {"additionalProperties", object_schema(tables.entry("name"))}};
  }
};

struct Keys {
  Json properties = Json::object();
  Json required = Json::array();

  void add(const Field& field) {
    Json schema = std::visit(ValueSchema{field}, field.value);
    std::string doc = field.doc;
    if (!field.if_absent.empty()) doc += " When absent: " + field.if_absent + ".";
    schema["description"] = doc;
    if (!properties.contains(field.key)) properties[field.key] = schema;
    if (field.is_required) required.push_back(field.key);
  }
  Json schema() const {
    Json object = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty()) object["required"] = required;
    return object;
  }
};

Json object_schema(const Fields& fields) {
  Keys common;
  const Kind* kind = nullptr;
  const Field* base = nullptr;
  for (const Field& field : fields.list()) {
    if (const auto* found = std::get_if<Kind>(&field.value)) kind = found;
    if (std::holds_alternative<Base>(field.value))
      base = &field;  // only in its own alternative, below
    else
      common.add(field);
  }
  if (!kind) return common.schema();

  std::string key;
  for (const Field& field : fields.list())
    if (std::get_if<Kind>(&field.value) == kind) key = field.key;
  Json alternatives = Json::array();
  Keys any = common;
  for (std::size_t i = 0; i < kind->words.size(); ++i) {
    Keys keys = common;
    keys.properties[key] = {{"const", kind->words[i]},
                            {"description", common.properties[key]["description"]}};
    for (const Field& field : kind->select(i).list()) keys.add(field), any.add(field);
    alternatives.push_back(keys.schema());
  }
  if (base) {
    any.add(*base);
    any.required = {base->key};
    alternatives.push_back(any.schema());
  }
  if (alternatives.size() == 1) return alternatives.front();
  return {{"anyOf", alternatives}};
}

}  // namespace

std::string json_schema(const Fields& fields, const std::string& title) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(object_schema(fields));
  return schema.dump(2) + "\n";
}

}  // namespace ripstop
