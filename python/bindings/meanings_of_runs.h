// Meanings of the attributes of runs and their results, as meanings.cpp reads them for the docstrings.
#pragma once

#include <string_view>

namespace ripstop::python {

// A line an attribute, of one class or of every class that has it. Other attributes have the wording of reports.
inline constexpr std::string_view meanings_of_runs = R"(
# every result
title: title of the case
inputs_hash: hash of all inputs of the result; None: not written to a folder
warnings: warnings about the result
usable: False: the result must not be used, because a quality limit is exceeded (exit code 4); None: result of an earlier version
converged: whether all criteria of convergence are met
nodes: number of nodes of the mesh, lines included
steps: number of steps
margins: margins of safety of all members
wall_time_s: wall time, earlier parts of a resumed run included
payload_mass_kg: mass of the payload, without the parachute
parachute_mass_kg: mass of the parachute as cut and sewn
projected_area_m2: projected area
max_principal_direction: direction of the maximum principal stress (x, y, z)
known_drag_coefficient: range of the drag coefficient in descent on S0 (Knacke), low and high
handbook_drag_coefficient: range of the drag coefficient in descent on S0 (Knacke), low and high
drag_coefficient: drag coefficient on S0
drag_coefficient_basis: kind of the coefficient: "axial" (steady flow on the axis), "descent" (flight) or "given"
drag_coefficient_from: source of the drag coefficient
drag_coefficient_uncertainty: relative uncertainty of the drag coefficient
axial_drag_coefficient: drag coefficient on S0 in steady flow on the axis
nominal_area_m2: nominal area S0
filling_time_s: filling time t_f
drag_area_uncertainty_m2: numerical uncertainty of the drag area, or the standard error of the flight
ground_m: height of the ground above sea level
load_uncertainty_from: source of load_uncertainty
approach_speed_m_s: mean speed over the disk of the canopy, one diameter upstream of it
descent_drag_coefficient: drag coefficient on S0 in descent, from weight and rate of descent
descent_drag_coefficient_standard_error: standard error of the drag coefficient in descent
low_pass_hz: cutoff frequency of the low-pass filter
reference_area_m2: reference area S0
density_kg_m3: density of the air
air_from: source of the density of the air; None: result of an earlier version
path_angle_deg: angle of the path below the horizon at line stretch; of a stage, at its start
run: folder of the run; empty: in memory
method: name of the method
note: reason why the method does not apply, or its assumptions
applies: whether the case is in the range of the method
count: number of equal pieces
folds: number of outer folds around the canopy
pressure_from: source of the pressure
canopy_material: material of the cloth
cloth_material: material of the cloth
line_material: material of the suspension lines
gores: number of gores
line_count: number of suspension lines
line_length_m: length of a suspension line from the confluence to the skirt
geometric_porosity: open area over the whole surface as constructed
flow_cells: number of cells of the flow
flow_steps: number of steps of the flow
cloth_steps: number of steps of the cloth
filling_constant: filling constant n: distance travelled during filling over the nominal diameter
start_up_s: start-up time, which the means exclude
line_load_factor: largest load of a line over an equal share of the load
weakest_member: member with the smallest margin of safety
height_lost_m: height that the payload has lost
# calibrate_damping()
Damping.damping_n_s_m3: damping C_a with the smallest misfit
Damping.misfit: misfit of the best opening, see docs/theory/inflation.md
Damping.peak_load_n: peak load of the best opening, low-passed as the measured one
Damping.measured_peak_n: measured peak load
Damping.every_step_peak_n: peak load of the best opening over all time steps, unfiltered
Damping.inflation_time_s: time after which the load of the best opening remains within 10 % of the steady load
Damping.measured_inflation_time_s: measured time after which the load remains within 10 % of the steady load
Damping.pressure_pa: uniform pressure difference
Damping.trials: openings in the order of their computation
DampingTrial.damping_n_s_m3: damping C_a of the opening
DampingTrial.misfit: relative deviation of the opening from the measurement
DampingTrial.peak_n: peak load, low-passed as the measured one
DampingTrial.peak_time_s: time of this peak
DampingTrial.every_step_peak_n: peak load over all time steps, unfiltered
DampingTrial.inflation_time_s: time after which the load remains within 10 % of the steady load
# check()
Check.computed_area_m2: area of the finished cloth, without allowances
Check.meshed_area_m2: area of the cloth as meshed, a polyhedron inside the cut cloth
Check.vent_area_m2: area of the vent as constructed
Check.slot_area_m2: area of slots and gaps as constructed
Check.mass_kg: masses of the parts
Check.cloth_nodes: number of nodes of the cloth
Check.resolved_cloth_nodes: number of cloth nodes from which the error of the diameter is below 1 %
Check.springs: number of springs
Check.smallest_spring_m: rest length of the shortest spring
Check.smallest_spring_part: part with the shortest spring
Check.stable_step_s: largest stable time step of the explicit integration
Check.stable_step_part: part that limits the time step
Check.printed_step_s: estimate of the stable time step by [NFM]
Check.flow_spacing_m: widths of the cells of the flow at the canopy (x, y, z)
Check.memory_bytes: estimated memory of a steady run
Check.core_time_s: estimated time of a steady run on one core
Check.blockage: disk of the undeformed canopy over the cross section of the domain or the nozzle
Check.speed_m_s: speed of the free stream
Check.deployment_speed_m_s: airspeed at line stretch for which the default tape and the warnings about members are
Check.deployment_speed_from: key or rule that gave this airspeed
PartMasses.cloth: mass of the cloth [kg]
PartMasses.tape: mass of the tape [kg]
PartMasses.lines: mass of the suspension lines [kg]
PartMasses.riser: mass of the riser [kg]
PartMasses.total: mass of the parachute as cut and sewn [kg]
# errors
Problem.file: file; empty: none
Problem.line: line in the file, from 1; 0: none
Problem.column: column in the line, from 1; 0: none
Problem.option: option of the command line; empty: none
Problem.key: full name of the key; empty: none
Problem.value: value as given
Problem.allowed: allowed values
Problem.message: whole message of the problem
# fabric()
Fabric.pressure_pa: uniform pressure difference over the canopy
Fabric.pressure_load_n: axial force of the pressure on the cloth
Fabric.line_tension_n: axial force on the fixed end of the lines
Fabric.projected_over_nominal: projected diameter over nominal diameter
Fabric.known_projected_over_nominal: usual range of this ratio in flight (Knacke), low and high
Fabric.steps: number of relaxation steps
Fabric.residual: residual force over applied force
Fabric.cloth_tolerance: residual below which the cloth is in equilibrium
Fabric.wall_time_s: wall time of the relaxation
# fit()
CouponComparison.name: direction of the records
CouponComparison.r2: coefficient of determination R2 of the virtual coupon to the measured curve
CouponComparison.strain: strains of both curves
CouponComparison.measured: measured load per width [N/m]
CouponComparison.simulated: load per width of the virtual coupon [N/m]
Estimate.value: the value
Estimate.standard_error: standard error of the value
Estimate.low: lower end of the 95 % interval
Estimate.high: upper end of the 95 % interval
FitProgress.pulls: number of virtual coupon tests so far
FitProgress.shear_fraction: shear fraction xi of the last tests
FitProgress.bending_fraction: bending fraction eps of the last tests
FitProgress.misfit: misfit of the last tests, which the fit minimises
FittedDirection.name: direction: warp, weft, bias, line or tape
FittedDirection.orientation_deg: angle between load and warp
FittedDirection.degree: degree of the polynomial
FittedDirection.r2: coefficient of determination R2 of the fit to the mean curve
FittedDirection.r2_all_points: coefficient of determination R2 of the fit to the points of all samples
FittedDirection.tested_strain: largest strain of the fitted records
FittedDirection.offset: load K_0 at zero strain
FittedDirection.coefficients: one Estimate for each of K_1..K_n
FittedDirection.strain: strains of the mean curve
FittedDirection.load: mean load of the samples at these strains
FittedDirection.spread: standard deviation of the samples at these strains
FittedDirection.fit: load of the fit at these strains
FittedDirection.band_low: lower limit of the pointwise 95 % band of the mean
FittedDirection.band_high: upper limit of the pointwise 95 % band of the mean
# descent(), export()
Descent.drag_area_m2: drag area C_D S0
Descent.run_speed_m_s: speed at which the drag area was computed
Descent.heights: rows of the table
DescentRow.height_m: height above sea level
DescentRow.speed_m_s: rate of descent at this height
DescentRow.speed_uncertainty_m_s: its uncertainty, from that of the drag area
DescentRow.time_to_ground_s: time from this height to the ground; None: at or below the ground
DescentRow.time_uncertainty_s: its uncertainty
ExportedParachute.drag_area_m2: drag area C_D S0
ExportedParachute.drag_area_mean_m2: mean of the drag area for a dispersion analysis
ExportedParachute.drag_area_deviation_m2: standard deviation of the drag area for a dispersion analysis
ExportedParachute.drag_coefficient: drag coefficient on the area named by drag_coefficient_on
ExportedParachute.drag_coefficient_on: name of the attribute that is its reference area
ExportedParachute.radius_m: half the projected diameter of the inflated canopy
ExportedParachute.height_m: height of the inflated canopy from skirt to crown
ExportedParachute.porosity: open area over the whole surface as constructed
ExportedParachute.deployment_speed_m_s: speed at deployment, for the filling time
ExportedParachute.deployment_speed_from: source of this speed
ExportedParachute.lag_s: filling time: from the trigger to the full drag area
ExportedParachute.lag_from: source of the filling time
ExportedParachute.lag_deviation_s: standard deviation of the filling time
ExportedParachute.mass_kg: mass of the parachute as cut and sewn
ExportedParachute.line_density_kg_m: mass per length of a line
ExportedParachute.cloth_density_kg_m2: mass per area of the cloth
ExportedParachute.packed_diameter_m: diameter of the packed parachute, a cylinder twice as long as wide
ExportedParachute.packed_length_m: its length
packed_volume_m3: volume of the packed parachute
# fly()
Flight.duration_s: duration of the flight
Flight.rate_of_descent_m_s: mean vertical speed of the payload after the start-up, positive downwards
Flight.glide_ratio: mean horizontal speed relative to the wind over the rate of descent
Flight.mean_oscillation_deg: mean of the peaks of the angle between the vertical and the line from payload to canopy
Flight.largest_oscillation_deg: largest of these peaks
Flight.oscillation_period_s: period of the oscillation
Flight.mean_angle_deg: mean angle between the vertical and the line from payload to canopy
Flight.mean_angle_of_attack_deg: mean angle between this line and the relative wind
Flight.largest_angle_of_attack_deg: largest angle between this line and the relative wind
Flight.axial_speed_m_s: speed at which the drag on the axis equals the weight; None: after an inflation
Flight.axial_drag_coefficient: drag coefficient on S0 in steady flow on the axis; None: after an inflation
Flight.density_kg_m3: density of the air at the start
Flight.largest_line_force_n: largest force of the lines on the payload
Flight.load_factor: largest_line_force_n over the weight of the payload
Flight.distance_m: horizontal distance over the ground
Flight.energy_residual: residual of the energy balance, over the potential energy lost
Flight.momentum_residual: residual of the momentum balance, over the impulse of the weight
Flight.handover: state before and after the end of the inflation; None: without one
Flight.cluster: motion of the canopies of a cluster; None: a single canopy
Flight.bodies: mean loads on the rigid bodies after the start-up; None: without any, or a flight that failed
FlightBody.name: name of the body in the case
FlightBody.drag_n: mean force along the air relative to the payload
FlightBody.drag_area_m2: mean of the drag over the dynamic pressure of that air
FlightBody.drag_area_standard_error_m2: standard error of this mean; None: the flight is too short
FlightBody.reference_area_m2: reference area of the body
FlightBody.drag_coefficient: drag area over the reference area
FlightBody.mean_incidence_deg: mean angle between the axis of the body and that air
FlightBody.in_fine_cells: share of the time with the whole body in the fine cells of the flow
FlightCluster.canopies: number of canopies
FlightCluster.first_spread_angle_deg: spread angle at the start
FlightCluster.cluster_factor: drag coefficient in descent over that of one canopy; None: not given
FlightCluster.motion: means and extremes; None: the flight failed
FlightCluster.pierced_edges: largest share of cloth edges that pierce cloth
ClusterMotion.mean_spread_angle_deg: mean spread angle over canopies and time
ClusterMotion.spread_angle_standard_deviation_deg: standard deviation over time of the mean over the canopies
ClusterMotion.smallest_gap_m: smallest distance between cloth nodes of two canopies
ClusterMotion.smallest_gap_time_s: time of the smallest gap
ClusterMotion.contact_gap_m: distance of nodes below which canopies count as touching
ClusterMotion.first_contact_s: time of the first contact of two canopies; None: no contact
ClusterMotion.contact_time_share: share of the time with contact
ClusterMotion.canopies: motion of each canopy
CanopyMotion.size_ratio: size of the canopy over the largest one; None: all are equal
CanopyMotion.mean_spread_angle_deg: mean angle between canopy and axis of the cluster, seen from the payload
CanopyMotion.spread_angle_standard_deviation_deg: standard deviation of this angle over time
CanopyMotion.mean_riser_load_n: mean riser load
CanopyMotion.largest_riser_load_n: largest riser load at the end of a step of the flow
CanopyMotion.largest_riser_load_time_s: time of this load
CanopyMotion.mean_mouth_area_m2: mean area of the mouth
FlightProgress.time_s: time of flight so far
FlightProgress.duration_s: longest time of flight
FlightProgress.rate_of_descent_m_s: present vertical speed of the payload, positive downwards
FlightProgress.oscillation_deg: present angle between the vertical and the line from payload to canopy
Handover.time_s: time since deployment
Handover.deployment_speed_m_s: airspeed at deployment
Handover.deployment_speed_from: key or option that gave this airspeed
Handover.same_flow: whether the flow continues unchanged; False: it is interpolated to the cells of the flight
Handover.speed_m_s: speed of the payload
Handover.path_angle_deg: angle of its path below the horizon
Handover.opening_peak_load_n: peak load of the inflation
Handover.load_before_n: load on the riser at the end of the inflation
Handover.load_after_n: load on the riser at the start of the flight
Handover.drag_before_n: drag of the canopy at the end of the inflation
Handover.drag_after_n: drag of the canopy at the start of the flight
Handover.elastic_energy_before_j: elastic energy of cloth and lines at the end of the inflation
Handover.elastic_energy_after_j: elastic energy of cloth and lines at the start of the flight
# inflate()
Inflation.speed_m_s: airspeed at deployment; None: result of an earlier version
Inflation.speed_from: key or option that gave this airspeed
Inflation.height_m: height above sea level at the start; None: result of an earlier version
Inflation.peak_load_n: peak load on the riser after the start-up, unfiltered
Inflation.peak_time_s: time of this peak since deployment
Inflation.inflation_time_s: time after which the load remains within 10 % of the steady load
Inflation.settling_time_s: time after which the rms deviation of the load remains below 10 % of the steady load
Inflation.steady_load_n: steady load; None: not settled, or a payload that decelerates
Inflation.stages: results of each reefing stage and of the open canopy; None: without reefing
Inflation.settled: whether the load at the end is steady
Inflation.impulse_n_s: integral of the load over time
Inflation.pressure_pa: uniform pressure difference; None: coupled inflation
Inflation.drag_area_peak_m2: largest drag area C_D S of a time step
Inflation.added_mass_kg: added mass of the canopy at the end
Inflation.deployment: deployment before the opening; None: without one
Inflation.speed_at_end_m_s: speed of the payload at the end; None: fixed end
Inflation.path_angle_at_end_deg: angle of the path of the payload below the horizon at the end
Inflation.cluster: openings of the canopies of a cluster; None: a single canopy
CanopyOpening.size_ratio: size of the canopy over the largest one; None: all are equal
CanopyOpening.delay_s: time until which the canopy stays folded; None: no canopy is delayed
CanopyOpening.peak_riser_load_n: peak riser load after the start-up, at the ends of blocks of steps
CanopyOpening.peak_riser_load_time_s: time of this peak since deployment
CanopyOpening.last_riser_load_n: riser load at the end, mean over the last fifth
CanopyOpening.filling_time_s: time at which the mouth first has the mean area of the full canopy; None: not filled
CanopyOpening.last_spread_angle_deg: spread angle at the end
ClusterOpening.canopies: opening of each canopy
ClusterOpening.peak_time_difference_s: largest difference between the times of the peaks
ClusterOpening.filling_time_difference_s: largest difference between the filling times; None: a canopy has not filled
ClusterOpening.smallest_gap_m: smallest distance between cloth nodes of two canopies
ClusterOpening.smallest_gap_time_s: time of the smallest gap
Inflation.steady_drag_returned: steady load over the given steady drag
Inflation.damping_n_s_m3: absolute damping C_a
Inflation.quadratic_damping_n_s2_m4: quadratic absolute damping
Inflation.inner_fold_radius_m: radius of the inner folds of the skirt at the start
Inflation.outer_fold_radius_m: radius of the outer folds of the skirt at the start
Inflation.handbook: loads of the same opening by handbook methods, for a payload
Inflation.energy_residual: largest residual of the energy balance, over the work of the pressure on the cloth
Inflation.momentum_residual: largest residual of the momentum balance of the air in any step, over the peak load
Inflation.step_changes: number of reductions of the time step because of strain
Inflation.measured_inflation_time_s: measured time after which the load remains within 10 % of the steady load
InflationShot.time: time since deployment [s]
InflationShot.positions: position of every node [m]
InflationShot.von_mises: von Mises stress of every cloth cell [N/m]
StageSummary.line_m: length of the reefing line; None: the open canopy
StageSummary.begin_s: start of the stage
StageSummary.end_s: end of the stage
StageSummary.peak_load_n: peak load on the riser in the stage, unfiltered
StageSummary.peak_time_s: time of this peak
StageSummary.load_at_end_n: mean load over the last fifth of the stage
StageSummary.drag_area_at_end_m2: mean drag area C_D S over the last fifth of the stage, in a coupled inflation
StageSummary.line_peak_n: peak tension of the reefing line
StageSummary.line_peak_time_s: time of the peak tension of the reefing line
MethodLoad.load_n: peak load
MethodLoad.time_s: time of the peak from the start of the stage; 0: not given by the method
DeploymentPhase.phase: name of the phase
DeploymentPhase.time_s: start of the phase
DeploymentPhase.path_m: distance that the payload has travelled
DeploymentPhase.payload_speed_m_s: airspeed of the payload
DeploymentPhase.bag_speed_m_s: airspeed of the container
Deployment.phases: phases in order
Deployment.snatch_load_n: largest tension at the payload
Deployment.snatch_time_s: time of this tension
Deployment.relative_speed_at_line_stretch_m_s: speed difference of payload and container at line stretch
Deployment.stopped: reason why the canopy does not leave its container; None: it leaves it
Inflation.bodies: loads on rigid bodies upstream; None: without any
OpeningBody.name: name of the body in the case
OpeningBody.peak_drag_n: largest force along the stream after the start-up
OpeningBody.peak_time_s: time of this peak since deployment
OpeningBody.drag_area_at_end_m2: mean drag area over the last fifth of the opening
OpeningBody.reference_area_m2: reference area of the body
OpeningBody.drag_coefficient_at_end: this drag area over the reference area
OpeningProgress.time_s: time since deployment
OpeningProgress.duration_s: end of the opening
OpeningProgress.load_n: present load on the riser
OpeningProgress.step_s: time step of the cloth
# stability()
Stability.speed_m_s: speed of the free stream
Stability.projected_diameter_m: projected diameter of the rigid shape
StabilityAngle.angle_deg: angle of attack
StabilityAngle.c_t: tangential force coefficient C_T: force along the canopy axis over q S0
StabilityAngle.c_n: normal force coefficient C_N: force normal to the axis over q S0, positive if it reduces the angle
StabilityAngle.c_m: moment coefficient C_m about the confluence over q S0 D0, positive if it increases the angle
StabilityAngle.c_d: drag coefficient C_D: force along the stream over q S0
StabilityAngle.c_l: lift coefficient C_L: force normal to the stream in the plane of the angle over q S0
StabilityAngle.c_y: side force coefficient C_Y: force normal to this plane over q S0
StabilityAngle.bodies: mean loads on rigid bodies upstream; None: without any
StabilityBody.name: name of the body in the case
StabilityBody.drag_n: force along the stream
StabilityBody.drag_standard_error_n: its standard error; None: steady flow
StabilityBody.force_n: force in the axes of the canopy (x, y, z)
StabilityBody.moment_n_m: moment about the centre of the aft end in these axes (x, y, z)
StabilityAngle.time_s: duration of the record; 0: steady flow
StabilityAngle.steps: number of time steps, or of iterations
Trim.angle_deg: angle of attack at which C_m = 0
Trim.standard_error_deg: its standard error; None: angle 0 by symmetry
Trim.stable: whether dC_m/dalpha is negative
# steady()
Steady.speed_m_s: speed of the free stream
Steady.coupling_iterations: number of coupling iterations
Steady.first_estimate: early drag and shape of the run; None: none was made
Steady.ledger: force balance
Steady.flow_domain: part of the flow domain that was solved
Steady.unsteady: means of the unsteady wake; None: steady flow
Steady.payload: equilibrium with the payload; None: the speed is given
Steady.bodies: loads on rigid bodies upstream; None: without any
Steady.cluster: angles and loads of a cluster of canopies; None: a single canopy
Steady.measured: row of [[measured]] of this speed; None: without one
BodyResult.name: name of the body in the case
BodyResult.drag_n: force along the stream
BodyResult.side_force_n: magnitude of the force across the stream
BodyResult.moment_n_m: moment about the centre of the aft end (x, y, z)
BodyResult.reference_area_m2: reference area of the body
BodyResult.drag_coefficient: drag coefficient on the reference area of the body
BodyResult.drag_standard_error_n: standard error of the drag, the mean of an unsteady flow; None: steady flow
ClusterCanopy.size_ratio: size of the canopy over the largest one; None: all are equal
ClusterCanopy.azimuth_deg: azimuth about the axis of the cluster, from x
ClusterCanopy.drag_n: force along the stream
ClusterCanopy.riser_load_n: magnitude of the air load, which the riser carries
ClusterCanopy.spreading_moment_n_m: moment about the confluence, positive where it increases the spread angle
ClusterResult.spread_angle_deg: angle between the axes of the canopies and of the cluster
ClusterResult.force_angle_deg: mean angle between the force and the axis of a canopy, positive outward
ClusterResult.gap_m: smallest distance between the cloth of two canopies
ClusterResult.riser_load_difference: difference between the largest and smallest riser load on an equal area over their mean
ClusterResult.cluster_factor: drag coefficient over that of one canopy; None: not given
ClusterResult.spread_search: solutions of the search for the equilibrium, the last one is the result; None: given angle
SpreadTrial.spread_angle_deg: angle between the axes of the canopies and of the cluster
SpreadTrial.force_angle_deg: mean angle between the force and the axis of a canopy, positive outward
SpreadTrial.force_angle_deviation_deg: standard deviation of that angle over the coupling iterations
SpreadTrial.drag_n: drag of the cluster
ClusterResult.canopies: loads on each canopy
ClusterResult.margins_one_failed: margins of the remaining canopies when the largest one fails
HeldPayload.mass_kg: mass of the payload
HeldPayload.weight_n: weight of payload and parachute
HeldPayload.payload_drag_n: drag of the payload
HeldPayload.drag_over_weight: drag of canopy and payload over the weight
Measured.drag_n: measured drag; None: not given
Measured.printed_nonlinear_n: drag by the nonlinear model of the source of the measurement
Measured.printed_linear_n: drag by the linear model of this source
SolvedDomain.part: "full" or "quarter"
SolvedDomain.reason: reason for the full domain; empty for a quarter
SolvedDomain.canopy_asymmetry_m: largest deviation of the shape from mirror symmetry
FirstEstimate.speed_m_s: speed of the free stream
FirstEstimate.drag_n: drag after 30 flow iterations
FirstEstimate.projected_diameter_m: projected diameter under a uniform pressure
SteadyIteration.iteration: number of the iteration, from 1
SteadyIteration.drag_change: change of the drag since the previous iteration, relative
SteadyIteration.shape_change_m: mean displacement of the nodes since the previous iteration
SteadyIteration.omega: relative position change, [NFM] Eq. 19
SteadyIteration.cloth_residual: residual force over applied force of the cloth
SteadyIteration.flow_iterations: number of iterations of the flow, or of its time steps
SteadyIteration.flow_residual: largest residual of the flow equations
SteadyIteration.flow_converged: whether the flow converged
SteadyIteration.cut_cells: number of cells that the canopy intersects
SteadyIteration.wall_time_s: wall time of the iteration
UnsteadyResult.drag_standard_error_n: standard error of the mean drag; None: not known
UnsteadyResult.strouhal: Strouhal number of the dominant frequency of the side force, with the inflated diameter
UnsteadyResult.watched: last averaging window
Watched.time_s: duration of the record, with its start-up
Watched.drag_n: mean drag
Watched.standard_error_n: standard error of the mean drag
Watched.deviation_n: standard deviation of the drag
Watched.side_force_n: mean side force (x, y, z)
Watched.side_force_error_n: standard error of the mean side force (x, y, z)
Watched.side_force_deviation_n: rms deviation of the side force from its mean
)";

}  // namespace ripstop::python
