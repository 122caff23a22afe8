#include "ripstop/canopy/shape.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "ripstop/core/checked_int.h"

namespace ripstop::inline canopy {
namespace {

using std::numbers::pi;

double circle_of(double area) {
  return std::sqrt(4 * area / pi);
}

// The outline seen along z: the farthest cloth in every direction from the axis. Rows are followed from node
// to node, since a coarse mesh has fewer columns than there are directions.
double outline_area(const Mesh& mesh, const std::vector<Vec3>& x) {
  constexpr int sectors = 180, steps = 8;
  std::vector<double> radius(sectors, 0.0);
  for (const Patch& patch : mesh.patches) {
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 0; column < patch.columns; ++column) {
        const bool last = column + 1 == patch.columns;
        const Vec3 a = x[patch.node(row, column)];
        const Vec3 b = last && !patch.periodic ? a : x[patch.node(row, last ? 0 : column + 1)];
        for (int k = 0; k < steps; ++k) {
          const Vec3 p = a + (double(k) / steps) * (b - a);
          const double angle = std::atan2(p.y, p.x) + pi;
          const int sector = std::min(sectors - 1, checked_int(angle / (2 * pi) * sectors, 0, sectors, [] {
                                        return "the outline of a canopy has a position that is not finite";
                                      }));
          radius[sector] = std::max(radius[sector], std::hypot(p.x, p.y));
        }
      }
    }
  }
  double area = 0;
  for (const double r : radius) area += pi * r * r / sectors;
  return area;
}

// The skirt's mean plane.
double skirt_height(const CanopyMesh& mesh, const std::vector<Vec3>& x) {
  const std::vector<int>& skirt = mesh.rigging.skirt_nodes;
  double z = 0;
  for (const int node : skirt) z += x[node].z / double(skirt.size());
  return z;
}

}  // namespace

CanopySize canopy_size(const CanopyMesh& mesh, const std::vector<Vec3>& x) {
  CanopySize size;
  size.projected_area = outline_area(mesh, x);
  size.projected_diameter = circle_of(size.projected_area);
  size.skirt_diameter = circle_of(skirt_area(mesh, x));
  const double skirt_z = skirt_height(mesh, x);
  for (const Patch& patch : mesh.patches) {
    for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node) {
      size.length = std::max(size.length, x[node].z - skirt_z);
    }
  }
  return size;
}

CanopySize mean_size(const CanopyMesh& one, const std::vector<std::vector<Vec3>>& canopies) {
  CanopySize mean;
  const double share = 1.0 / double(canopies.size());
  for (const std::vector<Vec3>& x : canopies) {
    const CanopySize size = canopy_size(one, x);
    mean.projected_diameter += share * size.projected_diameter;
    mean.projected_area += share * size.projected_area;
    mean.skirt_diameter += share * size.skirt_diameter;
    mean.length += share * size.length;
  }
  return mean;
}

double skirt_area(const CanopyMesh& mesh, const std::vector<Vec3>& x) {
  const std::vector<int>& skirt = mesh.rigging.skirt_nodes;
  double area = 0;
  for (std::size_t i = 0; i < skirt.size(); ++i) {
    const Vec3 a = x[skirt[i]], b = x[skirt[(i + 1) % skirt.size()]];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return std::abs(area);
}

double asymmetry(const Mesh& mesh, const std::vector<Vec3>& x, int symmetry) {
  const double turn = 2 * pi / symmetry, c = std::cos(turn), s = std::sin(turn);
  double worst = 0;
  for (const Patch& patch : mesh.patches) {
    if (patch.columns % symmetry != 0) continue;
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 0; column < patch.columns; ++column) {
        const Vec3 p = x[patch.node(row, column)];
        const Vec3 q = x[patch.node(row, (column + patch.columns / symmetry) % patch.columns)];
        worst = std::max(worst, norm(q - Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z}));
      }
    }
  }
  return worst;
}

std::vector<ProfileRing> canopy_profile(const CanopyMesh& mesh, const std::vector<Vec3>& x) {
  const double skirt = skirt_height(mesh, x);
  std::vector<ProfileRing> rings;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    const Patch& patch = mesh.patches[p];
    if (!patch.periodic) continue;
    for (int row = 0; row < patch.rows; ++row) {
      ProfileRing ring{static_cast<int>(p), row, -skirt, 0, INFINITY, 0};
      double area = 0;
      for (int column = 0; column < patch.columns; ++column) {
        const Vec3 a = x[patch.node(row, column)], b = x[patch.node(row, (column + 1) % patch.columns)];
        area += 0.5 * (a.x * b.y - a.y * b.x);
        ring.z += a.z / patch.columns;
        ring.smallest_radius = std::min(ring.smallest_radius, std::hypot(a.x, a.y));
        ring.largest_radius = std::max(ring.largest_radius, std::hypot(a.x, a.y));
      }
      ring.diameter = circle_of(std::abs(area));
      rings.push_back(ring);
    }
  }
  return rings;
}

std::map<std::string, double> image_sizes(const CanopyMesh& mesh, const std::vector<Vec3>& x) {
  std::map<std::string, double> sizes;
  const std::vector<ProfileRing> all = canopy_profile(mesh, x);
  if (all.empty()) return sizes;
  const auto rings_of = [&](const std::vector<int>& patches) {
    std::vector<ProfileRing> rings;
    std::copy_if(all.begin(), all.end(), std::back_inserter(rings), [&](const ProfileRing& ring) {
      return std::find(patches.begin(), patches.end(), ring.patch) != patches.end();
    });
    return rings;
  };
  std::vector<ProfileRing> band = rings_of(mesh.rigging.band_patches);
  const std::vector<ProfileRing> disk = rings_of(mesh.rigging.disk_patches);
  const auto by_z = [](const ProfileRing& a, const ProfileRing& b) { return a.z < b.z; };
  const auto length = [&](const std::vector<ProfileRing>& rings) {
    const auto [low, high] = std::minmax_element(rings.begin(), rings.end(), by_z);
    return high->z - low->z;
  };
  sizes["L_tot"] = std::max_element(all.begin(), all.end(), by_z)->z;
  if (band.empty() || disk.empty()) {
    sizes["D_st"] = std::min_element(all.begin(), all.end(), by_z)->diameter;
    sizes["D_mid"] = std::max_element(all.begin(), all.end(), [](const ProfileRing& a, const ProfileRing& b) {
                       return a.diameter < b.diameter;
                     })->diameter;
    return sizes;
  }
  std::sort(band.begin(), band.end(), by_z);
  sizes["D_st"] = band.front().diameter;
  sizes["D_mid"] = band[band.size() / 2].diameter;
  sizes["D_end"] = band.back().diameter;
  sizes["L_disk"] = length(disk);
  sizes["L_band"] = length(band);
  return sizes;
}

}  // namespace ripstop::inline canopy
