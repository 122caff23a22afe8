#include "ripstop/flow/cartesian/sheet_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "ripstop/core/checked_int.h"
#include "ripstop/flow/hems.h"

namespace ripstop::inline flow::cartesian {
namespace {

constexpr int lines = 5;  // a cell and direction; odd, so that one goes through the centre
constexpr int centre_line = lines / 2;
constexpr int finer = 3;         // points at a free edge for each line and direction
constexpr double reach = 1.5;    // cells: hits of neighbouring lines that belong to one crossing ...
constexpr double longest = 6.0;  // ... and the largest addition where the sheet is slanted

/// In cells. On which side of the sheet a cell's centre lies is decided with the sheet moved by this much. Where the
/// centre is on the sheet to rounding, the lines through it would otherwise disagree, and air would pass the cell.
constexpr Vec3 nudge{1e-9, 0.71e-9, 0.43e-9};

constexpr double longest_hem = 1e6;  // one edge of a triangle, in cells
using Point = std::array<double, 3>;

Point point_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

/// Cell of an axis that contains x; -1 or n outside.
int cell_at(const Axis& axis, double x) {
  if (x < axis.edge.front()) return -1;
  return static_cast<int>(std::upper_bound(axis.edge.begin(), axis.edge.end(), x) - axis.edge.begin()) - 1;
}

double centre(const Axis& axis, int c) {
  return 0.5 * (axis.edge[c] + axis.edge[c + 1]);
}

double least_width(const std::array<const Axis*, 3>& axes) {
  double least = 1e300;
  for (const Axis* axis : axes)
    least = std::min(least, *std::min_element(axis->width.begin(), axis->width.end()));
  return least;
}

/// Whether the sheet ends before it gets to where a point is, by the hem that is nearest to it.
bool ended(Vec3 point, const std::vector<Hem>& hems) {
  double least = 1e300;
  bool ended = false;
  for (const Hem& hem : hems) {
    const Vec3 along = hem.to - hem.from, from = point - hem.from;
    const double share = std::clamp(dot(from, along) / dot(along, along), 0.0, 1.0);
    const Vec3 apart = from - share * along;
    const double square = dot(apart, apart);
    if (square > least * (1 + 1e-9)) continue;
    const bool out = dot(apart, hem.inward) < 0;
    ended = square < least * (1 - 1e-9) ? out : ended || out;  // two that meet in a corner
    least = square;
  }
  return ended;
}

/// The free edges, and the cells within two cells of them.
class NearHem {
 public:
  NearHem(const std::array<const Axis*, 3>& axes, const std::vector<Triangle>& surface)
      : axes_(axes), hems_(hems(surface)), least_width_(least_width(axes)) {
    near_.assign(static_cast<std::size_t>(axes[0]->n) * axes[1]->n * axes[2]->n, 0);
    for (std::size_t hem = 0; hem < hems_.size(); ++hem) mark(hem);
  }

  bool at(const Point& p) const {
    int c[3];
    for (int a = 0; a < 3; ++a) {
      c[a] = cell_at(*axes_[a], p[a]);
      if (c[a] < 0 || c[a] >= axes_[a]->n) return false;
    }
    return near_[index(c[0], c[1], c[2])] != 0;
  }

  /// Those within two cells of one along an axis, and one to the sides.
  std::vector<Hem> about(const std::array<int, 3>& cell, int axis) const {
    std::vector<Hem> result;
    std::array<int, 3> far{1, 1, 1};
    far[axis] = 2;
    for_cells_about(cell, far, [&](std::size_t c) {
      const auto found = in_cell_.find(c);
      if (found == in_cell_.end()) return;
      for (const std::size_t hem : found->second) result.push_back(hems_[hem]);
    });
    return result;
  }

 private:
  std::size_t index(int i, int j, int k) const {
    return i + static_cast<std::size_t>(axes_[0]->n) * (j + static_cast<std::size_t>(axes_[1]->n) * k);
  }

  template <class Visit>
  void for_cells_about(const std::array<int, 3>& cell, const std::array<int, 3>& far,
                       const Visit& visit) const {
    int low[3], high[3];
    for (int a = 0; a < 3; ++a)
      low[a] = std::max(cell[a] - far[a], 0), high[a] = std::min(cell[a] + far[a], axes_[a]->n - 1);
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i) visit(index(i, j, k));
  }

  void mark(std::size_t hem) {
    const Vec3 p = hems_[hem].from, q = hems_[hem].to;
    const int steps = 1 + checked_int(norm(q - p) / least_width_, 0, longest_hem, [&] {
                        return fmt::format(
                            "a free edge of the sheet is {:.3g} m long: its motion has diverged; "
                            "a smaller time step may help",
                            norm(q - p));
                      });
    for (int s = 0; s <= steps; ++s) {
      const Point at = point_of(p + (static_cast<double>(s) / steps) * (q - p));
      std::array<int, 3> cell;
      bool outside = false;
      for (int a = 0; a < 3; ++a) {
        cell[a] = cell_at(*axes_[a], at[a]);
        outside = outside || at[a] < axes_[a]->edge.front() - 2 * axes_[a]->width.front() ||
                  at[a] > axes_[a]->edge.back() + 2 * axes_[a]->width.back();
      }
      if (outside) continue;
      for_cells_about(cell, {2, 2, 2}, [&](std::size_t c) { near_[c] = 1; });
      for (int a = 0; a < 3; ++a) cell[a] = std::clamp(cell[a], 0, axes_[a]->n - 1);
      std::vector<std::size_t>& here = in_cell_[index(cell[0], cell[1], cell[2])];
      if (here.empty() || here.back() != hem) here.push_back(hem);
    }
  }

  std::array<const Axis*, 3> axes_;
  std::vector<Hem> hems_;
  double least_width_;
  std::vector<char> near_;
  std::unordered_map<std::size_t, std::vector<std::size_t>> in_cell_;  // hems that pass through it
};

/// Sheet in a cell that found no face of its own axis.
struct Share {
  std::array<int, 3> cell;
  double area = 0;
};

struct Hit {
  double at = 0;      // along the axis [m]
  double nudged = 0;  // the same of the sheet moved by `nudge` [m]
  int triangle = 0;
  int line = 0;  // 0 .. lines^2 - 1
  bool hem = false;
};

/// Of a cell's line s along one axis.
double line_position(const Axis& axis, int c, int s) {
  return s == centre_line ? centre(axis, c) : axis.edge[c] + (s + 0.5) / lines * axis.width[c];
}

/// Of all lines along one axis.
std::vector<double> line_positions(const Axis& axis) {
  std::vector<double> positions;
  positions.reserve(static_cast<std::size_t>(axis.n) * lines);
  for (int c = 0; c < axis.n; ++c)
    for (int s = 0; s < lines; ++s) positions.push_back(line_position(axis, c, s));
  return positions;
}

/// On which side of the directed edge a -> b the point (u, v) lies; a point on the edge lies on the side that
/// the edge's lower end decides, so that two triangles that share the edge never both have or miss it.
bool left_of(double au, double av, double bu, double bv, double u, double v) {
  const bool forward = std::pair(au, av) < std::pair(bu, bv);
  if (!forward) std::swap(au, bu), std::swap(av, bv);
  const double side = (bu - au) * (v - av) - (bv - av) * (u - au);
  return forward ? side >= 0 : side < 0;
}

Vec3 unit_normal(const Triangle& t) {
  const Vec3 n = cross(t.b - t.a, t.c - t.a);
  const double length = norm(n);
  return length > 0 ? n / length : Vec3{};
}

class Columns {
 public:
  Columns(int axis, const std::array<const Axis*, 3>& axes, const std::vector<Triangle>& surface,
          const NearHem& hem)
      : axis_(axis),
        u_((axis + 1) % 3),
        v_((axis + 2) % 3),
        axes_(axes),
        surface_(surface),
        hem_(hem),
        nudge_(least_width(axes) * nudge) {
    const std::vector<double> us = line_positions(*axes[u_]), vs = line_positions(*axes[v_]);
    hits_.resize(static_cast<std::size_t>(axes[u_]->n) * axes[v_]->n);
    for (int t = 0; t < static_cast<int>(surface.size()); ++t) project(t, us, vs);
  }

  void faces(std::vector<SheetFace>& result, std::vector<Share>& left_over) {
    for (int cv = 0; cv < axes_[v_]->n; ++cv) {
      for (int cu = 0; cu < axes_[u_]->n; ++cu) {
        std::vector<Hit>& hits = hits_[cu + static_cast<std::size_t>(axes_[u_]->n) * cv];
        if (!hits.empty()) faces_of_column(hits, cu, cv, result, left_over);
      }
    }
  }

 private:
  using Corners = std::array<Point, 3>;

  double projected_area(const Corners& p) const {  // twice, signed
    return (p[1][u_] - p[0][u_]) * (p[2][v_] - p[0][v_]) - (p[1][v_] - p[0][v_]) * (p[2][u_] - p[0][u_]);
  }
  /// Where the line (u, v) meets the triangle, along the axis.
  double met_at(const Corners& p, double area, double u, double v) const {
    const double b = ((u - p[0][u_]) * (p[2][v_] - p[0][v_]) - (v - p[0][v_]) * (p[2][u_] - p[0][u_])) / area;
    const double c = ((p[1][u_] - p[0][u_]) * (v - p[0][v_]) - (p[1][v_] - p[0][v_]) * (u - p[0][u_])) / area;
    const auto [low, high] = std::minmax({p[0][axis_], p[1][axis_], p[2][axis_]});
    return std::clamp(p[0][axis_] + b * (p[1][axis_] - p[0][axis_]) + c * (p[2][axis_] - p[0][axis_]), low,
                      high);
  }

  void project(int t, const std::vector<double>& us, const std::vector<double>& vs) {
    const Triangle& s = surface_[t];
    const Corners still = {point_of(s.a), point_of(s.b), point_of(s.c)},
                  p = {point_of(s.a + nudge_), point_of(s.b + nudge_), point_of(s.c + nudge_)};
    const double area = projected_area(still), nudged_area = projected_area(p);
    if (area == 0 || nudged_area == 0) return;
    const auto range = [&](const std::vector<double>& all, int a) {
      const auto [low, high] =
          std::minmax({p[0][a], p[1][a], p[2][a], still[0][a], still[1][a], still[2][a]});
      return std::pair(std::lower_bound(all.begin(), all.end(), low) - all.begin(),
                       std::upper_bound(all.begin(), all.end(), high) - all.begin());
    };
    const auto [u_begin, u_end] = range(us, u_);
    const auto [v_begin, v_end] = range(vs, v_);
    for (auto iv = v_begin; iv < v_end; ++iv) {
      for (auto iu = u_begin; iu < u_end; ++iu) {
        const double u = us[iu], v = vs[iv];
        // The other lines of a cell measure covered areas, to which the sheet itself belongs.
        const bool central = iu % lines == centre_line && iv % lines == centre_line;
        const Corners& q = central ? p : still;
        const bool first = left_of(q[0][u_], q[0][v_], q[1][u_], q[1][v_], u, v);
        if (left_of(q[1][u_], q[1][v_], q[2][u_], q[2][v_], u, v) != first ||
            left_of(q[2][u_], q[2][v_], q[0][u_], q[0][v_], u, v) != first) {
          continue;
        }
        Hit hit;
        hit.at = met_at(still, area, u, v);
        hit.nudged = met_at(p, nudged_area, u, v);
        hit.triangle = t;
        hit.line = static_cast<int>(iu % lines + lines * (iv % lines));
        Point point;
        point[axis_] = hit.at, point[u_] = u, point[v_] = v;
        hit.hem = hem_.at(point);
        hits_[iu / lines + static_cast<std::size_t>(axes_[u_]->n) * (iv / lines)].push_back(hit);
      }
    }
  }

  /// Unit, its component along the axis not negative.
  Vec3 normal_of(Vec3 n) const { return point_of(n)[axis_] < 0 ? -1.0 * n : n; }

  double width_at(double at) const {
    return axes_[axis_]->width[std::clamp(cell_at(*axes_[axis_], at), 0, axes_[axis_]->n - 1)];
  }

  /// Area of the sheet of one line that belongs to faces of this axis [m2].
  double share(const Hit& h, int cu, int cv) const {
    return std::abs(point_of(unit_normal(surface_[h.triangle]))[axis_]) * axes_[u_]->width[cu] *
           axes_[v_]->width[cv] / (lines * lines);
  }

  /// The new face, or null where no two centres lie on either side.
  SheetFace* add(const Hit& hit, int cu, int cv, std::vector<SheetFace>& result) const {
    const Axis& axis = *axes_[axis_];
    int cell = cell_at(axis, hit.nudged);
    if (cell < 0 || cell >= axis.n) return nullptr;
    if (hit.nudged >= centre(axis, cell)) ++cell;  // between the centres of cell - 1 and cell
    if (cell < 1 || cell >= axis.n) return nullptr;
    SheetFace face;
    face.axis = axis_;
    int c[3];
    c[axis_] = cell, c[u_] = cu, c[v_] = cv;
    face.i = c[0], face.j = c[1], face.k = c[2];
    face.triangle = hit.triangle;
    Point point;
    point[axis_] = hit.at, point[u_] = centre(*axes_[u_], cu), point[v_] = centre(*axes_[v_], cv);
    face.point = {point[0], point[1], point[2]};
    face.outward = unit_normal(surface_[hit.triangle]);
    face.against = point_of(face.outward)[axis_] < 0;
    face.normal = face.across = normal_of(face.outward);
    result.push_back(face);
    return &result.back();
  }

  void faces_of_column(std::vector<Hit>& hits, int cu, int cv, std::vector<SheetFace>& result,
                       std::vector<Share>& left_over) const {
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
      return std::tie(a.at, a.triangle, a.line) < std::tie(b.at, b.triangle, b.line);
    });
    const auto central = [](const Hit& h) { return h.line == centre_line * (lines + 1); };
    const std::size_t first = result.size();
    for (const Hit& h : hits) {
      SheetFace* face = central(h) ? add(h, cu, cv, result) : nullptr;
      if (face) face->hem = h.hem;
    }
    const std::size_t last = result.size();
    std::vector<Vec3> normals(last - first),
        turned(last - first);        // of everything that a face represents, by area
    std::vector<const Hit*> beside;  // near a hem, lines that meet the sheet where the central one does not
    std::vector<std::bitset<lines * lines>> met(last - first);
    for (const Hit& h : hits) {
      std::size_t nearest = last;
      double closest = 1;
      for (std::size_t n = first; n < last; ++n) {
        const Point at = point_of(result[n].point), normal = point_of(result[n].normal);
        // As far as a slanted sheet gets along the axis while it crosses the column.
        const double slant =
            std::abs(normal[u_]) * axes_[u_]->width[cu] + std::abs(normal[v_]) * axes_[v_]->width[cv];
        const double far = reach * width_at(h.at) +
                           std::min(0.5 * slant / std::max(normal[axis_], 1e-3), longest * width_at(h.at));
        const double apart = std::abs(at[axis_] - h.at) / far;
        if (apart < closest) closest = apart, nearest = n;
        if (apart < 1) met[n - first].set(h.line);
      }
      if (nearest < last) {
        result[nearest].area += share(h, cu, cv);
        normals[nearest - first] += share(h, cu, cv) * unit_normal(surface_[h.triangle]);
        turned[nearest - first] += share(h, cu, cv) * normal_of(unit_normal(surface_[h.triangle]));
      } else if (h.hem) {
        beside.push_back(&h);
      } else {
        left_over.push_back({cell_of(h, cu, cv), share(h, cu, cv)});
      }
    }
    for (std::size_t n = first; n < last; ++n) {
      if (result[n].hem)
        result[n].cover = 1 - opening(result[n], point_of(result[n].point), met[n - first], cu, cv).share;
      const Vec3 sum = normals[n - first];
      if (norm(turned[n - first]) > 0) result[n].across = turned[n - first] / norm(turned[n - first]);
      if (!(norm(sum) > 0)) continue;
      result[n].outward = sum / norm(sum);
      result[n].normal = normal_of(result[n].outward);
    }
    hem_faces(beside, cu, cv, result, left_over);
  }

  /// Faces that the sheet covers in part, from lines in the order of their intersections.
  void hem_faces(const std::vector<const Hit*>& beside, int cu, int cv, std::vector<SheetFace>& result,
                 std::vector<Share>& left_over) const {
    for (std::size_t begin = 0; begin < beside.size();) {
      std::size_t end = begin + 1;
      while (end < beside.size() &&
             beside[end]->at - beside[end - 1]->at < reach * width_at(beside[end]->at)) {
        ++end;
      }
      // A line that meets the sheet and leaves it again passes no hem, but where the sheet is seen edgewise.
      std::array<int, lines * lines> crossings{};
      for (std::size_t n = begin; n < end; ++n) ++crossings[beside[n]->line];
      std::vector<const Hit*> across;
      for (std::size_t n = begin; n < end; ++n) {
        if (crossings[beside[n]->line] % 2 == 1) across.push_back(beside[n]);
      }
      const Hit* middle = across.empty() ? nullptr : across[across.size() / 2];
      SheetFace* face = middle ? add(*middle, cu, cv, result) : nullptr;
      if (face) {
        std::bitset<lines * lines> met;
        for (const Hit* h : across) met.set(h->line);
        Point at;
        at[axis_] = middle->at;
        at[u_] = line_position(*axes_[u_], cu, middle->line % lines);
        at[v_] = line_position(*axes_[v_], cv, middle->line / lines);
        const Opening open = opening(*face, at, met, cu, cv);
        face->hem = true;
        face->cover = 1 - open.share;
        if (!open.at_centre) {
          result.pop_back();
          face = nullptr;
        }
      }
      for (std::size_t n = begin; n < end; ++n) {
        face ? void(face->area += share(*beside[n], cu, cv))
             : left_over.push_back({cell_of(*beside[n], cu, cv), share(*beside[n], cu, cv)});
      }
      begin = end;
    }
  }

  /// Whether the lines about one are as it is.
  static bool alike_about(const std::bitset<lines * lines>& past, int line) {
    const int s = line % lines, t = line / lines;
    for (int v = std::max(t - 1, 0); v <= std::min(t + 1, lines - 1); ++v)
      for (int u = std::max(s - 1, 0); u <= std::min(s + 1, lines - 1); ++u)
        if (past[u + lines * v] != past[line]) return false;
    return true;
  }

  struct Opening {
    double share = 0;
    bool at_centre = false;  // on the central line the sheet has ended, and not bent out of the column
  };
  /// Open part of a face. Where a line does not intersect the sheet and the sheet has not ended, it has bent out of
  /// the column and continues next to the face, and nothing is open. `at`: a point of the sheet in the column.
  Opening opening(const SheetFace& face, const Point& at, const std::bitset<lines * lines>& met, int cu,
                  int cv) const {
    Opening open;
    if (met.all()) return open;
    const std::vector<Hem> hems = hem_.about({face.i, face.j, face.k}, axis_);
    if (hems.empty()) return open;
    const Point normal = point_of(face.normal);
    const int cells[] = {face.i, face.j, face.k}, cell = cells[axis_];
    // In the plane through `at`, as far as that lies between the two centres; share_u, share_v: of the cell's width.
    const auto ends = [&](double share_u, double share_v) {
      Point p;
      p[u_] = axes_[u_]->edge[cu] + share_u * axes_[u_]->width[cu];
      p[v_] = axes_[v_]->edge[cv] + share_v * axes_[v_]->width[cv];
      const double slant =
          (normal[u_] * (p[u_] - at[u_]) + normal[v_] * (p[v_] - at[v_])) / std::max(normal[axis_], 1e-3);
      p[axis_] = std::clamp(at[axis_] - slant, centre(*axes_[axis_], cell - 1), centre(*axes_[axis_], cell));
      return ended({p[0], p[1], p[2]}, hems);
    };
    std::bitset<lines * lines> past;
    for (int line = 0; line < lines * lines; ++line)
      past[line] = ends((line % lines + 0.5) / lines, (line / lines + 0.5) / lines);
    const std::bitset<lines* lines> missed = past & ~met;
    open.at_centre = missed[centre_line * (lines + 1)];
    if (missed.none()) return open;
    // A free edge along the grid would cross the lines row by row: the open part next to it is sampled more finely.
    int points = 0;
    for (int line = 0; line < lines * lines; ++line) {
      if (met[line] && past[line]) continue;
      if (alike_about(past, line)) {
        points += past[line] ? finer * finer : 0;
        continue;
      }
      for (int n = 0; n < finer * finer; ++n)
        points += ends((line % lines + (n % finer + 0.5) / finer) / lines,
                       (line / lines + (n / finer + 0.5) / finer) / lines);
    }
    open.share = static_cast<double>(points) / (lines * lines * finer * finer);
    return open;
  }

  std::array<int, 3> cell_of(const Hit& h, int cu, int cv) const {
    std::array<int, 3> cell;
    cell[axis_] = cell_at(*axes_[axis_], h.at), cell[u_] = cu, cell[v_] = cv;
    return cell;
  }

  int axis_, u_, v_;
  std::array<const Axis*, 3> axes_;
  const std::vector<Triangle>& surface_;
  const NearHem& hem_;
  Vec3 nudge_;  // [m]
  std::vector<std::vector<Hit>> hits_;
};

}  // namespace

std::vector<SheetFace> sheet_faces(const Axis& x, const Axis& y, const Axis& z,
                                   const std::vector<Triangle>& surface) {
  const std::array<const Axis*, 3> axes = {&x, &y, &z};
  const NearHem hem(axes, surface);
  std::vector<SheetFace> result;
  std::vector<Share> left_over;
  for (int axis = 0; axis < 3; ++axis) Columns(axis, axes, surface, hem).faces(result, left_over);

  // The rest, where the sheet is nearly parallel to an axis, is assigned to the face of its cell that is most
  // nearly normal to it.
  std::map<std::array<int, 3>, std::vector<std::size_t>> of_cell;
  for (std::size_t n = 0; n < result.size(); ++n) {
    const SheetFace& f = result[n];
    std::array<int, 3> cell = {f.i, f.j, f.k};
    of_cell[cell].push_back(n);
    --cell[f.axis];
    of_cell[cell].push_back(n);
  }
  for (const Share& share : left_over) {
    const auto found = of_cell.find(share.cell);
    if (found == of_cell.end()) continue;
    const auto square = [&](std::size_t n) { return point_of(result[n].normal)[result[n].axis]; };
    const std::size_t best =
        *std::max_element(found->second.begin(), found->second.end(),
                          [&](std::size_t a, std::size_t b) { return square(a) < square(b); });
    result[best].area += share.area;
  }
  return result;
}

}  // namespace ripstop::inline flow::cartesian
