"""The examples in Python, with settings that take seconds."""
import csv
import pathlib
import tempfile
import unittest

import numpy
import ripstop
import small

EXAMPLES = small.SOURCE / "examples/python"


class Examples(unittest.TestCase):
    def run_example(self, name, *arguments):
        done = small.python(EXAMPLES / name, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_a_trade_study(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "trade.csv")
            self.run_example("trade_study.py", "--families", "flat-circular", "cross", "--diameters", 1.2, 2.4, "--set",
                             "parachute.mesh.cloth_nodes=600", "--out", file)
            rows = list(csv.DictReader(file.read_text().splitlines()))
        self.assertEqual(len(rows), 4)
        for small_one, large in zip(rows[::2], rows[1::2]):
            self.assertEqual(small_one["family"], large["family"])
            self.assertGreater(float(small_one["descent_rate_m_s"]), 1.8 * float(large["descent_rate_m_s"]))
            self.assertGreater(float(large["parachute_mass_kg"]), 2 * float(small_one["parachute_mass_kg"]))

    def test_a_trade_study_that_flies(self):
        text = self.run_example("trade_study.py", "--families", "flat-circular", "--diameters", 1.0, "--fly", "--set",
                                "parachute.mesh.cloth_nodes=500", "coupling.max_iterations=2", "coupling.threads=1", "flow.max_iterations=20",
                                "flow.average_over=5", "flow.cells=[40,40,50]")
        row = next(csv.DictReader(text.splitlines()))
        known = next(f.drag_coefficient for f in ripstop.families() if f.family == "flat-circular")
        self.assertNotEqual(float(row["drag_coefficient"]), known)
        self.assertAlmostEqual(float(row["drag_coefficient"]), known, delta=0.4)

    def test_a_calibration(self):
        text = self.run_example("calibration.py", "--cloth-nodes", 500, "--duration", 0.1, "--smallest", 4, "--largest", 16, "--points", 4,
                                "--refinements", 1, "--threads", 1)
        self.assertEqual(text.count("misfit"), 5)
        self.assertRegex(text, r"C_a = [\d.]+ N s/m3: peak [\d.]+ N, measured [\d.]+ N\n$")

    def test_an_opening(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "opening.csv")
            text = self.run_example("opening.py", small.STRATOS, "--pressure", 300, "--cloth-nodes", 500, "--duration", 0.02, "--threads", 1,
                                    "--out", file)
            table = numpy.genfromtxt(file, delimiter=",", names=True)
        self.assertAlmostEqual(table["time_s"][-1], 0.02, delta=1e-4)
        self.assertRegex(text, r"peak [\d.]+ N at")
        self.assertEqual(len(text.split("lines: ")[1].split(" N")[0].split()), 18)

    def test_a_flight(self):
        with tempfile.TemporaryDirectory() as folder:
            case, way, lines = (pathlib.Path(folder, name) for name in ("case.toml", "way.csv", "parachute.py"))
            case.write_text(small.case().to_toml())
            text = self.run_example("flight.py", case, "--threads", 1, "--out", way, "--rocketpy", lines)
            table = numpy.genfromtxt(way, delimiter=",", names=True)
            names = {}
            try:
                exec(compile(lines.read_text(), "parachute.py", "exec"), names)
            except NameError:  # the call needs a rocket; the arguments come before it
                pass
        self.assertIn("converged", text)
        self.assertNotIn("NOT", text)
        # After a descent from apogee the payload has its terminal speed: drag equals weight.
        area = table["drag_area_m2"][-1]
        weight = 0.5 * table["density_kg_m3"][-1] * table["speed_m_s"][-1] ** 2 * area
        self.assertAlmostEqual(table["force_n"][-1] / weight, 1, delta=1e-3)
        (arguments,) = names["parachutes"]
        self.assertAlmostEqual(arguments["cd_s"] / area, 1, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
