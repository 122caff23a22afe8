// A page to draw on with Cairo, saved as PNG or SVG. Internal to output/: nobody else sees Cairo.
#pragma once

#include <cairo.h>

#include <filesystem>
#include <functional>
#include <string>

#include "ripstop/output/colour.h"
#include "ripstop/output/render.h"

namespace ripstop::inline output {

/// White page of this size [pixel]; `draw` fills it. The ending of the path, .png or .svg, chooses the
/// format. Throws Error(usage) for another ending, Error(bad_data) when Cairo refuses (text that is
/// not UTF-8), Error(io).
void write_drawing(const std::filesystem::path& path, int width, int height,
                   const std::function<void(cairo_t*)>& draw);

void set_colour(cairo_t* page, Colour colour, double alpha = 1);

enum class Align { left, centre, right };
struct TextStyle {
  double size = 18;  // [pixel]
  Align align = Align::left;
  bool bold = false;
  Colour colour = ink;
};
/// (x, y): the base line's left end, middle or right end.
void draw_text(cairo_t* page, double x, double y, const std::string& text, const TextStyle& style = {});
double text_width(cairo_t* page, const std::string& text, const TextStyle& style = {});

void draw_line(cairo_t* page, double x0, double y0, double x1, double y1, double width, Colour colour);
/// A line with a filled head at (x1, y1).
void draw_arrow(cairo_t* page, double x0, double y0, double x1, double y1, double width, Colour colour);
void fill_box(cairo_t* page, double x, double y, double width, double height, Colour colour,
              double alpha = 1);
/// Pixels one to one with their upper left corner at (x, y).
void draw_raster(cairo_t* page, double x, double y, const Raster& raster);

}  // namespace ripstop::inline output
