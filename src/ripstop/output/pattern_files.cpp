#include "ripstop/output/pattern_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ripstop/core/file.h"
#include "ripstop/core/units.h"

namespace ripstop {
namespace {

constexpr double mm = 1000;

struct Box {
  double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
};

Box box_of(const std::vector<Point2>& outline) {
  Box box;
  for (const Point2& p : outline) {
    box.left = std::min(box.left, p.x), box.right = std::max(box.right, p.x);
    box.bottom = std::min(box.bottom, p.y), box.top = std::max(box.top, p.y);
  }
  return box;
}

// DXF: lines of a group code and its value. Codes 10, 20, 30: a point; 8: the layer; 70: flags, 1 is closed.
/// `scale`: units per metre.
std::string dxf_polyline(const std::vector<Point2>& outline, const std::string& layer, bool closed,
                         double scale) {
  std::string text =
      fmt::format("0\nPOLYLINE\n8\n{}\n66\n1\n70\n{}\n10\n0.0\n20\n0.0\n30\n0.0\n", layer, closed ? 1 : 0);
  for (const Point2& p : outline)
    text +=
        fmt::format("0\nVERTEX\n8\n{}\n10\n{:.4f}\n20\n{:.4f}\n30\n0.0\n", layer, p.x * scale, p.y * scale);
  return text + fmt::format("0\nSEQEND\n8\n{}\n", layer);
}

std::string label(const Piece& piece) {
  return fmt::format("{}, cut {}, warp {:.0f} deg", piece.name, piece.count, piece.grain);
}

/// An arrow along the warp, eight tenths as long as it fits into the box about its middle: tail, tip, and the
/// barbs on either side of the tip.
std::array<Point2, 4> grain(const Piece& piece, const Box& box) {
  constexpr double barb = 0.008, spread = 25;  // [m], [deg]
  const auto along = [&](double turn) {
    const double angle = (piece.grain + turn) * std::numbers::pi / 180;
    return Point2{std::sin(angle), std::cos(angle)};
  };
  const Point2 middle{0.5 * (box.left + box.right), 0.5 * (box.bottom + box.top)}, d = along(0);
  const double across = 0.5 * (box.right - box.left), up = 0.5 * (box.top - box.bottom);
  const double half =
      0.8 * std::min(across / std::max(std::abs(d.x), 1e-9), up / std::max(std::abs(d.y), 1e-9));
  const Point2 tip{middle.x + half * d.x, middle.y + half * d.y};
  const auto back = [&](double turn) {
    const Point2 e = along(turn);
    return Point2{tip.x - barb * e.x, tip.y - barb * e.y};
  };
  return {Point2{middle.x - half * d.x, middle.y - half * d.y}, tip, back(spread), back(-spread)};
}

}  // namespace

void write_pattern_dxf(const std::filesystem::path& path, const Piece& piece, const Allowances& allowances,
                       DxfUnit unit) {
  const bool metric = unit == DxfUnit::millimetres;
  const double scale = metric ? mm : 1 / inch, text_height = 0.010 * scale, text_gap = 0.005 * scale;
  const std::vector<Point2> cut = with_allowance(piece, allowances);
  const Box box = box_of(cut);
  const auto [tail, tip, left, right] = grain(piece, box);
  std::string text = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n";
  // $MEASUREMENT: 0 inches, 1 millimetres; $INSUNITS: 1 inches, 4 millimetres. Readers without them guess the unit.
  text += fmt::format("9\n$MEASUREMENT\n70\n{}\n9\n$INSUNITS\n70\n{}\n", metric ? 1 : 0, metric ? 4 : 1);
  text += fmt::format("9\n$EXTMIN\n10\n{:.4f}\n20\n{:.4f}\n9\n$EXTMAX\n10\n{:.4f}\n20\n{:.4f}\n0\nENDSEC\n",
                      box.left * scale, box.bottom * scale, box.right * scale, box.top * scale);
  text += "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n4\n";
  int colour = 1;
  for (const char* layer : {"CUT", "SEAM", "GRAIN", "TEXT"})
    text += fmt::format("0\nLAYER\n2\n{}\n70\n0\n62\n{}\n6\nCONTINUOUS\n", layer, colour++);
  text += "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  text += dxf_polyline(cut, "CUT", true, scale) + dxf_polyline(piece.outline, "SEAM", true, scale) +
          dxf_polyline({tail, tip}, "GRAIN", false, scale) +
          dxf_polyline({left, tip, right}, "GRAIN", false, scale);
  text += fmt::format("0\nTEXT\n8\nTEXT\n10\n{:.4f}\n20\n{:.4f}\n30\n0.0\n40\n{:.4f}\n1\n{}\n",
                      tail.x * scale + text_gap, tail.y * scale, text_height, label(piece));
  write_file(path, text + "0\nENDSEC\n0\nEOF\n");
}

void write_pattern_svg(const std::filesystem::path& path, const Piece& piece, const Allowances& allowances) {
  constexpr double margin = 10, bar = 100;
  const std::vector<Point2> cut = with_allowance(piece, allowances);
  const Box box = box_of(cut);
  const double width = std::max((box.right - box.left) * mm, bar) + 2 * margin;
  const double height = (box.top - box.bottom) * mm + 4 * margin;
  const auto at = [&](Point2 p) {
    return fmt::format("{:.3f},{:.3f}", (p.x - box.left) * mm + margin, (box.top - p.y) * mm + margin);
  };
  const auto polygon = [&](const std::vector<Point2>& outline, const char* style) {
    std::string points;
    for (const Point2& p : outline) points += at(p) + " ";
    points.pop_back();
    return fmt::format("<polygon points=\"{}\" {}/>\n", points, style);
  };
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" "
      "viewBox=\"0 0 {0:.3f} {1:.3f}\">\n",
      width, height);
  text += polygon(cut, "fill=\"none\" stroke=\"#c0392b\" stroke-width=\"0.5\"");
  text += polygon(piece.outline,
                  "fill=\"none\" stroke=\"#2c3e50\" stroke-width=\"0.3\" stroke-dasharray=\"3 2\"");
  const auto [tail, tip, left, right] = grain(piece, box);
  text += fmt::format(
      "<polyline points=\"{0} {1} {2} {1} {3}\" fill=\"none\" stroke=\"#7f8c8d\" stroke-width=\"0.3\"/>\n",
      at(tail), at(tip), at(left), at(right));
  const double lower_edge = height - margin;
  text += fmt::format(
      "<path d=\"M {0} {1} h {2}\" stroke=\"#000\" stroke-width=\"0.5\"/>\n"
      "<text x=\"{0}\" y=\"{3}\" font-family=\"sans-serif\" font-size=\"5\">100 mm | {4}</text>\n</svg>\n",
      margin, lower_edge, bar, lower_edge - 3, label(piece));
  write_file(path, text);
}

void write_bill_csv(const std::filesystem::path& path, const Bill& bill) {
  std::string text = "part,material,count,finished,cut,unit,mass_kg\n";
  for (const BillRow& row : bill.rows)
    text += fmt::format("\"{}\",\"{}\",{},{:.6f},{:.6f},{},{:.6f}\n", row.part, row.material, row.count,
                        row.finished, row.cut, row.is_cloth ? "m2" : "m", row.mass);
  write_file(path, text);
}

}  // namespace ripstop
