// The disk-gap-band canopy: a flat disk with a vent, a gap that only the lines span, a cylindrical band.
#pragma once

#include "ripstop/parachute/family.h"

namespace ripstop::inline parachute {

/// [parachute] with type = "disk-gap-band": a flat disk with a vent, an open gap, a cylindrical band.
struct DiskGapBand {
  static const CanopyFamily family;

  double disk_diameter_m = 0;
  double vent_diameter_m = 0;
  double gap_height_m = 0;
  double band_height_m = 0;
};

void describe(Fields& fields, DiskGapBand& canopy);
void check_shape(const DiskGapBand& canopy, const Design& design, Findings& findings);
Experience experience(const DiskGapBand& canopy);
/// S0 is the cloth's area: disk - vent + band, as [NFM] has it. The lines' run counts from the disk's edge.
CanopyFacts facts(const DiskGapBand& canopy, int gores);
/// Sectors of the disk and panels of the band, one of each a gore.
CutPattern cut_pattern(const DiskGapBand& canopy, const Design& design);

/// Start shape: skirt (the band's lower edge) in the plane z = 0, mouth toward -z, disk flat at z = band +
/// gap, lines straight and taut from the confluence on the axis.
///
/// The disk is a polar lattice whose columns are halved toward the vent wherever they come too close, so that
/// the smallest spring stays near the mean spacing: the finer ring's last row is tied to the coarser ring's
/// first. Where a line is sewn to the cloth it is a chain of about `line_segment_m`, far longer than the
/// cloth's spacing (a short segment of so stiff a line would set the time step); the cloth nodes between are
/// tied to it. Throws Error(usage) when the numbers of gores and lines allow no such lattice.
CanopyMesh build_canopy(const DiskGapBand& canopy, const Design& design, const PartMaterials& materials);

}  // namespace ripstop::inline parachute
