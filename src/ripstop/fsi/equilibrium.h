// Static equilibrium of the cloth within the steady loop, regularised towards the previous shape where the cloth
// alone finds none.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/mesh/mesh.h"
#include "ripstop/parachute/cluster.h"

namespace ripstop::inline fsi {

struct EquilibriumOptions {
  double tolerance = 5e-4;      // RelaxOptions::tolerance
  bool shape_is_loaded = true;  // the previous shape is one under load: it may serve for regularisation
  double regularisation = 0;    // to start with [Pa/m]
  double unit = 0;              // of the regularisation, see regularisation_unit() [Pa/m]
  /// Further equilibria, each from the shape of the one before, as long as the regularisation carries a larger share of
  /// the load than this.
  double repeat_above = std::numeric_limits<double>::infinity();
};

struct Equilibrium {
  ClothState cloth;
  bool converged = false;
  int steps = 0;  // of all relaxations
  double residual = 0;
  double regularisation =
      0;  // RelaxOptions::regularisation: restoring force towards the previous shape, an area and displacement [Pa/m]
  double regularisation_share = 0;  // its norm over that of the applied load
  /// Of a cluster: node forces that keep each canopy at its angle, see pivot_restraint() [N]. Else empty.
  std::vector<Vec3> restraint = {};
};

/// Mean magnitude of the pressure over the root of the cloth's area [Pa/m].
double regularisation_unit(const std::vector<double>& pressure, const std::vector<double>& area);

/// At rest at `positions`.
ClothState cloth_at(const Cloth& cloth, const std::vector<Vec3>& positions);

/// Equilibrium under `loads`, sought from the shape `previous`.
///
/// Slack cloth under the pressures of a shape that it has left may have no equilibrium nearby: a loose edge turns over
/// and over, where in flight the flow would follow it. After 40,000 steps without rest every node is therefore pulled
/// back to `previous` in proportion to its area and displacement. As the steady loop converges, this force vanishes.
Equilibrium find_equilibrium(const Cloth& cloth, const std::vector<Vec3>& previous, const Loads& loads,
                             const EquilibriumOptions& options, ThreadTeam& team,
                             const std::function<void(const RelaxProgress&)>& report = {});

/// The same of the canopies of a cluster, one after the other, each in its own frame. `each` has the cloth of every
/// canopy, or of one if they are equal, `all` is that of the cluster. A canopy turns freely about the confluence: each is
/// turned back to the angle of the cluster, which changes no follower load, and the restraint cancels its moment there.
Equilibrium find_equilibrium(const Cluster& cluster, const std::vector<ClothPtr>& each, const Cloth& all,
                             const std::vector<Vec3>& previous, const Loads& loads,
                             const EquilibriumOptions& options, ThreadTeam& team,
                             const std::function<void(const RelaxProgress&)>& report = {});

}  // namespace ripstop::inline fsi
