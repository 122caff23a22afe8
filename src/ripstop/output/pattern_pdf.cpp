// Pieces on the sheets of a home printer: PDF with registration marks and a control square.
#include <cairo-pdf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/drawing.h"
#include "ripstop/output/piece_drawing.h"

namespace ripstop::inline output {
namespace {

constexpr double point = 0.0254 / 72;            // [m]
constexpr double margin = 0.010, glued = 0.005;  // unprinted edge of a sheet; drawn beyond its window [m]
constexpr double control_square = 0.100, mark = 0.005;  // sides of the square and of half a mark [m]
constexpr double most_sheets = 300;

constexpr Colour layer_colours[] = {{0.75, 0.22, 0.17}, {0.17, 0.24, 0.31}, {0.16, 0.50, 0.73},
                                    {0.75, 0.22, 0.17}, {0.56, 0.27, 0.68}, {0.50, 0.55, 0.55},
                                    {0, 0, 0}};

struct Sheets {
  double width = 0, height = 0;  // of the paper [m]
  int columns = 1, rows = 1;
  double window_width() const { return width - 2 * margin; }
  double window_height() const { return height - 2 * margin; }
};

Sheets sheets_for(const PieceBox& box, Paper paper, const std::string& piece) {
  Sheets s;
  s.width = paper == Paper::a4 ? 0.210 : 0.2159, s.height = paper == Paper::a4 ? 0.297 : 0.2794;
  const double columns = std::ceil((box.right - box.left) / s.window_width()),
               rows = std::ceil((box.top - box.bottom) / s.window_height());
  if (!(columns * rows <= most_sheets))
    throw Error(ExitCode::usage,
                fmt::format("{} needs {:.0f} x {:.0f} sheets of paper, more than {:g}: leave "
                            "--paper out and print the SVG or DXF on a plotter",
                            piece, columns, rows, most_sheets));
  s.columns = std::max(1, static_cast<int>(columns)), s.rows = std::max(1, static_cast<int>(rows));
  return s;
}

std::string sheet_name(int column, int row) {
  return fmt::format("{}{}", row + 1,
                     column < 26 ? std::string(1, static_cast<char>('A' + column))
                                 : fmt::format("A{}", static_cast<char>('A' + column % 26)));
}

/// Lower left corner of a sheet's window; the first row is the lowest.
Point2 corner(const Sheets& s, const PieceBox& box, int column, int row) {
  return {box.left + column * s.window_width(), box.bottom + row * s.window_height()};
}

/// Whether a part of a stroke lies in the window: by steps of a millimetre.
bool is_crossed(const PieceDrawing& drawing, const Sheets& s, Point2 low) {
  constexpr double step = 0.001;
  const auto within = [&](Point2 p) {
    return p.x >= low.x && p.x <= low.x + s.window_width() && p.y >= low.y &&
           p.y <= low.y + s.window_height();
  };
  for (const PieceStroke& stroke : drawing.strokes) {
    const std::size_t n = stroke.points.size();
    for (std::size_t i = 0; i + (stroke.closed ? 0 : 1) < n; ++i) {
      const Point2 a = stroke.points[i], b = stroke.points[(i + 1) % n];
      const int parts = 1 + static_cast<int>(std::min(1e6, std::hypot(b.x - a.x, b.y - a.y) / step));
      for (int k = 0; k <= parts; ++k)
        if (within({a.x + (b.x - a.x) * k / parts, a.y + (b.y - a.y) * k / parts})) return true;
    }
  }
  return false;
}

/// Strokes and texts, in metres with y up.
void draw_piece(cairo_t* page, const PieceDrawing& drawing, double stroke_width) {
  for (const PieceStroke& stroke : drawing.strokes) {
    set_colour(page, layer_colours[static_cast<int>(stroke.layer)]);
    cairo_set_line_width(page, stroke_width);
    cairo_new_path(page);
    for (const Point2& p : stroke.points) cairo_line_to(page, p.x, p.y);
    if (stroke.closed) cairo_close_path(page);
    cairo_stroke(page);
  }
  for (const PieceText& line : drawing.texts) {
    cairo_save(page);
    cairo_translate(page, line.at.x, line.at.y);
    cairo_scale(page, 1, -1);
    draw_text(page, 0, 0, line.text, {drawing.text_height, Align::left, false, {0, 0, 0}});
    cairo_restore(page);
  }
}

/// Maps metres with y up, from `low` at the lower left corner of the window, to the points of a page.
void begin_page(cairo_t* page, const Sheets& s, Point2 low, double scale) {
  cairo_translate(page, margin / point, (s.height - margin) / point);
  cairo_scale(page, scale / point, -scale / point);
  cairo_translate(page, -low.x, -low.y);
}

void draw_cross(cairo_t* page, double x, double y) {
  for (const auto& [dx, dy] : {Point2{mark, 0}, Point2{0, mark}})
    draw_line(page, x - dx, y - dy, x + dx, y + dy, 0.0002, {0, 0, 0});
}

void draw_sheet(cairo_t* page, const PieceDrawing& drawing, const Sheets& s, int column, int row,
                const std::string& name) {
  cairo_save(page);
  const Point2 low = corner(s, drawing.box, column, row);
  const double w = s.window_width(), h = s.window_height();
  begin_page(page, s, low, 1);
  for (const double x : {low.x, low.x + w})
    for (const double y : {low.y, low.y + h}) draw_cross(page, x, y);
  cairo_save(page);
  cairo_translate(page, low.x + 0.01, low.y + 0.006);
  cairo_scale(page, 1, -1);
  draw_text(page, 0, 0, fmt::format("{}: sheet {}", name, sheet_name(column, row)),
            {0.004, Align::left, false, {0.4, 0.4, 0.4}});
  cairo_restore(page);
  cairo_rectangle(page, low.x - glued, low.y - glued, w + 2 * glued, h + 2 * glued);
  cairo_clip(page);
  draw_piece(page, drawing, 0.0003);
  cairo_restore(page);
  cairo_show_page(page);
}

/// The control square, and the piece at a small scale with its sheets.
void draw_overview(cairo_t* page, const PieceDrawing& drawing, const Sheets& s, const std::string& name,
                   const std::vector<std::pair<int, int>>& printed) {
  const auto text = [&](double y, const std::string& line) {
    draw_text(page, margin / point, y / point, line, {11, Align::left, false, {0, 0, 0}});
  };
  text(0.016, name);
  text(0.023, "Print at 100 %, not fitted to the page. The square below must measure 100 mm by 100 mm.");
  text(0.030, "Cut or fold along the corner marks; neighbouring sheets meet at them.");
  set_colour(page, {0, 0, 0});
  cairo_set_line_width(page, 0.6);
  cairo_rectangle(page, margin / point, 0.036 / point, control_square / point, control_square / point);
  cairo_stroke(page);
  const double room_width = s.window_width(), room_height = s.height - margin - 0.146;
  const double scale =
      std::min(room_width / (s.columns * s.window_width()), room_height / (s.rows * s.window_height()));
  cairo_save(page);
  begin_page(page, s, {drawing.box.left, drawing.box.bottom}, scale);
  draw_piece(page, {drawing.strokes, {}, 0, drawing.box}, 0.0003 / scale);
  for (const auto& [column, row] : printed) {
    const Point2 low = corner(s, drawing.box, column, row);
    set_colour(page, {0.5, 0.5, 0.5});
    cairo_set_line_width(page, 0.0002 / scale);
    cairo_rectangle(page, low.x, low.y, s.window_width(), s.window_height());
    cairo_stroke(page);
    cairo_save(page);
    cairo_translate(page, low.x + 0.01, low.y + 0.01);
    cairo_scale(page, 1, -1);
    draw_text(page, 0, 0, sheet_name(column, row), {0.003 / scale, Align::left, false, {0.3, 0.3, 0.3}});
    cairo_restore(page);
  }
  cairo_restore(page);
  cairo_show_page(page);
}

cairo_status_t append_bytes(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

void write_pattern_pdf(const std::filesystem::path& path, const Piece& piece, const Allowances& allowances,
                       Paper paper, const PatternHead& head) {
  const PieceDrawing drawing = drawing_of(piece, allowances, head);
  const Sheets sheets = sheets_for(drawing.box, paper, piece.name);
  std::vector<std::pair<int, int>> printed;
  for (int row = 0; row < sheets.rows; ++row)
    for (int column = 0; column < sheets.columns; ++column)
      if (is_crossed(drawing, sheets, corner(sheets, drawing.box, column, row)))
        printed.emplace_back(column, row);
  std::string bytes;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_pdf_surface_create_for_stream(append_bytes, &bytes, sheets.width / point, sheets.height / point),
      cairo_surface_destroy);
  // Newer versions of cairo would write PDF 1.7 with compressed page objects.
  cairo_pdf_surface_restrict_to_version(surface.get(), CAIRO_PDF_VERSION_1_4);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> page(cairo_create(surface.get()), cairo_destroy);
  const std::string name = fmt::format("{}{}{}, {} sheets", head.title, head.title.empty() ? "" : ": ",
                                       piece.name, printed.size());
  draw_overview(page.get(), drawing, sheets, name, printed);
  for (const auto& [column, row] : printed) draw_sheet(page.get(), drawing, sheets, column, row, piece.name);
  cairo_surface_finish(surface.get());
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS ||
      cairo_status(page.get()) != CAIRO_STATUS_SUCCESS)
    throw Error(ExitCode::bad_data, fmt::format("{} could not be drawn", path.string()));
  write_file(path, bytes);
}

}  // namespace ripstop::inline output
