#include "ripstop/coupling/profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ripstop {
namespace {

/// Mean and largest of strains with weights.
class Gathered {
 public:
  void add(double strain, double weight) {
    sum_ += strain * weight;
    weights_ += weight;
    largest_ = std::max(largest_, strain);
  }
  bool any() const { return weights_ > 0; }
  Strains strains() const { return {sum_ / weights_, largest_}; }

 private:
  double sum_ = 0, weights_ = 0, largest_ = -1;
};

double strain_of(const Spring& spring, const std::vector<Vec3>& x) {
  return norm(x[spring.b] - x[spring.a]) / spring.rest_length - 1;
}

void add_cloth(Gathered& cloth, const Patch& patch, const std::vector<Vec3>& x) {
  for (const Direction direction : {along_row, along_column}) {
    const Offset step = direction_offset[direction];
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 0; column < patch.columns; ++column) {
        const std::size_t at = std::size_t(row) * patch.columns + column;
        const double width = patch.width[direction][at], rest = patch.rest_length[direction][at];
        if (!(width > 0)) continue;
        const Vec3 d = x[patch.node(row + step.row, (column + step.column) % patch.columns)] -
                       x[patch.node(row, column)];
        cloth.add(norm(d) / rest - 1, width * rest);
      }
    }
  }
}

}  // namespace

std::vector<ProfileRing> canopy_profile(const Mesh& mesh, const std::vector<Vec3>& x) {
  double skirt = 0;
  for (const int node : mesh.skirt_nodes) skirt += x[node].z / double(mesh.skirt_nodes.size());
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
      ring.diameter = std::sqrt(4 * std::abs(area) / std::numbers::pi);
      rings.push_back(ring);
    }
  }
  return rings;
}

std::map<std::string, double> image_sizes(const Mesh& mesh, const std::vector<Vec3>& x) {
  std::map<std::string, double> sizes;
  std::vector<ProfileRing> band, disk, all = canopy_profile(mesh, x);
  if (all.empty()) return sizes;
  for (const ProfileRing& ring : all) {
    const std::string& name = mesh.patches[ring.patch].name;
    if (name == "band") band.push_back(ring);
    if (name == "disk") disk.push_back(ring);
  }
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

std::map<std::string, Strains> part_strains(const Mesh& mesh, const std::vector<Vec3>& x) {
  Gathered lines, tape, cloth;
  for (const LineRun& line : mesh.lines) {
    for (int i = 0; i < line.free_springs; ++i) {
      const Spring& spring = mesh.springs[line.springs[i]];
      lines.add(strain_of(spring, x), spring.rest_length);
    }
  }
  for (const Spring& spring : mesh.springs) {
    if (mesh.parts[spring.part].ends_with("tape"))
      tape.add(strain_of(spring, x), spring.rest_length * spring.scale);
  }
  for (const Patch& patch : mesh.patches) add_cloth(cloth, patch, x);
  std::map<std::string, Strains> strains;
  if (lines.any()) strains["lines"] = lines.strains();
  if (tape.any()) strains["tape"] = tape.strains();
  if (cloth.any()) strains["cloth"] = cloth.strains();
  return strains;
}

}  // namespace ripstop
