#include "ripstop/run/sizing/pattern.h"

#include <algorithm>

#include "ripstop/case/payload.h"
#include "ripstop/core/file.h"
#include "ripstop/output/pattern_files.h"
#include "ripstop/run/json.h"

namespace ripstop {

std::string to_json(const PatternResult& result) {
  return json_text(result);
}

PatternResult run_pattern(const Settings& resolved, const Allowances& allowances, double packing_density) {
  PatternResult result;
  result.title = resolved.title();
  result.nominal_area = nominal_area(resolved.parachute());
  result.cloth_area = computed_area(resolved.parachute());
  result.packing_density = packing_density;
  result.allowances = allowances;
  result.pattern = cut_pattern(resolved);
  result.bill = parachute_bill(resolved, allowances, packing_density);
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
