#include "ripstop/run/filling.h"

namespace ripstop {
namespace {

// n: Knacke, NWC TP 6575, Table 5-6, unreefed; Pflanz's exponents: Fig. 5-51, 1 for ribbon and ringslot, 2 for solid
// cloth; Ludtke's: 6 for solid cloth (NOLTR 72-146), 2 for ringslot. Written
// down from memory, none checked against the print.
constexpr const char* handbook =
    "Knacke Table 5-6 and Fig. 5-51, Ludtke NOLTR 72-146; not checked against the prints";
constexpr const char* as_solid = "not in the tables: as solid flat circular (assumed)";
constexpr const char* as_slotted = "not in the tables: between ringslot and ringsail (assumed)";

struct Row {
  const char* type;
  KnownFilling filling;
};
constexpr Row rows[] = {
    {"flat-circular", {8, 2, 6, handbook}},    {"conical", {8, 2, 6, handbook}},
    {"extended-skirt", {10, 2, 6, handbook}},  {"cross", {11.7, 2, 6, handbook}},
    {"ringslot", {14, 1, 2, handbook}},        {"ringsail", {7, 2, 2, handbook}},
    {"disk-gap-band", {10, 2, 2, as_slotted}},
};

}  // namespace

KnownFilling known_filling(const std::string& type) {
  for (const Row& row : rows)
    if (type == row.type) return row.filling;
  return {8, 2, 6, as_solid};
}

}  // namespace ripstop
