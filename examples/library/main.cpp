// A canopy made in code: checked, looked at under a pressure, and solved in a steady flow; all in memory.
#include <cstdio>

#include "ripstop/core/error.h"
#include "ripstop/parachute/flat_circular.h"
#include "ripstop/run/sizing/fabric.h"
#include "ripstop/run/steady/steady.h"

namespace {

ripstop::Case my_canopy() {
  ripstop::Case given;
  given.title = "My canopy at 20 m/s";
  given.parachute.canopy = ripstop::FlatCircular{.nominal_diameter_m = 1.0, .vent_diameter_m = 0.1};
  given.parachute.gores = 12;
  given.parachute.lines.count = 12;
  given.parachute.lines.length_m = 1.0;
  given.parachute.mesh.cloth_nodes = 1500;
  given.flow.speed_m_s = 20;
  given.flow.density_kg_m3 = 1.2;
  given.flow.cells = {24, 24, 36};  // a quick look: five across the canopy, too few for the air's own load
  given.coupling.load = ripstop::CanopyLoad::uniform;
  return given;
}

struct Progress : ripstop::SteadyObserver {
  void iterated(const ripstop::SteadyRun&, const ripstop::SteadyState& state,
                const ripstop::FlowField&) override {
    const ripstop::SteadyIteration& last = state.iterations.back();
    std::printf("iteration %d: drag %.2f N, cloth moved %.2f mm\n", last.iteration, last.fluid_force,
                1000 * last.shape_change);
  }
};

}  // namespace

int main() {
  try {
    // Checked first: every mistake at once.
    const ripstop::Settings resolved = ripstop::resolve(ripstop::checked(my_canopy()));

    const ripstop::FabricResult still = ripstop::run_fabric(resolved, 240).result;
    std::printf("under 240 Pa: %.3f m wide, %.0f N\n", still.size.projected_diameter, still.pressure_load);

    Progress progress;
    const ripstop::SteadySolution flight = ripstop::run_steady(resolved, progress);
    std::printf("drag %.2f N, C_D %.3f, %s\n", flight.result.drag, flight.result.drag_coefficient,
                flight.result.converged ? "converged" : "not converged");
    return flight.result.converged ? 0 : 1;
  } catch (const ripstop::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
