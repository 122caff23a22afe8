#!/usr/bin/env python3
"""The scores of the blind predictions and the details of ADEPT, validation/ojf/score.py and adept.py."""
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
OJF = ROOT / "validation/ojf"
sys.path.insert(0, str(OJF))
import adept  # pylint: disable=wrong-import-position
import score  # pylint: disable=wrong-import-position
import score_plot  # pylint: disable=wrong-import-position


class FrozenPredictions(unittest.TestCase):
    def test_have_the_recorded_hashes(self):
        for name in score.FROZEN:
            self.assertTrue(score.frozen(name), name)

    def test_reject_a_changed_digit(self):
        with tempfile.TemporaryDirectory() as folder:
            changed = (OJF / "frozen/predictions.csv").read_bytes().replace(b"728.887", b"628.887")
            (pathlib.Path(folder) / "predictions.csv").write_bytes(changed)
            with self.assertRaises(SystemExit):
                score.frozen("predictions.csv", pathlib.Path(folder))

    def test_are_those_of_their_commits(self):
        for name, (commit, _) in score.FROZEN.items():
            command = ["git", "-C", str(ROOT), "show", f"{commit}:validation/ojf/{name}"]
            made = subprocess.run(command, capture_output=True, check=False)
            if made.returncode != 0:
                self.skipTest("the history of the repository is not available")
            self.assertEqual(made.stdout, (OJF / "frozen" / name).read_bytes(), name)


class Measurements(unittest.TestCase):
    def test_have_the_air_and_the_speeds_of_the_predictions(self):
        known = score.measured_drags()
        self.assertEqual(len(known), 13)
        for row in score.frozen("predictions.csv"):
            point = known[row["parachute"], float(row["nominal_m_s"])]
            self.assertEqual(float(row["density_kg_m3"]), point["density_kg_m3"])
            self.assertEqual(float(row["speed_m_s"]), point[f"{row['speed_basis']}_m_s"])

    def test_give_the_drag_area_of_force_over_dynamic_pressure(self):
        point = {"measured_drag_n": 300.0, "density_kg_m3": 1.2, "nominal_m_s": 20.0, "measured_m_s": 25.0}
        self.assertAlmostEqual(score.drag_area(point, "nominal"), 1.25)
        self.assertAlmostEqual(score.drag_area(point, "measured"), 0.8)


class Scores(unittest.TestCase):
    KNOWN = {("walrus", 10.0): {"measured_drag_n": 100.0}, ("adept", 10.0): {"measured_drag_n": 50.0},
             ("adept", 20.0): {"measured_drag_n": 200.0}}

    def rows(self, uncertainty):
        made = {("walrus", 10): 110, ("adept", 10): 40, ("adept", 20): 202}
        common = {"porosity_model": "specified-jet", "fabric_model": "nonlinear", "speed_basis": "nominal"}
        return score.predicted_uncertainties(
            [{**common, "parachute": parachute, "nominal_m_s": speed, "drag_n": drag, "uncertainty_n": uncertainty}
             for (parachute, speed), drag in made.items()], [])

    def test_are_signed_means_absolute_means_and_the_largest_error(self):
        errors = score.drag_errors(self.rows("9.5"), self.KNOWN)
        line, = score.score_lines(errors)
        self.assertEqual(line[3:8], ["3", "-3.0", "10.3", "-20.0", "1 of 3"])  # +10, -20 and +1 %, +10, -10 and +2 N
        self.assertEqual(line[-2:], ["+10.0 / 10.0 / +10.0", "-9.5 / 10.5 / -20.0"])

    def test_say_where_no_uncertainty_was_stated(self):
        line, = score.score_lines(score.drag_errors(self.rows(""), self.KNOWN))
        self.assertEqual(line[7], "none stated")

    def test_put_the_largest_mean_absolute_error_first(self):
        errors = {("good", "nonlinear", "nominal"): {"walrus": [(10, 1, None)], "adept": [(10, -2, None)]},
                  ("bad", "nonlinear", "nominal"): {"walrus": [(10, 30, None)], "adept": [(10, -32, None)]}}
        self.assertEqual([line[0] for line in score.score_lines(errors)], ["bad", "good"])

    def test_of_a_constant_drag_area_are_the_smallest_that_a_constant_can_have(self):
        known = score.measured_drags()
        areas = [score.drag_area(known[key], "nominal") for key in known if key[0] == "walrus"]
        best, errors = score.constant_drag_area(areas)
        for other in (0.999 * best, 1.001 * best):
            moved = [100 * (other / area - 1) for area in areas]
            self.assertGreater(sum(e * e for e in moved), sum(e * e for e in errors))

    def test_of_peaks_mark_the_calibrated_one_and_those_outside_their_uncertainty(self):
        lines = {(line[0], line[1]): line for line in score.peak_lines(score.frozen("openings.csv"))}
        self.assertEqual(lines["ADEPT", score.AIRS["coupled"]][2:6], ["251", "219 +- 30", "-12.7", "no"])
        self.assertEqual(lines["WALRUS", score.AIRS["coupled"]][5], "yes")
        self.assertIn("calibrated", lines["Stratos IV", score.AIRS["damped"]][4])
        self.assertNotIn("calibrated", lines["WALRUS", score.AIRS["damped"]][4])

    def test_have_all_points_and_peaks_in_the_picture(self):
        rows = score.predicted_uncertainties(score.frozen("predictions.csv"), score.frozen("uncertainty.csv"))
        loads = score.plotted_loads(rows, score.measured_drags())
        kinds = [load["kind"] for load in loads]
        self.assertEqual([kinds.count(kind) for kind in ("nominal", "measured", "peak")], [13, 13, 3])
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "picture.svg"
            score_plot.draw(picture, loads, score.NAMES)
            drawn = xml.etree.ElementTree.parse(picture).getroot().findall("{http://www.w3.org/2000/svg}polygon")
        stars = [shape for shape in drawn if len(shape.get("points").split()) == 10]
        self.assertEqual(len(stars), 2 * 3 + 1)  # both panels, and the legend


class DetailsOfAdept(unittest.TestCase):
    def test_have_an_unchanged_case_first_and_folders_of_their_own(self):
        for runs in adept.RUNS:
            made = list(adept.commands(runs))
            self.assertEqual(made[0][2], "unchanged")
            self.assertEqual(len({name for *_, name in made}), len(made))
            chosen = adept.RUNS[runs][1]
            self.assertEqual(len(made), 1 + (len(chosen) if chosen else sum(map(len, adept.VARIATIONS.values()))))

    def test_vary_one_thing_of_the_unchanged_case(self):
        (*_, unchanged, _), *varied = adept.commands("uniform load, 2.8 cm")
        for detail, _, label, _, arguments, _ in varied:
            self.assertEqual(arguments[:len(unchanged)], unchanged, f"{detail} {label}")
            self.assertGreater(len(arguments), len(unchanged), f"{detail} {label}")

    def test_rows_of_the_unchanged_layout_have_two_slots_and_no_fullness_at_the_skirt(self):
        rows = adept.rows()
        self.assertEqual(rows.count("{"), adept.SAILS)
        self.assertEqual(rows.count("slot_deg=3"), 2)
        self.assertTrue(rows.startswith("parachute.rows=[{height=1, slot_deg=0, leading_fullness=0.00000,"), rows)

    def test_together_allow_the_root_of_the_sum_of_squares_or_the_sum_of_the_extremes_of_each(self):
        changes = [("", 0), ("slots", -4), ("slots", 1), ("slots", -3), ("vent", -3), ("lines", 2),
                   ("grid alignment", 50)]
        found = [{"detail": detail, "change_percent": str(change)} for detail, change in changes]
        allowed = adept.allowed(found)
        self.assertAlmostEqual(allowed["root"][0], -5)
        self.assertAlmostEqual(allowed["root"][1], 5**0.5)
        self.assertEqual(allowed["sum"], (-7, 3))

    def test_shift_the_frozen_errors_by_their_range(self):
        found = [{"detail": "slots", "change_percent": "-10"}]
        root, _ = adept.interval_lines(found)
        self.assertEqual(root[1:], ["-10.0 to +0.0", "+21.6", "+9.4 to +21.6", "+6.9", "-3.8 to +6.9"])


if __name__ == "__main__":
    unittest.main()
