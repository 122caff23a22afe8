// Tables in the forms of machines: accepted forms, and ambiguous forms that are refused.
#include "ripstop/core/table/table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../../refusal.h"
#include "ripstop/core/units.h"

namespace ripstop::table {
namespace {

using Q = Quantity;

Table read(const std::string& text, const Format& format = {}) {
  return parse_table(text, "t.csv", format);
}
std::string refused(const std::string& text, const Format& format = {}) {
  return refusal_of([&] { read(text, format); }, ExitCode::bad_data);
}
#define EXPECT_SAYS(message, text) EXPECT_NE((message).find(text), std::string::npos) << (message)

using Values = std::vector<double>;

/// The only column of a quantity in the first specimen.
const Column& column(const Table& table, Q quantity, std::size_t specimen = 0) {
  const std::vector<const Column*> found = table.specimens.at(specimen).all(quantity);
  if (found.size() != 1)
    throw std::runtime_error(fmt::format("{} columns of {}", found.size(), name_of(quantity)));
  return *found.front();
}
Values values(const std::string& text, Q quantity = Q::force, const Format& format = {}) {
  return column(read(text, format), quantity).values;
}

std::string utf16(const std::string& ascii, bool big, bool mark) {
  std::string bytes = !mark ? "" : big ? "\xfe\xff" : "\xff\xfe";
  for (const char c : ascii) bytes += big ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

TEST(TableText, AnyEncodingGivesTheSameTable) {
  const std::string text = "Force (N);Extension (mm)\r\n1,5;0,1\r\n2,5;0,2\r\n";
  for (const std::string& bytes :
       {text, "\xef\xbb\xbf" + text, utf16(text, false, true), utf16(text, true, true),
        utf16(text, false, false), utf16(text, true, false)}) {
    const Table table = read(bytes);
    EXPECT_EQ(column(table, Q::force).values, (Values{1.5, 2.5}));
    EXPECT_EQ(table.encoding, bytes.size() > 2 * text.size() - 1 ? "UTF-16" : "UTF-8");
  }
  const Table latin = read(
      "Pr\xfc"
      "fkraft [N]\tL\xe4ngen\xe4nderung [\xb5m]\n1\t2\n");
  EXPECT_EQ(latin.encoding, "Windows-1252");
  EXPECT_EQ(column(latin, Q::force).heading, "Prüfkraft [N]");
  EXPECT_NEAR(column(latin, Q::extension).values[0], 2e-6, 1e-18);
}

TEST(TableText, LineEndsMayBeOfAnySystem) {
  for (const char* end : {"\n", "\r\n", "\r"})
    EXPECT_EQ(values(fmt::format("Force (N),Time (s){0}1,2{0}3,4{0}", end)), (Values{1, 3}));
}

TEST(TableText, FilesThatAreNoTextAreRefused) {
  EXPECT_SAYS(refused(std::string("PK\x03\x04", 4) + "abc"), "save its sheet as CSV");
  EXPECT_SAYS(refused(std::string("Force (N),Time (s)\n1,\0\n", 22)),
              "line 2 has a character with the code 0");
  EXPECT_SAYS(refused("\xff\xfe"
                      "a"),
              "incomplete character");
  EXPECT_SAYS(refused(""), "empty");
  EXPECT_SAYS(refused("Force (N),Time (s)\n1,2\n3,4"), "t.csv:3: the last line has no line end");
  EXPECT_SAYS(refused("Force (N),Time (s)\n"), "t.csv:1: a header, but no measurements");
  EXPECT_SAYS(refused("Force (N),\"Time (s)\n1,2\n"), "t.csv:1: this quotation mark is not closed");
}

TEST(TableText, SeparatorsAreFoundByTheRowsTheyGive) {
  for (const char* separator : {"\t", ";", "|", ",", "  ", " "}) {
    const std::string text =
        fmt::format("Force (N){0}Extension (mm){0}Time (s)\n1.5{0}0.25{0}3\n2.5{0}0.5{0}4\n", separator);
    EXPECT_EQ(values(text), (Values{1.5, 2.5})) << separator;
    EXPECT_EQ(values(text, Q::time), (Values{3, 4})) << separator;
  }
  EXPECT_EQ(values("sep=;\nForce (N);Time (s)\n1,5;2\n"), (Values{1.5}));
  EXPECT_EQ(values("\"Force (N)\",\"Time (s)\"\n\"0,5\",\"0,1\"\n\"1,5\",\"0,2\"\n"), (Values{0.5, 1.5}));
  EXPECT_EQ(values("\"Force\n(N)\",Time (s)\n1,2\n"), (Values{1}));
  EXPECT_EQ(values("Crosshead position [mm]\tLoad [N]\n0.5\t1\n"), (Values{1}));
}

TEST(TableHeader, TextBeforeItIsIgnored) {
  const std::string text =
      "Test report;17;2\nSpeed;50;mm/min;Load cell;500;N\nOperator;Smith\n\nForce (N);Stroke (mm)\n1,5;2\n";
  EXPECT_EQ(values(text), (Values{1.5}));
  EXPECT_EQ(read(text).specimens[0].lines, (std::vector<int>{6}));
  EXPECT_EQ(read(text).specimens[0].header_line, 5);
}

TEST(TableHeader, MayBeAComment) {
  const Table table = read(
      "# Flight 3\n# Time (s),Altitude (ft),Vertical velocity (m/s)\n0.1,100,5\n# Event APOGEE\n0.2,200,6\n");
  EXPECT_NEAR(column(table, Q::altitude).values[1], 60.96, 1e-12);
  EXPECT_EQ(column(table, Q::speed).values, (Values{5, 6}));
  EXPECT_EQ(table.comments.size(), 3u);
}

TEST(TableHeader, EmptyAndSurplusColumnsAndTrailingSeparatorsAreLeftOut) {
  EXPECT_EQ(values("Force (N),,Remark,Time (s),\n1,,good,2,,\n,,,,\n3,,,4\n"), (Values{1, 3}));
  EXPECT_EQ(values("Force (N),Battery (V),Time (s)\n1,x,2\n"), (Values{1}));
}

TEST(TableHeader, NumbersWithoutAHeaderAreRefused) {
  EXPECT_SAYS(refused("1,2\n3,4\n"), "t.csv:1: numbers without a heading");
  EXPECT_SAYS(refused("A,B\n1,2\n3,4\n"),
              "t.csv:2: numbers without a heading of a known quantity above them (the line above");
}

TEST(TableUnits, CanBeInManyPlaces) {
  for (const char* heading :
       {"Force (kN)", "Force [kN]", "Force{kN}", "\"Force, kN\"", "Force / kN", "Force/kN", "force_kN",
        "Force kN", "Kraft in kN", "Load (Channel 1) [kN]", "F [kN]", "Standardkraft [kN]", "Charge (kN)",
        "Prüfkraft / kN", "Last [kN]", "Tension (kN)", "Effort (kN)"})
    EXPECT_EQ(values(fmt::format("{},Time (s)\n1.5,2\n", heading)), (Values{1500})) << heading;
  for (const char* units : {"kN,s", "(kN),(s)", "[kN],[s]"})
    EXPECT_EQ(values(fmt::format("Load,Time\n{}\n1.5,2\n", units)), (Values{1500})) << units;
}

TEST(TableUnits, DisagreementsAndUnknownOnesAreRefused) {
  EXPECT_SAYS(refused("Force [kN],Time (s)\nN,s\n1,2\n"), "t.csv:2: mixed units");
  EXPECT_SAYS(refused("Force [apples],Time (s)\n1,2\n"),
              "t.csv:1: \"apples\" in the heading \"Force [apples]\" is not a unit");
  EXPECT_SAYS(refused("Force,Time (s)\n1,2\n"), "t.csv:1: no unit for the column \"Force\"");
  EXPECT_SAYS(refused("Force (kg),Time (s)\n1,2\n"), "known: N, kN");
  EXPECT_EQ(values("Force (N),Time\n1,2\n", Q::time), (Values{2}));
}

TEST(TableUnits, EveryUnitOfThePageIsKnown) {
  const std::vector<std::tuple<const char*, const char*, double>> all{{"Force", "N", 1},
                                                                      {"Force", "kN", 1e3},
                                                                      {"Force", "cN", 0.01},
                                                                      {"Force", "lbf", 4.4482216152605},
                                                                      {"Force", "kgf", 9.80665},
                                                                      {"Force", "gf", 9.80665e-3},
                                                                      {"Force", "MN", 1e6},
                                                                      {"Force", "mN", 1e-3},
                                                                      {"Weg", "m", 1},
                                                                      {"Weg", "mm", 1e-3},
                                                                      {"Weg", "cm", 0.01},
                                                                      {"Weg", "in", 0.0254},
                                                                      {"Weg", "ft", 0.3048},
                                                                      {"Strain", "%", 0.01},
                                                                      {"Strain", "-", 1},
                                                                      {"Strain", "mm/mm", 1},
                                                                      {"Time", "s", 1},
                                                                      {"Time", "ms", 1e-3},
                                                                      {"Time", "min", 60},
                                                                      {"Speed", "m/s", 1},
                                                                      {"Speed", "ft/s", 0.3048},
                                                                      {"Speed", "km/h", 1 / 3.6},
                                                                      {"Speed", "mph", 0.44704},
                                                                      {"Acceleration", "m/s2", 1},
                                                                      {"Acceleration", "m/s²", 1},
                                                                      {"Acceleration", "m/s^2", 1},
                                                                      {"Acceleration", "g", 9.80665},
                                                                      {"Pressure", "Pa", 1},
                                                                      {"Pressure", "kPa", 1e3},
                                                                      {"Pressure", "hPa", 100},
                                                                      {"Pressure", "mbar", 100},
                                                                      {"Pressure", "psi", 6894.757293168},
                                                                      {"Pressure", "MPa", 1e6},
                                                                      {"Stress", "N/mm²", 1e6},
                                                                      {"Density", "kg/m³", 1},
                                                                      {"Density", "g/cm3", 1e3}};
  for (const auto& [heading, unit, factor] : all) {
    const Table table = read(fmt::format("{} ({}),Altitude (m)\n1.5,2\n", heading, unit));
    EXPECT_NEAR(table.specimens[0].columns.at(0).values.at(0), 1.5 * factor, 1e-12 * factor) << unit;
  }
  EXPECT_FALSE(find_unit(Dimension::force, "Mn"));  // mega or milli
  EXPECT_EQ(find_unit(Dimension::force, "LBS")->name, "lbf");
}

TEST(TableHeadings, AreKnownInSixLanguages) {
  const std::map<Q, std::pair<const char*, std::vector<const char*>>> all{
      {Q::force,
       {"N",
        {"Force", "Tensile load", "Prüfkraft", "Zugkraft", "Fuerza", "Forza", "Kracht", "Carga", "Carico",
         "Force de traction", "Trekkracht", "Belasting"}}},
      {Q::extension,
       {"mm",
        {"Extension", "Crosshead", "Traversenweg", "Verlängerung", "Verlaengerung", "Längenänderung",
         "Déplacement", "Allongement", "Verplaatsing", "Desplazamiento", "Alargamiento", "Spostamento",
         "Allungamento", "Corsa", "Dehnung"}}},
      {Q::strain,
       {"%",
        {"Strain", "Tensile strain (Displacement)", "Dehnung", "Déformation", "Rek", "Deformación",
         "Deformazione", "Elongation", "Allongement"}}},
      {Q::stress,
       {"MPa", {"Stress", "Zugspannung", "Contrainte", "Spanning", "Tensión", "Esfuerzo", "Sforzo"}}},
      {Q::time, {"s", {"Time", "Prüfzeit", "Temps", "Tijd", "Tiempo", "Tempo", "Elapsed time"}}},
      {Q::altitude,
       {"m",
        {"Altitude", "Height", "Höhe", "Hoehe", "Hauteur", "Hoogte", "Altura", "Quota",
         "Pressure altitude"}}},
      {Q::speed,
       {"m/s",
        {"Speed", "Velocity", "Geschwindigkeit", "Vitesse", "Snelheid", "Velocidad", "Velocità",
         "Vertical velocity"}}},
      {Q::acceleration,
       {"g",
        {"Acceleration", "Beschleunigung", "Accélération", "Versnelling", "Aceleración", "Accelerazione"}}},
      {Q::pressure, {"hPa", {"Pressure", "Luftdruck", "Pression", "Druk", "Presión", "Pressione"}}},
      {Q::drag,
       {"N", {"Drag", "Drag force", "Luftwiderstand", "Traînée", "Weerstand", "Resistencia", "Resistenza"}}},
      {Q::density,
       {"kg/m3",
        {"Density", "Luftdichte", "Densité", "Masse volumique", "Dichtheid", "Densidad", "Densità"}}}};
  for (const auto& [quantity, words] : all)
    for (const char* word : words.second) {
      const Heading heading = read_heading(fmt::format("{} [{}]", word, words.first));
      EXPECT_EQ(meaning_in(heading, heading.unit), quantity) << word;
    }
}

TEST(TableHeadings, OfOtherThingsAreLeftOut) {
  for (const char* heading :
       {"Strain rate (1/s)", "Drag coefficient (-)", "Drag area (m2)", "Load cell temperature (°C)",
        "Spannung [V]", "Force (V)", "Widerstand [Ohm]", "Pressure coefficient"}) {
    const Table table = read(fmt::format("Time (s),Altitude (m),{}\n1,2,3\n", heading));
    EXPECT_EQ(table.specimens[0].columns.size(), 2u) << heading;
  }
}

TEST(TableNumbers, DecimalCommasAndGroupsAreReadWhereTheyLeaveNoChoice) {
  const auto one = [](const char* number, const char* other = "0,5") {
    return values(fmt::format("Force (N);Extension (mm)\n{};{}\n", number, other)).at(0);
  };
  EXPECT_EQ(one("1,5"), 1.5);
  EXPECT_EQ(one("1.016,5"), 1016.5);
  EXPECT_EQ(one("1 016,5"), 1016.5);
  EXPECT_EQ(one("1\u00a0016,5"), 1016.5);
  EXPECT_EQ(one("1'016,5"), 1016.5);
  EXPECT_EQ(one("1\u2019016,5"), 1016.5);
  EXPECT_EQ(one("1.234.567"), 1234567);
  EXPECT_EQ(one("1.016"), 1016);  // the file has decimal commas
  EXPECT_EQ(one("1,016"), 1.016);
  EXPECT_EQ(one("\u22121,5E+02"), -150);
  EXPECT_EQ(one("+,5"), 0.5);
  EXPECT_EQ(one("1,016.5", "0.5"), 1016.5);
  EXPECT_EQ(one("1.016", "0.5"), 1.016);
  EXPECT_EQ(one("1013.250", "0.5"), 1013.25);
  EXPECT_EQ(one("5.", "0.5"), 5);
}

TEST(TableNumbers, ThousandsThatMayBeDecimalsAreRefused) {
  for (const char* other : {"1", "0,5", "0.5"}) {
    const std::string text =
        fmt::format("Extension (mm);Load (N)\n{0};985\n{0};998\n{0};1.016\n{0};1.905\n", other);
    const std::string message = refused(text);
    EXPECT_SAYS(message, "t.csv:4: \"1.016\" in the column \"Load (N)\" (number 2) may be a thousand");
    EXPECT_SAYS(message, "\"985\" (line 2)");
    EXPECT_SAYS(message, "--decimal");
  }
  const std::string text = "Extension (mm)\tLoad (N)\n1\t985\n2\t1.016\n3\t1.905\n";
  EXPECT_EQ(values(text, Q::force, {{}, {}, Decimal::comma}), (Values{985, 1016, 1905}));
  EXPECT_EQ(values(text, Q::force, {{}, {}, Decimal::point}), (Values{985, 1.016, 1.905}));
  EXPECT_SAYS(refused("Extension (mm);Load (N)\n1;1,016\n2;1,905\n"),
              "no other value of the file shows which");
  // A column that has decimals of other lengths leaves no choice.
  EXPECT_EQ(values("Extension (mm);Load (N)\n1;1\n2;1.016\n3;1.25\n"), (Values{1, 1.016, 1.25}));
}

TEST(TableNumbers, BrokenOnesAreRefusedWithTheirPlace) {
  for (const char* cell :
       {"x", "nan", "inf", "1.01.6", "12,34,567.8", "1e999", "1.5 N", "#VALUE!", "--", "1e"}) {
    const std::string message = refused(fmt::format("Force (N);Time (s)\n1.5;1\n{};2\n", cell));
    EXPECT_SAYS(message, fmt::format("t.csv:3: \"{}\" in the column \"Force (N)\" (number 1)", cell));
  }
  EXPECT_SAYS(refused("Force (N);Time (s)\n0.5;1\n1;0,5\n"),
              "t.csv:3: \"0,5\" in the column \"Time (s)\" (number 2) has a different decimal mark");
  EXPECT_SAYS(refused("Force (N),Time (s)\n1,2\n3\n"), "t.csv:3: 1 values for 2 columns");
  EXPECT_SAYS(refused("Force (N),Time (s)\n1,5,2\n"), "decimal commas need quotes");
  EXPECT_SAYS(refused("Force (N),Time (s)\n1,2\na,b\n3,4\n"), "t.csv:3: text between the numbers");
  EXPECT_EQ(values("Force (N),Time (s)\n1,2\nEnd of test\n"), (Values{1}));
}

TEST(TableTime, ClockTimesAreSecondsAfterTheFirst) {
  const auto times = [](const std::string& heading, const std::vector<std::string>& cells) {
    std::string text = "Altitude (m);" + heading + "\n";
    for (const std::string& cell : cells) text += "100;" + cell + "\n";
    const Table table = read(text);
    EXPECT_EQ(column(table, Q::time).unit, "clock");
    return column(table, Q::time).values;
  };
  EXPECT_EQ(times("Time", {"10:15:03", "10:15:03.5", "10:16:03"}), (Values{0, 0.5, 60}));
  EXPECT_EQ(times("Uhrzeit", {"23:59:59,5", "00:00:00,5"}), (Values{0, 1}));
  EXPECT_EQ(times("Time", {"1:02.5", "1:03.5"}), (Values{0, 1}));
  EXPECT_EQ(times("Time (hh:mm)", {"10:15", "11:16"}), (Values{0, 3660}));
  EXPECT_EQ(times("Time [mm:ss]", {"10:15", "11:16"}), (Values{0, 61}));
  EXPECT_EQ(times("Timestamp", {"2026-05-31T23:59:59Z", "2026-06-01T00:00:01Z"}), (Values{0, 2}));
  EXPECT_EQ(times("Date/Time", {"31.05.2026 23:59:59", "01.06.2026 00:00:01"}), (Values{0, 2}));
  EXPECT_EQ(times("Time", {"11:59:59 AM", "12:00:01 PM"}), (Values{0, 2}));
  const auto refusal = [&](const char* a, const char* b) {
    return refused(fmt::format("Altitude (m);Time\n1;{}\n2;{}\n", a, b));
  };
  EXPECT_SAYS(refusal("10:15", "10:16"), "t.csv:2: \"10:15\" in the column \"Time\" (number 2) may be hours");
  EXPECT_SAYS(refusal("05/03/2026 10:15:00", "05/04/2026 10:15:00"), "order of day and month is ambiguous");
  EXPECT_SAYS(refusal("10:15:01", "7"),
              "t.csv:3: \"7\" in the column \"Time\" (number 2) is not a clock time");
}

TEST(TableSpecimens, CanBeBelowEachOther) {
  const Table own = read(
      "Specimen 1\nForce (N);Stroke (mm)\n1,5;2\n2;3\n\nSpecimen 2\nWidth;25\nForce (kN);Stroke (mm)\n4;5\n");
  ASSERT_EQ(own.specimens.size(), 2u);
  EXPECT_EQ(own.specimens[1].name, "Specimen 2");
  EXPECT_EQ(column(own, Q::force, 0).values, (Values{1.5, 2}));
  EXPECT_EQ(column(own, Q::force, 1).values, (Values{4000}));
  const Table one = read("Kraft [N];Weg [mm]\nProbe 1\n1;2\n3;4\nProbe 2\n5;6\n");
  ASSERT_EQ(one.specimens.size(), 2u);
  EXPECT_EQ(one.specimens[0].name, "Probe 1");
  EXPECT_EQ(column(one, Q::force, 1).values, (Values{5}));
}

TEST(TableSpecimens, CanBeNextToEachOther) {
  const Table table = read("A;;B\nForce (N);Stroke (mm);Force (N);Stroke (mm)\n1;2;3;4\n5;6;7;8\n9;10\n");
  ASSERT_EQ(table.specimens.size(), 2u);
  EXPECT_EQ(table.specimens[1].name, "B");
  EXPECT_EQ(column(table, Q::force, 0).values, (Values{1, 5, 9}));
  EXPECT_EQ(column(table, Q::force, 1).values, (Values{3, 7}));
  const Table numbered =
      read("Time (s),Force 1 (N),Force 2 (N),Stroke 1 (mm),Stroke 2 (mm)\n0,1,2,3,4\n1,5,6,7,8\n");
  ASSERT_EQ(numbered.specimens.size(), 2u);
  EXPECT_EQ(column(numbered, Q::force, 1).values, (Values{2, 6}));
  EXPECT_EQ(column(numbered, Q::time, 1).values, (Values{0, 1}));
  // Two load cells of one specimen are two columns.
  EXPECT_EQ(read("Force 1 (N),Force 2 (N),Stroke (mm)\n1,2,3\n").specimens.size(), 1u);
  EXPECT_EQ(read("Stroke (mm),Stroke (in),Force (N),Force (lbf)\n1,2,3,4\n").specimens.size(), 1u);
  EXPECT_SAYS(refused("Force (N);Stroke (mm);Force (N);Stroke (mm)\n1;2;3;4\n5;6;7\n"),
              "t.csv:3: 3 values for 4 columns");
}

TEST(TableSpecimens, MayBeNamedInAColumn) {
  std::string text = "Specimen,Force (N),Stroke (mm)\n", counted = "Sample,Force (N),Stroke (mm)\n";
  for (int i = 0; i < 12; ++i) {
    text += fmt::format("{},{},{}\n", i < 5 ? "A" : "B", i, i);
    counted += fmt::format("{},{},{}\n", i + 1, i, i);
  }
  const Table table = read(text);
  ASSERT_EQ(table.specimens.size(), 2u);
  EXPECT_EQ(table.specimens[1].name, "B");
  EXPECT_EQ(column(table, Q::force, 1).values, (Values{5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(read(counted).specimens.size(), 1u);  // a counter of rows
}

TEST(TableColumns, AreThoseThatTheUserNames) {
  const std::string text = "Kanal 1,Kanal 2,Load (N),Load (Channel 2) [N]\n1,2,3,4\n";
  const auto choose = [&](const std::string& columns) {
    return values(text, Q::force, {{}, parse_columns(columns), Decimal::automatic});
  };
  EXPECT_EQ(choose("force=Kanal 1 [kN]"), (Values{1000}));
  EXPECT_EQ(choose("force=Kanal 1 [kN],extension=Kanal 2 [mm]"), (Values{1000}));
  EXPECT_EQ(choose("force=Load"), (Values{3}));
  EXPECT_EQ(choose("force=Load (Channel 2)"), (Values{4}));
  const auto refusal = [&](const std::string& columns) {
    return refused(text, {{}, parse_columns(columns), Decimal::automatic});
  };
  EXPECT_SAYS(refusal("force=Kraft [N]"),
              "t.csv:1: no column \"Kraft\", which is given for the force; the headings are");
  EXPECT_SAYS(refusal("force=Load [kN]"), "t.csv:1: mixed units");
  EXPECT_SAYS(refusal("force=Kanal 1"), "t.csv:1: no unit for the column \"Kanal 1\"");
  const std::vector<ColumnChoice> comma = parse_columns("force=Load, N,extension=Weg, gesamt [mm]");
  ASSERT_EQ(comma.size(), 2u);
  EXPECT_EQ(comma[0].heading, "Load, N");
  EXPECT_EQ(comma[1].heading, "Weg, gesamt");
  EXPECT_EQ(comma[1].unit, "mm");
  for (const char* wrong : {"force", "=Load", "kraft=Load", "force=", "force= [N]"})
    EXPECT_SAYS(refusal_of([&] { parse_columns(wrong); }, ExitCode::usage), "QUANTITY=HEADING") << wrong;
}

TEST(TableColumns, ThatAreNotWantedMayBeBroken) {
  const std::string text = "Force (N),Stroke (mm),Strain,Pressure (apples)\n1,2,x,y\n";
  const Table table = read(text, {{Q::force, Q::extension, Q::strain}, {}, Decimal::automatic});
  EXPECT_EQ(need_only(table, table.specimens[0], Q::force).values, (Values{1}));
  EXPECT_SAYS(refusal_of([&] { need_only(table, table.specimens[0], Q::strain); }, ExitCode::bad_data),
              "no unit");
  EXPECT_SAYS(refused(text), "no unit");
}

TEST(TableColumns, AreExplainedInOneLineEach) {
  const std::vector<std::string> lines = explanation(read("Kraft [kN];Weg [mm]\n1,5;2\n2,5;\n"));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "t.csv: column 1 \"Kraft [kN]\" is force in kN, 2 values from 1500 to 2500 N");
  EXPECT_EQ(lines[1],
            "t.csv: column 2 \"Weg [mm]\" is extension in mm, 1 values from 0.002 to 0.002 m, 1 cells empty");
}

}  // namespace
}  // namespace ripstop::table
