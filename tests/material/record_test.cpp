#include "ripstop/material/record.h"

#include <gtest/gtest.h>

#include <sstream>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/material/clean.h"
#include "synthetic.h"

namespace ripstop {
namespace {

struct Bench : ::testing::Test {
  TemporaryFolder folder{"record"};

  std::filesystem::path file(const std::string& text) {
    const std::filesystem::path path = folder.path / "r.csv";
    write_file(path, text);
    return path;
  }
  TensileRecord read(const std::string& text, const Coupon& given = {}, const RecordFormat& format = {}) {
    return read_record(file(text), given, format);
  }
  CleanRecord clean(const std::string& text) { return clean_record(read(text), LoadKind::per_width); }

  /// The refusal must name the file, this place and this reason.
  template <class Work>
  void refused(Work&& work, const std::string& place, const std::string& reason) {
    try {
      work();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(std::string(error.what()).find("r.csv" + place), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
      return;
    }
    ADD_FAILURE() << "not refused; expected: " << reason;
  }
};

const Coupon coupon{0.2, 0.05, 0};

std::string with_rows(const std::string& head, int rows, const std::function<std::string(int)>& row) {
  std::string text = head + "\n";
  for (int i = 0; i < rows; ++i) text += row(i) + "\n";
  return text;
}

std::string line(const std::string& head, double factor = 100, int rows = 40) {
  return with_rows(head, rows, [&](int i) { return fmt::format("{},{}", i, factor * i); });
}

TEST_F(Bench, ColumnsMayStandInAnyOrderAndUnit) {
  const TensileRecord a = read("extension [mm],force [N]\n1,10\n2,20\n", coupon);
  const TensileRecord b =
      read("Load (lbf);Time [s];Crosshead position (in)\n2,24809;0,1;0,0393701\n", coupon);
  const TensileRecord c = read("# comment\nForce_kN\tstrain_%\n0.01\t0.5\n", coupon);
  EXPECT_NEAR(a.displacement[1], 2e-3, 1e-15);
  EXPECT_NEAR(a.force[0], 10, 1e-12);
  EXPECT_NEAR(b.displacement[0], 1e-3, 1e-8);
  EXPECT_NEAR(b.force[0], 10, 1e-4);
  EXPECT_NEAR(b.time[0], 0.1, 1e-12);
  EXPECT_NEAR(c.displacement[0], 1e-3, 1e-12);
  EXPECT_NEAR(c.force[0], 10, 1e-12);
}

TEST_F(Bench, UnitsMayStandInALineOfTheirOwnOrInTheFileBeside) {
  const TensileRecord a = read("Extension,Load\n(mm),(kN)\n1,0.01\n", coupon);
  const TensileRecord b = read("x1,x2\n10,1\n", coupon, {"x1", "x2", "N", "mm"});
  EXPECT_NEAR(a.force[0], b.force[0], 1e-12);
  EXPECT_NEAR(a.displacement[0], b.displacement[0], 1e-15);
}

TEST_F(Bench, AHeadingIsFoundWithoutItsUnit) {
  const std::string text = "Load (N),Preload (N),Travel (mm),Way (mm)\n10,1,2,3\n";
  const TensileRecord named = read(text, coupon, {"Load", "Way", "", ""});
  EXPECT_EQ(named.force, (std::vector<double>{10}));
  EXPECT_NEAR(named.displacement[0], 3e-3, 1e-15);
  RecordFormat format;
  format.columns = table::parse_columns("force=Preload,extension=Way");
  EXPECT_EQ(read(text, coupon, format).force, (std::vector<double>{1}));
  format.force_column = "Load";  // of the record itself
  EXPECT_EQ(read(text, coupon, format).force, (std::vector<double>{10}));
  refused([&] { read(text, coupon, {"Kraft", "", "", ""}); }, ":1:", "no column \"Kraft\"");
}

TEST_F(Bench, AFileMayHoldSeveralSpecimens) {
  const std::string text =
      "# length: 200 mm\nForce (N);Stroke (mm);Force (N);Stroke (mm)\n1,5;2;3,5;4\n5;6\n";
  const std::vector<TensileRecord> records = read_records(file(text));
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].force, (std::vector<double>{1.5, 5}));
  EXPECT_EQ(records[1].force, (std::vector<double>{3.5}));
  EXPECT_EQ(records[1].name(), "r.csv (2)");
  ASSERT_EQ(records[0].understood.size(), 2u);
  EXPECT_NE(records[0].understood[1].find("\"Force (N)\" is force in N"), std::string::npos)
      << records[0].understood[1];
  refused([&] { read(text); }, ":3:", "2 specimens in one file");
}

TEST_F(Bench, AStrainIsOfTheCouponsLength) {
  EXPECT_NEAR(read("Load [N];Dehnung [%]\n1,5;2,5\n", coupon).displacement[0], 5e-3, 1e-15);
  // A strain without a unit is not needed where there is an extension.
  EXPECT_NEAR(read("Load [N];Tensile strain;Extension [mm]\n1,5;x;3\n", coupon).displacement[0], 3e-3, 1e-15);
}

TEST_F(Bench, ManyPointsAfterTheHighestForceAreDoubted) {
  for (const int after : {10, 40}) {
    std::string text = "# length: 1 m\nextension [mm],force [N]\n";
    for (int i = 0; i < 60; ++i) text += fmt::format("{},{}\n", i, 100.5 * i);
    for (int i = 0; i < after; ++i) text += fmt::format("{},{}\n", 60 + i, 300.5 - i);
    const CleanRecord record = clean_record(read(text), LoadKind::whole);
    EXPECT_EQ(record.late.empty(), after == 10) << record.late;
    EXPECT_EQ(record.late.find(" % of the points follow the highest force") == 2, after == 40);
  }
}

TEST_F(Bench, TheRecordsOwnCommentsDescribeTheCoupon) {
  const TensileRecord r =
      read("# length: 20 cm\n# width = 2 in\n# orientation: 45 deg\nforce_n,extension_mm\n1,1\n");
  EXPECT_NEAR(r.coupon.length, 0.2, 1e-15);
  EXPECT_NEAR(r.coupon.width, 0.0508, 1e-15);
  EXPECT_EQ(r.coupon.orientation, 45);
}

TEST_F(Bench, FilesThatCannotBeReadAreRefusedWithLineAndReason) {
  refused([&] { read("", coupon); }, "", "empty");
  refused([&] { read("extension [mm],force [N]\n", coupon); }, ":1:", "no measurements");
  refused([&] { read("extension [mm],force [N]\n1,2\n3,x\n", coupon); }, ":3:", "\"x\" in the column");
  refused([&] { read("extension [mm],force [N]\n1,2\n3\n", coupon); },
          ":3:", "check that the file is complete");
  refused([&] { read("extension [mm],force [N]\n1,nan\n", coupon); }, ":2:", "not a finite number");
  refused([&] { read("extension,force [N]\n1,2\n", coupon); }, ":1:", "no unit");
  refused([&] { read("extension [mm],force [apples]\n1,2\n", coupon); }, ":1:", "not a unit");
  refused([&] { read("extension [mm],pressure [Pa]\n1,2\n", coupon); }, ":1:", "no column for the force");
  refused([&] { read("extension [mm],force [N],load [N]\n1,2,2\n", coupon); }, ":1:", "two columns");
  refused([&] { read("# length: -200 mm\nextension [mm],force [N]\n1,2\n"); }, ":1:", "must be above 0");
  refused([&] { read("# length: 200 bananas\nextension [mm],force [N]\n1,2\n"); },
          ":1:", "a number and a unit");
  refused([&] { read("extension [mm],force [N]\n1,2\n"); }, "", "no coupon length");
  refused([&] { read("# length: 100 mm\nextension [mm],force [N]\n1,2\n", coupon); }, "",
          "the campaign file gives");
  refused([&] { read("extension [mm],force [N]\n1,2\n", coupon, {"", "", "kN", ""}); }, ":1:", "mixed units");
}

TEST_F(Bench, RecordsThatAreNotOnePullAreRefusedWithLineAndReason) {
  const std::string head = "# length: 200 mm\n# width: 50 mm\n# orientation: 0 deg\nextension [mm],force [N]";
  refused([&] { clean(line(head, 100, 8)); }, ":12:", "a curve needs");
  refused([&] { clean(with_rows(head, 40, [](int i) { return fmt::format("{},{}", i, 4000 - 100 * i); })); },
          ":5:", "only decreases");
  refused([&] { clean(line(head, -100)); }, ":5:", "change the sign");
  refused(
      [&] {
        clean(with_rows(head, 80, [](int i) { return fmt::format("{},{}", i < 40 ? i : 80 - i, 100 + i); }));
      },
      ":48:", "points decrease");
  refused(
      [&] {
        clean(with_rows(head, 60,
                        [](int i) { return fmt::format("{},{}", i, (i < 30 ? 0.1 : 100.0) * (i + 1)); }));
      },
      ":35:", "mixed units");
  refused(
      [&] { clean(line("# length: 200 m\n# width: 50 mm\n# orientation: 0 deg\nextension [mm],force [N]")); },
      ":44:", "factor of 1000");
  refused(
      [&] { clean(line("# length: 200 mm\n# width: 50 mm\n# orientation: 0 deg\nextension [m],force [N]")); },
      ":44:", "factor of 1000");
}

TEST_F(Bench, ReadsASyntheticRecordAsItIsMadeWithoutText) {
  SyntheticRecord wanted;
  wanted.load = [](double e) { return 30006 * e - 18936 * e * e; };
  for (const double width : {0.05, 0.0}) {
    wanted.width = width;
    std::mt19937 random(3), same(3);
    const TensileRecord made = synthetic_record(wanted, random);
    const TensileRecord read = parse_record(synthetic_csv(wanted, same), "s.csv");
    EXPECT_EQ(random, same);
    EXPECT_NEAR(read.coupon.length, made.coupon.length, 1e-15);
    EXPECT_NEAR(read.coupon.width, made.coupon.width, 1e-15);
    EXPECT_EQ(read.coupon.orientation, made.coupon.orientation);
    EXPECT_EQ(read.line, made.line);
    EXPECT_EQ(read.force, made.force);
    ASSERT_EQ(read.displacement.size(), made.displacement.size());
    for (std::size_t i = 0; i < read.displacement.size(); ++i)
      EXPECT_NEAR(read.displacement[i], made.displacement[i], 1e-15);
  }
}

TEST_F(Bench, SlackOffsetAndFailureAreCutAndSaid) {
  std::mt19937 random(3);
  SyntheticRecord wanted;
  wanted.load = [](double e) { return 30006 * e - 18936 * e * e; };
  wanted.scatter = wanted.failure_scatter = 0;
  wanted.noise = 0.002;
  wanted.offset = 7;
  wanted.slack = 0.004;
  wanted.points = 800;
  const CleanRecord record = clean(synthetic_csv(wanted, random));
  // The offset is a mean over few points whose errors hang together: a standard deviation of 0.55 N.
  EXPECT_NEAR(record.force_offset, 7, 1.6);
  EXPECT_GT(record.slack, 0.0015);
  EXPECT_LT(record.slack, 0.0065);
  EXPECT_NEAR(record.failure_strain, 0.33, 0.005);
  EXPECT_NEAR(record.failure_load, wanted.load(0.33), 0.01 * wanted.load(0.33));
  ASSERT_EQ(record.trimmed.size(), 3u);
  EXPECT_NE(record.trimmed[0].find("after the peak"), std::string::npos);
  EXPECT_NE(record.trimmed[1].find("offset"), std::string::npos);
  EXPECT_NE(record.trimmed[2].find("slack"), std::string::npos);
  // What is left is the curve from its true zero on.
  for (std::size_t i = 0; i < record.strain.size(); i += 50)
    EXPECT_NEAR(record.load[i], wanted.load(record.strain[i]), 0.02 * wanted.load(0.33));
}

// The level of five points before the pull is no load cell's offset: ten it takes.
TEST_F(Bench, AnOffsetIsReadOffTenPointsAtLeast) {
  for (const int idle : {6, 60}) {
    std::string text = "# length: 200 mm\n# width: 50 mm\n# orientation: 0 deg\nextension [mm],force [N]\n";
    for (int i = 0; i < 200; ++i) {
      const double pull = i < idle ? 0.0 : 5.0 * (i - idle);
      text += fmt::format("{:.4f},{:.4f}\n", 0.2 * i, 3 + pull);
    }
    text += fmt::format("{:.4f},1.0\n", 0.2 * 200);
    const CleanRecord record = clean(text);
    EXPECT_NEAR(record.force_offset, idle == 60 ? 3 : 0, 1e-9) << idle;
  }
}

TEST_F(Bench, AFewPointsOutOfOrderArePutInTheirPlace) {
  std::mt19937 random(5);
  SyntheticRecord wanted;
  wanted.load = [](double e) { return 20000 * e; };
  wanted.noise = 1e-4;
  std::string text = synthetic_csv(wanted, random), moved;
  std::vector<std::string> lines;
  for (std::istringstream stream(text); std::getline(stream, moved);) lines.push_back(moved);
  std::swap(lines[60], lines[90]);
  std::swap(lines[130], lines[120]);
  std::string shuffled;
  for (const std::string& l : lines) shuffled += l + "\n";
  const CleanRecord a = clean(text), b = clean(shuffled);
  EXPECT_EQ(a.strain, b.strain);
  EXPECT_EQ(a.load, b.load);
  EXPECT_NE(b.trimmed.front().find("points sorted"), std::string::npos);
}

TEST_F(Bench, ARecordThatWasCutOrHasSurplusValuesIsRefused) {
  const std::string whole = line("# length: 1 m\nextension [mm],force [N]", 100);
  EXPECT_EQ(read(whole).force.size(), 40u);
  refused([&] { read(whole.substr(0, whole.size() - 2)); }, ":42:", "may be incomplete");
  refused([&] { read("extension [mm],force [N]\n1,2\n3,4,5\n", coupon); }, ":3:", "3 values for 2 columns");
  EXPECT_EQ(read("extension [mm],force [N]\n1,2,\n", coupon).force.size(), 1u);  // an empty one is none
}

TEST_F(Bench, ARecordThatEndsBeforeTheBreakIsTold) {
  const std::string rising = line("# length: 1 m\nextension [mm],force [N]", 100);
  EXPECT_FALSE(clean_record(read(rising), LoadKind::whole).breaks);
  EXPECT_TRUE(clean_record(read(rising + "40,500\n41,100\n42,90\n"), LoadKind::whole).breaks);
}

TEST_F(Bench, ALineNeedsNoWidthAndClothDoes) {
  const std::string text = line("# length: 1 m\nextension [mm],force [N]", 100);
  EXPECT_NEAR(clean_record(read(text), LoadKind::whole).failure_load, 3700, 250);
  refused([&] { clean(text); }, "", "no coupon width");
}

}  // namespace
}  // namespace ripstop
