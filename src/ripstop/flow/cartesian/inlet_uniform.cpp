// The stream over the whole inlet.
#include <algorithm>

#include "ripstop/flow/cartesian/boundary.h"

namespace ripstop::inline flow::cartesian {

Inlet::Inlet(const Layout& layout_)
    : layout(layout_),
      w(static_cast<std::size_t>(layout.stride_z)),
      k(static_cast<std::size_t>(layout.stride_z)),
      omega(static_cast<std::size_t>(layout.stride_z)) {}

Inlet uniform_inlet(const Discretisation& d) {
  Inlet inlet(d.layout);
  const Freestream& air = d.air;
  // k = 3/2 (I U)^2, omega = k / nu_t.
  const double fluctuation = air.turbulence_intensity * air.speed();
  inlet.mean_speed = air.velocity.z;
  Stream& stream = inlet.stream;
  stream.velocity = air.velocity;
  stream.k = 1.5 * fluctuation * fluctuation;
  stream.omega = stream.k / (air.viscosity_ratio * air.viscosity / air.density);
  std::fill(inlet.w.begin(), inlet.w.end(), air.velocity.z);
  std::fill(inlet.k.begin(), inlet.k.end(), stream.k);
  std::fill(inlet.omega.begin(), inlet.omega.end(), stream.omega);
  return inlet;
}

}  // namespace ripstop::inline flow::cartesian
