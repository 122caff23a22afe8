#include "ripstop/run/opening/filling.h"

#include <cmath>

#include "ripstop/core/units.h"

namespace ripstop::inline run {
namespace {

// n: Knacke, NWC TP 6575, Table 5-6 (page 5-44), unreefed. Pflanz's exponents: his Fig. 5-51 (page 5-59), 1 for ribbon
// and ringslot, 2 for flat circular, conical and extended skirt. Both were read in github.com/nrdptel/hpr-sim,
// crates/hpr-sim/src/recovery.rs, which names these pages. Ludtke's 6 for solid cloth: the comment of his program (its
// transcription to C, in a public repository), which has 1 for ribbon; his 2 for slotted canopies is from memory.
constexpr const char* handbook = "Knacke Table 5-6 and Fig. 5-51, Ludtke's program; read in transcriptions";
constexpr const char* without_n = "Knacke Fig. 5-51; n not in his table: as flat circular (assumed)";
constexpr const char* without_exponents = "Knacke Table 5-6; exponents as solid cloth (assumed)";
constexpr const char* slotted =
    "Knacke Table 5-6 and Fig. 5-51, read in a transcription; Ludtke's exponent not verified";
constexpr const char* slotted_without_exponents =
    "Knacke Table 5-6, read in a transcription; exponents as solid cloth, Ludtke's not verified (assumed)";
constexpr const char* as_solid = "not in the tables: as solid flat circular (assumed)";
constexpr const char* as_slotted = "not in the tables: between ringslot and ringsail (assumed)";

struct Row {
  const char* type;
  KnownFilling filling;
};
constexpr Row table_rows[] = {
    {"flat-circular", {8, 2, 6, handbook}},    {"conical", {8, 2, 6, without_n}},
    {"extended-skirt", {10, 2, 6, handbook}},  {"cross", {11.7, 2, 6, without_exponents}},
    {"ringslot", {14, 1, 2, slotted}},         {"ringsail", {7, 2, 2, slotted_without_exponents}},
    {"disk-gap-band", {10, 2, 2, as_slotted}},
};

}  // namespace

double slow_filling_coefficient(double constant) {
  constexpr double flat_circular = 8;
  return constant / flat_circular * 4.0;
}

double filling_constant_at(double constant, double speed) {
  constexpr double lowest = 150;     // [ft/s]
  const double feet = speed / foot;  // [ft/s]
  return feet < lowest ? slow_filling_coefficient(constant) * std::pow(feet, 0.15) : constant;
}

KnownFilling known_filling(const std::string& type) {
  for (const Row& row : table_rows)
    if (type == row.type) return row.filling;
  return {8, 2, 6, as_solid};
}

}  // namespace ripstop::inline run
