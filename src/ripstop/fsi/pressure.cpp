#include "ripstop/fsi/pressure.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "ripstop/canopy/shape.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/core/error.h"

namespace ripstop::inline fsi {
namespace {

constexpr double load_tolerance = 1e-3;
constexpr int most_relaxations = 8;
// Of the cloth; the load follows it within a few parts of ten thousand.
constexpr RelaxOptions relaxation{1e-3, 200000};

class Equilibrium {
 public:
  Equilibrium(const Mesh& mesh, bool linear, ThreadTeam& team, std::function<void()> alive = {})
      : cells_(mesh.cell_count()),
        cloth_(make_cloth(mesh, {linear, 0, 0})),
        state_(start_state(*cloth_)),
        team_(team),
        alive_(std::move(alive)) {}

  UniformPressure under(double pressure) {
    const Loads loads{std::vector<double>(cells_, pressure), {}};
    const RelaxResult result = relax(state_, *cloth_, loads, relaxation, team_, [&](const RelaxProgress&) {
      if (alive_) alive_();
    });
    ++relaxations_;
    if (!result.converged) {
      throw Error(
          ExitCode::not_converged,
          fmt::format("no equilibrium of the canopy under a uniform {:.4g} Pa within {} relaxation steps "
                      "(residual {:.2g}, tolerance {:.2g})",
                      pressure, result.steps, result.residual, relaxation.tolerance));
    }
    const double load = pressure_force(*cloth_, state_, loads).z;
    return {pressure, load, load / pressure, relaxations_};
  }

 private:
  int cells_;
  ClothPtr cloth_;
  ClothState state_;
  ThreadTeam& team_;
  std::function<void()> alive_;
  int relaxations_ = 0;
};

}  // namespace

UniformPressure load_under(double pressure, const Mesh& mesh, bool linear, ThreadTeam& team) {
  return Equilibrium(mesh, linear, team).under(pressure);
}

UniformPressure pressure_for(double load, const CanopyMesh& mesh, bool linear, ThreadTeam& team,
                             const std::function<void()>& alive) {
  if (!(load > 0))
    throw Error(ExitCode::bad_data, fmt::format("a steady drag of {} N: must be above 0", load));
  Equilibrium equilibrium(mesh, linear, team, alive);
  UniformPressure answer = equilibrium.under(load / skirt_area(mesh, mesh.start));  // a first guess
  while (std::abs(answer.load / load - 1) > load_tolerance) {
    if (answer.relaxations == most_relaxations) {
      throw Error(ExitCode::not_converged,
                  fmt::format("no uniform pressure found for a load of {:.4g} N: {:.4g} Pa gives {:.4g} N",
                              load, answer.pressure, answer.load));
    }
    answer = equilibrium.under(load / answer.axial_area);
  }
  return answer;
}

}  // namespace ripstop::inline fsi
