// A flow that is computed at the density of deployment, as it is at the density of the present height.
//
// At a given speed the motion of the air does not depend on its density, and all pressures and forces are
// proportional to it. The input of the flow is therefore scaled to the density of deployment, and its output to the
// present one, only here.
#pragma once

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline fsi {

class FlowAtDensity {
 public:
  /// `density` of deployment [kg/m3].
  FlowAtDensity(std::unique_ptr<Flow> flow, double density) : flow_(std::move(flow)), density_(density) {}

  void set_density_ratio(double ratio) { ratio_ = ratio; }
  double density() const { return density_ * ratio_; }  // present [kg/m3]

  /// The canopy, and rigid bodies that have moved.
  void place(const std::vector<Triangle>& surface, SheetMotion motion, std::vector<Placement> rigid) {
    for (double& compliance : motion.yields) compliance *= ratio_;
    for (double& pressure : motion.pressure) pressure /= ratio_;
    rigid.push_back({0, surface, std::move(motion)});
    flow_->place_all(rigid);
  }
  void stream(Vec3 velocity, Vec3 acceleration) { flow_->stream(velocity, acceleration); }
  double longest_step(double courant) { return flow_->longest_step(courant); }
  FlowStep step(double length) {
    FlowStep step = flow_->step(length);
    step.force = ratio_ * step.force, step.momentum_gap = ratio_ * step.momentum_gap;
    for (BodyLoad& body : step.bodies) body = {ratio_ * body.force, ratio_ * body.moment};
    return step;
  }
  std::vector<SheetLoad> sheet_loads() const {
    std::vector<SheetLoad> loads = flow_->sheet_loads();
    for (SheetLoad& one : loads) {
      one.drop *= ratio_, one.force = ratio_ * one.force;
      if (one.inside) *one.inside *= ratio_;
      if (one.outside) *one.outside *= ratio_;
    }
    return loads;
  }

  /// At the density of deployment, for files and checkpoints.
  Flow& at_deployment() { return *flow_; }
  const Flow& at_deployment() const { return *flow_; }

 private:
  std::unique_ptr<Flow> flow_;
  double density_, ratio_ = 1;
};

}  // namespace ripstop::inline fsi
