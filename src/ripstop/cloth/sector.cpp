#include "ripstop/cloth/sector.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace ripstop::inline cloth {
namespace {

constexpr int most_images = 128;
constexpr double same_place = 1e-7;  // of the size

struct Plane {  // through the z axis, at an angle
  double cosine, sine;
  explicit Plane(double angle) : cosine(std::cos(angle)), sine(std::sin(angle)) {}
  Vec3 mirrored(Vec3 x) const {
    const double out = distance(x);
    return {x.x + 2 * out * sine, x.y - 2 * out * cosine, x.z};
  }
  double distance(Vec3 x) const { return x.y * cosine - x.x * sine; }
};

class Search {
 public:
  Search(const Mesh& mesh, const std::vector<Vec3>& x) : mesh_(mesh), x_(x) {
    for (const Vec3 p : x) size_ = std::max({size_, std::abs(p.x), std::abs(p.y)});
    for (const Patch& patch : mesh.patches) loose_ = std::max(loose_, patch.node(patch.rows, 0));
    for (int node = loose_; node < mesh.node_count(); ++node) by_height_.emplace(x[node].z, node);
    for (const Spring& spring : mesh.springs) springs_.emplace(std::minmax(spring.a, spring.b), &spring);
  }

  /// As many planes as there are: 2n images, mirrored at angles 0 and pi / n.
  std::optional<Sector> widest(const Loads& loads) {
    int columns = 0;
    for (const Patch& patch : mesh_.patches) columns = std::gcd(columns, patch.columns);
    for (int n = std::min(columns, most_images) / 2; n > 1; --n) {
      if (columns % (2 * n) != 0) continue;
      if (std::optional<Sector> sector = sector_between(n, loads)) return sector;
    }
    return {};
  }

 private:
  std::optional<Sector> sector_between(int n, const Loads& loads) {
    n_ = n;
    planes_ = {Plane(0), Plane(std::numbers::pi / n)};
    for (const int plane : {0, 1})
      if (!find_mirrored(plane)) return {};
    Sector sector;
    sector.images = 2 * n;
    take_nodes(sector);
    if (!find_images(sector)) return {};
    for (const Patch& patch : mesh_.patches) sector.mesh.patches.push_back(half_of(patch));
    if (!take_springs(sector.mesh) || !take_ties(sector.mesh)) return {};
    for (const int node : mesh_.fixed)
      if (own_[node] >= 0) sector.mesh.fixed.push_back(own_[node]);
    sector.mesh.fabric_names = mesh_.fabric_names;
    keep_plane_nodes(sector);
    take_pressures(sector, loads);
    return sector;
  }

  bool near(Vec3 a, Vec3 b) const { return norm(a - b) < same_place * size_; }

  /// The node that each becomes in the mirror; whether there are such, and the springs with them.
  bool find_mirrored(int plane) {
    std::vector<int>& mirrored = mirrored_[plane];
    mirrored.assign(x_.size(), -1);
    for (const Patch& patch : mesh_.patches)
      for (int row = 0; row < patch.rows; ++row)
        for (int column = 0; column < patch.columns; ++column)
          mirrored[patch.node(row, column)] =
              patch.node(row, (patch.columns + plane * patch.columns / n_ - column) % patch.columns);
    for (int node = loose_; node < mesh_.node_count(); ++node) {
      const Vec3 there = planes_[plane].mirrored(x_[node]);
      for (auto at = by_height_.lower_bound(there.z - same_place * size_);
           at != by_height_.end() && at->first <= there.z + same_place * size_; ++at)
        if (near(x_[at->second], there)) mirrored[node] = at->second;
    }
    for (int node = 0; node < mesh_.node_count(); ++node)
      if (mirrored[node] < 0 || !near(planes_[plane].mirrored(x_[node]), x_[mirrored[node]])) return false;
    return std::all_of(mesh_.springs.begin(), mesh_.springs.end(), [&](const Spring& spring) {
      const auto [first, last] = springs_.equal_range(std::minmax(mirrored[spring.a], mirrored[spring.b]));
      return std::any_of(first, last, [&](const auto& other) {
        return other.second->scale == spring.scale &&
               std::abs(other.second->rest_length / spring.rest_length - 1) < same_place &&
               mesh_.laws[other.second->law].coefficients == mesh_.laws[spring.law].coefficients;
      });
    });
  }

  void take_nodes(Sector& sector) {
    own_.assign(x_.size(), -1);
    node_.clear();
    const auto take = [&](int node) {
      own_[node] = static_cast<int>(node_.size());
      node_.push_back(node);
      sector.mesh.start.push_back(x_[node]);
      sector.mesh.mass.push_back(mesh_.mass[node]);
    };
    for (const Patch& patch : mesh_.patches)
      for (int row = 0; row < patch.rows; ++row)
        for (int column = 0; column <= patch.columns / (2 * n_); ++column) take(patch.node(row, column));
    for (int node = loose_; node < mesh_.node_count(); ++node)
      if (planes_[0].distance(x_[node]) > -same_place * size_ &&
          planes_[1].distance(x_[node]) < same_place * size_ && (x_[node].x > 0 || on_axis(x_[node])))
        take(node);
  }

  bool on_axis(Vec3 x) const { return std::hypot(x.x, x.y) < same_place * size_; }

  /// Alternately in one mirror and the other.
  bool find_images(Sector& sector) {
    sector.image.assign(x_.size(), {});
    images_.assign(x_.size(), {});
    for (std::size_t own = 0; own < node_.size(); ++own) {
      Sector::Image image{static_cast<int>(own)};
      int node = node_[own];
      for (int k = 0; k < 2 * n_; ++k) {
        if (sector.image[node].node < 0) sector.image[node] = image;
        images_[node].set(k);
        const int plane = k % 2 == 0 ? 1 : 0;
        const Plane& p = planes_[plane];
        const double c = p.cosine * p.cosine - p.sine * p.sine, s = 2 * p.cosine * p.sine;
        image = {image.node, c * image.xx + s * image.yx, c * image.xy + s * image.yy,
                 s * image.xx - c * image.yx, s * image.xy - c * image.yy};
        node = mirrored_[plane][node];
      }
    }
    return std::all_of(sector.image.begin(), sector.image.end(),
                       [](const Sector::Image& i) { return i.node >= 0; });
  }

  /// Springs in a plane belong to both of its sides.
  Patch half_of(const Patch& patch) {
    Patch half = patch;
    half.periodic = false;
    half.columns = patch.columns / (2 * n_) + 1;
    half.first_node = own_[patch.first_node];
    const std::size_t count = static_cast<std::size_t>(half.rows) * half.columns;
    half.cell_area.assign(patch.cell_area.size() / patch.columns * half.columns, 0.0);
    half.viscosity_share.clear();
    for (int d = 0; d < direction_count; ++d) {
      half.width[d].assign(count, 0.0);
      half.rest_length[d].assign(count, 0.0);
    }
    const int last = half.columns - 1;
    for (int row = 0; row < half.rows; ++row)
      for (int column = 0; column <= last; ++column) {
        const std::size_t i = static_cast<std::size_t>(row) * half.columns + column,
                          of = static_cast<std::size_t>(row) * patch.columns + column;
        if (column < last && i < half.cell_area.size()) half.cell_area[i] = patch.cell_area[of];
        for (int d = 0; d < direction_count; ++d) {
          const int to = column + direction_offset[d].column;
          if (to < 0 || to > last) continue;
          const bool in_plane = to == column && (column == 0 || column == last);
          half.width[d][i] = (in_plane ? 0.5 : 1) * patch.width[d][of];
          half.rest_length[d][i] = patch.rest_length[d][of];
        }
      }
    return half;
  }

  bool take_springs(Mesh& mesh) {
    mesh.laws = mesh_.laws;
    mesh.parts = mesh_.parts;
    for (Spring spring : mesh_.springs) {
      const bool inside = (images_[spring.a] & images_[spring.b]).any();
      if (!inside && !near(turned_half(x_[spring.a]), x_[spring.b])) return false;
      for (const auto& [a, b] : {std::pair{spring.a, spring.b}, std::pair{spring.b, spring.a}}) {
        if (own_[a] < 0 || (inside && own_[b] < 0)) continue;
        Spring taken = spring;
        taken.a = own_[a], taken.b = own_[b];
        if (!inside) {  // straight across the axis: to a node there
          taken.rest_length = 0.5 * spring.rest_length;
          taken.b = static_cast<int>(mesh.start.size());
          mesh.start.push_back({0, 0, x_[a].z});
          mesh.mass.push_back(mesh_.mass[a]);
        }
        const bool of_axis = on_axis(x_[a]) && on_axis(x_[b]);
        for (const Plane& plane : planes_)
          if (!of_axis && lies_in(plane, x_[a]) && (!inside || lies_in(plane, x_[b]))) taken.scale *= 0.5;
        if (of_axis) taken.scale /= 2 * n_;
        mesh.springs.push_back(taken);
        if (inside) break;
      }
    }
    return true;
  }
  static Vec3 turned_half(Vec3 x) { return {-x.x, -x.y, x.z}; }
  bool lies_in(const Plane& plane, Vec3 x) const { return std::abs(plane.distance(x)) < same_place * size_; }

  bool take_ties(Mesh& mesh) const {
    for (Tie tie : mesh_.ties) {
      if (own_[tie.node] < 0) continue;
      tie.node = own_[tie.node];
      for (Tie::Master& master : tie.masters)
        if ((master.node = own_[master.node]) < 0) return false;
      mesh.ties.push_back(tie);
    }
    return true;
  }

  /// Nodes of the planes move in them. A spring without width has each of them stepped by itself, with its freedom.
  void keep_plane_nodes(Sector& sector) const {
    Mesh& mesh = sector.mesh;
    std::vector<char> tied(mesh.start.size(), 0);
    for (const Tie& tie : mesh.ties) tied[tie.node] = 1;
    mesh.laws.push_back({{1}});
    mesh.parts.emplace_back("plane of symmetry");
    int before = -1, earlier = -1;  // of these nodes, in different places
    for (int node = 0; node < mesh.node_count(); ++node) {
      const bool first = lies_in(planes_[0], mesh.start[node]),
                 second = lies_in(planes_[1], mesh.start[node]);
      Symmetric& free = sector.freedom.emplace_back(Symmetric{1, 1, 1, 0, 0, 0});
      if (!first && !second) continue;
      const Plane& plane = planes_[first ? 0 : 1];
      free = {plane.cosine * plane.cosine, plane.sine * plane.sine, 1, plane.cosine * plane.sine, 0, 0};
      if (first && second) free = {0, 0, 1, 0, 0, 0};
      if (tied[node]) continue;
      if (before >= 0 && near(mesh.start[before], mesh.start[node])) before = earlier;
      if (before >= 0)
        mesh.springs.push_back({before, node, size_, 0, static_cast<int>(mesh.laws.size()) - 1, 0,
                                static_cast<int>(mesh.parts.size()) - 1});
      earlier = before, before = node;
    }
  }

  void take_pressures(Sector& sector, const Loads& loads) const {
    if (loads.cell_pressure.empty()) return;
    std::size_t first = 0;
    for (std::size_t p = 0; p < mesh_.patches.size(); ++p) {
      const Patch &whole = mesh_.patches[p], &half = sector.mesh.patches[p];
      const int cells = half.columns - 1, rows = static_cast<int>(whole.cell_area.size()) / whole.columns;
      for (int row = 0; row < rows; ++row) {
        std::vector<double> sum(half.columns, 0.0);
        for (int column = 0; column < whole.columns; ++column) {
          const int in = column % (2 * cells);
          sum[std::min(in, 2 * cells - 1 - in)] += loads.cell_pressure[first + row * whole.columns + column];
        }
        for (const double s : sum) sector.loads.cell_pressure.push_back(s / (2 * n_));
      }
      first += static_cast<std::size_t>(rows) * whole.columns;
    }
  }

  const Mesh& mesh_;
  const std::vector<Vec3>& x_;
  double size_ = 0;
  int loose_ = 0;                                              // first node outside patches
  std::multimap<double, int> by_height_;                       // of these
  std::multimap<std::pair<int, int>, const Spring*> springs_;  // by ends
  int n_ = 0;
  std::array<Plane, 2> planes_{Plane(0), Plane(0)};
  std::array<std::vector<int>, 2> mirrored_;
  std::vector<int> own_, node_;                   // the sector's number of a node, and back
  std::vector<std::bitset<most_images>> images_;  // in which images a node lies
};

}  // namespace

std::vector<Vec3> Sector::whole(const std::vector<Vec3>& positions) const {
  std::vector<Vec3> x;
  for (const Image& i : image) {
    const Vec3 p = positions[i.node];
    x.push_back({i.xx * p.x + i.xy * p.y, i.yx * p.x + i.yy * p.y, p.z});
  }
  return x;
}

std::optional<Sector> sector_of(const Mesh& mesh, const std::vector<Vec3>& start, const Loads& loads) {
  const bool closed = !mesh.patches.empty() && std::all_of(mesh.patches.begin(), mesh.patches.end(),
                                                           [](const Patch& patch) { return patch.periodic; });
  if (!closed || mesh.drawstring || !loads.node_force.empty()) return {};
  return Search(mesh, start).widest(loads);
}

}  // namespace ripstop::inline cloth
