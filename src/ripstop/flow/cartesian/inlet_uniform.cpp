// The stream over the whole inlet.
#include <algorithm>

#include "ripstop/flow/cartesian/boundary.h"

namespace ripstop::cartesian {

Inlet::Inlet(const Layout& layout_)
    : layout(layout_),
      w(static_cast<std::size_t>(layout.stride_z)),
      k(static_cast<std::size_t>(layout.stride_z)),
      omega(static_cast<std::size_t>(layout.stride_z)) {}

Inlet uniform_inlet(const Discretisation& d) {
  Inlet inlet(d.layout);
  const Freestream& air = d.air;
  // k = 3/2 (I U)^2, omega = k / nu_t.
  const double fluctuation = air.turbulence_intensity * air.speed;
  inlet.stream_speed = inlet.mean_speed = air.speed;
  inlet.stream_k = 1.5 * fluctuation * fluctuation;
  inlet.stream_omega = inlet.stream_k / (air.viscosity_ratio * air.viscosity / air.density);
  std::fill(inlet.w.begin(), inlet.w.end(), air.speed);
  std::fill(inlet.k.begin(), inlet.k.end(), inlet.stream_k);
  std::fill(inlet.omega.begin(), inlet.omega.end(), inlet.stream_omega);
  return inlet;
}

}  // namespace ripstop::cartesian
