// Cloth that is still in its bag when a coupled opening starts: it moves with the bag and leaves it from skirt to vent.
//
// The packed canopy is the folded one, pressed together along the axis to a share c of its length. A bag that has moved
// downstream by b since line stretch has released the cloth up to the folded distance b / (1 - c) from the skirt: there
// the canopy, stretched out from the skirt, reaches the mouth of the bag.
#pragma once

#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/fsi/coupled_flow.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop {

struct Bag {
  double mass = 0, drag_area = 0;  // empty, with what pulls it [kg], [m2]
  double strip_force = 0;          // that pulls cloth out of it [N]
  double relative_speed = 0;       // downstream of the payload when the canopy begins to leave it [m/s]
  double packed_share = 0.1;       // c
};

class PackedCloth {
 public:
  PackedCloth(const Bag& bag, const CanopyMesh& mesh, const std::vector<Vec3>& folded);

  /// The start: all cloth but the skirt's edge in the bag.
  const std::vector<Vec3>& positions() const { return packed_; }
  BagMotion start(double payload_speed) const { return {0, payload_speed - bag_.relative_speed, 0}; }
  bool holds(int node, const BagMotion& motion) const { return distance_[node] > released(motion); }
  bool empty(const BagMotion& motion) const { return released(motion) >= length_; }

  /// Steps in which the bag releases no more than a small part of the canopy [s].
  double longest_step(double payload_speed, const BagMotion& motion) const;
  /// Packed nodes are predicted to move with the bag.
  void hold(double payload_speed, const BagMotion& motion, ClothMotion& predicted) const;
  /// The bag keeps the air's load off the packed cloth; the strip force pulls at the cloth that has just left it.
  void shield(const BagMotion& motion, const std::vector<Cell>& cells, Loads& loads) const;
  /// Moves the bag over a step of `length` [s], and the packed cloth with it, which leaves with the speed of the bag:
  ///   M dv/dt = F - rho v^2 (C_D S) / 2 + M g,
  /// M of bag and packed cloth, v through the air. The bag does not overtake the payload. Returns the work that the bag
  /// does on the packed cloth in the frame of the payload [J].
  struct Stream {
    double payload_speed = 0, density = 0, gravity = 0;  // [m/s], [kg/m3], along the path [m/s2]
  };
  double carry(const Stream& stream, double length, const Cloth& cloth, ClothState& state,
               BagMotion& motion) const;

 private:
  double released(const BagMotion& motion) const { return motion.travel / (1 - bag_.packed_share); }
  std::vector<int> just_released(const BagMotion& motion) const;

  Bag bag_;
  std::vector<double> mass_;      // of the nodes [kg]
  std::vector<double> distance_;  // from the skirt's edge along the axis, folded; negative: not cloth [m]
  double length_ = 0;             // the largest [m]
  std::vector<Vec3> packed_;
};

}  // namespace ripstop
