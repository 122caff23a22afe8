#include "ripstop/run/sizing/pattern.h"

#include <algorithm>

#include "ripstop/case/assemble.h"
#include "ripstop/core/file.h"
#include "ripstop/output/pattern_files.h"
#include "ripstop/run/json.h"

namespace ripstop {

std::string to_json(const PatternResult& result) {
  return json_text(result);
}

PatternResult run_pattern(const Case& given, const Allowances& allowances, double packing_density) {
  PatternResult result;
  result.title = given.title;
  result.nominal_area = nominal_area(given.parachute);
  result.cloth_area = computed_area(given.parachute);
  result.packing_density = packing_density;
  result.allowances = allowances;
  result.pattern = cut_pattern(given.parachute);
  if (!reinforcement_tape(given)) result.pattern.tapes.clear();
  result.bill = bill_of(result.pattern, given.parachute, part_materials(given), allowances, packing_density);
  return result;
}

void write_pattern(const std::filesystem::path& folder, const PatternResult& result) {
  make_folder(folder);
  for (const Piece& piece : result.pattern.pieces) {
    std::string name = piece.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    write_pattern_dxf(folder / (name + ".dxf"), piece, result.allowances);
    write_pattern_svg(folder / (name + ".svg"), piece, result.allowances);
  }
  write_bill_csv(folder / "bill.csv", result.bill);
  write_file(folder / "result.json", to_json(result));
}

}  // namespace ripstop
