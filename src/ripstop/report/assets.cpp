#include "ripstop/report/assets.h"

// The files become data of this object as they are; RIPSTOP_REPORT_DIR is set where this file is compiled.
// NOLINTBEGIN(bugprone-macro-parentheses): the macro contains a declared name
#define RIPSTOP_ASSET(symbol, file)                                                                     \
  __asm__(".section .rodata\n.global " #symbol "\n" #symbol ":\n.incbin \"" RIPSTOP_REPORT_DIR "/" file \
          "\"\n.global " #symbol "_end\n" #symbol "_end:\n.byte 0\n.previous\n");                       \
  extern "C" const char symbol[];                                                                       \
  extern "C" const char symbol##_end[];
// NOLINTEND(bugprone-macro-parentheses)

RIPSTOP_ASSET(ripstop_report_skeleton, "page/page.html")
RIPSTOP_ASSET(ripstop_report_uplot_css, "vendor/uplot.min.css")
RIPSTOP_ASSET(ripstop_report_css, "page/page.css")
RIPSTOP_ASSET(ripstop_report_print_css, "page/print.css")
RIPSTOP_ASSET(ripstop_report_three, "vendor/three.min.js")
RIPSTOP_ASSET(ripstop_report_uplot, "vendor/uplot.min.js")
RIPSTOP_ASSET(ripstop_report_data, "page/data.js")
RIPSTOP_ASSET(ripstop_report_elements, "page/elements.js")
RIPSTOP_ASSET(ripstop_report_colours, "page/colours.js")
RIPSTOP_ASSET(ripstop_report_plots, "page/plots.js")
RIPSTOP_ASSET(ripstop_report_tables, "page/tables.js")
RIPSTOP_ASSET(ripstop_report_materials, "page/materials.js")
RIPSTOP_ASSET(ripstop_report_canopy, "page/canopy.js")
RIPSTOP_ASSET(ripstop_report_air, "page/air.js")
RIPSTOP_ASSET(ripstop_report_viewer, "page/viewer.js")
RIPSTOP_ASSET(ripstop_report_controls, "page/controls.js")
RIPSTOP_ASSET(ripstop_report_main, "page/main.js")

namespace ripstop {

#define RIPSTOP_TEXT(symbol) std::string_view(symbol, static_cast<std::size_t>(symbol##_end - (symbol)))

std::string_view report_skeleton() {
  return RIPSTOP_TEXT(ripstop_report_skeleton);
}

std::vector<Asset> report_styles() {
  return {{"uplot.min.css", RIPSTOP_TEXT(ripstop_report_uplot_css)},
          {"page.css", RIPSTOP_TEXT(ripstop_report_css)},
          {"print.css", RIPSTOP_TEXT(ripstop_report_print_css)}};
}

std::vector<Asset> report_scripts() {
  return {{"three.min.js", RIPSTOP_TEXT(ripstop_report_three)},
          {"uplot.min.js", RIPSTOP_TEXT(ripstop_report_uplot)},
          {"data.js", RIPSTOP_TEXT(ripstop_report_data)},
          {"elements.js", RIPSTOP_TEXT(ripstop_report_elements)},
          {"colours.js", RIPSTOP_TEXT(ripstop_report_colours)},
          {"plots.js", RIPSTOP_TEXT(ripstop_report_plots)},
          {"tables.js", RIPSTOP_TEXT(ripstop_report_tables)},
          {"materials.js", RIPSTOP_TEXT(ripstop_report_materials)},
          {"canopy.js", RIPSTOP_TEXT(ripstop_report_canopy)},
          {"air.js", RIPSTOP_TEXT(ripstop_report_air)},
          {"viewer.js", RIPSTOP_TEXT(ripstop_report_viewer)},
          {"controls.js", RIPSTOP_TEXT(ripstop_report_controls)},
          {"main.js", RIPSTOP_TEXT(ripstop_report_main)}};
}

}  // namespace ripstop
