// Meanings of the attributes of loads, patterns, recoveries and sizes, in the format of meanings_of_runs.h.
#pragma once

#include <string_view>

namespace ripstop::python {

inline constexpr std::string_view meanings_of_design = R"(
# materials()
Material.name: value of parachute.canopy_material, lines.material or tape.material of a case
Material.kind: fabric, line or tape
Material.areal_density_kg_m2: mass per area of a cloth; None: another kind
Material.linear_density_kg_m: mass per length of a line or tape; None: a cloth
Material.width_m: width of a tape; None: another kind
Material.thickness_m: thickness; None: not known
Material.strength_n_m: breaking load per width of a cloth, as sold; None: not known, or another kind
Material.strength_n: breaking load of a line or tape, as sold; None: not known, or a cloth
Material.strength_from: source of the strength
Material.tested_strain: strain up to which the load curve is valid; None: not known
Material.permeability_m_s: volume flow per area through a cloth at 124.5 Pa; None: not given as a pressure drop
Material.permeability_cfm: the same in CFM/ft2
Material.source: sources of the values
Material.warning: warnings of the fit; empty: none
Material.file: file of the material, with the source of each number
Material.curve: loads at ten strains up to the tested strain, or to 0.1
Material.air: volume flow through a cloth at six pressure differences
MaterialLoad.strain: strain of the material along the load
MaterialLoad.warp_load_n_m: load per width along the warp; None: a line or tape
MaterialLoad.weft_load_n_m: load per width along the weft; None: a line or tape
MaterialLoad.tension_n: tension of a line or tape; None: a cloth
MaterialFlow.pressure_pa: pressure difference
MaterialFlow.velocity_m_s: volume flow per area

# load()
Load.speed_m_s: airspeed at line stretch
Load.speed_from: source of this speed
Load.height_m: height above sea level at line stretch
Load.required_load_n: larger one of highest_design_load_n and snatch load, for the required hardware
Load.opening_coefficient: opening force coefficient C_x
Load.opening_coefficient_from: source of C_x
Load.filling_exponent: exponent of the drag area over time
Load.ludtke_exponent: the same exponent in Ludtke's method
Load.filling_from: source of filling constant and exponent
Load.stages: loads of each reefed stage and of the open canopy
Load.design_drag_coefficient: drag coefficient on S0 of the infinite-mass load: at least the handbook's, unless C_x is given
Load.design_load_caution: condition in which a computed opening has a larger load; empty: none
Load.design_method: method of the design load; empty: a measured load
Load.required_hardware: strength that each part of the hardware needs under the required load
HardwareNeed.rated_load_n: required rated load
HardwareNeed.breaking_load_n: required breaking load of a metal part
HardwareNeed.textile_breaking_load_n: required breaking load of a textile part
Load.peak_load_n: peak load of the trajectory
Load.peak_time_s: time of this peak after line stretch
Load.record_peak_load_n: peak load of the trajectory with the drag area of a computed opening; None: without one
Load.snatch: snatch load; None: without a speed difference
Load.steady_speed_m_s: rate of steady descent; if it is not reached: speed at impact
Load.steady_time_s: time from line stretch to this speed
Load.steady_drop_m: height lost from line stretch to this speed
Load.steady_reached: whether the descent becomes steady above the ground
StageLoads.begin_s: start of the stage after line stretch
StageLoads.speed_m_s: airspeed at the start of the stage
StageLoads.height_m: height above sea level at the start of the stage
StageLoads.drag_area_before_m2: drag area before the stage
StageLoads.drag_area_m2: drag area at the end of the filling
StageLoads.ballistic_parameter: ballistic parameter A
StageLoads.mass_ratio: mass ratio R_m
StageLoads.methods: load by each method
StageLoads.highest_n: largest load of the applicable methods
StageLoads.lowest_n: smallest load of the applicable methods
StageLoads.spread: difference of highest_n and lowest_n over the mean of the applicable methods
Snatch.speed_difference_m_s: speed difference of payload and canopy at line stretch
Snatch.load_n: snatch load
Snatch.time_s: time from line stretch to the snatch load
Snatch.stretch_m: extension of lines, riser and hardware at the snatch load
Snatch.line_load_n: load of one line
Snatch.line_margin: breaking load of a line over line_load_n; not a margin of safety
Snatch.riser_margin: breaking load of the riser over the snatch load, not a margin of safety; None: there is no riser
Snatch.speed_difference_from: source of the speed difference
Snatch.model: model of the snatch load, in words
Snatch.deployment_load_n: snatch load by [deployment] of the case; None: it is load_n, or the case has no [deployment]
Snatch.deployment_speed_difference_m_s: speed difference of this load
Snatch.changes: snatch loads with one part changed
SnatchChange.part: part that is changed
SnatchChange.half_length_n: snatch load with half the length; None: a part breaks
SnatchChange.double_length_n: snatch load with twice the length; None: a part breaks
SnatchChange.half_stiffness_n: snatch load with half the stiffness; None: a part breaks
SnatchChange.double_stiffness_n: snatch load with twice the stiffness; None: a part breaks
Margin.member: member: cloth, tape, hem, a line, riser or a part of the hardware
Margin.load: largest load of the member, without the safety factor
Margin.load_from: kind of the load of hardware in an opening; None: other members and results
Margin.unit: unit of load and strength: N/m for cloth, else N
Margin.strength: strength of the material as sold; None: not known
Margin.strength_from: source of the strength
Margin.knock_down: allowable load over strength
Margin.used: utilisation: safety factor times load over allowable load
Margin.margin_of_safety: margin of safety: 1 / utilisation - 1
Margins.members: one Margin for each member
# pattern()
BillRow.part: name of the part
BillRow.material: material of the part
BillRow.is_cloth: whether the part is cloth: sizes are areas [m2], else lengths [m]
BillRow.finished: size without allowances, of all pieces
BillRow.cut: size with allowances, of all pieces
BillRow.cut_each: size with allowances, of one piece
BillRow.mass_kg: mass as cut, of all pieces
CutLength.name: name of the part
CutLength.length_m: length of one piece, finished
Pattern.cloth_area_m2: area of the cloth, finished
Pattern.mass_kg: mass as cut, without thread
Pattern.packing_density_kg_m3: density of the packed parachute
Pattern.seam_allowance_m: seam allowance of the cloth
Pattern.hem_allowance_m: hem allowance of the cloth
Pattern.line_loop_m: extra length of line at each end for its loop
Pattern.tape_overlap_m: extra length of each tape
Pattern.bill: bill of materials
Pattern.hems: length of each hem, of all pieces
Pattern.line_on_canopy_m: length of each suspension line that is sewn to the canopy
Pattern.drawings: names of the drawings of the pieces
# recovery()
FastestDeployment.height_m: height above sea level
FastestDeployment.snatch: snatch load at the speed to use; None: without a speed difference
FastestDeployment.margin_of_safety: margin of safety that every member keeps
FastestDeployment.load_uncertainty: relative uncertainty of the load, which gives the range of the speeds
FastestDeployment.design_method: method of the design load, whose speed is the result
FastestDeployment.design_load_caution: condition in which a computed opening has a larger load; empty: none
FastestDeployment.advice: speed to use, and the reason why the methods differ
FastestDeployment.methods: fastest safe speed by each method
SafeSpeed.speed_m_s: fastest safe airspeed at line stretch; None: no limit in the searched range
SafeSpeed.lowest_m_s: fastest safe airspeed if the loads are larger by their uncertainty
SafeSpeed.highest_m_s: fastest safe airspeed if the loads are smaller by their uncertainty
SafeSpeed.unsafe_at_m_s: lowest speed of the search, if the margin is not kept even there
SafeSpeed.load_n: load at the fastest safe speed
SafeSpeed.weakest_member: member that reaches its allowable load first
SafeSpeed.applies: whether the method applies at this speed
Ranged.value: the value
Ranged.low: lower end of its range
Ranged.high: upper end of its range
RecoveryStage.stage: "drogue" or "main"
RecoveryStage.title: title of the case of the parachute
RecoveryStage.time_s: time of the opening since apogee
RecoveryStage.height_m: height of the opening above the ground
RecoveryStage.speed_m_s: airspeed at the opening
RecoveryStage.lowest_load_n: smallest opening load of the applicable methods
RecoveryStage.highest_load_n: largest opening load of the applicable methods
RecoveryStage.lowest_finite_mass_load_n: smallest opening load of the applicable methods without the infinite-mass load; None: there is none
RecoveryStage.highest_finite_mass_load_n: largest opening load of the applicable methods without the infinite-mass load; None: there is none
RecoveryStage.lowest_drag_coefficient: lower end of the range of the drag coefficient in descent on S0
RecoveryStage.highest_drag_coefficient: upper end of the range of the drag coefficient in descent on S0
RecoveryStage.drag_coefficient_range_from: source of this range
RecoveryStage.lowest_design_load_n: lower end of the range of the design load (guide/recovery.md)
RecoveryStage.highest_design_load_n: design load at the highest airspeed, plus the uncertainty of the load
RecoveryStage.load_uncertainty: relative uncertainty of the load at one airspeed, from the range of the drag coefficient and the scatter of openings
RecoveryStage.design_load_caution: condition in which a computed opening has a larger load; empty: none
RecoveryStage.snatch_load_n: snatch load by [deployment] of its case, at the highest airspeed; None: without [deployment]
RecoveryStage.separation_load_n: load on the hardware with length_m and stiffness_n when two sections part; None: no separation speed, or no such hardware
RecoveryStage.margins: margins of safety under highest_design_load_n; for lines, riser and hardware under the snatch load if it is larger; for hardware under the separation load if it is larger
RecoveryStage.required_hardware: strength that each part of the hardware needs under the largest of highest_design_load_n, snatch_load_n and separation_load_n
RecoveryStage.fastest_safe_deployment: fastest safe deployment by the method of the design load; None: the load is measured at one speed
RecoveryStage.descent_rate_m_s: rate of descent at the end of the stage
RecoveryStage.duration_s: duration of the stage
RecoveryStage.drift_m: drift with the wind during the stage
RecoveryStage.parachute_mass_kg: mass of the parachute of the stage
RecoveryStage.bay_length_m: length of the packed parachute in the bay; None: its diameter is not given
SectionEnergy.mass_kg: mass of the section
SectionEnergy.energy_j: kinetic energy at landing
Recovery.mass_kg: mass that descends, without the parachutes
Recovery.total_mass_kg: mass that descends, with the parachutes
Recovery.apogee_m: apogee above the ground
Recovery.wind_m_s: speed of the wind at its reference height
Recovery.wind_reference_height_m: height above the ground at which the wind is given
Recovery.wind_exponent: exponent of the power law of the wind; 0: the same wind at all heights
Recovery.apogee_wind_m_s: speed of the wind at apogee
Recovery.stages: one RecoveryStage for each parachute
Recovery.time_s: time from apogee to the ground
Recovery.drift_m: drift with the wind from apogee to the ground
Recovery.range_m: horizontal distance along the flight path in still air
Recovery.landing_speed_m_s: airspeed at landing
Recovery.energy_j: kinetic energy of the total mass at landing
Recovery.sections: kinetic energy of each section
# size()
family: canopy family: name of its example
type: value of parachute.type
Family.drag_coefficient: axial drag coefficient of the example on S0, computed by Ripstop
Family.speed_m_s: speed of the run of the example
Family.density_kg_m3: density of the air in the run of the example
Family.made: command and machine of the run of the example
Family.flown: drag coefficient in descent; None: not flown
FlownDrag.drag_coefficient: drag coefficient in descent on S0
FlownDrag.standard_error: standard error of the coefficient
FlownDrag.made: command and machine of the flight
Size.descent_rate_m_s: required rate of descent
Size.height_m: height above sea level at which this rate is required, and at which the parachute opens
Size.axial_drag_coefficient: axial drag coefficient of the family on S0
Size.descent_drag_coefficient: drag coefficient of the family in descent on S0, from a computed free flight; None: there is none
Size.handbook_diameter_m: nominal diameters that follow from the range of the handbook, largest first
Size.tape_material: material of the tape; "none": without tape
Size.tape_material_from: reason for the tape
Size.deployment_speed_m_s: airspeed at line stretch
Size.load_uncertainty: relative uncertainty of the design load
Load.load_uncertainty: relative uncertainty of the design load
Load.highest_design_load_n: design load plus its uncertainty
Size.highest_design_load_n: design load plus its uncertainty
Load.smallest_margin_of_safety: margin of safety of the weakest member under the highest design load, or a larger snatch load
Load.smallest_margin_member: weakest member under the highest design load, or a larger snatch load
Size.smallest_margin_of_safety: margin of safety of the weakest member under the highest design load
Size.smallest_margin_member: weakest member under the highest design load
Size.margins: margins of safety under the design load
Size.margins_under_highest_design_load: margins of safety under the highest design load
Load.margins: margins of safety under the design load; for lines, riser and hardware under the snatch load if it is larger
Load.margins_under_highest_design_load: margins of safety under the highest design load; for lines, riser and hardware under the snatch load if it is larger
Size.opening_load_n: largest load of the applicable handbook methods; not the design load
Size.opening_load_low_n: smallest load of the applicable handbook methods
Size.lowest_finite_mass_load_n: smallest opening load of the applicable methods without the infinite-mass load; None: there is none
Size.highest_finite_mass_load_n: largest opening load of the applicable methods without the infinite-mass load; None: there is none
Size.checks: runs of the verification, in order
Size.opening: opening loads by all methods
SizeCheck.descent_rate_m_s: computed rate of descent
SizeCheck.descent_rate_standard_error_m_s: standard error of this rate; None: steady run
)";

}  // namespace ripstop::python
