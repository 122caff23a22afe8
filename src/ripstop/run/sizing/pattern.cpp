#include "ripstop/run/sizing/pattern.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <utility>

#include "ripstop/case/payload.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/file.h"
#include "ripstop/core/positive.h"
#include "ripstop/output/pattern_files.h"
#include "ripstop/run/json.h"

namespace ripstop::inline run {
namespace {

std::string drawing_name(const Piece& piece, const char* ending) {
  std::string name = piece.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name + ending;
}

/// Files of an earlier pattern would be cut together with the new ones.
void remove_earlier_drawings(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "result.json";
  if (!std::filesystem::exists(file)) return;
  const auto earlier = nlohmann::json::parse(read_file(file), nullptr, false);
  if (!earlier.is_object() || !earlier.contains("bill") || !earlier.contains("drawings")) return;
  const auto& names = earlier["drawings"];
  for (const auto& entry : names) {
    if (!entry.is_string()) continue;
    const std::filesystem::path name = entry.get<std::string>();
    const bool drawing =
        name.extension() == ".dxf" || name.extension() == ".svg" || name.extension() == ".pdf";
    if (drawing && !name.has_parent_path()) remove_path(folder / name);
  }
}

}  // namespace

std::string today() {
  return fmt::format("{:%Y-%m-%d}", fmt::localtime(std::time(nullptr)));
}

std::string to_json(const PatternResult& result) {
  return json_text(result);
}

PatternResult run_pattern(const Settings& resolved, const Allowances& allowances, double packing_density) {
  const std::pair<const char*, double> lengths[] = {{"seam allowance (m)", allowances.seam},
                                                    {"hem allowance (m)", allowances.hem},
                                                    {"line loop (m)", allowances.line_loop},
                                                    {"tape overlap (m)", allowances.tape_overlap}};
  for (const auto& [name, length] : lengths)
    require_within(name, length, allowance_range.low, allowance_range.high);
  require_within("packing density (kg/m3)", packing_density, packing_density_range.low,
                 packing_density_range.high);
  PatternResult result;
  result.title = resolved.title();
  result.nominal_area = nominal_area(resolved.parachute());
  result.cloth_area = computed_area(resolved.parachute());
  result.packing_density = packing_density;
  result.allowances = allowances;
  result.pattern = cut_pattern(resolved);
  result.hems = hems_of(result.pattern);
  result.line_length = resolved.parachute().lines.length_m;
  result.line_on_canopy = result.pattern.line_on_canopy;
  result.bill = parachute_bill(resolved, allowances, packing_density);
  for (const Piece& piece : result.pattern.pieces)
    for (const char* ending : {".dxf", ".svg"}) result.drawings.push_back(drawing_name(piece, ending));
  return result;
}

void write_pattern(const std::filesystem::path& folder, const PatternResult& result,
                   const PatternFiles& files) {
  make_results_folder(folder, "pattern");
  remove_earlier_drawings(folder);
  const PatternHead head{result.title, files.case_file, files.date};
  PatternResult written = result;
  for (const Piece& piece : result.pattern.pieces) {
    write_pattern_dxf(folder / drawing_name(piece, ".dxf"), piece, result.allowances, files.unit, head);
    write_pattern_svg(folder / drawing_name(piece, ".svg"), piece, result.allowances, head);
    if (!files.paper) continue;
    written.drawings.push_back(drawing_name(piece, *files.paper == Paper::a4 ? "-a4.pdf" : "-letter.pdf"));
    write_pattern_pdf(folder / written.drawings.back(), piece, result.allowances, *files.paper, head);
  }
  write_bill_csv(folder / "bill.csv", result.bill);
  write_file(folder / "result.json", to_json(written));
}

}  // namespace ripstop::inline run
