#include "ripstop/output/pattern_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "ripstop/core/file.h"
#include "ripstop/core/markup.h"
#include "ripstop/core/units.h"
#include "ripstop/output/piece_drawing.h"

namespace ripstop::inline output {
namespace {

constexpr double mm = 1000;

// DXF: lines of a group code and its value. Codes 10, 20, 30: a point; 8: the layer; 70: flags, 1 is closed.
/// `scale`: units per metre.
std::string dxf_polyline(const PieceStroke& stroke, double scale) {
  const char* layer = piece_layers[static_cast<int>(stroke.layer)];
  std::string text = fmt::format("0\nPOLYLINE\n8\n{}\n66\n1\n70\n{}\n10\n0.0\n20\n0.0\n30\n0.0\n", layer,
                                 stroke.closed ? 1 : 0);
  for (const Point2& p : stroke.points)
    text +=
        fmt::format("0\nVERTEX\n8\n{}\n10\n{:.4f}\n20\n{:.4f}\n30\n0.0\n", layer, p.x * scale, p.y * scale);
  return text + fmt::format("0\nSEQEND\n8\n{}\n", layer);
}

/// A value on one line of characters that AC1009 supports.
std::string dxf_text(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

/// Stroke of an SVG, by layer: colour, width and dashes.
constexpr const char* svg_styles[] = {"stroke=\"#c0392b\" stroke-width=\"0.5\"",
                                      "stroke=\"#2c3e50\" stroke-width=\"0.3\" stroke-dasharray=\"3 2\"",
                                      "stroke=\"#2980b9\" stroke-width=\"0.3\" stroke-dasharray=\"6 2 1 2\"",
                                      "stroke=\"#c0392b\" stroke-width=\"0.5\"",
                                      "stroke=\"#8e44ad\" stroke-width=\"0.5\"",
                                      "stroke=\"#7f8c8d\" stroke-width=\"0.3\""};

}  // namespace

void write_pattern_dxf(const std::filesystem::path& path, const Piece& piece, const Allowances& allowances,
                       DxfUnit unit, const PatternHead& head) {
  const bool metric = unit == DxfUnit::millimetres;
  const double scale = metric ? mm : 1 / inch;
  const PieceDrawing drawing = drawing_of(piece, allowances, head);
  const PieceBox& box = drawing.box;
  std::string text = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n";
  // $MEASUREMENT: 0 inches, 1 millimetres; $INSUNITS: 1 inches, 4 millimetres. Readers without them guess the unit.
  text += fmt::format("9\n$MEASUREMENT\n70\n{}\n9\n$INSUNITS\n70\n{}\n", metric ? 1 : 0, metric ? 4 : 1);
  text += fmt::format("9\n$EXTMIN\n10\n{:.4f}\n20\n{:.4f}\n9\n$EXTMAX\n10\n{:.4f}\n20\n{:.4f}\n0\nENDSEC\n",
                      box.left * scale, box.bottom * scale, box.right * scale, box.top * scale);
  text += "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n7\n";
  int colour = 1;
  for (const char* layer : piece_layers)
    text += fmt::format("0\nLAYER\n2\n{}\n70\n0\n62\n{}\n6\nCONTINUOUS\n", layer, colour++);
  text += "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  for (const PieceStroke& stroke : drawing.strokes) text += dxf_polyline(stroke, scale);
  for (const PieceText& line : drawing.texts)
    text +=
        fmt::format("0\nTEXT\n8\nTEXT\n10\n{:.4f}\n20\n{:.4f}\n30\n0.0\n40\n{:.4f}\n1\n{}\n",
                    line.at.x * scale, line.at.y * scale, drawing.text_height * scale, dxf_text(line.text));
  write_file(path, text + "0\nENDSEC\n0\nEOF\n");
}

void write_pattern_svg(const std::filesystem::path& path, const Piece& piece, const Allowances& allowances,
                       const PatternHead& head) {
  constexpr double margin = 10, bar = 100;
  const PieceDrawing drawing = drawing_of(piece, allowances, head);
  const PieceBox& box = drawing.box;
  const double width = std::max((box.right - box.left) * mm, bar) + 2 * margin;
  const double height = (box.top - box.bottom) * mm + 4 * margin;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" "
      "viewBox=\"0 0 {0:.3f} {1:.3f}\">\n",
      width, height);
  for (const PieceStroke& stroke : drawing.strokes) {
    std::string points;
    for (const Point2& p : stroke.points)
      points += fmt::format("{}{:.3f},{:.3f}", points.empty() ? "" : " ", (p.x - box.left) * mm + margin,
                            (box.top - p.y) * mm + margin);
    text += fmt::format("<{} points=\"{}\" fill=\"none\" {}/>\n", stroke.closed ? "polygon" : "polyline",
                        points, svg_styles[static_cast<int>(stroke.layer)]);
  }
  const auto write_text = [&](double x, double y, double size, const std::string& line) {
    text += fmt::format(
        "<text x=\"{:.3f}\" y=\"{:.3f}\" font-family=\"sans-serif\" font-size=\"{:.3g}\">{}</text>\n", x, y,
        size, escaped_markup(line));
  };
  for (const PieceText& line : drawing.texts)
    write_text((line.at.x - box.left) * mm + margin, (box.top - line.at.y) * mm + margin,
               drawing.text_height * mm, line.text);
  const double lower_edge = height - margin;
  text += fmt::format("<path d=\"M {} {} h {}\" stroke=\"#000\" stroke-width=\"0.5\"/>\n", margin, lower_edge,
                      bar);
  write_text(margin, lower_edge - 3, 5, "100 mm");
  write_file(path, text + "</svg>\n");
}

void write_bill_csv(const std::filesystem::path& path, const Bill& bill) {
  std::string text = "part,material,count,cut_each,finished,cut,unit,mass_kg\n";
  for (const BillRow& row : bill.rows)
    text +=
        fmt::format("\"{}\",\"{}\",{},{:.6f},{:.6f},{:.6f},{},{:.6f}\n", row.part, row.material, row.count,
                    row.cut_each(), row.finished, row.cut, row.is_cloth ? "m2" : "m", row.mass);
  write_file(path, text);
}

}  // namespace ripstop::inline output
