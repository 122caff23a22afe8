#include "ripstop/canopy/mirror.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>

namespace ripstop::inline canopy {
namespace {

constexpr double same_place = 1e-7;  // of the size of the canopy
constexpr double same_value = 1e-6;  // of masses and lengths, relative

Vec3 in_mirror(Vec3 v, std::size_t plane) {
  return plane == 0 ? Vec3{-v.x, v.y, v.z} : Vec3{v.x, -v.y, v.z};
}

bool alike(double a, double b) {
  return std::abs(a - b) <= same_value * std::max(std::abs(a), std::abs(b));
}

/// Points by their place.
class PointCloud {
 public:
  PointCloud(const std::vector<Vec3>& points, double size) : points_(points), near_(same_place * size) {
    for (int n = 0; n < static_cast<int>(points.size()); ++n)
      in_box_[key(box(points[n].x), box(points[n].y), box(points[n].z))].push_back(n);
  }

  /// The first point at a place for which `matches` is true; -1 for none.
  template <class Matches>
  int at(Vec3 place, const Matches& matches) const {
    const std::int64_t x = box(place.x), y = box(place.y), z = box(place.z);
    for (int around = 0; around < 27; ++around) {
      const auto found = in_box_.find(key(x + around % 3 - 1, y + around / 3 % 3 - 1, z + around / 9 - 1));
      if (found == in_box_.end()) continue;
      for (const int n : found->second)
        if (norm(points_[n] - place) <= near_ && matches(n)) return n;
    }
    return -1;
  }

 private:
  std::int64_t box(double at) const { return std::llround(at / (4 * near_)); }
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    const auto mixed = [](std::int64_t value, std::uint64_t factor) {
      return static_cast<std::uint64_t>(value) * factor;
    };
    return mixed(x, 0x9e3779b97f4a7c15u) ^ mixed(y, 0xc2b2ae3d27d4eb4fu) ^ mixed(z, 0x165667b19e3779f9u);
  }

  const std::vector<Vec3>& points_;
  double near_;
  std::unordered_map<std::uint64_t, std::vector<int>> in_box_;
};

/// A mirror exchanges the two diagonals of a cell of the lattice.
bool lattice_is_mirrored(const Patch& patch) {
  const SpringLaw &up = patch.law[shear_up], &down = patch.law[shear_down];
  return up.coefficients == down.coefficients && patch.damping[shear_up] == patch.damping[shear_down];
}

bool springs_are_mirrored(const Mesh& mesh, double size) {
  std::vector<Vec3> middles;
  for (const Spring& spring : mesh.springs)
    middles.push_back(0.5 * (mesh.start[spring.a] + mesh.start[spring.b]));
  const PointCloud cloud(middles, size);
  for (std::size_t n = 0; n < middles.size(); ++n) {
    const Spring& own = mesh.springs[n];
    for (const std::size_t plane : {0u, 1u}) {
      const int image = cloud.at(in_mirror(middles[n], plane), [&](int other) {
        const Spring& s = mesh.springs[other];
        return alike(s.rest_length, own.rest_length) && alike(s.scale, own.scale) &&
               mesh.laws[s.law].coefficients == mesh.laws[own.law].coefficients;
      });
      if (image < 0) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<MirrorImages> mirror_images(const Mesh& mesh) {
  if (!std::all_of(mesh.patches.begin(), mesh.patches.end(), lattice_is_mirrored)) return {};
  double size = 0;
  for (const Vec3 p : mesh.start) size = std::max({size, std::abs(p.x), std::abs(p.y)});
  const PointCloud cloud(mesh.start, size);
  MirrorImages images;
  for (const std::size_t plane : {0u, 1u}) {
    for (std::size_t node = 0; node < mesh.start.size(); ++node) {
      const int image = cloud.at(in_mirror(mesh.start[node], plane),
                                 [&](int other) { return alike(mesh.mass[other], mesh.mass[node]); });
      if (image < 0) return {};
      images[plane].push_back(image);
    }
  }
  if (!springs_are_mirrored(mesh, size)) return {};
  return images;
}

double mirror_gap(const Mesh& mesh, const MirrorImages& images, const std::vector<Vec3>& x) {
  double worst = 0;
  for (const Patch& patch : mesh.patches)
    for (int node = patch.node(0, 0); node < patch.node(patch.rows, 0); ++node)
      for (const std::size_t plane : {0u, 1u})
        worst = std::max(worst, norm(x[images[plane][node]] - in_mirror(x[node], plane)));
  return worst;
}

}  // namespace ripstop::inline canopy
