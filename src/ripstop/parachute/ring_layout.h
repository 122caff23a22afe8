// How many columns and rows a canopy's strips of cloth get, so that springs stay near the mean spacing.
#pragma once

#include <functional>
#include <vector>

#include "ripstop/parachute/design.h"

namespace ripstop::inline parachute {

/// A strip of cloth right round the canopy, from its lower edge toward the vent.
struct Strip {
  double length = 0;                                     // along the meridian [m]
  std::function<double(double distance)> circumference;  // as cut, `distance` [m] above the lower edge [m]
  bool whole = false;                                    // columns change only at its edges
};

/// A part of a strip with a constant number of columns.
struct Ring {
  int columns = 0;
  double from = 0, to = 0;          // distances above the strip's lower edge [m]
  int cells = 0;                    // along the meridian
  std::vector<double> graded = {};  // of every row above `from` [m]; empty: equally spaced

  double rise(int row) const { return graded.empty() ? (to - from) * row / cells : graded[row]; }
};

struct RingLayout {
  std::vector<std::vector<Ring>> strips;

  int nodes() const;
};

/// The layout whose node count is nearest to `design.mesh.cloth_nodes`, among those whose columns meet every gore
/// seam and every line. Columns are halved toward the vent wherever they come too close; of two neighbouring rings
/// one has as many columns as the other, or half. Throws Error(usage) when there are too few nodes for the numbers of
/// gores and lines. For cloth cut on the bias the rows are spaced like the columns, since its cells have to be nearly
/// square; the node count is then met as far as the numbers of columns allow.
RingLayout lay_out_rings(const std::vector<Strip>& strips, double cloth_area, const Design& design);

}  // namespace ripstop::inline parachute
