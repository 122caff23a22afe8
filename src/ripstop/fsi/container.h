// The container of a canopy that opens while it leaves it.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/core/vec3.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop::inline fsi {

/// A body behind the payload on its path, with the canopy that has not left it. Cloth leaves it from skirt to vent.
struct Container {
  double mass = 0, drag_area = 0;             // empty, with the pilot chute [kg], [m2]
  double canopy_mass = 0, canopy_length = 0;  // length from skirt to vent, stretched out [kg], [m]
  double strip_force = 0;                     // that pulls the canopy out of it [N]
  double relative_speed = 0;                  // of payload and container at the start [m/s]
};

struct ContainerMotion {
  double speed = 0;                 // through the air [m/s]
  double apart = 0;                 // distance that it has fallen behind the cloth in it [m]
  double farthest = 0;              // largest `apart`: the length of canopy that has left it [m]
  std::optional<double> left = {};  // time at which the whole canopy has left it [s]
};
template <Of<ContainerMotion> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("speed", m.speed);
  visit("apart", m.apart);
  visit("farthest", m.farthest);
  visit("left", m.left);
}

/// Over one step of `length` [s], with the mean speed `cloth_speed` [m/s] of the cloth inside, in air of `density`
/// [kg/m3] and under gravity along the path [m/s2]. Returns the mean force between container and cloth [N], from 0 to
/// the strip force: it acts while the cloth between them is taut, and keeps them at one speed if it can.
double move_container(ContainerMotion& motion, const Container& container, double cloth_speed, double length,
                      double density, double gravity);

/// Cloth in the container stays folded: it moves along the axis only.
class ContainedCloth {
 public:
  /// `folded`: positions of the nodes of `mesh` [m], the skirt at the smallest z of the cloth and the vent at the
  /// largest.
  ContainedCloth(const Mesh& mesh, const std::vector<Vec3>& folded);

  /// Those that the container guides: the nodes farther from the skirt than this share of the canopy's length.
  std::vector<int> beyond(double share) const;

 private:
  std::vector<double> from_skirt_;  // share of the canopy's length, by node; below 0 for lines
};

}  // namespace ripstop::inline fsi
