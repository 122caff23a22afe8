#include "ripstop/fsi/packed_cloth.h"

#include <algorithm>
#include <limits>

namespace ripstop {
namespace {

constexpr double released_a_step = 1.0 / 60;  // of the canopy's length, at most
constexpr double stripped_edge = 1.0 / 20;    // of the canopy's length, that the strip force acts on

}  // namespace

PackedCloth::PackedCloth(const Bag& bag, const CanopyMesh& mesh, const std::vector<Vec3>& folded)
    : bag_(bag), mass_(mesh.mass), distance_(folded.size(), -1.0), packed_(folded) {
  double skirt = std::numeric_limits<double>::infinity();
  const auto each_cloth_node = [&](const auto& work) {
    for (const Patch& patch : mesh.patches)
      for (int i = 0; i < patch.rows * patch.columns; ++i) work(patch.first_node + i);
  };
  each_cloth_node([&](int node) { skirt = std::min(skirt, folded[node].z); });
  each_cloth_node([&](int node) {
    distance_[node] = folded[node].z - skirt;
    length_ = std::max(length_, distance_[node]);
    packed_[node].z = skirt + bag.packed_share * distance_[node];
  });
}

double PackedCloth::longest_step(double payload_speed, const BagMotion& motion) const {
  const double away = payload_speed - motion.speed;
  return away > 0 ? released_a_step * length_ * (1 - bag_.packed_share) / away
                  : std::numeric_limits<double>::infinity();
}

void PackedCloth::hold(double payload_speed, const BagMotion& motion, ClothMotion& predicted) const {
  for (std::size_t n = 0; n < distance_.size(); ++n)
    if (holds(static_cast<int>(n), motion)) predicted.velocity[n] = {0, 0, payload_speed - motion.speed};
}

std::vector<int> PackedCloth::just_released(const BagMotion& motion) const {
  std::vector<int> nodes;
  double edge = -1;  // of the cloth that is out
  for (const double distance : distance_)
    if (distance <= released(motion)) edge = std::max(edge, distance);
  for (std::size_t n = 0; n < distance_.size(); ++n)
    if (distance_[n] >= 0 && distance_[n] <= edge && distance_[n] > edge - stripped_edge * length_)
      nodes.push_back(static_cast<int>(n));
  return nodes;
}

void PackedCloth::shield(const BagMotion& motion, const std::vector<Cell>& cells, Loads& loads) const {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].corner[0] < 0) continue;
    for (const int node : cells[c].corner)
      if (holds(node, motion)) loads.cell_pressure[c] = 0;
  }
  for (std::size_t n = 0; n < distance_.size(); ++n)
    if (holds(static_cast<int>(n), motion)) loads.node_force[n] = {};
  double mass = 0;
  const std::vector<int> edge = just_released(motion);
  for (const int node : edge) mass += mass_[node];
  for (const int node : edge) loads.node_force[node].z += bag_.strip_force * mass_[node] / mass;
}

double PackedCloth::carry(const Stream& stream, double length, const Cloth& cloth, ClothState& state,
                          BagMotion& motion) const {
  double mass = bag_.mass;
  for (std::size_t n = 0; n < distance_.size(); ++n)
    if (holds(static_cast<int>(n), motion)) mass += mass_[n];
  const double strip = just_released(motion).empty() ? 0 : bag_.strip_force;
  const double drag = 0.5 * stream.density * motion.speed * motion.speed * bag_.drag_area;
  motion.speed =
      std::min(motion.speed + length * ((strip - drag) / mass + stream.gravity), stream.payload_speed);
  motion.travel += length * (stream.payload_speed - motion.speed);

  std::vector<Vec3> x = ripstop::positions(state, cloth), v = velocities(state, cloth);
  const Vec3 velocity{0, 0, stream.payload_speed - motion.speed};
  double work = 0;
  for (std::size_t n = 0; n < distance_.size(); ++n) {
    if (!holds(static_cast<int>(n), motion)) continue;
    work += 0.5 * mass_[n] * (dot(velocity, velocity) - dot(v[n], v[n]));
    x[n] = packed_[n] + Vec3{0, 0, motion.travel};
    v[n] = velocity;
  }
  set_positions(state, cloth, x);
  set_velocities(state, cloth, v);
  return work;
}

}  // namespace ripstop
