#include "ripstop/flow/cartesian/near_hem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/checked_int.h"

namespace ripstop::inline flow::cartesian {
namespace {

constexpr double longest_hem = 1e6;  // one edge of a triangle, in cells
constexpr double tied = 1e-9;        // of squares of distances: two edges that meet in a corner
/// An edge is left out if it is farther than another one by these, which are more than `tied` and than rounding.
constexpr double farther = 1 + 1e-6, farther_m = 1e-12;

}  // namespace

double least_width(const std::array<const Axis*, 3>& axes) {
  double least = 1e300;
  for (const Axis* axis : axes)
    least = std::min(least, *std::min_element(axis->width.begin(), axis->width.end()));
  return least;
}

HemsAbout::Segment::Segment(const Hem& hem)
    : from(hem.from),
      along(hem.to - hem.from),
      inward(hem.inward),
      middle(0.5 * (hem.from + hem.to)),
      square(dot(along, along)),
      half(0.5 * norm(along)) {}

Vec3 HemsAbout::Segment::apart(Vec3 point) const {
  const Vec3 away = point - from;
  return away - std::clamp(dot(away, along) / square, 0.0, 1.0) * along;
}

// Points of a face follow each other closely, so the edge nearest to the last one bounds the distance.
bool HemsAbout::ended(Vec3 point) {
  double near = farther * norm(segments_[nearest_]->apart(point)) + farther_m, least = 1e300;
  bool ended = false;
  for (std::size_t n = 0; n < segments_.size(); ++n) {
    const Segment& segment = *segments_[n];
    const Vec3 off = point - segment.middle;
    const double far = near + segment.half;
    if (dot(off, off) > far * far) continue;
    const Vec3 apart = segment.apart(point);
    const double square = dot(apart, apart);
    if (square > least * (1 + tied)) continue;
    const bool out = dot(apart, segment.inward) < 0;
    ended = square < least * (1 - tied) ? out : ended || out;
    least = square;
    nearest_ = n;
  }
  return ended;
}

NearHem::NearHem(const std::array<const Axis*, 3>& axes, const std::array<Places, 3>& edges,
                 const std::vector<Triangle>& surface)
    : axes_(axes), least_width_(least_width(axes)) {
  const std::vector<Hem> all = hems(surface);
  segments_.reserve(all.size());
  for (const Hem& hem : all) segments_.emplace_back(hem);
  marks_.assign(static_cast<std::size_t>(axes[0]->n) * axes[1]->n * axes[2]->n, 0);
  for (std::size_t hem = 0; hem < all.size(); ++hem) mark(hem, all[hem], edges);
}

bool NearHem::at(const std::array<int, 3>& cell) const {
  for (int a = 0; a < 3; ++a)
    if (cell[a] < 0 || cell[a] >= axes_[a]->n) return false;
  return (marks_[index(cell[0], cell[1], cell[2])] & near) != 0;
}

void NearHem::about(const std::array<int, 3>& cell, int axis, HemsAbout& result) const {
  result.clear();
  std::array<int, 3> far{1, 1, 1};
  far[axis] = 2;
  for_cells_about(cell, far, [&](std::size_t c) {
    if ((marks_[c] & passed) == 0) return;
    for (const std::size_t hem : in_cell_.find(c)->second) result.add(segments_[hem]);
  });
}

template <class Visit>
void NearHem::for_cells_about(const std::array<int, 3>& cell, const std::array<int, 3>& far,
                              const Visit& visit) const {
  int low[3], high[3];
  for (int a = 0; a < 3; ++a)
    low[a] = std::max(cell[a] - far[a], 0), high[a] = std::min(cell[a] + far[a], axes_[a]->n - 1);
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) visit(index(i, j, k));
}

void NearHem::mark(std::size_t hem, const Hem& ends, const std::array<Places, 3>& edges) {
  const Vec3 p = ends.from, q = ends.to;
  const int steps = 1 + checked_int(norm(q - p) / least_width_, 0, longest_hem, [&] {
                      return fmt::format(
                          "a free edge of the sheet is {:.3g} m long: its motion has diverged; "
                          "a smaller time step may help",
                          norm(q - p));
                    });
  for (int s = 0; s <= steps; ++s) {
    const Vec3 v = p + (static_cast<double>(s) / steps) * (q - p);
    const double at[] = {v.x, v.y, v.z};
    std::array<int, 3> cell;
    bool outside = false;
    for (int a = 0; a < 3; ++a) {
      cell[a] = edges[a].up_to(at[a]) - 1;
      outside = outside || at[a] < axes_[a]->edge.front() - 2 * axes_[a]->width.front() ||
                at[a] > axes_[a]->edge.back() + 2 * axes_[a]->width.back();
    }
    if (outside) continue;
    for_cells_about(cell, {2, 2, 2}, [&](std::size_t c) { marks_[c] |= near; });
    for (int a = 0; a < 3; ++a) cell[a] = std::clamp(cell[a], 0, axes_[a]->n - 1);
    const std::size_t c = index(cell[0], cell[1], cell[2]);
    marks_[c] |= passed;
    std::vector<std::size_t>& here = in_cell_[c];
    if (here.empty() || here.back() != hem) here.push_back(hem);
  }
}

}  // namespace ripstop::inline flow::cartesian
