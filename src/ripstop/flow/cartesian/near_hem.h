// The free edges of a sheet on a grid: which cells are near them, and whether the sheet has ended at a point.
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/cartesian/grid.h"
#include "ripstop/flow/cartesian/places.h"
#include "ripstop/flow/flow.h"
#include "ripstop/flow/hems.h"

namespace ripstop::inline flow::cartesian {

/// Free edges about a face.
class HemsAbout {
 public:
  struct Segment {
    explicit Segment(const Hem& hem);
    /// From its nearest point to this one.
    Vec3 apart(Vec3 point) const;

    Vec3 from, along, inward, middle;
    double square = 0, half = 0;  // of its length [m2], [m]
  };

  void clear() { segments_.clear(), nearest_ = 0; }
  bool empty() const { return segments_.empty(); }
  void add(const Segment& segment) { segments_.push_back(&segment); }
  /// Whether the sheet ends before it gets to where a point is, by the edge that is nearest to it.
  bool ended(Vec3 point);

 private:
  std::vector<const Segment*> segments_;
  std::size_t nearest_ = 0;  // to the last point
};

/// The free edges of a sheet, and the cells within two cells of them.
class NearHem {
 public:
  /// `edges` of the cells, one set an axis.
  NearHem(const std::array<const Axis*, 3>& axes, const std::array<Places, 3>& edges,
          const std::vector<Triangle>& surface);

  /// False for a cell outside the box.
  bool at(const std::array<int, 3>& cell) const;
  /// Those within two cells of one along an axis, and one to the sides.
  void about(const std::array<int, 3>& cell, int axis, HemsAbout& result) const;

 private:
  static constexpr char near = 1, passed = 2;  // marks of a cell

  std::size_t index(int i, int j, int k) const {
    return i + static_cast<std::size_t>(axes_[0]->n) * (j + static_cast<std::size_t>(axes_[1]->n) * k);
  }
  template <class Visit>
  void for_cells_about(const std::array<int, 3>& cell, const std::array<int, 3>& far,
                       const Visit& visit) const;
  void mark(std::size_t hem, const Hem& ends, const std::array<Places, 3>& edges);

  std::array<const Axis*, 3> axes_;
  std::vector<HemsAbout::Segment> segments_;
  double least_width_;
  std::vector<char> marks_;
  std::unordered_map<std::size_t, std::vector<std::size_t>> in_cell_;  // edges that pass through it
};

/// Of all cells.
double least_width(const std::array<const Axis*, 3>& axes);

}  // namespace ripstop::inline flow::cartesian
