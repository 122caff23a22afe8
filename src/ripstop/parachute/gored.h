// The mesh of any canopy made of equal gores, from its flat pattern.
#pragma once

#include <concepts>

#include "ripstop/parachute/build.h"
#include "ripstop/parachute/cut.h"
#include "ripstop/parachute/gore.h"

namespace ripstop::inline parachute {

/// Start shape as start_profile() has it: skirt seams in the plane z = 0, mouth toward -z, seams at the
/// angles 2 pi k / N. Cloth with fullness bulges outward between the radials, tilted about the strip's upper
/// edge so that its columns keep their length; the rest of the fullness is compressed at the start.
///
/// Every strip is a ring lattice over all gores, columns halved toward the vent as in ring_layout.h. Seams and lines
/// lie on columns. A strip that is not `joined` is attached at the radials only: by shared nodes without a slot, else
/// by lines and tape along the radials. Throws Error(usage) when nothing spans a slot, or when the numbers of gores
/// and lines allow no lattice.
CanopyMesh build_gored(const GorePattern& pattern, const Design& design, const PartMaterials& materials);

/// A family of equal gores: the flat pattern determines everything for which the family has no function of
/// its own.
template <class T>
concept Gored = requires(const T& canopy, int gores) {
  { gore_pattern(canopy, gores) } -> std::same_as<GorePattern>;
};
template <Gored T>
CanopyFacts facts(const T& canopy, int gores) {
  return facts(gore_pattern(canopy, gores));
}
template <Gored T>
CutPattern cut_pattern(const T& canopy, const Design& design) {
  return cut_pattern(gore_pattern(canopy, design.gores), design);
}
template <Gored T>
CanopyMesh build_canopy(const T& canopy, const Design& design, const PartMaterials& materials) {
  return build_gored(gore_pattern(canopy, design.gores), design, materials);
}

/// Whether tape lies along the lower or the upper edge of a strip; a joint has it once, as a lower edge.
bool has_hem_tape(const Design& design, const GorePattern& pattern, std::size_t strip, bool upper);

}  // namespace ripstop::inline parachute
