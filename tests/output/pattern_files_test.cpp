// The files of a pattern, read back: their outlines are those of the piece, in millimetres.
#include "ripstop/output/pattern_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <regex>
#include <sstream>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

const Piece triangle{"gore", 8, {{-0.2, 0}, {0.2, 0}, {0, 0.5}}, {Edge::hem, Edge::seam, Edge::seam}};

/// Vertices of the polylines of a DXF file, by layer. Every line pair is a group code and its value.
std::map<std::string, std::vector<Point2>> dxf_outlines(const std::string& text) {
  std::map<std::string, std::vector<Point2>> outlines;
  std::istringstream stream(text);
  std::string code, value, entity, layer;
  while (std::getline(stream, code) && std::getline(stream, value)) {
    if (code == "0") entity = value;
    if (code == "8") layer = value;
    if (entity == "VERTEX" && code == "10") outlines[layer].push_back({std::stod(value), 0});
    if (entity == "VERTEX" && code == "20") outlines[layer].back().y = std::stod(value);
  }
  EXPECT_EQ(entity, "EOF");
  return outlines;
}

TEST(PatternFiles, TheDxfHoldsTheFinishedAndTheCutOutlineInMillimetres) {
  const TemporaryFolder folder("pattern");
  const Allowances allowances{.seam = 0.01, .hem = 0.02};
  write_pattern_dxf(folder.path / "gore.dxf", triangle, allowances);
  const auto outlines = dxf_outlines(read_file(folder.path / "gore.dxf"));
  ASSERT_EQ(outlines.at("SEAM").size(), 3u);
  EXPECT_NEAR(polygon_area(outlines.at("SEAM")), 0.4 * 0.5 / 2 * 1e6, 1);
  EXPECT_NEAR(polygon_area(outlines.at("CUT")), polygon_area(with_allowance(triangle, allowances)) * 1e6, 1);
  EXPECT_NEAR(outlines.at("CUT")[0].y, -20, 1e-3);
}

/// Values of the header's variables by name.
std::map<std::string, std::string> dxf_header(const std::string& text) {
  std::map<std::string, std::string> values;
  std::istringstream stream(text);
  std::string code, value, name;
  while (std::getline(stream, code) && std::getline(stream, value) && value != "ENDSEC") {
    if (code == "9") name = value;
    if (code == "70") values[name] = value;
  }
  return values;
}

TEST(PatternFiles, DxfStatesItsUnitAndItsCoordinatesHaveIt) {
  const TemporaryFolder folder("pattern");
  struct Expected {
    DxfUnit unit;
    const char *measurement, *units;
    double metre;
  };
  for (const auto& [unit, measurement, units, metre] :
       {Expected{DxfUnit::millimetres, "1", "4", 1000}, Expected{DxfUnit::inches, "0", "1", 1 / 0.0254}}) {
    write_pattern_dxf(folder.path / "gore.dxf", triangle, {.seam = 0, .hem = 0}, unit);
    const std::string text = read_file(folder.path / "gore.dxf");
    auto header = dxf_header(text);
    EXPECT_EQ(header["$MEASUREMENT"], measurement);
    EXPECT_EQ(header["$INSUNITS"], units);
    const auto outlines = dxf_outlines(text);
    for (std::size_t i = 0; i < triangle.outline.size(); ++i) {
      EXPECT_NEAR(outlines.at("SEAM")[i].x, triangle.outline[i].x * metre, 1e-4);
      EXPECT_NEAR(outlines.at("SEAM")[i].y, triangle.outline[i].y * metre, 1e-4);
    }
    const Point2 tail = outlines.at("GRAIN")[0], tip = outlines.at("GRAIN")[1];
    EXPECT_NEAR(std::hypot(tip.x - tail.x, tip.y - tail.y), 0.4 * metre, 0.1 * metre);
  }
}

TEST(PatternFiles, TheGrainArrowPointsAlongTheWarpAndStaysOnThePiecesBox) {
  const TemporaryFolder folder("pattern");
  for (const double degrees : {0.0, 45.0, 90.0}) {
    Piece piece = triangle;
    piece.grain = degrees;
    write_pattern_dxf(folder.path / "gore.dxf", piece, {.seam = 0, .hem = 0});
    const auto outlines = dxf_outlines(read_file(folder.path / "gore.dxf"));
    const std::vector<Point2>& arrow = outlines.at("GRAIN");  // tail, tip; then barb, tip, barb
    ASSERT_EQ(arrow.size(), 5u);
    const double dx = arrow[1].x - arrow[0].x, dy = arrow[1].y - arrow[0].y;
    EXPECT_NEAR(std::atan2(dx, dy) * 180 / std::numbers::pi, degrees, 1e-3);
    EXPECT_GT(std::hypot(dx, dy), 250);
    for (const Point2& p : arrow) {
      EXPECT_LE(std::abs(p.x), 200);
      EXPECT_GE(p.y, 0);
      EXPECT_LE(p.y, 500);
    }
    // Both barbs lie behind the tip, equally far from the shaft.
    const auto beside = [&](Point2 p) {
      return ((p.x - arrow[1].x) * dy - (p.y - arrow[1].y) * dx) / std::hypot(dx, dy);
    };
    EXPECT_NEAR(beside(arrow[2]), -beside(arrow[4]), 1e-3);
    EXPECT_GT(std::abs(beside(arrow[2])), 1);
    EXPECT_LT((arrow[2].x - arrow[1].x) * dx + (arrow[2].y - arrow[1].y) * dy, 0);
  }
}

TEST(PatternFiles, TheSvgPrintsAtTrueSize) {
  const TemporaryFolder folder("pattern");
  write_pattern_svg(folder.path / "gore.svg", triangle, {.seam = 0, .hem = 0});
  const std::string text = read_file(folder.path / "gore.svg");
  EXPECT_NE(text.find("<polyline"), std::string::npos);  // the grain's arrow
  std::smatch size;
  ASSERT_TRUE(std::regex_search(
      text, size,
      std::regex(R"x(width="([0-9.]+)mm" height="([0-9.]+)mm" viewBox="0 0 ([0-9.]+) ([0-9.]+)")x")));
  EXPECT_EQ(size[1], size[3]);  // one unit is one millimetre
  EXPECT_EQ(size[2], size[4]);
  std::smatch points;
  ASSERT_TRUE(std::regex_search(text, points, std::regex(R"x(points="([0-9., -]+)")x")));
  std::istringstream stream(points[1]);
  std::vector<Point2> outline;
  Point2 p;
  char comma = 0;
  while (stream >> p.x >> comma >> p.y) outline.push_back(p);
  EXPECT_NEAR(std::abs(polygon_area(outline)), 1e5, 1);
}

TEST(PatternFiles, TheSvgHasTheCutAndTheFinishedOutlineWithPaperAllRound) {
  const TemporaryFolder folder("pattern");
  write_pattern_svg(folder.path / "gore.svg", triangle, {.seam = 0.01, .hem = 0.02});
  const std::string text = read_file(folder.path / "gore.svg");
  std::smatch size;
  ASSERT_TRUE(std::regex_search(text, size, std::regex(R"x(width="([0-9.]+)mm" height="([0-9.]+)mm")x")));
  const double width = std::stod(size[1]), height = std::stod(size[2]);
  const std::regex polygon(R"x(<polygon points="([0-9., -]+)")x");
  std::vector<double> areas;
  double left = width, right = 0, top = height, bottom = 0;
  for (std::sregex_iterator found(text.begin(), text.end(), polygon), end; found != end; ++found) {
    std::istringstream stream((*found)[1]);
    std::vector<Point2> outline;
    char comma = 0;
    for (Point2 p; stream >> p.x >> comma >> p.y;) {
      outline.push_back(p);
      left = std::min(left, p.x), right = std::max(right, p.x);
      top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    }
    areas.push_back(std::abs(polygon_area(outline)));
  }
  ASSERT_EQ(areas.size(), 2u);
  EXPECT_NEAR(areas[1], 1e5, 1);
  EXPECT_GT(areas[0], 1.05 * areas[1]);
  for (const double edge : {left, width - right, top}) EXPECT_NEAR(edge, 10, 1e-3);
  EXPECT_GE(height - bottom, 10);  // the bar and the name are there
}

TEST(PatternFiles, DxfHasFoldsNotchesLinesAndATitleBlockOnLayersOfTheirOwn) {
  const TemporaryFolder folder("pattern");
  Piece piece = triangle;
  piece.edge_names = {"skirt", "", ""};
  piece.marks = {{{-0.2, 0}, "line"}, {{0.2, 0}, "line"}};
  const PatternHead head{"Canop\xc3\xa9", "case.toml", "2026-01-31"};
  write_pattern_dxf(folder.path / "gore.dxf", piece, {.seam = 0.01, .hem = 0.02}, DxfUnit::millimetres, head);
  const std::string text = read_file(folder.path / "gore.dxf");
  const auto outlines = dxf_outlines(text);
  ASSERT_EQ(outlines.at("FOLD").size(), 2u);  // the hem
  EXPECT_NEAR(outlines.at("FOLD")[1].x - outlines.at("FOLD")[0].x, 400, 1e-3);
  EXPECT_NEAR(outlines.at("FOLD")[0].y, 0, 1e-6);
  // Sides of 0.539 m are cut into two parts by a notch each: from 10 mm outside the seam, 5 mm deep.
  const std::vector<Point2>& notch = outlines.at("NOTCH");
  ASSERT_EQ(notch.size(), 4u);
  for (int side : {0, 1}) {
    const Point2 from = notch[2 * side], to = notch[2 * side + 1];
    EXPECT_NEAR(std::hypot(to.x - from.x, to.y - from.y), 5, 1e-3);
    EXPECT_NEAR(from.y - 10 * 0.2 / std::hypot(0.2, 0.5), 250, 1e-3);
  }
  EXPECT_NEAR(notch[0].x, -notch[2].x, 1e-3) << "notches of both sides meet";
  ASSERT_EQ(outlines.at("LINES").size(), 8u);  // two crosses
  EXPECT_NEAR(0.5 * (outlines.at("LINES")[0].x + outlines.at("LINES")[1].x), -200, 1e-3);
  for (const char* wanted : {"gore, cut 8, warp along arrow", "Canop??", "case.toml, 2026-01-31, Ripstop",
                             "seam 10 mm, hem 20 mm", "skirt, fold", "\nseam\n"})
    EXPECT_NE(text.find(wanted), std::string::npos) << wanted;
  for (const char c : text) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << int(c);
}

TEST(PatternFiles, SvgTextIsEscaped) {
  const TemporaryFolder folder("pattern");
  write_pattern_svg(folder.path / "gore.svg", triangle, {}, {"<b> & co", "", ""});
  EXPECT_NE(read_file(folder.path / "gore.svg").find("&lt;b&gt; &amp; co"), std::string::npos);
}

/// Sizes of the pages of a PDF [pt].
std::vector<std::pair<double, double>> pdf_pages(const std::string& text) {
  std::vector<std::pair<double, double>> pages;
  const std::regex box(R"x(/MediaBox \[ 0 0 ([0-9.]+) ([0-9.]+) \])x");
  for (std::sregex_iterator found(text.begin(), text.end(), box), end; found != end; ++found)
    pages.emplace_back(std::stod((*found)[1]), std::stod((*found)[2]));
  return pages;
}

TEST(PatternFiles, PdfHasAnOverviewAndTheSheetsThatALineCrosses) {
  const TemporaryFolder folder("pattern");
  const Piece square{
      "square", 1, {{0, 0}, {0.9, 0}, {0.9, 0.9}, {0, 0.9}}, {Edge::hem, Edge::hem, Edge::hem, Edge::hem}};
  // 0.94 m on windows of 190 x 277 mm: 5 columns, 4 rows; the middle ones hold the arrow in the third column only.
  write_pattern_pdf(folder.path / "square.pdf", square, {.seam = 0, .hem = 0.02}, Paper::a4);
  const auto pages = pdf_pages(read_file(folder.path / "square.pdf"));
  EXPECT_EQ(pages.size(), 1u + 14u + 2u);
  for (const auto& [width, height] : pages) {
    EXPECT_NEAR(width, 210 / 25.4 * 72, 0.01);
    EXPECT_NEAR(height, 297 / 25.4 * 72, 0.01);
  }
  write_pattern_pdf(folder.path / "letter.pdf", triangle, {}, Paper::letter);
  EXPECT_NEAR(pdf_pages(read_file(folder.path / "letter.pdf")).at(0).first, 612, 0.01);
  Piece huge = square;
  for (Point2& p : huge.outline) p.x *= 30, p.y *= 30;
  EXPECT_THROW(write_pattern_pdf(folder.path / "huge.pdf", huge, {}, Paper::a4), Error);
}

}  // namespace
}  // namespace ripstop
