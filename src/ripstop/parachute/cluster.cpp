#include "ripstop/parachute/cluster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "ripstop/core/error.h"

namespace ripstop::inline parachute {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// v after the smallest rotation that brings the unit vector `from` to the z axis (Rodrigues).
Vec3 raised(Vec3 v, Vec3 from) {
  const Vec3 axis = cross(from, {0, 0, 1});
  return from.z * v + cross(axis, v) + (dot(axis, v) / (1 + from.z)) * axis;
}

void shift(std::vector<int>& indices, int by) {
  for (int& i : indices) i += by;
}

/// Numbers of nodes, springs, patches and parts of a canopy behind those of earlier ones.
struct Offsets {
  int node, spring, patch, part, radial;
};

void append(CanopyMesh& all, const CanopyMesh& one, const Offsets& at, int number) {
  for (Patch patch : one.patches) {
    patch.first_node += at.node;
    patch.piece = number - 1;
    all.patches.push_back(std::move(patch));
  }
  for (Spring spring : one.springs) {
    spring.a += at.node, spring.b += at.node, spring.part += at.part;
    all.springs.push_back(spring);
  }
  for (Tie tie : one.ties) {
    tie.node += at.node;
    for (Tie::Master& master : tie.masters) master.node += at.node;
    all.ties.push_back(std::move(tie));
  }
  for (const std::string& part : one.parts) all.parts.push_back(fmt::format("canopy {}, {}", number, part));
  for (const int node : one.fixed) all.fixed.push_back(node + at.node);
  for (LineRun line : one.rigging.lines) {
    line.radial += at.radial;
    shift(line.springs, at.spring);
    all.rigging.lines.push_back(std::move(line));
  }
  const auto add = [](std::vector<int>& to, std::vector<int> more, int by) {
    shift(more, by);
    to.insert(to.end(), more.begin(), more.end());
  };
  add(all.rigging.vent_line_springs, one.rigging.vent_line_springs, at.spring);
  add(all.rigging.riser_springs, one.rigging.riser_springs, at.spring);
  add(all.rigging.tape_springs, one.rigging.tape_springs, at.spring);
  add(all.rigging.skirt_nodes, one.rigging.skirt_nodes, at.node);
  add(all.rigging.disk_patches, one.rigging.disk_patches, at.patch);
  add(all.rigging.band_patches, one.rigging.band_patches, at.patch);
}

}  // namespace

double ClusterLayout::azimuth(int k) const {
  const double first = canopies == 3 ? full_turn / 4 : canopies == 4 ? full_turn / 8 : 0;
  return first + full_turn * k / canopies;
}

Vec3 ClusterLayout::width() const {
  Vec3 low, high;
  for (int k = 0; k < canopies; ++k) {
    const Vec3 axis = std::sin(spread) * Vec3{std::cos(azimuth(k)), std::sin(azimuth(k)), 0};
    low = {std::min(low.x, axis.x), std::min(low.y, axis.y), 0};
    high = {std::max(high.x, axis.x), std::max(high.y, axis.y), 0};
  }
  // About the axis of the cluster, which is that of the domain.
  return {2 * std::max(high.x, -low.x), 2 * std::max(high.y, -low.y), 0};
}

Cluster::Cluster(CanopyMesh one, ClusterLayout layout) : one_(std::move(one)), layout_(layout) {
  if (one_.fixed.size() != 1 || one_.rigging.skirt_nodes.empty() || one_.patches.empty())
    throw Error(ExitCode::usage,
                fmt::format("a canopy of a cluster needs one fixed node and a skirt; this one has {} fixed "
                            "nodes and {} nodes at its skirt",
                            one_.fixed.size(), one_.rigging.skirt_nodes.size()));
  end_of_riser_ = one_.start[one_.fixed.front()];
  const double length = skirt_centroid(one_, one_.start).z - end_of_riser_.z;
  confluence_ = end_of_riser_ + Vec3{0, 0, length * (1 - std::cos(layout_.spread))};
}

Cluster::Frame Cluster::frame(int k) const {
  const double around = layout_.azimuth(k), c = std::cos(around), s = std::sin(around);
  const double axial = std::cos(layout_.spread), outward = std::sin(layout_.spread);
  return {{c * axial, s * axial, -outward}, {-s, c, 0}, {c * outward, s * outward, axial}};
}

CanopyMesh Cluster::mesh() const {
  CanopyMesh all;
  all.laws = one_.laws;
  all.fabric_names = one_.fabric_names;
  const int nodes = one_.node_count(), springs = static_cast<int>(one_.springs.size()),
            patches = static_cast<int>(one_.patches.size()), parts = static_cast<int>(one_.parts.size());
  int radials = 0;
  for (const LineRun& line : one_.rigging.lines) radials = std::max(radials, line.radial + 1);
  all.start.resize(static_cast<std::size_t>(nodes) * layout_.canopies);
  for (int k = 0; k < layout_.canopies; ++k) {
    append(all, one_, {k * nodes, k * springs, k * patches, k * parts, k * radials}, k + 1);
    all.mass.insert(all.mass.end(), one_.mass.begin(), one_.mass.end());
    put(k, one_.start, all.start);
  }
  all.rigging.confluence = one_.rigging.confluence;
  all.rigging.canopies = layout_.canopies;
  return all;
}

std::vector<Vec3> Cluster::own(int k, const std::vector<Vec3>& all) const {
  const Frame axes = frame(k);
  std::vector<Vec3> x = part(k, all);
  for (Vec3& p : x) p = end_of_riser_ + axes.in(p - confluence_);
  return x;
}

void Cluster::put(int k, const std::vector<Vec3>& own, std::vector<Vec3>& all) const {
  const Frame axes = frame(k);
  const std::size_t first = static_cast<std::size_t>(k) * own.size();
  for (std::size_t n = 0; n < own.size(); ++n)
    all[first + n] = confluence_ + axes.out(own[n] - end_of_riser_);
}

std::vector<Vec3> Cluster::overlaid(const std::vector<Vec3>& all) const {
  std::vector<Vec3> x;
  for (int k = 0; k < layout_.canopies; ++k) {
    const std::vector<Vec3> one = own(k, all);
    x.insert(x.end(), one.begin(), one.end());
  }
  return x;
}

std::vector<Vec3> Cluster::upright(std::vector<Vec3> own) const {
  const Vec3 arm = skirt_centroid(one_, own) - end_of_riser_;
  const Vec3 axis = arm / norm(arm);
  for (Vec3& p : own) p = end_of_riser_ + raised(p - end_of_riser_, axis);
  return own;
}

JoinedCluster join_risers(const CanopyMesh& cluster) {
  JoinedCluster joined{cluster, std::vector<int>(cluster.start.size(), 0)};
  std::vector<char> removed(cluster.start.size(), 0);
  for (std::size_t k = 1; k < cluster.fixed.size(); ++k) removed[cluster.fixed[k]] = 1;
  int count = 0;
  for (std::size_t n = 0; n < removed.size(); ++n)
    if (!removed[n]) joined.node[n] = count++;
  CanopyMesh& mesh = joined.mesh;
  const int confluence = joined.node[cluster.fixed.front()];
  mesh.start.resize(count), mesh.mass.assign(count, 0.0);
  for (std::size_t n = 0; n < removed.size(); ++n) {
    if (removed[n]) joined.node[n] = confluence;
    mesh.mass[joined.node[n]] += cluster.mass[n];
  }
  mesh.start = joined.joined(cluster.start);
  const auto renumber = [&](int& node) { node = joined.node[node]; };
  for (Patch& patch : mesh.patches) renumber(patch.first_node);
  for (Spring& spring : mesh.springs) renumber(spring.a), renumber(spring.b);
  for (Tie& tie : mesh.ties) {
    renumber(tie.node);
    for (Tie::Master& master : tie.masters) renumber(master.node);
  }
  for (int& node : mesh.rigging.skirt_nodes) renumber(node);
  renumber(mesh.rigging.confluence);
  mesh.fixed = {confluence};
  return joined;
}

std::vector<Vec3> JoinedCluster::joined(const std::vector<Vec3>& all) const {
  std::vector<Vec3> x(mesh.mass.size());
  for (std::size_t n = all.size(); n-- > 0;)
    x[node[n]] = all[n];  // the confluence is that of the first canopy
  return x;
}

double Cluster::gap(const std::vector<Vec3>& all) const {
  const double half = 0.5 * full_turn / layout_.canopies;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < layout_.canopies; ++k) {
    const double around = layout_.azimuth(k), c = std::cos(around), s = std::sin(around);
    const std::vector<Vec3> x = part(k, all);
    for (const Patch& patch : one_.patches)
      for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node) {
        const Vec3 p = x[node];
        const double outward = c * p.x + s * p.y, across = std::abs(c * p.y - s * p.x);
        least = std::min(least, outward * std::sin(half) - across * std::cos(half));
      }
  }
  return 2 * least;
}

}  // namespace ripstop::inline parachute
