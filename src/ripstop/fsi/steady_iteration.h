// The numbers of one coupling iteration: a row of iterations.csv.
#pragma once

#include "ripstop/core/members.h"

namespace ripstop::inline fsi {

/// Forces are axial, along +z [N].
struct SteadyIteration {
  int iteration = 0;             // from 1
  double fluid_force = 0;        // of the fluid on the porous cells: the drag
  double nodal_load = 0;         // sum of the pressure loads on the cloth's nodes
  double line_tension = 0;       // of the cloth on its fixed end
  double momentum_deficit = 0;   // through the faces of the flow's box
  double transfer_factor = 0;    // fluid force over that of the pressures alone, as they came to the cloth
  double residual_traction = 0;  // residual_traction_share() of the load; 0 except for CanopyLoad::of_flow
  double axial_moment = 0;       // of the air's load about the canopy's axis [N m]
  double section_gap = 0;     // largest_section_gap() of the cloth's stress and the load that made the shape
  double approach_speed = 0;  // approach_speed() [m/s]
  double drag_change = 0;     // relative to the iteration before; infinite at the first
  double shape_change = 0;    // e_k = mean |x^{k+1} - x^k| [m], [NFM] Eq. 18
  double omega = 0;           // |X_{k+1} - X_k| / |X_k|, [NFM] Eq. 19
  double printed_tolerance = 0;  // R dx^2 / (S0 K_max), the tolerance of omega in Eq. 19
  int cloth_steps = 0;
  double cloth_residual = 0;
  double regularisation =
      0;  // RelaxOptions::regularisation [Pa/m]; 0: the cloth found its equilibrium by itself
  double regularisation_share = 0;  // RelaxResult::regularisation_share
  int flow_iterations = 0;
  double flow_residual = 0;     // largest of all equations
  bool flow_converged = false;  // to Stopping::residual, and its drag has settled
  int flow_averaged = 0;        // iterations over which a flow that did not converge is averaged; 0: none
  double drag_deviation = 0;    // standard deviation of the drag over them, or over the watch [N]
  double drag_left = 0;         // FlowField::drag_left
  bool in_time = false;         // the flow was watched in time; flow_iterations are its steps
  double drag_error = 0;        // standard error of the mean drag of such a flow [N]
  int cut_cells = 0;
  double wall_time = 0;  // [s]
};

template <Of<SteadyIteration> T, class Visit>
void each_member(T& i, Visit&& visit) {
  visit("iteration", i.iteration, Shown{"|iter.", 5, "{:.0f}"});
  visit("drag_n", i.fluid_force, Shown{"air|load N", 8, "{:.2f}"});
  visit("nodal_load_n", i.nodal_load, Shown{"cloth|load N", 8, "{:.2f}"});
  visit("line_tension_n", i.line_tension, Shown{"line|load N", 8, "{:.2f}"});
  visit("momentum_deficit_n", i.momentum_deficit, Shown{"momentum|deficit N", 9, "{:.2f}"});
  visit("transfer_factor", i.transfer_factor);
  visit("load_remainder", i.residual_traction);
  visit("axial_moment_n_m", i.axial_moment);
  visit("section_gap", i.section_gap);
  visit("approach_speed_m_s", i.approach_speed);
  visit("drag_change", i.drag_change, Shown{"drag|change", 8, "{:.3f} %", 100});
  visit("shape_change_m", i.shape_change, Shown{"shape|change mm", 9, "{:.3f}", 1000});
  visit("omega", i.omega);
  visit("printed_tolerance", i.printed_tolerance);
  visit("cloth_steps", i.cloth_steps, Shown{"cloth|steps", 5, "{:.0f}"});
  visit("cloth_residual", i.cloth_residual);
  visit("cloth_hold_pa_m", i.regularisation);
  visit("cloth_held", i.regularisation_share);
  visit("flow_iterations", i.flow_iterations, Shown{"flow|iter.", 5, "{:.0f}"});
  visit("flow_residual", i.flow_residual);
  visit("flow_converged", i.flow_converged);
  visit("flow_averaged", i.flow_averaged);
  visit("drag_deviation_n", i.drag_deviation);
  visit("drag_left", i.drag_left);
  visit("in_time", i.in_time);
  visit("drag_error_n", i.drag_error);
  visit("cut_cells", i.cut_cells);
  visit("wall_time_s", i.wall_time, Shown{"time|m:ss", 5, ""});
}

}  // namespace ripstop::inline fsi
