// Where a wake sucks air back in through the outlet, that air has the total pressure of air at rest; with its
// static pressure held instead, it would come in ever faster.
#include "ripstop/flow/cartesian/boundary.h"

namespace ripstop::inline flow::cartesian {
namespace {

class StillAir final : public OutletBoundary {
 public:
  bool carries_back() const override { return true; }

  // Half of the distance to the value required by the present flux.
  void pressure(int n, const double* flux, const double* rho, double* p) const override {
    for (int i = 0; i < n; ++i) {
      const double total = flux[i] < 0 ? -0.5 * flux[i] * flux[i] / rho[i] : 0;
      p[i] = 0.5 * (p[i] + total);
    }
  }
};

}  // namespace

std::unique_ptr<OutletBoundary> still_air_outlet() {
  return std::make_unique<StillAir>();
}

}  // namespace ripstop::inline flow::cartesian
