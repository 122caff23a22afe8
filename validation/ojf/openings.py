"""The openings of the campaign as settings of a case, and their variations."""

# The openings: speed [m/s], density [kg/m3], radius of the folded skirt [m]; the cloth's damping as in the examples.
OPENINGS = {"stratos-iv": (27.1, 1.2, 0.1), "walrus": (27.43, 1.204, 0.2), "adept": (27, 1.205, 0.1)}
OPENING = ["inflation.duration_s=0.45", "inflation.frames=90", "inflation.line_segment_m=0.06",
           "inflation.cloth_damping_s=1e-5", "inflation.low_pass_hz=100", "parachute.mesh.cloth_nodes=12800",
           "flow.tunnel.shear_layer_m=0.1", "flow.cells=[110,110,122]"]
OPENING_OF = {"stratos-iv": [], "walrus": [], "adept": ["inflation.cloth_compression=0.1"]}  # sails that wrinkle remain closed
# Varied inputs of a peak; an early peak ends the run. Variations of Stratos IV alone also apply to the other two.
FINER, TO_THE_PEAK = "flow.cells=[138,138,152]", ["inflation.duration_s=0.2", "inflation.frames=40"]
OPENING_VARIATIONS = [("stratos-iv", "air 1.25 times as fine", [FINER, *TO_THE_PEAK]), ("stratos-iv", "half the folds", ["inflation.folds=9"]),
                      ("stratos-iv", "half the step", ["inflation.courant=0.25", *TO_THE_PEAK]),
                      *[("stratos-iv", f"{label} the nodes", [f"parachute.mesh.cloth_nodes={nodes}", *TO_THE_PEAK])
                        for label, nodes in (("0.7 times", 9000), ("1.4 times", 18000), ("twice", 25600))],
                      ("walrus", "air 1.25 times as fine", [FINER, "inflation.duration_s=0.3", "inflation.frames=60"]), ("adept", "air 1.25 times as fine", [FINER])]
# Under the uniform pressure of their steady load (docs/validation.md), with the damping calibrated on Stratos IV.
# C_a is that calibrated on Stratos IV, for ADEPT with cloth that resists compression, as in its example.
DAMPED = {"stratos-iv": ["--damping", "10.39"], "walrus": ["--damping", "10.39", "--pressure", "534.5"],
          "adept": ["--damping", "10.51", "--pressure", "593"]}
