// Values that are read from a table are those of the file: every given key has its place.
#include "ripstop/core/toml/read.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "toml_keys.h"

namespace ripstop {
namespace {

struct Round {
  double radius = 1;
};
void describe(Fields& fields, Round& round) {
  fields.number("radius", round.radius, Range{}, "");
}
struct Flat {};
void describe(Fields&, Flat&) {}

struct EveryKind : PlainKeys {
  std::variant<Flat, Round> kind;
  std::string name;
  std::optional<std::string> other_name;
  std::optional<int> given_count;
  std::optional<Vec3> given_place;
  int word = 0;
  Height table;
  std::vector<Height> rows;
  std::map<std::string, Height> named;
};

Fields fields_of_every_kind(EveryKind& keys) {
  Fields fields = fields_of(keys);
  fields.kind("kind", keys.kind, {"flat", "round"}, "");
  fields.name("name", keys.name, "");
  fields.name("other_name", keys.other_name, "");
  fields.integer("given_count", keys.given_count, Range{}, "");
  fields.vector("given_place", keys.given_place, Range{}, "");
  fields.choice("word", keys.word, {{"one", 1}, {"two", 2}}, "");
  fields.table("table", keys.table, "");
  fields.rows("rows", keys.rows, "");
  fields.named_tables("named", keys.named, "");
  return fields;
}

const std::vector<std::string> every_line = {"kind = \"round\"",
                                             "text = \"a b\"",
                                             "name = \"a\"",
                                             "other_name = \"b\"",
                                             "number = 1.5",
                                             "given = 7",
                                             "count = 30",
                                             "given_count = 4",
                                             "on = false",
                                             "place = [1, 2, 3]",
                                             "given_place = [4, 5, 6]",
                                             "cells = [7, 8, 9]",
                                             "list = [0.5, 0.25]",
                                             "word = \"two\"",
                                             "table = {height = 2}",
                                             "rows = [{height = 3}, {height = 4}]",
                                             "named = {c = {height = 5}}",
                                             "radius = 6"};

TEST(TomlRead, EveryKindOfValueIsTakenAndHasItsPlace) {
  std::string text;
  for (const std::string& line : every_line) text += line + "\n";
  EveryKind keys;
  Origins origins;
  std::vector<Problem> problems;
  read_table(fields_of_every_kind(keys), parse_toml(text, "keys.toml"), origins, problems);
  EXPECT_TRUE(problems.empty()) << to_text(problems.front());
  ASSERT_TRUE(std::holds_alternative<Round>(keys.kind));
  EXPECT_EQ(std::get<Round>(keys.kind).radius, 6);
  EXPECT_EQ(keys.text, "a b");
  EXPECT_EQ(keys.name, "a");
  EXPECT_EQ(keys.other_name, "b");
  EXPECT_EQ(keys.number, 1.5);
  EXPECT_EQ(keys.given, 7);
  EXPECT_EQ(keys.count, 30);
  EXPECT_EQ(keys.given_count, 4);
  EXPECT_FALSE(keys.on);
  EXPECT_EQ(keys.place, (Vec3{1, 2, 3}));
  EXPECT_EQ(keys.given_place, (Vec3{4, 5, 6}));
  EXPECT_EQ(keys.cells, (std::array<int, 3>{7, 8, 9}));
  EXPECT_EQ(keys.list, (std::vector<double>{0.5, 0.25}));
  EXPECT_EQ(keys.word, 2);
  EXPECT_EQ(keys.table.height, 2);
  ASSERT_EQ(keys.rows.size(), 2u);
  EXPECT_EQ(keys.rows[1].height, 4);
  EXPECT_EQ(keys.named.at("c").height, 5);
  for (std::size_t n = 0; n < every_line.size(); ++n) {
    const std::string key = every_line[n].substr(0, every_line[n].find(' '));
    if (key == "table") continue;  // its keys have their own
    ASSERT_TRUE(origins.contains(key)) << key;
    EXPECT_EQ(origins[key].line, static_cast<int>(n) + 1) << key;
    EXPECT_EQ(origins[key].file, "keys.toml") << key;
  }
  for (const char* key : {"table.height", "rows[1].height", "named.c.height"})
    EXPECT_TRUE(origins.contains(key)) << key;
}

TEST(TomlRead, AValueOfAnotherTypeIsReportedAtItsPlaceAndChangesNothing) {
  for (std::size_t n = 0; n < every_line.size(); ++n) {
    const std::string key = every_line[n].substr(0, every_line[n].find(' '));
    std::string text;
    for (std::size_t k = 0; k < every_line.size(); ++k)
      text += k == n ? key + (key == "on" ? " = 1\n" : " = true\n") : every_line[k] + "\n";
    EveryKind keys;
    Origins origins;
    std::vector<Problem> problems;
    read_table(fields_of_every_kind(keys), parse_toml(text, "keys.toml"), origins, problems);
    ASSERT_FALSE(problems.empty()) << key;
    EXPECT_EQ(problems.front().key, key);
    EXPECT_EQ(problems.front().origin.line, static_cast<int>(n) + 1) << key;
    EXPECT_FALSE(origins.contains(key)) << key;
  }
}

struct Line {
  double mass_kg = 0, share = 0;
  std::vector<double> lengths_m;
};

std::vector<Problem> read_line(Line& line, const std::string& text) {
  Fields fields;
  fields.number("mass_kg", line.mass_kg, Range{}, "");
  fields.number("share", line.share, Range{}, "");
  fields.numbers("lengths_m", line.lengths_m, 0, 9, Range{}, "");
  Origins origins;
  std::vector<Problem> problems;
  read_table(fields, parse_toml(text, "keys.toml"), origins, problems);
  return problems;
}

TEST(TomlRead, ANumberMayHaveAUnitThatItsKeyCanTake) {
  Line line;
  EXPECT_TRUE(read_line(line, "mass_kg = \"5 lb\"\nshare = \"5 %\"\nlengths_m = [2, \"72 in\"]\n").empty());
  EXPECT_DOUBLE_EQ(line.mass_kg, 2.26796185);
  EXPECT_DOUBLE_EQ(line.share, 0.05);
  EXPECT_EQ(line.lengths_m, (std::vector<double>{2, 1.8288}));
  const std::vector<Problem> problems =
      read_line(line, "mass_kg = \"5 ft\"\nshare = \"5\"\nlengths_m = [\"2 s\"]\n");
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[0].message, "must be a number, or one with a unit that can be converted to m");
  EXPECT_EQ(problems[1].message, "must be a number, or one with a unit that can be converted to kg");
  EXPECT_EQ(problems[2].message, "must be a number, not text");
}

}  // namespace
}  // namespace ripstop
