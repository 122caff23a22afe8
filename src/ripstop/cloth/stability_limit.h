// Bounds on the cloth's largest frequency, and checks on a state. Internal to cloth/.
#pragma once

#include <array>
#include <vector>

#include "ripstop/cloth/layout.h"
#include "ripstop/core/thread_team.h"

namespace ripstop::inline cloth {

/// Symmetric 3 x 3: xx, yy, zz, xy, xz, yz.
using Symmetric = std::array<double, 6>;
inline Vec3 operator*(const Symmetric& a, Vec3 b) {
  return {a[0] * b.x + a[3] * b.y + a[4] * b.z, a[3] * b.x + a[1] * b.y + a[5] * b.z,
          a[4] * b.x + a[5] * b.y + a[2] * b.z};
}

/// Diagonal blocks of the tangent stiffness, by node [N/m], tied nodes' handed to their masters: of every
/// spring k n n^T + max(T / l, floor k) (I - n n^T), with the tangent k of its first pull where it is slack.
void node_blocks(const Cloth& cloth, const ClothState& state, double floor, ThreadTeam& team,
                 std::vector<Symmetric>& blocks);

/// Of a drawstring, by node, tied rings' handed to their masters: x^T K x <= sum stiffness_i |x_i|^2 for its tangent
/// stiffness K, and likewise of its damper [N/m], [N s/m]. Empty without one.
struct StringShares {
  std::vector<double> stiffness, damping;
};
StringShares string_shares(const Cloth& cloth, const ClothState& state);

/// lambda_max of the diagonal block of the tangent stiffness, by node [N/m], tied nodes' handed to their
/// masters; likewise of the relative damping [N s/m]. See stability_limit.
struct NodeStiffness {
  std::vector<double> stiffness, damping;
  StringShares string;
  double largest_strain = 0;
  int stretched_node = -1;
};
NodeStiffness node_stiffness(const Cloth& cloth, const ClothState& state);
/// As stability_limit(cloth, state), whose node_stiffness() is known.
StabilityLimit stability_limit(const Cloth& cloth, const ClothState& state, const NodeStiffness& node);

/// Pressure and point forces over the free nodes, tied nodes' handed on.
struct AppliedLoad {
  double norm = 0;  // root sum of squares [N]
  double sum = 0;   // of the magnitudes [N]
  Vec3 moment;      // about `pivot` [N m]
};
AppliedLoad applied_load(const Cloth& cloth, const ClothState& state, const Loads& loads, Vec3 pivot = {});

/// Throws Error(diverged) for positions that are not finite.
void check_health(const Cloth& cloth, const ClothState& state);

}  // namespace ripstop::inline cloth
