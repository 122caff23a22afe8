#!/usr/bin/env python3
"""The comparison of a tutorial with the output of its coupled steady runs, validation/tutorials/follow.py."""
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "validation/tutorials"))
import follow  # pylint: disable=wrong-import-position

OUTPUT = """
    1   149.19    90.19
  drag computed              128.4 N
  drag coefficient           0.6810 on S0 = 0.7854 m2
  maximum line tension       11.5 N
iteration 5: 128.6 N
25789 nodes, largest radius 0.360 m
"""


def runs(tolerance=0.005):
    coupled = follow.CoupledRuns(tolerance)
    coupled.add(OUTPUT)
    return coupled


class CoupledRuns(unittest.TestCase):
    def test_print_a_line_within_the_tolerance_and_the_rounding(self):
        for line in ("drag computed  127.9 N", "maximum line tension 11.4 N", "iteration 5: 127.9 N", "25789 nodes, largest radius 0.359 m"):
            self.assertTrue(runs().prints_line(line), line)

    def test_do_not_print_a_line_beyond_it(self):
        for line in ("drag computed 127.5 N", "drag computed 130.0 N", "maximum line tension 11.3 N", "iteration 4: 128.6 N", "iteration 15: 128.6 N",
                     "25788 nodes, largest radius 0.360 m", "mean drag 128.4 N", "converged"):
            self.assertFalse(runs().prints_line(line), line)

    def test_need_the_same_numbers_without_a_tolerance(self):
        self.assertTrue(runs(0).prints_line("drag computed 128.4 N"))
        self.assertFalse(runs(0).prints_line("drag computed 127.9 N"))

    def test_have_the_drags_of_prose_only_in_lines_of_a_drag(self):
        self.assertTrue(runs().have_drag("127.9"))
        self.assertTrue(runs().have_drag("0.68"))
        self.assertFalse(runs().have_drag("127.5"))
        self.assertFalse(runs().have_drag("149.2"))

    def test_have_a_drag_within_a_range(self):
        self.assertTrue(runs().have_drag_within("127.5", "128.4"))
        self.assertFalse(runs().have_drag_within("126.5", "128.3"))

    def test_report_the_differences_with_the_tolerance(self):
        coupled = runs()
        self.assertEqual(coupled.report(), [])
        coupled.prints_line("drag computed 127.9 N")
        self.assertEqual(coupled.report(), ["within 0.5 % (coupling.drag_tolerance) and rounding: drag computed 127.9 N: here drag computed 128.4 N"])

    def test_are_commands_and_scripts_that_compute_one(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "flight.py").write_text("import ripstop\nrun = ripstop.steady(case)\n")
            (folder / "study.py").write_text("import ripstop\nload = ripstop.load(case)\n")
            for command, expected in (("ripstop steady my.toml --out run", True), ("python3 flight.py", True), ("python3 study.py", False),
                                      ("ripstop load my.toml --steady run", False)):
                self.assertEqual(follow.is_coupled(command, folder), expected, command)


if __name__ == "__main__":
    unittest.main()
