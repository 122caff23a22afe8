#include "ripstop/cloth/pivot.h"

#include <Eigen/Dense>

#include "ripstop/cloth/restraint.h"

namespace ripstop::inline cloth {
namespace {

// Solves sum weight (r^2 I - r r^T) w = moment.
Vec3 turn(const Eigen::Matrix3d& inertia, Vec3 moment) {
  const Eigen::Vector3d w = inertia.fullPivLu().solve(Eigen::Vector3d(moment.x, moment.y, moment.z));
  return {w.x(), w.y(), w.z()};
}

void add_inertia(Eigen::Matrix3d& inertia, double weight, Vec3 r) {
  const Eigen::Vector3d e(r.x, r.y, r.z);
  inertia += weight * (e.squaredNorm() * Eigen::Matrix3d::Identity() - e * e.transpose());
}

}  // namespace

std::optional<Vec3> pivot_of(const Cloth& cloth, const ClothState& state) {
  const std::vector<int>& fixed = cloth.mesh.fixed;
  if (fixed.empty()) return {};
  const Vec3 first = get(state.x.data(), cloth.slot[fixed[0]]);
  for (int node : fixed)
    if (!(get(state.x.data(), cloth.slot[node]) == first)) return {};
  return first;
}

void stop_turning(const Cloth& cloth, ClothState& state, const std::vector<Symmetric>& masses, Vec3 pivot) {
  std::vector<double> mass;
  for (const Symmetric& m : masses) mass.push_back(std::max({m[0], m[1], m[2]}));
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Vec3 momentum;
  for (std::size_t node = 0; node < mass.size(); ++node) {
    if (mass[node] == 0) continue;
    const Vec3 r = get(state.x.data(), cloth.slot[node]) - pivot;
    add_inertia(inertia, mass[node], r);
    momentum += mass[node] * cross(r, get(state.v.data(), cloth.slot[node]));
  }
  const Vec3 w = turn(inertia, momentum);
  for (std::size_t node = 0; node < mass.size(); ++node) {
    if (mass[node] == 0) continue;
    const int slot = cloth.slot[node];
    put(state.v.data(), slot, get(state.v.data(), slot) - cross(w, get(state.x.data(), slot) - pivot));
  }
  follow(cloth, state.v.data(), 0, cloth.row_count, true);
  mirror(cloth, state.v.data(), 0, cloth.row_count);
}

void cancel_moment(const Cloth& cloth, const ClothState& state, Vec3 moment, Vec3 pivot,
                   std::vector<Vec3>& force) {
  const auto free = [&](int node) { return !cloth.is_tied[node] && !cloth.is_fixed[node]; };
  const auto arm = [&](int node) { return get(state.x.data(), cloth.slot[node]) - pivot; };
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (int node = 0; node < cloth.mesh.node_count(); ++node)
    if (free(node)) add_inertia(inertia, 1, arm(node));
  const Vec3 t = turn(inertia, moment);
  force.resize(cloth.mesh.node_count());
  for (int node = 0; node < cloth.mesh.node_count(); ++node)
    if (free(node)) force[node] -= cross(t, arm(node));
}

std::vector<Vec3> pivot_restraint(const Cloth& cloth, const ClothState& state, const Loads& loads) {
  const std::optional<Vec3> pivot = pivot_of(cloth, state);
  if (!pivot) return {};
  std::vector<Vec3> force;
  cancel_moment(cloth, state, applied_load(cloth, state, loads, *pivot).moment, *pivot, force);
  return force;
}

}  // namespace ripstop::inline cloth
