// What is written of a table reads back, and a reader of the file sees plain text.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/write.h"

namespace ripstop {
namespace {

struct Keys {
  std::string text;
  double number = 0.1;
  std::optional<double> absent, given = 2;
  int count = 3;
  bool on = true;
  Vec3 place{1, -2.5, 1e-7};
  std::array<int, 3> cells{4, 5, 6};
  std::vector<double> list{1, 0.25};
};

Fields fields_of(Keys& keys) {
  Fields fields;
  fields.text("text", keys.text, 100, "");
  fields.number("number", keys.number, Range{}, "");
  fields.number("absent", keys.absent, Range{}, "");
  fields.number("given", keys.given, Range{}, "");
  fields.integer("count", keys.count, Range{}, "");
  fields.toggle("on", keys.on, "");
  fields.vector("place", keys.place, Range{}, "");
  fields.integers("cells", keys.cells, Range{}, "");
  fields.numbers("list", keys.list, 0, 9, Range{}, "");
  return fields;
}

struct Row {
  double height = 1;
};
void describe(Fields& fields, Row& row) {
  fields.number("height", row.height, Range{}, "");
}

TEST(TomlWrite, OfTablesThatMayBeManyJsonHasAListAlsoOfNone) {
  std::vector<Row> rows;
  const auto json = [&] {
    Fields fields;
    fields.rows("rows", rows, "");
    return nlohmann::json::parse(to_json(fields));
  };
  EXPECT_EQ(json(), nlohmann::json::parse(R"({"rows": []})"));
  rows.resize(2);
  EXPECT_EQ(json(), nlohmann::json::parse(R"({"rows": [{"height": 1}, {"height": 1}]})"));
}

TEST(TomlWrite, EveryKindOfValueHasItsOwnLineAndAnAbsentOneHasNone) {
  Keys keys;
  keys.text = "a b ~";
  EXPECT_EQ(to_toml(fields_of(keys)),
            "text = \"a b ~\"\nnumber = 0.1\ngiven = 2\ncount = 3\non = true\nplace = [1, -2.5, 1e-07]\n"
            "cells = [4, 5, 6]\nlist = [1, 0.25]\n");
}

TEST(TomlWrite, OnlyWhatCannotStandInATextIsEscaped) {
  Keys keys;
  const auto line = [&](const std::string& text) {
    keys.text = text;
    const std::string toml = to_toml(fields_of(keys));
    return toml.substr(0, toml.find("\nnumber"));
  };
  EXPECT_EQ(line("say \"no\" \\ yes"), "text = \"say \\\"no\\\" \\\\ yes\"");
  EXPECT_EQ(line("\x1f \x20 \x7e \x7f"), "text = \"\\u001F   ~ \\u007F\"");
  EXPECT_EQ(line("tab\there"), "text = \"tab\\u0009here\"");
  EXPECT_EQ(line("m²"), "text = \"m²\"");
}

TEST(TomlWrite, JsonHasTheSameValuesUnderTheSameKeys) {
  Keys keys;
  keys.text = "a \"b\"";
  const auto json = nlohmann::ordered_json::parse(to_json(fields_of(keys)));
  EXPECT_EQ(json, nlohmann::ordered_json::parse(
                      R"({"text": "a \"b\"", "number": 0.1, "given": 2, "count": 3, "on": true,
                          "place": [1, -2.5, 1e-07], "cells": [4, 5, 6], "list": [1, 0.25]})"));
}

}  // namespace
}  // namespace ripstop
