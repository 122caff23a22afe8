// One HTML file that shows one or several runs, without a request to any network: its content as plain data, and the
// page made of it. It is independent of solvers; run/report.h takes the data from run folders.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ripstop/report/flow_view.h"
#include "ripstop/report/shape_view.h"

namespace ripstop::inline report {

/// One number, word or list of a result, as result.json has it.
struct ReportValue {
  std::string key;   // "drag_n"
  std::string json;  // its value as JSON: "396.8"
};

struct ReportColumn {
  std::string text, unit;  // unit: empty where the values have none
};
struct ReportTable {
  std::string id, title, note;  // the note may be empty
  std::vector<ReportColumn> columns;
  std::vector<std::vector<std::string>> rows;  // numbers as text that reads back
};

struct ReportSeries {
  std::string name;
  std::vector<double> x, y;
  bool line = true, dashed = false;  // without a line: points
};
struct ReportPlot {
  std::string id, title;
  ReportColumn x, y;
  std::vector<ReportSeries> series;
  bool logarithmic = false;  // y
  bool over_time = false;    // x is the time of the shape's frames [s]
};

struct ReportRun {
  std::string kind;                   // "steady", "opening", "flight", "size", "stability"
  std::string name, title;            // the folder's name, the case's title
  bool converged = true;              // an opening always is
  std::vector<ReportValue> values;    // in the order of result.json; nested ones are tables
  std::vector<std::string> headline;  // keys of the values that the page begins with
  std::vector<ReportTable> tables;
  std::vector<ReportPlot> plots;
  std::vector<std::string> warnings;
  std::string case_file;                                        // case.toml
  std::vector<std::pair<std::string, std::string>> provenance;  // name and value
  ShapeView shape;                                              // empty: not kept
  FlowView flow;                                                // empty: not kept
};

struct Report {
  std::string title;
  std::vector<ReportRun> runs;
  ReportTable comparison;         // of several runs
  std::vector<ReportPlot> plots;  // over all of them
};

/// The largest page that is written [bytes].
inline constexpr std::size_t largest_page = 10'000'000;

/// The whole page. Frames of openings are thinned out, then flows left out, until it is no larger than
/// `largest_page`. No text in it can end a script or start one.
std::string report_page(const Report& report);

/// A shape and the colour scale as the scripts of the page read them: JSON with packed numbers.
std::string shape_json(const ShapeView& shape);
/// Plots likewise, as a JSON list.
std::string plots_json(const std::vector<ReportPlot>& plots);

/// Whether a file begins as report_page() does.
bool is_report(const std::string& page);

}  // namespace ripstop::inline report
