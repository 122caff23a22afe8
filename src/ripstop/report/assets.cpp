#include "ripstop/report/assets.h"

#include "ripstop/core/embedded.h"

// RIPSTOP_REPORT_DIR is set where this file is compiled.
#define RIPSTOP_ASSET(symbol, file) RIPSTOP_EMBEDDED(symbol, RIPSTOP_REPORT_DIR "/" file)

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

namespace ripstop::inline report {

std::string_view report_skeleton() {
  return RIPSTOP_EMBEDDED_TEXT(ripstop_report_skeleton);
}

std::vector<Asset> report_styles() {
  return {{"uplot.min.css", RIPSTOP_EMBEDDED_TEXT(ripstop_report_uplot_css)},
          {"page.css", RIPSTOP_EMBEDDED_TEXT(ripstop_report_css)},
          {"print.css", RIPSTOP_EMBEDDED_TEXT(ripstop_report_print_css)}};
}

std::vector<Asset> report_scripts() {
  return {{"three.min.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_three)},
          {"uplot.min.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_uplot)},
          {"data.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_data)},
          {"elements.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_elements)},
          {"colours.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_colours)},
          {"plots.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_plots)},
          {"tables.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_tables)},
          {"materials.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_materials)},
          {"canopy.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_canopy)},
          {"air.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_air)},
          {"viewer.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_viewer)},
          {"controls.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_controls)},
          {"main.js", RIPSTOP_EMBEDDED_TEXT(ripstop_report_main)}};
}

}  // namespace ripstop::inline report
