#include "ripstop/fsi/cluster_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ripstop/core/angle.h"
#include "ripstop/core/error.h"
#include "ripstop/fsi/summary.h"

namespace ripstop::inline fsi {
namespace {

/// Mean and standard deviation over time.
struct OverTime {
  double weight = 0, sum = 0, squares = 0;

  void add(double value, double length) {
    weight += length, sum += length * value, squares += length * value * value;
  }
  double mean() const { return sum / weight; }
  double deviation() const { return std::sqrt(std::max(0.0, squares / weight - mean() * mean())); }
};

/// Points along a line, and how far along it.
struct Along {
  double at;
  Vec3 point;
};
std::vector<Along> sorted_along(const std::vector<Vec3>& points, Vec3 line) {
  std::vector<Along> sorted;
  for (const Vec3 p : points) sorted.push_back({dot(p, line), p});
  std::sort(sorted.begin(), sorted.end(), [](const Along& a, const Along& b) { return a.at < b.at; });
  return sorted;
}

Vec3 middle_of(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (const Vec3 p : points) sum += p;
  return sum / double(points.size());
}

Vec3 centre_of(const std::vector<int>& nodes, const std::vector<Vec3>& x) {
  Vec3 sum;
  for (const int n : nodes) sum += x[n];
  return sum / double(nodes.size());
}

}  // namespace

std::vector<double> mouth_areas(const std::vector<Cell>& cells, const std::vector<Vec3>& x, int canopies) {
  std::vector<double> areas;
  const std::size_t count = cells.size() / static_cast<std::size_t>(canopies);
  for (std::size_t first = 0; first < cells.size(); first += count) {
    Vec3 sum;
    for (std::size_t i = first; i < first + count; ++i)
      if (const Cell& c = cells[i]; c.corner[0] >= 0)
        sum += area_vector(x[c.corner[0]], x[c.corner[1]], x[c.corner[2]], x[c.corner[3]]);
    areas.push_back(norm(sum));
  }
  return areas;
}

std::vector<Vec3> riser_forces(const CanopyMesh& mesh, const std::vector<Vec3>& x,
                               const std::vector<double>& tensions, int payload) {
  const std::size_t canopies = static_cast<std::size_t>(mesh.rigging.canopies),
                    count = mesh.springs.size() / canopies;
  std::vector<Vec3> forces(canopies);
  for (std::size_t s = 0; s < mesh.springs.size(); ++s) {
    const Spring& spring = mesh.springs[s];
    if (spring.a != payload && spring.b != payload) continue;
    const Vec3 d = x[spring.a == payload ? spring.b : spring.a] - x[payload];
    forces[s / count] += (tensions[s] / norm(d)) * d;
  }
  return forces;
}

// Both sets are sorted along the line between their centres: points that are farther apart on it than the smallest
// distance so far need no comparison.
double smallest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const Vec3 between = middle_of(b) - middle_of(a);
  const Vec3 line = norm(between) > 0 ? between / norm(between) : Vec3{1, 0, 0};
  const std::vector<Along> low = sorted_along(a, line), high = sorted_along(b, line);
  double least = std::numeric_limits<double>::infinity();
  for (auto p = low.rbegin(); p != low.rend(); ++p) {
    auto q = std::lower_bound(high.begin(), high.end(), p->at - least,
                              [](const Along& one, double at) { return one.at < at; });
    for (; q != high.end() && q->at - p->at < least; ++q) least = std::min(least, norm(q->point - p->point));
  }
  return least;
}

std::vector<double> canopy_gaps(const CanopyMesh& mesh, const std::vector<Cell>& cells,
                                const std::vector<Vec3>& x) {
  const int canopies = mesh.rigging.canopies;
  std::vector<char> cloth(x.size(), 0);
  std::vector<std::vector<Vec3>> points(static_cast<std::size_t>(canopies));
  const std::size_t count = cells.size() / points.size();
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (const int node : cells[i].corner)
      if (node >= 0 && !cloth[node]) cloth[node] = 1, points[i / count].push_back(x[node]);
  std::vector<double> gaps(points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < points.size(); ++k)
    for (std::size_t other = 0; other < k; ++other) {
      const double gap = smallest_distance(points[k], points[other]);
      gaps[k] = std::min(gaps[k], gap), gaps[other] = std::min(gaps[other], gap);
    }
  return gaps;
}

std::vector<CanopyRow> canopy_rows(const CanopyMesh& mesh, const Cloth& cloth, const ClothState& state,
                                   int payload) {
  const int canopies = mesh.rigging.canopies;
  const std::vector<Vec3> x = positions(state, cloth);
  const std::vector<Cell> cells = cells_of(mesh);
  const std::vector<double> mouth = mouth_areas(cells, x, canopies), gap = canopy_gaps(mesh, cells, x);
  const std::vector<Vec3> pull = riser_forces(mesh, x, spring_tensions(cloth, state), payload);
  const Vec3 all = skirt_centroid(mesh, x), axis = all - x[payload];
  std::vector<CanopyRow> rows;
  for (int k = 0; k < canopies; ++k) {
    const auto index = static_cast<std::size_t>(k);
    const Vec3 skirt = centre_of(of_canopy(mesh.rigging.skirt_nodes, k, canopies), x),
               line = skirt - x[payload], aside = skirt - all;
    rows.push_back({state.time, k + 1.0, std::atan2(norm(cross(line, axis)), dot(line, axis)) / degree,
                    std::atan2(aside.y, aside.x) / degree, norm(pull[index]), mouth[index], gap[index]});
  }
  return rows;
}

ClusterMotion summarise_cluster(const std::vector<CanopyRow>& rows, int canopies, double begin, double from,
                                double contact_gap) {
  if (rows.empty() || !(rows.back().time > from))
    throw Error(ExitCode::usage, "a flight without a step after its start-up has no mean");
  ClusterMotion motion;
  motion.contact_gap = contact_gap, motion.smallest_gap = std::numeric_limits<double>::infinity();
  motion.canopies.resize(static_cast<std::size_t>(canopies));
  std::vector<OverTime> spread(motion.canopies.size()), load = spread, mouth = spread;
  OverTime mean, contact;
  double before = begin;
  for (std::size_t i = 0; i + motion.canopies.size() <= rows.size(); i += motion.canopies.size()) {
    const double time = rows[i].time, length = time - before;
    double of_all = 0, gap = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < motion.canopies.size(); ++k) {
      const CanopyRow& row = rows[i + k];
      CanopyMotion& canopy = motion.canopies[k];
      if (row.riser_load > canopy.largest_load)
        canopy.largest_load = row.riser_load, canopy.largest_load_time = time;
      gap = std::min(gap, row.gap);
      of_all += row.spread / canopies;
      if (!(time > from)) continue;
      spread[k].add(row.spread, length), load[k].add(row.riser_load, length);
      mouth[k].add(row.mouth_area, length);
    }
    if (time > from) mean.add(of_all, length);
    if (gap < motion.smallest_gap) motion.smallest_gap = gap, motion.smallest_gap_time = time;
    if (gap < contact_gap && !motion.first_contact) motion.first_contact = time;
    contact.add(gap < contact_gap ? 1 : 0, length);
    before = time;
  }
  for (std::size_t k = 0; k < motion.canopies.size(); ++k) {
    CanopyMotion& canopy = motion.canopies[k];
    canopy.mean_spread = spread[k].mean(), canopy.spread_deviation = spread[k].deviation();
    canopy.mean_load = load[k].mean(), canopy.mean_mouth_area = mouth[k].mean();
  }
  motion.mean_spread = mean.mean(), motion.spread_deviation = mean.deviation();
  motion.contact_share = contact.mean();
  return motion;
}

ClusterOpening summarise_openings(const std::vector<CanopyRow>& rows, int canopies, double start_up,
                                  const std::vector<double>& delays) {
  constexpr double last = 0.8;  // of the opening
  if (rows.empty()) throw Error(ExitCode::usage, "an opening without a row has no loads");
  ClusterOpening opening;
  opening.canopies.resize(static_cast<std::size_t>(canopies));
  const double from = last * rows.back().time;
  std::vector<OverTime> load(opening.canopies.size());
  std::vector<std::vector<AreaAt>> mouth(opening.canopies.size());
  const auto of_row = [](const CanopyRow& row) { return static_cast<std::size_t>(row.canopy) - 1; };
  opening.smallest_gap = std::numeric_limits<double>::infinity();
  for (const CanopyRow& row : rows) {
    CanopyOpening& canopy = opening.canopies[of_row(row)];
    if (row.time > start_up && row.riser_load > canopy.peak_load)
      canopy.peak_load = row.riser_load, canopy.peak_time = row.time;
    if (row.gap < opening.smallest_gap) opening.smallest_gap = row.gap, opening.smallest_gap_time = row.time;
    if (row.time > from) load[of_row(row)].add(row.riser_load, 1);
    mouth[of_row(row)].push_back({row.time, row.mouth_area});
    canopy.last_spread = row.spread;
  }
  for (std::size_t k = 0; k < load.size(); ++k) {
    CanopyOpening& canopy = opening.canopies[k];
    canopy.last_load = load[k].mean();
    if (!delays.empty()) canopy.delay = delays[k];
    if (const auto filling = filling_of(mouth[k])) canopy.filling_time = filling->time;
  }
  const auto [first, second] = std::minmax_element(
      opening.canopies.begin(), opening.canopies.end(),
      [](const CanopyOpening& a, const CanopyOpening& b) { return a.peak_time < b.peak_time; });
  opening.peak_difference = second->peak_time - first->peak_time;
  double earliest = std::numeric_limits<double>::infinity(), latest = 0;
  for (const CanopyOpening& canopy : opening.canopies) {
    if (!canopy.filling_time) return opening;
    earliest = std::min(earliest, *canopy.filling_time), latest = std::max(latest, *canopy.filling_time);
  }
  opening.filling_difference = latest - earliest;
  return opening;
}

}  // namespace ripstop::inline fsi
