"""The tunnel of the campaign as settings of a case, and its undocumented details."""

# The Open Jet Facility of [NFM]: an octagonal nozzle of 2.85 m. Its distance from the canopy, the thickness of its edge and the
# place of the speed measurement are undocumented. The distance is assumed, and all of them are varied. Other settings are
# defaults; box and cells are given because the case files have the printed ones.
SPECIFIED = ["flow.porosity_model=sheet", "parachute.canopy_material=f-111-physical"]
JET_FLOW = ["flow.tunnel.kind=open-jet", "flow.tunnel.shape=octagon", "flow.tunnel.width_m=2.85", "flow.box_m=[8,8,9]",
            "flow.cells=[88,88,98]"]
JET_DISTANCE = "flow.tunnel.nozzle_distance_m=3"
JET_SPECIFIED = [*SPECIFIED, *JET_FLOW, JET_DISTANCE]
FREE_FLOW = ["flow.box_m=[8,8,9]", "flow.cells=[88,88,98]", "flow.canopy_position_m=3"]
# Settings of steady flows on the cells of the unsteady ones, a quarter of a cell off the axis. Only changes are used, so
# the cloth has the mean pressure, under which slack cloth converges quickly.
JET_BASE = [*SPECIFIED, *JET_FLOW, "flow.core.off_axis=0.25", "coupling.load=uniform"]
JET_VARIATIONS = {
    "nozzle": [("2 m before the skirt", ["flow.tunnel.nozzle_distance_m=2", "flow.box_m=[8,8,8]"]),
               ("4 m before the skirt", ["flow.tunnel.nozzle_distance_m=4", "flow.box_m=[8,8,10]"])],
    "jet's edge": [("0.15 m thick", ["flow.tunnel.shear_layer_m=0.15"]), ("0.5 m", ["flow.tunnel.shear_layer_m=0.5"]),
                   ("round, of its area", ["flow.tunnel.shape=circle", "flow.tunnel.width_m=2.927"])],
    "still air": [("5 % of the speed", ["flow.tunnel.outside_speed=0.05"]), ("10 x 10 m", ["flow.box_m=[10,10,9]"])],
    "grid": [("a fifth coarser", ["flow.cells=[70,70,78]"]), ("on the axis", ["flow.core.off_axis=0"]),
             ("0.4 of a cell beside it", ["flow.core.off_axis=0.4"])],
    "turbulence": [("intensity 5 %", ["flow.turbulence_intensity=0.05"])],
    "permeability": [(f"{cfm} CFM/ft2, of 3", [f"materials.f-111-physical.pressure_drop_linear_pa_s_m={3 / cfm * 8169.3:.1f}"]) for cfm in (0.5, 5)],
}
