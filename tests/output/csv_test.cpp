#include "ripstop/output/csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

TEST(Csv, EveryDoubleComesBackBitForBit) {
  const TemporaryFolder folder("csv");
  using limits = std::numeric_limits<double>;
  CsvTable table{{"drag_n", "time_s"},
                 {{0.0, -0.0},
                  {limits::denorm_min(), -limits::denorm_min()},
                  {limits::min(), std::nextafter(limits::min(), 0)},
                  {limits::max(), limits::lowest()},
                  {limits::infinity(), -limits::infinity()},
                  {0.1, 1.0 / 3}}};
  std::mt19937_64 random(7);
  while (table.rows.size() < 5000) {
    const double a = std::bit_cast<double>(random()), b = std::bit_cast<double>(random());
    if (!std::isnan(a) && !std::isnan(b)) table.rows.push_back({a, b});
  }
  write_csv(folder.path / "t.csv", table);
  const CsvTable read = read_csv(folder.path / "t.csv");
  EXPECT_EQ(read.columns, table.columns);
  ASSERT_EQ(read.rows.size(), table.rows.size());
  for (std::size_t i = 0; i < read.rows.size(); ++i) {
    for (int k : {0, 1}) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(read.rows[i][k]),
                std::bit_cast<std::uint64_t>(table.rows[i][k]));
    }
  }
  write_csv(folder.path / "nan.csv", CsvTable{{"a"}, {{limits::quiet_NaN()}}});
  EXPECT_TRUE(std::isnan(read_csv(folder.path / "nan.csv").rows[0][0]));
}

TEST(Csv, AColumnThatIsThereTwiceAndATableCutInMidNumberAreRefused) {
  const TemporaryFolder folder("csv-cut");
  write_file(folder.path / "twice.csv", "speed_m_s,drag_n,speed_m_s\n1,2,3\n");
  EXPECT_THROW(read_csv(folder.path / "twice.csv"), Error);
  write_file(folder.path / "cut.csv", "speed_m_s,drag_n\n10,43.1\n20,15");  // of 152.3
  EXPECT_THROW(read_csv(folder.path / "cut.csv"), Error);
}

TEST(Csv, CommentsBlanksAndWindowsLineEndsAreRead) {
  const TemporaryFolder folder("csv-loose");
  write_file(folder.path / "t.csv",
             "# from a tunnel\r\nspeed_m_per_s, drag_n\r\n\r\n 10 ,43.1\r\n15,100.2\r\n");
  const CsvTable table = read_csv(folder.path / "t.csv");
  EXPECT_EQ(table.column("drag_n"), (std::vector<double>{43.1, 100.2}));
  EXPECT_THROW(table.column("drag"), Error);
}

TEST(Csv, AMistakeIsReportedWithFileAndLine) {
  const TemporaryFolder folder("csv-bad");
  for (const char* text :
       {"", "a,b\n1,2\n1,2,3\n", "a,b\n1,2\n1,x\n", "a,b\n1,2\n1,2 3\n", "a,b\n1,2\n1,\n"}) {
    write_file(folder.path / "t.csv", text);
    try {
      read_csv(folder.path / "t.csv");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(std::string(error.what()).find(*text ? "t.csv:3:" : "t.csv is empty"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_THROW(write_csv(folder.path / "u.csv", CsvTable{{"a,b"}, {}}), Error);
  EXPECT_THROW(write_csv(folder.path / "u.csv", {{"a"}, {{1, 2}}}), Error);
}

TEST(CsvLog, AKillAtAnyByteLosesNoCompleteRowAndNothingElse) {
  const TemporaryFolder folder("csv-log");
  const std::vector<std::string> columns = {"iteration", "drag_n"};
  const std::filesystem::path path = folder.path / "iterations.csv";
  {
    CsvLog log(path, columns);
    for (int i = 1; i <= 3; ++i) log.add({1.0 * i, 0.1 * i});
  }
  const std::string whole = read_file(path);
  for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
    write_file(path, whole.substr(0, cut));
    const auto complete_lines = std::count(whole.begin(), whole.begin() + static_cast<long>(cut), '\n');
    CsvLog log(path, columns);
    const std::size_t kept = read_csv(path).rows.size();
    EXPECT_EQ(kept, static_cast<std::size_t>(std::max(complete_lines - 1, 0L))) << cut;
    for (std::size_t i = kept + 1; i <= 3; ++i)
      log.add({1.0 * static_cast<double>(i), 0.1 * static_cast<double>(i)});
    EXPECT_EQ(read_file(path), whole) << cut;
  }
}

TEST(CsvLog, ARestartFromAnEarlierIterationDropsTheRowsAfterIt) {
  const TemporaryFolder folder("csv-restart");
  const std::filesystem::path path = folder.path / "iterations.csv";
  CsvLog first(path, {"iteration"});
  for (int i = 0; i < 5; ++i) first.add({1.0 * i});
  CsvLog second(path, {"iteration"}, 2);
  second.add({2});
  EXPECT_EQ(read_csv(path).column("iteration"), (std::vector<double>{0, 1, 2}));
  EXPECT_THROW(CsvLog(path, {"step"}), Error);  // another table is not overwritten
  EXPECT_EQ(read_csv(path).rows.size(), 3u);
}

}  // namespace
}  // namespace ripstop
