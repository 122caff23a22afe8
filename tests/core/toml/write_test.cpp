// A written table reads back, and is plain text for a reader.
#include "ripstop/core/toml/write.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "toml_keys.h"

namespace ripstop {
namespace {

TEST(TomlWrite, OfTablesThatMayBeManyJsonHasAListAlsoOfNone) {
  std::vector<Height> rows;
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
  PlainKeys keys;
  keys.text = "a b ~";
  EXPECT_EQ(to_toml(fields_of(keys)),
            "text = \"a b ~\"\nnumber = 0.1\ngiven = 2\ncount = 3\non = true\nplace = [1, -2.5, 1e-07]\n"
            "cells = [4, 5, 6]\nlist = [1, 0.25]\n");
}

TEST(TomlWrite, OnlyCharactersInvalidInATextAreEscaped) {
  PlainKeys keys;
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
  PlainKeys keys;
  keys.text = "a \"b\"";
  const auto json = nlohmann::ordered_json::parse(to_json(fields_of(keys)));
  EXPECT_EQ(json, nlohmann::ordered_json::parse(
                      R"({"text": "a \"b\"", "number": 0.1, "given": 2, "count": 3, "on": true,
                          "place": [1, -2.5, 1e-07], "cells": [4, 5, 6], "list": [1, 0.25]})"));
}

}  // namespace
}  // namespace ripstop
