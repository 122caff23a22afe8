#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ripstop/core/build_info.h"
#include "ripstop/core/hash.h"
#include "ripstop/core/markup.h"
#include "ripstop/core/words.h"
#include "ripstop/output/colour.h"
#include "ripstop/report/assets.h"
#include "ripstop/report/encode.h"
#include "ripstop/report/report.h"

namespace ripstop::inline report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* beginning = "<!doctype html>\n<!-- Ripstop report -->\n";

// Steps of values between their least and their largest: finer than a screen's, coarse enough to pack well.
constexpr int point_levels = 65534, cell_levels = 4095;
constexpr int moving_point_levels = 16383, moving_cell_levels = 1023;

/// Data that are removed from a page to reduce its size.
struct Thinning {
  std::size_t without_flow = 0, without_shape = 0;  // of the last so many runs
  std::size_t every = 1;                            // of an opening's frames
};

Json packed(const std::vector<double>& values, int components, int levels) {
  const Quantised q = quantise(values, components, levels);
  return {{"n", values.size()}, {"components", components}, {"bytes", 2},
          {"low", q.low},       {"step", q.step},           {"data", pack_integers(q.values, components, 2)}};
}

Json packed(const std::vector<int>& values, int components) {
  return {{"n", values.size()},
          {"components", components},
          {"bytes", 4},
          {"data", pack_integers({values.begin(), values.end()}, components, 4)}};
}

Json worded(const ReportColumn& column) {
  return {{"text", column.text}, {"unit", column.unit}};
}

/// Six digits: more than a plot can show.
Json rounded(const std::vector<double>& values) {
  Json list = Json::array();
  for (double value : values)
    list.push_back(std::isfinite(value) ? Json::parse(fmt::format("{:.6g}", value)) : Json());
  return list;
}

Json to_json(const ReportPlot& plot) {
  Json series = Json::array();
  for (const ReportSeries& s : plot.series)
    series.push_back(
        {{"name", s.name}, {"x", rounded(s.x)}, {"y", rounded(s.y)}, {"line", s.line}, {"dashed", s.dashed}});
  return {{"id", plot.id},
          {"title", plot.title},
          {"x", worded(plot.x)},
          {"y", worded(plot.y)},
          {"logarithmic", plot.logarithmic},
          {"overTime", plot.over_time},
          {"series", series}};
}

Json to_json(const ReportTable& table) {
  Json columns = Json::array();
  for (const ReportColumn& column : table.columns) columns.push_back(worded(column));
  return {{"id", table.id},
          {"title", table.title},
          {"note", table.note},
          {"columns", columns},
          {"rows", table.rows}};
}

Json to_json(const ShapeFrame& frame, bool moving) {
  Json cells = Json::array();
  for (const CellValues& values : frame.cells) {
    const Wording words = in_words(values.key);
    cells.push_back({{"key", values.key},
                     {"text", words.text},
                     {"unit", words.unit},
                     {"values", packed(values.values, 1, moving ? moving_cell_levels : cell_levels)}});
  }
  Json j = {{"time", frame.time},
            {"points", packed(frame.points, 3, moving ? moving_point_levels : point_levels)},
            {"cells", cells}};
  if (!frame.line_values.empty())
    j["tension"] = packed(frame.line_values, 1, moving ? moving_cell_levels : cell_levels);
  return j;
}

/// Every so many frames, the first and the last in any case.
Json to_json(const ShapeView& shape, std::size_t every) {
  Json frames = Json::array();
  const std::size_t last = shape.frames.size() - 1;
  for (std::size_t i = 0; i <= last; ++i)
    if (i == last || (i % every == 0 && i + every / 2 <= last))
      frames.push_back(to_json(shape.frames[i], last > 0));
  Json j = {{"quads", packed(shape.quads, 4)},       {"segments", packed(shape.segments, 2)},
            {"parts", packed(shape.parts, 1)},       {"partNames", shape.part_names},
            {"framesComputed", shape.frames.size()}, {"frames", frames}};
  if (!shape.path.empty())
    j["path"] = {{"times", rounded(shape.path_times)},
                 {"points", packed(shape.path, 3, point_levels)},
                 {"anchor", shape.anchor}};
  return j;
}

Json to_json(const FlowView& flow) {
  return {{"cells", flow.cells},
          {"origin", {flow.origin.x, flow.origin.y, flow.origin.z}},
          {"spacing", {flow.spacing.x, flow.spacing.y, flow.spacing.z}},
          {"pressure", packed(flow.pressure, 1, moving_cell_levels)},
          {"speed", packed(flow.speed, 1, moving_cell_levels)},
          {"streamlines", packed(flow.streamlines, 3, moving_point_levels)},
          {"lengths", packed(flow.lengths, 1)},
          {"streamlineSpeed", packed(flow.streamline_speed, 1, moving_cell_levels)}};
}

Json to_json(const ReportRun& run, bool with_flow, bool with_shape, std::size_t every) {
  Json values = Json::array(), tables = Json::array(), plots = Json::array(), provenance = Json::array();
  for (const ReportValue& value : run.values) {
    const Wording words = in_words(value.key);
    values.push_back(
        {{"key", value.key}, {"text", words.text}, {"unit", words.unit}, {"value", Json::parse(value.json)}});
  }
  for (const ReportTable& table : run.tables) tables.push_back(to_json(table));
  for (const ReportPlot& plot : run.plots) plots.push_back(to_json(plot));
  for (const auto& [what, value] : run.provenance) provenance.push_back({what, value});
  Json j = {{"kind", run.kind},           {"name", run.name},        {"title", run.title},
            {"converged", run.converged}, {"values", values},        {"headline", run.headline},
            {"tables", tables},           {"plots", plots},          {"warnings", run.warnings},
            {"caseFile", run.case_file},  {"provenance", provenance}};
  if (with_shape && !run.shape.frames.empty()) j["shape"] = to_json(run.shape, every);
  if (with_flow && !run.flow.pressure.empty()) j["flow"] = to_json(run.flow);
  return j;
}

Json colour_table() {
  std::string bytes;
  for (int i = 0; i < 256; ++i) {
    const Colour colour = scale_colour(i / 255.0);
    for (double part : {colour.red, colour.green, colour.blue})
      bytes += static_cast<char>(std::lround(255 * part));
  }
  return base64(bytes);
}

/// JSON inside a script element, which ends at the first "</script" and may be confused by "<!--": no '<' is
/// left. Broken UTF-8 becomes U+FFFD.
std::string embedded(const Json& data) {
  const std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace);
  std::string result;
  result.reserve(text.size());
  for (char c : text) {
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  }
  return result;
}

std::string page_of(const Report& report, const Thinning& thinning) {
  Json runs = Json::array(), plots = Json::array();
  for (std::size_t i = 0; i < report.runs.size(); ++i) {
    const std::size_t to_end = report.runs.size() - i;
    runs.push_back(to_json(report.runs[i], to_end > thinning.without_flow, to_end > thinning.without_shape,
                           thinning.every));
  }
  for (const ReportPlot& plot : report.plots) plots.push_back(to_json(plot));
  const Json data = {
      {"version", version()}, {"title", report.title}, {"colours", colour_table()},
      {"runs", runs},         {"plots", plots},        {"comparison", to_json(report.comparison)}};
  const std::string text = embedded(data);
  const std::string nonce = hash_bytes(text);  // scripts without it do not run
  std::string page = beginning;
  page +=
      "<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += fmt::format(
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'nonce-{}'; "
      "style-src 'unsafe-inline'; img-src data: blob:\">\n<title>{}</title>\n",
      nonce, escaped_markup(report.title));
  for (const Asset& style : report_styles()) page += fmt::format("<style>\n{}</style>\n", style.text);
  page += fmt::format("</head>\n{}", report_skeleton());
  page += "<script type=\"application/json\" id=\"report-data\">" + text + "</script>\n";
  for (const Asset& script : report_scripts())
    page += fmt::format("<script nonce=\"{}\">\n{}</script>\n", nonce, script.text);
  return page + "</body>\n</html>\n";
}

}  // namespace

std::string report_page(const Report& report) {
  Thinning thinning;
  std::size_t most_frames = 0;
  for (const ReportRun& run : report.runs) most_frames = std::max(most_frames, run.shape.frames.size());
  constexpr std::size_t enough_frames = 12;
  while (true) {
    std::string page = page_of(report, thinning);
    if (page.size() <= largest_page) return page;
    const std::size_t all = report.runs.size();
    // The frames' part of a page falls as 1 / every.
    const std::size_t wanted = thinning.every * page.size() / largest_page + 1;
    if (most_frames / (thinning.every + 1) >= enough_frames)
      thinning.every = std::clamp(wanted, thinning.every + 1, most_frames / enough_frames);
    else if (thinning.without_flow < all)
      ++thinning.without_flow;
    else if (thinning.without_shape < all)
      ++thinning.without_shape;
    else
      return page;  // tables and plots alone
  }
}

std::string shape_json(const ShapeView& shape) {
  Json j = to_json(shape, 1);
  j["colours"] = colour_table();
  return j.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string plots_json(const std::vector<ReportPlot>& plots) {
  Json list = Json::array();
  for (const ReportPlot& plot : plots) list.push_back(to_json(plot));
  return list.dump(-1, ' ', true, Json::error_handler_t::replace);
}

bool is_report(const std::string& page) {
  return page.starts_with(beginning);
}

}  // namespace ripstop::inline report
