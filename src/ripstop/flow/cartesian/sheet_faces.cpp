#include "ripstop/flow/cartesian/sheet_faces.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

#include "ripstop/flow/cartesian/near_hem.h"
#include "ripstop/flow/cartesian/places.h"

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

using Point = std::array<double, 3>;

Point point_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

double centre(const Axis& axis, int c) {
  return 0.5 * (axis.edge[c] + axis.edge[c + 1]);
}

/// Sheet in a cell that found no face of its own axis.
struct Share {
  std::array<int, 3> cell;
  double area = 0;
};

struct Hit {
  double at = 0;      // along the axis [m]
  double nudged = 0;  // the same of the sheet moved by `nudge` [m]
  int triangle = 0;
  int line = 0;        // 0 .. lines^2 - 1
  int cu = 0, cv = 0;  // cell across the axis
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

/// A sheet on a grid, for the columns of all axes.
struct Sheet {
  Sheet(const std::array<const Axis*, 3>& all_axes, const std::vector<Triangle>& triangles)
      : axes(all_axes),
        surface(triangles),
        normals(triangles.size()),
        edges{Places(axes[0]->edge), Places(axes[1]->edge), Places(axes[2]->edge)},
        line_at{Places(line_positions(*axes[0])), Places(line_positions(*axes[1])),
                Places(line_positions(*axes[2]))},
        hem(axes, edges, triangles),
        nudged_by(least_width(axes) * nudge) {}

  /// Cell of an axis that contains x; -1 or n outside.
  int cell_at(int axis, double x) const { return edges[axis].up_to(x) - 1; }

  std::array<const Axis*, 3> axes;
  const std::vector<Triangle>& surface;
  std::vector<Vec3> normals;  // unit, of every triangle
  std::array<Places, 3> edges, line_at;
  NearHem hem;
  Vec3 nudged_by;  // [m]
};

/// Faces of some columns, and sheet that has none there.
struct ColumnFaces {
  std::vector<SheetFace> faces;
  std::vector<Share> left_over;
};

/// The columns of cells along one axis: the lines in them meet the sheet, and the hits of a column become faces.
class Columns {
 public:
  Columns(int axis, const Sheet& sheet, int ranks)
      : axis_(axis),
        u_((axis + 1) % 3),
        v_((axis + 2) % 3),
        sheet_(sheet),
        axes_(sheet.axes),
        hits_(static_cast<std::size_t>(ranks)) {}

  /// One thread's part of the triangles.
  void project(int rank, IndexRange triangles) {
    for (int t = triangles.begin; t < triangles.end; ++t) project(t, hits_[rank]);
  }

  /// One thread's part of the columns, after all triangles have been projected. Those of all ranks, one after the
  /// other, are in an order that does not depend on their number.
  void faces(int rank, ColumnFaces& result) const {
    const int across = axes_[u_]->n;
    const IndexRange rows = rows_of(rank);
    const auto each_hit = [&](const auto& visit) {
      for (const std::vector<Hit>& some : hits_)
        for (const Hit& h : some)
          if (h.cv >= rows.begin && h.cv < rows.end) visit(h, h.cu + across * (h.cv - rows.begin));
    };
    std::vector<int> begin(static_cast<std::size_t>(across) * (rows.end - rows.begin) + 1, 0);
    each_hit([&](const Hit&, int column) { ++begin[column + 1]; });
    for (std::size_t n = 1; n < begin.size(); ++n) begin[n] += begin[n - 1];
    std::vector<int> next(begin.begin(), begin.end() - 1);
    std::vector<Hit> hits(begin.back());
    each_hit([&](const Hit& h, int column) { hits[next[column]++] = h; });
    HemsAbout hems;
    for (std::size_t n = 0; n + 1 < begin.size(); ++n)
      if (begin[n] < begin[n + 1])
        faces_of_column({hits.begin() + begin[n], hits.begin() + begin[n + 1]}, hems, result);
  }

 private:
  using Corners = std::array<Point, 3>;
  using Hits = std::span<Hit>;

  /// Rows of columns with about as many hits as those of every other rank.
  IndexRange rows_of(int rank) const {
    std::vector<long long> before(axes_[v_]->n + 1, 0);
    for (const std::vector<Hit>& some : hits_)
      for (const Hit& h : some) ++before[h.cv + 1];
    for (std::size_t n = 1; n < before.size(); ++n) before[n] += before[n - 1];
    const auto ranks = static_cast<long long>(hits_.size());
    const auto first = [&](int r) {
      if (r == ranks) return axes_[v_]->n;
      const auto at = std::lower_bound(before.begin(), before.end() - 1, before.back() * r / ranks);
      return static_cast<int>(at - before.begin());
    };
    return {rank == 0 ? 0 : first(rank), first(rank + 1)};
  }

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

  void project(int t, std::vector<Hit>& hits) const {
    const Triangle& s = sheet_.surface[t];
    const Vec3 by = sheet_.nudged_by;
    const Corners still = {point_of(s.a), point_of(s.b), point_of(s.c)},
                  p = {point_of(s.a + by), point_of(s.b + by), point_of(s.c + by)};
    const auto range = [&](int a) {  // the sheet is nudged upwards
      return IndexRange{sheet_.line_at[a].below(std::min({still[0][a], still[1][a], still[2][a]})),
                        sheet_.line_at[a].up_to(std::max({p[0][a], p[1][a], p[2][a]}))};
    };
    const IndexRange us = range(u_);
    if (us.begin >= us.end) return;
    const IndexRange vs = range(v_);
    if (vs.begin >= vs.end) return;
    const double area = projected_area(still), nudged_area = projected_area(p);
    if (area == 0 || nudged_area == 0) return;
    for (int iv = vs.begin; iv < vs.end; ++iv) {
      for (int iu = us.begin; iu < us.end; ++iu) {
        const double u = sheet_.line_at[u_][iu], v = sheet_.line_at[v_][iv];
        // The other lines of a cell measure covered areas, to which the sheet itself belongs.
        const bool central = iu % lines == centre_line && iv % lines == centre_line;
        const Corners& q = central ? p : still;
        const bool first = left_of(q[0][u_], q[0][v_], q[1][u_], q[1][v_], u, v);
        if (left_of(q[1][u_], q[1][v_], q[2][u_], q[2][v_], u, v) != first ||
            left_of(q[2][u_], q[2][v_], q[0][u_], q[0][v_], u, v) != first) {
          continue;
        }
        hits.push_back({met_at(still, area, u, v), met_at(p, nudged_area, u, v), t,
                        iu % lines + lines * (iv % lines), iu / lines, iv / lines});
      }
    }
  }

  /// Unit, its component along the axis not negative.
  Vec3 normal_of(Vec3 n) const { return point_of(n)[axis_] < 0 ? -1.0 * n : n; }

  double width_at(double at) const {
    return axes_[axis_]->width[std::clamp(sheet_.cell_at(axis_, at), 0, axes_[axis_]->n - 1)];
  }

  /// Area of the sheet of one line that belongs to faces of this axis [m2].
  double share(const Hit& h) const {
    return std::abs(point_of(sheet_.normals[h.triangle])[axis_]) * axes_[u_]->width[h.cu] *
           axes_[v_]->width[h.cv] / (lines * lines);
  }
  bool near_hem(const Hit& h) const { return sheet_.hem.at(cell_of(h)); }

  /// The new face, or null where no two centres lie on either side.
  SheetFace* add(const Hit& hit, std::vector<SheetFace>& result) const {
    const Axis& axis = *axes_[axis_];
    int cell = sheet_.cell_at(axis_, hit.nudged);
    if (cell < 0 || cell >= axis.n) return nullptr;
    if (hit.nudged >= centre(axis, cell)) ++cell;  // between the centres of cell - 1 and cell
    if (cell < 1 || cell >= axis.n) return nullptr;
    SheetFace face;
    face.axis = axis_;
    int c[3];
    c[axis_] = cell, c[u_] = hit.cu, c[v_] = hit.cv;
    face.i = c[0], face.j = c[1], face.k = c[2];
    face.triangle = hit.triangle;
    Point point;
    point[axis_] = hit.at, point[u_] = centre(*axes_[u_], hit.cu), point[v_] = centre(*axes_[v_], hit.cv);
    face.point = {point[0], point[1], point[2]};
    face.outward = sheet_.normals[hit.triangle];
    face.against = point_of(face.outward)[axis_] < 0;
    face.normal = face.across = normal_of(face.outward);
    result.push_back(face);
    return &result.back();
  }

  void faces_of_column(Hits hits, HemsAbout& hems, ColumnFaces& result) const {
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
      return std::tie(a.at, a.triangle, a.line) < std::tie(b.at, b.triangle, b.line);
    });
    std::vector<SheetFace>& faces = result.faces;
    const auto central = [](const Hit& h) { return h.line == centre_line * (lines + 1); };
    const std::size_t first = faces.size();
    for (const Hit& h : hits) {
      SheetFace* face = central(h) ? add(h, faces) : nullptr;
      if (face) face->hem = near_hem(h);
    }
    const std::size_t count = faces.size() - first;
    std::vector<Crossing> crossings;
    crossings.reserve(count);
    for (std::size_t n = 0; n < count; ++n) crossings.push_back(crossing_of(faces[first + n], hits[0]));
    std::vector<const Hit*>
        off_centre;  // near a hem, lines that meet the sheet where the central one does not
    for (const Hit& h : hits) {
      std::size_t nearest = count;
      double closest = 1;
      const double width = width_at(h.at);
      for (std::size_t n = 0; n < count; ++n) {
        Crossing& crossing = crossings[n];
        const double far = reach * width + std::min(crossing.longer, longest * width);
        const double apart = std::abs(crossing.at - h.at) / far;
        if (apart < closest) closest = apart, nearest = n;
        if (apart < 1) crossing.met.set(h.line);
      }
      if (nearest < count) {
        const Vec3 normal = sheet_.normals[h.triangle];
        const double area = share(h);
        faces[first + nearest].area += area;
        crossings[nearest].normals += area * normal;
        crossings[nearest].turned += area * normal_of(normal);
      } else if (near_hem(h)) {
        off_centre.push_back(&h);
      } else {
        result.left_over.push_back({cell_of(h), share(h)});
      }
    }
    for (std::size_t n = 0; n < count; ++n) {
      SheetFace& face = faces[first + n];
      const Vec3 sum = crossings[n].normals, turned = crossings[n].turned;
      if (face.hem)
        face.cover = 1 - opening(face, point_of(face.point), crossings[n].met, hits[0], hems).share;
      if (norm(turned) > 0) face.across = turned / norm(turned);
      if (!(norm(sum) > 0)) continue;
      face.outward = sum / norm(sum);
      face.normal = normal_of(face.outward);
    }
    hem_faces(off_centre, hems, result);
  }

  /// A face where the central line of its column has met the sheet.
  struct Crossing {
    double at = 0;      // along the axis [m]
    double longer = 0;  // half as far as a slanted sheet gets along the axis while it crosses the column [m]
    Vec3 normals, turned;  // of everything that the face represents, by area
    std::bitset<lines* lines> met = {};
  };
  /// `h` is any hit of the column.
  Crossing crossing_of(const SheetFace& face, const Hit& h) const {
    const Point normal = point_of(face.normal);
    const double slant =
        std::abs(normal[u_]) * axes_[u_]->width[h.cu] + std::abs(normal[v_]) * axes_[v_]->width[h.cv];
    return {point_of(face.point)[axis_], 0.5 * slant / std::max(normal[axis_], 1e-3), {}, {}};
  }

  /// Faces that the sheet covers in part, from lines of one column in the order of their intersections.
  void hem_faces(const std::vector<const Hit*>& off_centre, HemsAbout& hems, ColumnFaces& result) const {
    for (std::size_t begin = 0; begin < off_centre.size();) {
      std::size_t end = begin + 1;
      while (end < off_centre.size() &&
             off_centre[end]->at - off_centre[end - 1]->at < reach * width_at(off_centre[end]->at)) {
        ++end;
      }
      // A line that meets the sheet and leaves it again passes no hem, but where the sheet is seen edgewise.
      std::array<int, lines * lines> crossings{};
      for (std::size_t n = begin; n < end; ++n) ++crossings[off_centre[n]->line];
      std::vector<const Hit*> across;
      for (std::size_t n = begin; n < end; ++n) {
        if (crossings[off_centre[n]->line] % 2 == 1) across.push_back(off_centre[n]);
      }
      const Hit* middle = across.empty() ? nullptr : across[across.size() / 2];
      SheetFace* face = middle ? add(*middle, result.faces) : nullptr;
      if (face) {
        std::bitset<lines * lines> met;
        for (const Hit* h : across) met.set(h->line);
        Point at;
        at[axis_] = middle->at;
        at[u_] = line_position(*axes_[u_], middle->cu, middle->line % lines);
        at[v_] = line_position(*axes_[v_], middle->cv, middle->line / lines);
        const Opening open = opening(*face, at, met, *middle, hems);
        face->hem = true;
        face->cover = 1 - open.share;
        if (!open.at_centre) {
          result.faces.pop_back();
          face = nullptr;
        }
      }
      for (std::size_t n = begin; n < end; ++n) {
        face ? void(face->area += share(*off_centre[n]))
             : result.left_over.push_back({cell_of(*off_centre[n]), share(*off_centre[n])});
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
  /// the column and continues next to the face, and nothing is open. `at`: a point of the sheet in the column of `h`.
  Opening opening(const SheetFace& face, const Point& at, const std::bitset<lines * lines>& met, const Hit& h,
                  HemsAbout& hems) const {
    Opening open;
    if (met.all()) return open;
    sheet_.hem.about({face.i, face.j, face.k}, axis_, hems);
    if (hems.empty()) return open;
    const Point normal = point_of(face.normal);
    const int cells[] = {face.i, face.j, face.k}, cell = cells[axis_];
    // In the plane through `at`, as far as that lies between the two centres; share_u, share_v: of the cell's width.
    const auto ends = [&](double share_u, double share_v) {
      Point p;
      p[u_] = axes_[u_]->edge[h.cu] + share_u * axes_[u_]->width[h.cu];
      p[v_] = axes_[v_]->edge[h.cv] + share_v * axes_[v_]->width[h.cv];
      const double slant =
          (normal[u_] * (p[u_] - at[u_]) + normal[v_] * (p[v_] - at[v_])) / std::max(normal[axis_], 1e-3);
      p[axis_] = std::clamp(at[axis_] - slant, centre(*axes_[axis_], cell - 1), centre(*axes_[axis_], cell));
      return hems.ended({p[0], p[1], p[2]});
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

  std::array<int, 3> cell_of(const Hit& h) const {
    std::array<int, 3> cell;
    cell[axis_] = sheet_.cell_at(axis_, h.at), cell[u_] = h.cu, cell[v_] = h.cv;
    return cell;
  }

  int axis_, u_, v_;
  const Sheet& sheet_;
  std::array<const Axis*, 3> axes_;
  std::vector<std::vector<Hit>> hits_;  // of each rank's triangles
};

/// Number of a cell; unique also for those next to the box.
std::int64_t number_of(const std::array<int, 3>& cell, const std::array<const Axis*, 3>& axes) {
  return cell[0] + 1 + (axes[0]->n + 2) * (cell[1] + 1 + (axes[1]->n + 2) * (cell[2] + std::int64_t{1}));
}

// The rest, where the sheet is nearly parallel to an axis, is assigned to the face of its cell that is most nearly
// normal to it.
void assign(const std::vector<Share>& left_over, const std::array<const Axis*, 3>& axes,
            std::vector<SheetFace>& faces) {
  struct OfCell {
    std::int64_t cell;
    double square;
    std::size_t face;
  };
  std::vector<OfCell> all;
  all.reserve(2 * faces.size());
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const SheetFace& f = faces[n];
    const double square = point_of(f.normal)[f.axis];
    std::array<int, 3> cell = {f.i, f.j, f.k};
    all.push_back({number_of(cell, axes), square, n});
    --cell[f.axis];
    all.push_back({number_of(cell, axes), square, n});
  }
  // Of each cell the best one first, the earlier one of two that are alike.
  std::sort(all.begin(), all.end(), [](const OfCell& a, const OfCell& b) {
    return std::tuple(a.cell, -a.square, a.face) < std::tuple(b.cell, -b.square, b.face);
  });
  for (const Share& share : left_over) {
    const std::int64_t cell = number_of(share.cell, axes);
    const auto best = std::lower_bound(all.begin(), all.end(), cell,
                                       [](const OfCell& a, std::int64_t c) { return a.cell < c; });
    if (best != all.end() && best->cell == cell) faces[best->face].area += share.area;
  }
}

}  // namespace

std::vector<SheetFace> sheet_faces(const Axis& x, const Axis& y, const Axis& z,
                                   const std::vector<Triangle>& surface, ThreadTeam* team) {
  const std::array<const Axis*, 3> axes = {&x, &y, &z};
  const int ranks = team ? team->size() : 1;
  Sheet sheet(axes, surface);
  std::array<Columns, 3> columns = {Columns(0, sheet, ranks), Columns(1, sheet, ranks),
                                    Columns(2, sheet, ranks)};
  std::vector<std::array<ColumnFaces, 3>> found(static_cast<std::size_t>(ranks));
  const auto work = [&](int rank) {
    const IndexRange mine = part_of(static_cast<int>(surface.size()), rank, ranks);
    for (int t = mine.begin; t < mine.end; ++t) sheet.normals[t] = unit_normal(surface[t]);
    for (Columns& of_axis : columns) of_axis.project(rank, mine);
    if (team) team->barrier();
    for (int axis = 0; axis < 3; ++axis) columns[axis].faces(rank, found[rank][axis]);
  };
  team ? team->run(work) : work(0);
  std::vector<SheetFace> result;
  std::vector<Share> left_over;
  for (int axis = 0; axis < 3; ++axis) {
    for (const std::array<ColumnFaces, 3>& some : found) {
      result.insert(result.end(), some[axis].faces.begin(), some[axis].faces.end());
      left_over.insert(left_over.end(), some[axis].left_over.begin(), some[axis].left_over.end());
    }
  }
  assign(left_over, axes, result);
  return result;
}

}  // namespace ripstop::inline flow::cartesian
