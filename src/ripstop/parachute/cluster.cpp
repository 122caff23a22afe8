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

/// Numbers of nodes, springs, patches, parts, lines and laws of a canopy behind those of earlier ones.
struct Offsets {
  int node, spring, patch, part, radial, law;
};

void append(CanopyMesh& all, const CanopyMesh& one, const Offsets& at, int number) {
  for (Patch patch : one.patches) {
    patch.first_node += at.node;
    patch.piece = number - 1;
    all.patches.push_back(std::move(patch));
  }
  for (Spring spring : one.springs) {
    spring.a += at.node, spring.b += at.node, spring.part += at.part, spring.law += at.law;
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

/// The slices of all lists by canopy need equal counts.
void require_same_topology(const CanopyMesh& a, const CanopyMesh& b) {
  const auto patches = [](const Patch& p, const Patch& q) {
    return p.first_node == q.first_node && p.rows == q.rows && p.columns == q.columns;
  };
  const auto ends = [](const Spring& s, const Spring& t) { return s.a == t.a && s.b == t.b; };
  if (a.start.size() == b.start.size() && std::ranges::equal(a.patches, b.patches, patches) &&
      std::ranges::equal(a.springs, b.springs, ends) && a.ties.size() == b.ties.size() &&
      a.fixed == b.fixed && a.rigging.skirt_nodes == b.rigging.skirt_nodes &&
      a.rigging.lines.size() == b.rigging.lines.size())
    return;
  throw Error(
      ExitCode::usage,
      fmt::format("the meshes of two canopies of the cluster differ in more than their size: {} and {} "
                  "nodes, {} and {} springs; use another size of the canopy",
                  a.start.size(), b.start.size(), a.springs.size(), b.springs.size()));
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

Cluster::Cluster(CanopyMesh one, ClusterLayout layout)
    : Cluster(std::vector<CanopyMesh>{std::move(one)}, layout) {}

Cluster::Cluster(std::vector<CanopyMesh> canopies, ClusterLayout layout)
    : each_(std::move(canopies)), layout_(layout) {
  if (!equal() && std::ssize(each_) != layout_.canopies)
    throw Error(ExitCode::usage,
                fmt::format("{} meshes for a cluster of {} canopies", each_.size(), layout_.canopies));
  for (const CanopyMesh& mesh : each_) {
    if (mesh.fixed.size() != 1 || mesh.rigging.skirt_nodes.empty() || mesh.patches.empty())
      throw Error(ExitCode::usage,
                  fmt::format("a canopy of a cluster needs one fixed node and a skirt; this one has {} fixed "
                              "nodes and {} nodes at its skirt",
                              mesh.fixed.size(), mesh.rigging.skirt_nodes.size()));
    require_same_topology(each_.front(), mesh);
  }
  int longest = 0;
  for (int k = 1; k < std::ssize(each_); ++k)
    if (length(k) > length(longest)) longest = k;
  confluence_ = end_of_riser(longest) + Vec3{0, 0, length(longest) * (1 - std::cos(layout_.spread))};
}

double Cluster::length(int k) const {
  return skirt_centroid(one(k), one(k).start).z - end_of_riser(k).z;
}

Cluster::Frame Cluster::frame(int k) const {
  const double around = layout_.azimuth(k), c = std::cos(around), s = std::sin(around);
  const double axial = std::cos(layout_.spread), outward = std::sin(layout_.spread);
  return {{c * axial, s * axial, -outward}, {-s, c, 0}, {c * outward, s * outward, axial}};
}

CanopyMesh Cluster::mesh() const {
  CanopyMesh all;
  all.laws = one().laws;
  all.fabric_names = one().fabric_names;
  const int nodes = one().node_count(), springs = static_cast<int>(one().springs.size()),
            patches = static_cast<int>(one().patches.size()), parts = static_cast<int>(one().parts.size());
  int radials = 0;
  for (const LineRun& line : one().rigging.lines) radials = std::max(radials, line.radial + 1);
  all.start.resize(static_cast<std::size_t>(nodes) * layout_.canopies);
  for (int k = 0; k < layout_.canopies; ++k) {
    const CanopyMesh& canopy = one(k);
    int laws = 0;
    if (!equal() && k > 0) {
      laws = static_cast<int>(all.laws.size());
      all.laws.insert(all.laws.end(), canopy.laws.begin(), canopy.laws.end());
    }
    append(all, canopy, {k * nodes, k * springs, k * patches, k * parts, k * radials, laws}, k + 1);
    all.mass.insert(all.mass.end(), canopy.mass.begin(), canopy.mass.end());
    put(k, canopy.start, all.start);
  }
  all.rigging.confluence = one().rigging.confluence;
  all.rigging.canopies = layout_.canopies;
  return all;
}

std::vector<Vec3> Cluster::own(int k, const std::vector<Vec3>& all) const {
  const Frame axes = frame(k);
  const Vec3 end = end_of_riser(k);
  std::vector<Vec3> x = part(k, all);
  for (Vec3& p : x) p = end + axes.in(p - confluence_);
  return x;
}

void Cluster::put(int k, const std::vector<Vec3>& own, std::vector<Vec3>& all) const {
  const Frame axes = frame(k);
  const Vec3 end = end_of_riser(k);
  const std::size_t first = static_cast<std::size_t>(k) * own.size();
  for (std::size_t n = 0; n < own.size(); ++n) all[first + n] = confluence_ + axes.out(own[n] - end);
}

std::vector<Vec3> Cluster::overlaid(const std::vector<Vec3>& all) const {
  std::vector<Vec3> x;
  for (int k = 0; k < layout_.canopies; ++k) {
    std::vector<Vec3> canopy = own(k, all);
    if (!equal()) {
      const double larger = length(0) / length(k);
      const Vec3 to = end_of_riser(0), from = end_of_riser(k);
      for (Vec3& p : canopy) p = to + larger * (p - from);
    }
    x.insert(x.end(), canopy.begin(), canopy.end());
  }
  return x;
}

std::vector<Vec3> Cluster::upright(int k, std::vector<Vec3> own) const {
  const Vec3 end = end_of_riser(k), arm = skirt_centroid(one(k), own) - end;
  const Vec3 axis = arm / norm(arm);
  for (Vec3& p : own) p = end + raised(p - end, axis);
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
    for (const Patch& patch : one().patches)
      for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node) {
        const Vec3 p = x[node];
        const double outward = c * p.x + s * p.y, across = std::abs(c * p.y - s * p.x);
        least = std::min(least, outward * std::sin(half) - across * std::cos(half));
      }
  }
  return 2 * least;
}

}  // namespace ripstop::inline parachute
