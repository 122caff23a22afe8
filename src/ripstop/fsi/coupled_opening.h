// The opening of a canopy whose cloth and flow are stepped together in time.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ripstop/fsi/container.h"
#include "ripstop/fsi/coupled_flow.h"
#include "ripstop/fsi/opening.h"

namespace ripstop::inline fsi {

class CoupledOpening : public Opening {
 public:
  /// `problem` has `air`.
  explicit CoupledOpening(InflationProblem problem);

  InflationState start() const override;
  std::vector<HistoryRow> advance(InflationState& state, std::vector<AirRow>* air_rows = nullptr) override;
  InflationFrame frame(InflationState& state) const override;
  CoupledFlow* air() const override { return air_.get(); }

 private:
  AirRow step(InflationState& state, int rows, std::vector<HistoryRow>& history);
  void deploy_at_start(AirMemory& air) const;
  std::vector<int> contained(const AirMemory& air) const;
  std::vector<GuidedNode> held(double time) const;
  double advance_container(const std::vector<int>& inside, const std::vector<Vec3>& before, double length,
                           InflationState& state) const;
  void compute_added_mass(InflationState& state) const;
  int rows_of_next_step(const InflationState& state, int left);

  std::unique_ptr<CoupledFlow> air_;
  std::optional<ContainedCloth> contained_;       // where the problem has a container
  std::vector<std::vector<GuidedNode>> delayed_;  // the cloth of every canopy that opens later
};

}  // namespace ripstop::inline fsi
