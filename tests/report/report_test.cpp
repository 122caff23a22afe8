// The page as text: packed data read back, no text of a case becomes part of the page, and it remains small.
#include "ripstop/report/report.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

#include "ripstop/report/assets.h"
#include "ripstop/report/encode.h"

namespace ripstop {
namespace {

using nlohmann::json;

std::string from_base64(const std::string& text) {
  std::string bytes;
  unsigned group = 0;
  int bits = 0;
  for (char c : text) {
    if (c == '=') break;
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    group = group << 6 | static_cast<unsigned>(letters.find(c));
    if ((bits += 6) >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 255);
  }
  return bytes;
}

std::vector<std::uint32_t> unpacked(const std::string& text, std::size_t count, std::size_t components,
                                    int bytes) {
  std::string planes(count * static_cast<std::size_t>(bytes), '\0');
  uLongf size = planes.size();
  const std::string packed = from_base64(text);
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(planes.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  std::vector<std::uint32_t> values(count, 0);
  const std::uint32_t mask = bytes == 2 ? 0xffff : 0xffffffff;
  for (std::size_t i = 0; i < count; ++i) {
    for (int b = 0; b < bytes; ++b)
      values[i] |= static_cast<std::uint32_t>(static_cast<unsigned char>(planes[b * count + i])) << (8 * b);
    if (i >= components) values[i] = (values[i] + values[i - components]) & mask;
  }
  return values;
}

TEST(Encode, Base64IsThatOfItsSpecification) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Encode, WholeNumbersComeBack) {
  const std::vector<std::uint32_t> values = {5, 0, 65535, 3, 1, 65534, 40000, 7};
  for (int bytes : {2, 4})
    for (int components : {1, 2, 4})
      EXPECT_EQ(unpacked(pack_integers(values, components, bytes), 8, components, bytes), values);
  const std::vector<std::uint32_t> large = {4'000'000'000, 1, 70000};
  EXPECT_EQ(unpacked(pack_integers(large, 1, 4), 3, 1, 4), large);
}

TEST(Encode, ValuesReturnWithinHalfAStepAndMissingOnesRemainMissing) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> values = {1.5, -20, none, 300, 2.25, 7, 2.25, none};
  const Quantised q = quantise(values, 2, 1000);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]))
      EXPECT_EQ(q.values[i], no_number);
    else
      EXPECT_NEAR(q.low[i % 2] + q.step[i % 2] * q.values[i], values[i], 0.5001 * q.step[i % 2]);
  }
  const Quantised same = quantise({4, 4, 4}, 1);
  EXPECT_EQ(same.low[0] + same.step[0] * same.values[1], 4);
}

ReportRun hostile_run() {
  const std::string text = "</script><script>document.title='taken'</script><!--<script>\xff\"'&";
  ReportRun run;
  run.kind = "steady";
  run.name = run.title = text;
  run.values = {{"title", json(text.substr(0, 50)).dump()},
                {"max_von_mises_on", json(text.substr(0, 50)).dump()}};
  run.warnings = {text};
  run.case_file = text;
  run.provenance = {{text, text}};
  run.tables = {{"ledger", text, text, {{text, text}}, {{text}}}};
  run.plots = {{"p", text, {text, text}, {text, text}, {{text, {1, 2}, {1, 2}, true, false}}, false, false}};
  return run;
}

/// Elements of the page, as a browser's parser finds the ends of scripts.
std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(ReportPage, NoTextOfACaseBecomesAScriptOrEndsOne) {
  Report report;
  report.runs = {hostile_run()};
  report.title = report.runs[0].title;
  const std::string page = report_page(report);
  Report plain;
  plain.runs = {ReportRun{}};
  EXPECT_EQ(count(page, "</script"), count(report_page(plain), "</script"));
  EXPECT_EQ(count(page, "</script"), report_scripts().size() + 1);
  EXPECT_EQ(count(page, "<!--<script"), 0u);
  EXPECT_EQ(count(page, "<title>&lt;/script&gt;"), 1u);
}

TEST(ReportPage, MakesNoRequestToANetwork) {
  const std::string page =
      report_page({.title = "t", .runs = {hostile_run()}, .comparison = {}, .plots = {}});
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  const std::regex loads(R"((src|href)\s*=\s*["']?(https?:)?//)");
  for (const Asset& asset : report_styles())
    EXPECT_EQ(asset.text.find("url("), std::string_view::npos) << asset.name;
  EXPECT_FALSE(std::regex_search(std::string(report_skeleton()), loads));
  EXPECT_TRUE(is_report(page));
  EXPECT_FALSE(is_report("<!doctype html><html></html>"));
}

/// Half a sphere of `rows` x `columns` cells, breathing over `frames`; every value is noise, which packs worst.
ShapeView dome(int rows, int columns, int frames) {
  ShapeView view;
  view.part_names = {"line"};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const int next = (j + 1) % columns, a = i * columns;
      for (int node : {a + j, a + next, a + columns + next, a + columns + j}) view.quads.push_back(node);
    }
  const int nodes = (rows + 1) * columns;
  for (int j = 0; j < 24; ++j) {
    view.segments.insert(view.segments.end(), {rows * columns + j * columns / 24, nodes});
    view.parts.push_back(0);
  }
  unsigned noise = 1;
  const auto random = [&] { return (noise = noise * 1664525u + 1013904223u) / 4294967296.0; };
  for (int f = 0; f < frames; ++f) {
    ShapeFrame frame;
    frame.time = 0.01 * f;
    const double radius = 1 + 0.2 * std::sin(0.3 * f);
    for (int i = 0; i <= rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const double polar = 1.57 * (i + 1) / (rows + 1), angle = 6.2831853 * j / columns;
        frame.points.insert(frame.points.end(), {radius * std::sin(polar) * std::cos(angle) + 1e-4 * random(),
                                                 radius * std::sin(polar) * std::sin(angle) + 1e-4 * random(),
                                                 radius * std::cos(polar) + 1e-4 * random()});
      }
    frame.points.insert(frame.points.end(), {0, 0, -2});
    for (const char* key : {"von_mises_n_per_m", "strain_max"}) {
      frame.cells.push_back({key, {}});
      for (int cell = 0; cell < rows * columns; ++cell) frame.cells.back().values.push_back(1000 * random());
    }
    frame.line_values.assign(24, 10 + f);
    view.frames.push_back(frame);
  }
  return view;
}

json data_of(const Report& report) {
  const std::string page = report_page(report), begin = "id=\"report-data\">";
  const std::size_t at = page.find(begin) + begin.size();
  return json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST(ReportPage, HasTheProvenanceOfEveryRun) {
  Report report;
  report.runs.resize(2);
  report.runs[0].provenance = {{"version", "1.2"}, {"threads", "3"}};
  const json runs = data_of(report).at("runs");
  EXPECT_EQ(runs.at(0).at("provenance"), json::parse(R"([["version", "1.2"], ["threads", "3"]])"));
  EXPECT_TRUE(runs.at(1).at("provenance").empty());
}

TEST(ReportPage, HasTablesAndPlotsWithTheirWordsUnitsAndNumbers) {
  const ReportTable table{"ledger", "Ledger", "a note", {{"member", ""}, {"load", "N"}}, {{"line", "1.5"}}};
  ReportPlot plot;
  plot.id = "drag", plot.title = "Drag", plot.x = {"speed", "m/s"}, plot.y = {"drag", "N"};
  plot.series = {{"computed", {1, 2}, {1.0 / 3, NAN}, false, true}};
  plot.logarithmic = true;
  Report report;
  report.runs.resize(2);
  report.runs[0].tables = {table};
  report.runs[0].plots = {plot};
  report.comparison = table;
  plot.logarithmic = false, plot.over_time = true;
  report.plots = {plot};
  const json page = data_of(report);
  const json of_table = json::parse(R"({"id": "ledger", "title": "Ledger", "note": "a note",
      "columns": [{"text": "member", "unit": ""}, {"text": "load", "unit": "N"}], "rows": [["line", "1.5"]]})");
  json of_plot = json::parse(R"({"id": "drag", "title": "Drag", "x": {"text": "speed", "unit": "m/s"},
      "y": {"text": "drag", "unit": "N"}, "logarithmic": true, "overTime": false,
      "series": [{"name": "computed", "x": [1, 2], "y": [0.333333, null], "line": false, "dashed": true}]})");
  EXPECT_EQ(page.at("runs")[0].at("tables"), json::array({of_table}));
  EXPECT_EQ(page.at("runs")[0].at("plots"), json::array({of_plot}));
  EXPECT_EQ(page.at("comparison"), of_table);
  of_plot["logarithmic"] = false, of_plot["overTime"] = true;
  EXPECT_EQ(page.at("plots"), json::array({of_plot}));
}

TEST(ReportPage, HasTheStreamlinesByTheirPointsWithTheSpeedAtEach) {
  Report report;
  report.runs.resize(1);
  FlowView& flow = report.runs[0].flow;
  flow.pressure = {1, 2}, flow.speed = {3, 4};
  flow.streamlines = {0.1, -2, 30, 0.2, -1, 20, 0.3, 4, 25, 0.4, 5, 40};
  flow.lengths = {3, 1};
  flow.streamline_speed = {10, 12, 11, 9};
  const json page = data_of(report).at("runs")[0].at("flow");
  const auto values = [&](const char* key, std::size_t components) {
    const json& packed = page.at(key);
    EXPECT_EQ(packed.at("components"), components) << key;
    const std::size_t count = packed.at("n");
    std::vector<double> found;
    for (const std::uint32_t step : unpacked(packed.at("data"), count, components, packed.at("bytes"))) {
      const std::size_t k = found.size() % components;
      found.push_back(packed.at("low")[k].get<double>() + packed.at("step")[k].get<double>() * step);
    }
    return found;
  };
  const std::vector<double> points = values("streamlines", 3), speed = values("streamlineSpeed", 1);
  ASSERT_EQ(points.size(), flow.streamlines.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double span = i % 3 == 0 ? 0.3 : i % 3 == 1 ? 7 : 20;
    EXPECT_NEAR(points[i], flow.streamlines[i], 1e-4 * span) << i;
  }
  ASSERT_EQ(speed.size(), 4u);
  EXPECT_NEAR(speed[1], 12, 0.01);
  EXPECT_EQ(page.at("lengths").at("n"), 2);
}

TEST(ReportPage, HasEveryFrameOfASmallOpeningInItsOrder) {
  Report report;
  report.runs.resize(1);
  report.runs[0].kind = "opening";
  report.runs[0].shape = dome(4, 8, 5);
  std::vector<int>& parts = report.runs[0].shape.parts;
  report.runs[0].shape.part_names = {"line", "riser"};
  parts[3] = parts[7] = 1;
  const json data = data_of(report);
  const json& shape = data.at("runs")[0].at("shape");
  EXPECT_EQ(shape.at("parts").at("components"), 1);
  const std::vector<std::uint32_t> named = unpacked(shape.at("parts").at("data"), parts.size(), 1, 4);
  EXPECT_EQ(std::vector<int>(named.begin(), named.end()), parts);
  EXPECT_EQ(shape.at("framesComputed"), 5);
  std::vector<double> times;
  for (const json& frame : shape.at("frames")) {
    times.push_back(frame.at("time"));
    EXPECT_EQ(frame.at("tension").at("n"), parts.size());
    EXPECT_EQ(frame.at("cells").size(), report.runs[0].shape.frames[0].cells.size());
  }
  EXPECT_EQ(times, (std::vector<double>{0, 0.01, 0.02, 0.03, 0.04}));
}

// Also used for the time measurement of the browser test: RIPSTOP_DOME is the name of the file.
TEST(ReportPage, WithFiftyThousandMovingNodesIsAtMostTenMegabytes) {
  Report report;
  report.title = "dome";
  report.runs.resize(1);
  report.runs[0].kind = "opening";
  report.runs[0].name = report.runs[0].title = "dome";
  report.runs[0].shape = dome(199, 250, 30);
  ASSERT_GE(report.runs[0].shape.frames[0].points.size() / 3, 50000u);
  const std::string page = report_page(report);
  EXPECT_LE(page.size(), largest_page);
  if (const char* file = std::getenv("RIPSTOP_DOME")) std::ofstream(file) << page;
}

}  // namespace
}  // namespace ripstop
