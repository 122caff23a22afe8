// Known data of a canopy family, for comparison with computed values.
#pragma once

#include <array>
#include <optional>

namespace ripstop::inline parachute {

struct KnownRange {
  double low = 0, high = 0;  // 0: not known

  std::optional<std::array<double, 2>> if_known() const {
    return high > 0 ? std::optional(std::array{low, high}) : std::nullopt;
  }
};

/// Ranges and C_x from T. W. Knacke, Parachute Recovery Systems Design Manual, NWC TP 6575 (1991), Tables 5-1
/// (solid textile) and 5-2 (slotted canopies); the projected ratios are not checked against the print.
struct Experience {
  KnownRange projected_ratio;  // projected over nominal diameter in steady flight
  KnownRange
      drag_coefficient;  // on the nominal area, in descent: includes the motion of canopies that oscillate and glide
  double opening_coefficient = 0;  // C_x: peak over steady drag at infinite mass
  const char* opening_source = "";
  /// Largest tension of a suspension line over the mean of all lines in steady flow; 1: not computed. Of the example
  /// of the family: `ripstop steady examples/<family>/case.toml`, lines.csv.
  double line_load_factor = 1;
  /// Cloth nodes from which on the projected diameter under uniform pressure changes by less than 1 % when the mesh
  /// is made finer. Measured on the examples, with wrinkled and taut cloth, from 1,500 to 25,000 nodes
  /// (docs/guide/canopies.md, How fine a mesh). The error depends on the spacing over the size of the canopy, so the
  /// number is valid for other sizes.
  int cloth_nodes = 0;
  /// Radius of the folded skirt over the nominal diameter where a closed mouth is requested without a radius: one at
  /// which the example folds with a strain below 1e-3 and without pierced edges (tests/case/deployment_test.cpp).
  double closed_mouth = 0.04;
};

/// C_x and the ranges of the drag coefficient agree with crates/hpr-sim/src/recovery.rs of github.com/nrdptel/hpr-sim,
/// which names the printed pages 5-3 and 5-4; C_x of the solid canopies also with parachute_design.m of the Stanford
/// Student Space Initiative. The disk-gap-band is in neither: C_x and drag agree with the table as OSCALC's manual
/// reprints it (mwitty.com/content.php?id=5709156, text by character recognition).
inline constexpr const char* knacke_transcribed =
    "Knacke, NWC TP 6575, Tables 5-1 and 5-2, infinite mass; value agrees with a public transcription, not "
    "verified in print";

/// Of a shape that the tables do not have, with its required nodes and closed mouth.
constexpr Experience untabulated(int cloth_nodes, double closed_mouth) {
  return {
      .projected_ratio = {},
      .drag_coefficient = {},
      .opening_coefficient = 1.8,
      .opening_source = "not in Knacke's tables: the largest value of the solid canopies, on the safe side",
      .cloth_nodes = cloth_nodes,
      .closed_mouth = closed_mouth};
}

}  // namespace ripstop::inline parachute
