// Walls without friction: nothing passes.
#include "ripstop/flow/cartesian/boundary.h"

namespace ripstop::inline flow::cartesian {
namespace {

class Slip final : public SideBoundary {
 public:
  double mirror() const override { return -1; }
};

}  // namespace

std::unique_ptr<SideBoundary> slip_sides() {
  return std::make_unique<Slip>();
}

}  // namespace ripstop::inline flow::cartesian
