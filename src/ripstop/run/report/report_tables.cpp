#include "ripstop/run/report/report_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "ripstop/case/settings.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/words.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/json.h"
#include "ripstop/run/sizing/pattern.h"

namespace ripstop::inline run {
namespace {

using Json = nlohmann::ordered_json;

Json parsed(const std::filesystem::path& file, const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object())
    throw Error(ExitCode::bad_data, fmt::format("{}: is not a result of Ripstop", file.string()));
  return json;
}

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return csv_number(value.get<double>());
  if (value.is_null()) return "";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return value.dump();
}

std::string heading(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

bool is_group(const Json& value) {
  return value.is_object() || (value.is_array() && !value.empty() && value.front().is_object());
}

/// Columns are all keys of all rows; a group in a row becomes a separate table.
ReportTable table_of_rows(const std::string& id, const Json& rows) {
  ReportTable table{id, heading(in_words(id).text), "", {}, {}};
  std::vector<std::string> keys;
  for (const Json& row : rows)
    for (const auto& [name, value] : row.items())
      if (!is_group(value) && std::find(keys.begin(), keys.end(), name) == keys.end()) keys.push_back(name);
  for (const std::string& key : keys) {
    const Wording words = in_words(key);
    table.columns.push_back({words.text, words.unit});
  }
  for (const Json& row : rows) {
    std::vector<std::string> fields;
    for (const std::string& key : keys) fields.push_back(row.contains(key) ? text_of(row[key]) : "");
    table.rows.push_back(std::move(fields));
  }
  return table;
}

/// For the titles of the tables in a row: the name of its stage, else its number.
std::string row_name(const Json& row, std::size_t i) {
  const auto stage = row.find("stage");
  return stage != row.end() && stage->is_string() ? stage->get<std::string>() : fmt::format("{}", i + 1);
}

void add_group(std::vector<ReportTable>& tables, const std::string& key, const Json& group) {
  std::vector<std::pair<std::string, const Json*>> nested;
  ReportTable table{key, heading(in_words(key).text), "", {{"", ""}, {"", ""}, {"unit", ""}}, {}};
  if (group.is_object()) {
    for (const auto& [name, value] : group.items()) {
      if (is_group(value)) {
        nested.emplace_back(name, &value);
        continue;
      }
      const Wording words = in_words(name);
      table.rows.push_back({words.text, text_of(value), words.unit});
    }
  } else {
    table = table_of_rows(key, group);
    for (std::size_t i = 0; i < group.size(); ++i)
      for (const auto& [name, value] : group[i].items())
        if (is_group(value))
          nested.emplace_back(group.size() > 1 ? fmt::format("{} {}", row_name(group[i], i), name) : name,
                              &value);
  }
  if (!table.rows.empty()) tables.push_back(table);
  for (const auto& [name, value] : nested) add_group(tables, key + " " + name, *value);
}

/// The weakest member and its margin of safety as values of the run, for its head.
void add_weakest(ReportRun& run, const Json& json) {
  if (json.contains("smallest_margin_member")) return;  // under the highest design load: the result names it
  if (!json.contains("margins") || !json["margins"].is_object()) return;
  const Json& margins = json["margins"];
  const std::string weakest = margins.value("weakest_member", "");
  for (const Json& member : margins.value("members", Json::array()))
    if (!weakest.empty() && member.value("member", "") == weakest && member.contains("margin_of_safety")) {
      run.values.push_back({"weakest_member", Json(weakest).dump()});
      run.values.push_back({"margin_of_safety", member["margin_of_safety"].dump()});
    }
}

}  // namespace

void add_result(ReportRun& run, const std::string& text, const std::filesystem::path& file) {
  const Json json = parsed(file, text);
  for (const auto& [key, value] : json.items()) {
    if (key == "warnings" && value.is_array())
      run.warnings = value.get<std::vector<std::string>>();
    else if (is_group(value))
      add_group(run.tables, key, value);
    else
      run.values.push_back({key, value.dump(-1, ' ', false, Json::error_handler_t::replace)});
  }
  add_weakest(run, json);
  run.title = json.value("title", "");
  run.converged = json.value("converged", true);
}

std::vector<std::string> headline_of(const std::string& kind) {
  if (kind == "opening")
    return {"peak_load_n",    "low_pass_peak_load_n", "knacke_load_n",
            "weakest_member", "margin_of_safety",     "steady_load_n",
            "filling_time_s", "speed_at_end_m_s",     "max_line_tension_n"};
  if (kind == "flight")
    return {"rate_of_descent_m_s",  "descent_drag_coefficient", "axial_drag_coefficient",
            "glide_ratio",          "mean_oscillation_deg",     "largest_oscillation_deg",
            "oscillation_period_s", "largest_line_force_n",     "load_factor",
            "weakest_member",       "margin_of_safety",         "ended_by"};
  if (kind == "fabric")
    return {"pressure_pa",        "pressure_load_n",   "projected_diameter_m", "projected_over_nominal",
            "max_line_tension_n", "max_von_mises_n_m", "max_cloth_strain"};
  return {"speed_m_s",          "drag_n",         "drag_coefficient", "drag_area_m2", "projected_diameter_m",
          "max_line_tension_n", "weakest_member", "margin_of_safety"};
}

void add_unusable(ReportRun& run) {
  for (const ReportValue& value : run.values)
    if (value.key == "usable" && value.json == "false")
      run.warnings.insert(run.warnings.begin(), "The result of this run must not be used.");
}

ReportTable bill_table(const Settings& resolved) {
  const PatternResult pattern = run_pattern(resolved, {}, packed_by_hand);
  ReportTable table{"bill",
                    "Bill of materials",
                    fmt::format("Cut dimensions with the default allowances, without thread: {:.4g} g, "
                                "{:.3g} litres packed by hand. ripstop pattern writes the pieces to scale.",
                                1000 * pattern.bill.mass, 1000 * pattern.bill.packed_volume),
                    {{"part", ""},
                     {"material", ""},
                     {"count", ""},
                     {"cut each", ""},
                     {"finished", ""},
                     {"cut", ""},
                     {"unit", ""},
                     {"mass", "g"}},
                    {}};
  for (const BillRow& row : pattern.bill.rows)
    table.rows.push_back({row.part, row.material, fmt::format("{}", row.count),
                          fmt::format("{:.3f}", row.cut_each()), fmt::format("{:.3f}", row.finished),
                          fmt::format("{:.3f}", row.cut), row.is_cloth ? "m²" : "m",
                          fmt::format("{:.1f}", 1000 * row.mass)});
  return table;
}

ReportTable sources_table(const Settings& resolved, const std::filesystem::path& run_json) {
  const Json run = parsed(run_json, read_file(run_json));
  const Json written = Json::parse(case_json(resolved));
  ReportTable table{
      "sources", "Default values of the case", "", {{"key", ""}, {"value", ""}, {"source", ""}}, {}};
  for (const Json& source : run.value("sources", Json::array())) {
    const std::string key = source.value("key", "");
    const auto place = pointer_of(key);
    table.rows.push_back(
        {key, written.contains(place) ? text_of(written.at(place)) : "", source.value("from", "")});
  }
  return table;
}

void add_provenance(ReportRun& run, const std::filesystem::path& run_json) {
  const Json json = parsed(run_json, read_file(run_json));
  for (const auto& [key, value] : json.items())
    if (key != "case" && key != "sources") run.provenance.emplace_back(in_words(key).text, text_of(value));
}

double number_of(const ReportRun& run, const std::string& key) {
  for (const ReportValue& value : run.values) {
    if (value.key != key) continue;
    const Json json = Json::parse(value.json);
    if (json.is_number()) return json.get<double>();
  }
  return std::numeric_limits<double>::quiet_NaN();
}

ReportTable comparison_table(const std::vector<ReportRun>& runs) {
  ReportTable table{"comparison",
                    "Comparison of runs",
                    "Differences are relative to the first run.",
                    {{"", ""}, {"unit", ""}},
                    {}};
  for (const ReportRun& run : runs) table.columns.push_back({run.name, ""});
  for (const ReportValue& value : runs.front().values) {
    const Wording words = in_words(value.key);
    std::vector<std::string> row = {words.text, words.unit};
    bool everywhere = true;
    for (const ReportRun& run : runs) {
      const double number = number_of(run, value.key);
      everywhere = everywhere && number == number;
      row.push_back(csv_number(number));
    }
    if (everywhere) table.rows.push_back(row);
  }
  return table;
}

}  // namespace ripstop::inline run
