// Whether cloth has passed through cloth, asked of its surface and not of the contact's nodes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ripstop/cloth/layout.h"
#include "ripstop/core/error.h"

namespace ripstop::inline cloth {
namespace {

constexpr double neighbourhood = 3;  // edges: cells that are closer on the cloth may touch
constexpr double farthest =
    1e15;  // from the origin, in widths: whole numbers of a double are exact up to here

/// Of the segment p-q and the triangle a, b, c (Moeller and Trumbore 1997).
bool pierces(Vec3 p, Vec3 q, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 along = q - p, u = b - a, v = c - a, h = cross(along, v);
  const double det = dot(u, h);
  if (det == 0) return false;
  const Vec3 s = p - a, k = cross(s, u);
  const double first = dot(s, h) / det, second = dot(along, k) / det, place = dot(v, k) / det;
  return first >= 0 && second >= 0 && first + second <= 1 && place >= 0 && place <= 1;
}

struct Edge {
  int a, b;
};

std::vector<Edge> edges_of(const std::vector<Cell>& cells) {
  std::vector<std::pair<int, int>> ends;
  for (const Cell& cell : cells)
    for (int k = 0; k < 4 && cell.corner[0] >= 0; ++k)
      ends.push_back(std::minmax(cell.corner[k], cell.corner[(k + 1) % 4]));
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Edge> edges;
  for (const auto& [a, b] : ends)
    if (a != b) edges.push_back({a, b});
  return edges;
}

using Place = std::array<long long, 3>;

Place square_of(Vec3 x, double width) {
  const auto along = [&](double a) { return std::llround(std::clamp(a / width, -farthest, farthest)); };
  return {along(x.x), along(x.y), along(x.z)};
}

}  // namespace

double pierced_share(const Mesh& mesh, const std::vector<Vec3>& x) {
  const std::vector<Cell> cells = cells_of(mesh);
  const std::vector<Edge> edges = edges_of(cells);
  if (edges.empty()) return 0;
  for (const Edge& edge : edges)
    for (const int node : {edge.a, edge.b})
      if (!is_finite(x[node]))
        throw Error(ExitCode::diverged, fmt::format("pierced cloth: node {} ({}) has no finite position",
                                                    node, place_of(mesh, node)));
  // Middles of an edge and a cell that meet are nearer than half the longest edge and half the longest diagonal.
  double width = 0;
  std::vector<std::pair<Place, int>> placed;
  const auto middle = [&](const Cell& cell) {
    return 0.25 * (x[cell.corner[0]] + x[cell.corner[1]] + x[cell.corner[2]] + x[cell.corner[3]]);
  };
  for (const Cell& cell : cells)
    for (int k = 0; k < 4 && cell.corner[0] >= 0; ++k) {
      width = std::max(width, norm(x[cell.corner[k]] - middle(cell)));
      width = std::max(width, norm(x[cell.corner[(k + 1) % 4]] - x[cell.corner[k]]));
    }
  if (!(width > 0)) return 0;
  width *= 1.5;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].corner[0] >= 0) placed.push_back({square_of(middle(cells[i]), width), static_cast<int>(i)});
  std::sort(placed.begin(), placed.end());

  const auto neighbours = [&](const Edge& edge, const Cell& cell) {
    const double length = norm(mesh.start[edge.b] - mesh.start[edge.a]);
    double nearest = std::numeric_limits<double>::infinity();
    for (const int corner : cell.corner)
      for (const int end : {edge.a, edge.b})
        nearest = std::min(nearest, norm(mesh.start[corner] - mesh.start[end]));
    return nearest < neighbourhood * length;
  };
  const auto is_pierced_by = [&](const Edge& edge, const Cell& cell) {
    const auto& c = cell.corner;
    const Vec3 p = x[edge.a], q = x[edge.b];
    return (pierces(p, q, x[c[0]], x[c[1]], x[c[2]]) || pierces(p, q, x[c[0]], x[c[2]], x[c[3]])) &&
           !neighbours(edge, cell);
  };
  const auto pierces_any = [&](const Edge& edge) {
    const Place centre = square_of(0.5 * (x[edge.a] + x[edge.b]), width);
    for (long long dx = -1; dx <= 1; ++dx)
      for (long long dy = -1; dy <= 1; ++dy) {
        const Place from{centre[0] + dx, centre[1] + dy, centre[2] - 1};
        const Place past{from[0], from[1], centre[2] + 2};
        auto at = std::lower_bound(placed.begin(), placed.end(), std::pair{from, -1});
        for (; at != placed.end() && at->first < past; ++at)
          if (is_pierced_by(edge, cells[at->second])) return true;
      }
    return false;
  };
  const auto count = std::count_if(edges.begin(), edges.end(), pierces_any);
  return static_cast<double>(count) / static_cast<double>(edges.size());
}

}  // namespace ripstop::inline cloth
