// Files as machines write them, each with its expectation next to it, in the form of tests/<room>/tables/README.md.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/table/heading.h"
#include "ripstop/core/table/table.h"
#include "ripstop/core/table/text.h"

namespace ripstop::table {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::vector<fs::path> files_of(const char* kind) {
  std::vector<fs::path> files;
  for (const auto& room : fs::directory_iterator(fs::path(RIPSTOP_SOURCE_DIR) / "tests")) {
    const fs::path folder = room.path() / "tables" / kind;
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder))
      if (!entry.path().string().ends_with(".expect.json")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct Case {
  Json expected;
  Format format;
};

Case case_of(const fs::path& file) {
  Case given;
  given.expected = Json::parse(read_file(file.string() + ".expect.json"));
  const Json& e = given.expected;
  if (e.contains("wanted"))
    for (const std::string name : e["wanted"]) given.format.wanted.push_back(quantity_named(name).value());
  given.format.columns = parse_columns(e.value("columns_option", ""));
  given.format.decimal = parse_decimal(e.value("decimal", ""));
  return given;
}

void compare(const Column& column, const Json& expected, const std::string& what) {
  EXPECT_EQ(name_of(column.quantity), expected.at("quantity").get<std::string>()) << what;
  EXPECT_EQ(column.unit, expected.at("unit").get<std::string>()) << what;
  EXPECT_EQ(column.problem, "") << what;
  std::vector<double> values;
  double largest = 0;
  for (const double value : column.values)
    if (!std::isnan(value)) values.push_back(value), largest = std::max(largest, std::abs(value));
  EXPECT_EQ(values.size(), expected.value("count", values.size())) << what;
  ASSERT_FALSE(values.empty()) << what;
  const std::map<std::string, double> found{{"first", values.front()},
                                            {"last", values.back()},
                                            {"max", *std::max_element(values.begin(), values.end())}};
  for (const auto& [key, value] : found)
    EXPECT_NEAR(value, expected.value(key, value), 1e-9 * largest) << what << ", " << key;
}

TEST(TableFiles, GoodOnesAreReadAsTheyAre) {
  const std::vector<fs::path> files = files_of("good");
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    try {
      const auto [expected, format] = case_of(file);
      const Table table = read_table(file, format);
      EXPECT_EQ(table.specimens.size(), expected.value("specimens", 1u));
      std::vector<std::pair<std::size_t, const Column*>> columns;
      for (std::size_t k = 0; k < table.specimens.size(); ++k)
        for (const Column& column : table.specimens[k].columns) columns.emplace_back(k + 1, &column);
      const Json& wanted = expected.at("columns");
      std::size_t i = 0;
      for (const Json& one : wanted) {
        const std::size_t specimen = one.value("specimen", 1u);
        if (i >= columns.size()) break;
        EXPECT_EQ(columns[i].first, specimen) << one;
        compare(*columns[i++].second, one, one.dump());
      }
      EXPECT_EQ(columns.size(), wanted.size());
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

/// A command that needs these quantities, and its error.
std::string refusal(const fs::path& file) {
  try {
    const Format format = case_of(file).format;
    const Table table = read_table(file, format);
    for (const Specimen& specimen : table.specimens)
      for (const Quantity quantity : format.wanted) need_only(table, specimen, quantity);
  } catch (const Error& error) {
    EXPECT_TRUE(error.code() == ExitCode::bad_data || error.code() == ExitCode::usage) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

TEST(TableFiles, BadOnesAreRefusedWithPlaceAndRemedy) {
  const std::vector<fs::path> files = files_of("bad");
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    const std::string message = refusal(file);
    const Json expected = Json::parse(read_file(file.string() + ".expect.json"));
    for (const std::string text : expected.at("error_contains"))
      EXPECT_NE(message.find(text), std::string::npos) << message << "\nhas not: " << text;
  }
}

// Every line of a wrong separator is a heading that may have a unit at each of its blanks and commas.
TEST(Tables, AnHourOfALoadCellIsReadWithinSeconds) {
  std::string text = "Time (s),Load (N),Temperature (C),Event\n";
  for (int i = 0; i < 36000; ++i)
    text += fmt::format("{:.1f},{:.3f},21.{},\n", 0.1 * i, 100 + 0.01 * (i % 977), i % 10);
  const std::clock_t begin = std::clock();
  const table::Table read =
      table::parse_table(text, "hour.csv", {{table::Quantity::time, table::Quantity::force}, {}, {}});
  EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 4);
  ASSERT_EQ(read.specimens.size(), 1u);
  EXPECT_EQ(read.specimens[0].lines.size(), 36000u);
}

// The fast test before a heading is read: it must not exclude one.
TEST(Tables, AHeadingWithAMeaningMayHaveOne) {
  int headings = 0, excluded = 0;
  for (const char* kind : {"good", "bad"})
    for (const fs::path& file : files_of(kind)) {
      const std::string text = read_file(file);
      for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(",;|\t\n", begin), text.size());
        const std::string cell = text.substr(begin, end - begin);
        const bool known = !read_heading(cell).meanings.empty(), may_be = may_have_meaning(words_of(cell));
        EXPECT_TRUE(may_be || !known) << cell;
        headings += known, excluded += !may_be;
        begin = end + 1;
      }
    }
  EXPECT_GT(headings, 200);
  EXPECT_GT(excluded, 1000);
}

}  // namespace
}  // namespace ripstop::table
