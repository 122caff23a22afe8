// Jet of a nozzle through the inlet, surrounded by air that is nearly at rest. All of it has the k and omega of the
// stream: the shear layer develops its own within one nozzle width.
#include <algorithm>

#include "ripstop/flow/cartesian/boundary.h"

namespace ripstop::inline flow::cartesian {

Inlet jet_inlet(const Discretisation& d, const Jet& jet) {
  Inlet inlet = uniform_inlet(d);
  const double speed = d.air.velocity.z;
  inlet.stream.velocity = {0, 0, jet.outside * speed};
  std::fill(inlet.w.begin(), inlet.w.end(), inlet.stream.velocity.z);
  double sum = 0;
  for (int j = 0; j < d.grid.ny; ++j) {
    for (int i = 0; i < d.grid.nx; ++i) {
      const double share = mean_speed_share(jet, d.x.edge[i], d.x.edge[i + 1], d.y.edge[j], d.y.edge[j + 1]);
      inlet.w[d.layout.in_plane(i, j)] = share * speed;
      sum += share * d.x.width[i] * d.y.width[j];
    }
  }
  inlet.mean_speed = speed * sum / (d.grid.size.x * d.grid.size.y);
  return inlet;
}

}  // namespace ripstop::inline flow::cartesian
