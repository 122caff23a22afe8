#include "ripstop/fsi/pressure_profile.h"

#include <algorithm>
#include <cmath>

#include "ripstop/core/checked_int.h"

namespace ripstop::inline fsi {

std::vector<PressureRing> pressure_profile(const std::vector<Cell>& cells, const std::vector<Vec3>& x,
                                           const SidePressures& sides, const std::vector<double>& load,
                                           int rings) {
  struct Piece {
    double along, area;
    PressureRing at;
  };
  std::vector<Piece> pieces;
  double first = INFINITY, last = -INFINITY;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto [i, j, k, l] = cells[c].corner;
    if (i < 0) continue;
    const Vec3 p = 0.25 * (x[i] + x[j] + x[k] + x[l]);
    const double radius = std::hypot(p.x, p.y), along = radius - p.z;
    first = std::min(first, along), last = std::max(last, along);
    pieces.push_back({along,
                      norm(area_vector(x[i], x[j], x[k], x[l])),
                      {0, radius, p.z, sides.inside[c], sides.outside[c], load[c]}});
  }
  std::vector<PressureRing> profile(rings);
  std::vector<double> area(rings, 0.0);
  for (const Piece& piece : pieces) {
    const double share = last > first ? (piece.along - first) / (last - first) : 0;
    const int ring = std::min(rings - 1, checked_int(share * rings, 0, rings, [] {
                                return "pressures along the gores: a position of the cloth is not finite";
                              }));
    area[ring] += piece.area;
    for (double PressureRing::*value : {&PressureRing::radius, &PressureRing::z, &PressureRing::inside,
                                        &PressureRing::outside, &PressureRing::load})
      profile[ring].*value += piece.area * (piece.at.*value);
  }
  std::vector<PressureRing> result;
  for (int ring = 0; ring < rings; ++ring) {
    if (!(area[ring] > 0)) continue;
    for (double PressureRing::*value : {&PressureRing::radius, &PressureRing::z, &PressureRing::inside,
                                        &PressureRing::outside, &PressureRing::load})
      profile[ring].*value /= area[ring];
    if (!result.empty()) {
      const PressureRing& before = result.back();
      profile[ring].arc =
          before.arc + std::hypot(profile[ring].radius - before.radius, profile[ring].z - before.z);
    }
    result.push_back(profile[ring]);
  }
  return result;
}

}  // namespace ripstop::inline fsi
