// The cutting pattern of the parachute of a case, and its files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/output/pattern_files.h"
#include "ripstop/parachute/cut.h"

namespace ripstop::inline run {

template <Of<BillRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("part", row.part);
  visit("material", row.material);
  visit("count", row.count);
  visit("is_cloth", row.is_cloth);
  visit("finished", row.finished);
  visit("cut", row.cut);
  visit("cut_each", row.cut_each());
  visit("mass_kg", row.mass);
}

template <Of<CutLength> T, class Visit>
void each_member(T& part, Visit&& visit) {
  visit("name", part.name);
  visit("count", part.count);
  visit("length_m", part.length);
}

/// result.json of `ripstop pattern`; finished and cut amounts are [m2] of cloth, else [m].
struct PatternResult {
  std::string title;
  double nominal_area = 0, cloth_area = 0;  // [m2]
  double packing_density = 0;               // [kg/m3]
  Allowances allowances;
  Bill bill;
  std::vector<CutLength> hems;                 // free edges of the cloth
  double line_length = 0, line_on_canopy = 0;  // of each suspension line: to the skirt, and beyond it [m]
  std::vector<std::string> drawings;           // names of the files of the pieces
  CutPattern pattern;                          // not in result.json: it is in the drawings
};
template <Of<PatternResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("nominal_area_m2", r.nominal_area);
  visit("cloth_area_m2", r.cloth_area);
  visit("mass_kg", r.bill.mass);
  visit("packing_density_kg_m3", r.packing_density);
  visit("packed_volume_m3", r.bill.packed_volume);
  visit("seam_allowance_m", r.allowances.seam);
  visit("hem_allowance_m", r.allowances.hem);
  visit("line_loop_m", r.allowances.line_loop);
  visit("tape_overlap_m", r.allowances.tape_overlap);
  visit("bill", r.bill.rows);
  visit("hems", r.hems);
  visit("line_length_m", r.line_length);
  visit("line_on_canopy_m", r.line_on_canopy);
  visit("drawings", r.drawings);
}
std::string to_json(const PatternResult& result);

/// Throws Error(usage) for an allowance or a density outside its range.
PatternResult run_pattern(const Settings& resolved, const Allowances& allowances, double packing_density);

/// How the drawings are written.
struct PatternFiles {
  DxfUnit unit = DxfUnit::millimetres;
  std::optional<Paper> paper;   // also as PDF on sheets of it
  std::string case_file, date;  // for the title block; empty: left out
};

/// Local date for a title block: "2030-01-31".
std::string today();

/// Every piece as DXF and SVG, bill.csv and result.json. Drawings that the result.json of an earlier pattern in this
/// folder lists are removed first. Throws Error(usage) for the folder of a run and as write_pattern_pdf(), Error(io).
void write_pattern(const std::filesystem::path& folder, const PatternResult& result,
                   const PatternFiles& files = {});

inline const Range allowance_range = from(0).up_to(1);            // [m]
inline const Range packing_density_range = from(50).up_to(1500);  // [kg/m3]

}  // namespace ripstop::inline run
