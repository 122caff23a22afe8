"""Runs: the program's numbers, arrays that share the library's memory, progress, Ctrl-C, and the interpreter's lock."""
import gc
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy
import ripstop
import small

# Members of a result that differ between two runs of the same case.
WALL_TIME = "wall_time_s"

STOPPED = """
import sys, time
sys.path[:0] = {path!r}
import ripstop, small
case = small.{case}
print("begun", flush=True)
try:
    ripstop.{call}
except KeyboardInterrupt:
    print("stopped", flush=True)
"""


def numbers(result):
    """Without the wall time and the members of runs in a folder."""
    return {key: value for key, value in result.items() if key not in (WALL_TIME, "inputs_hash")}


class SteadyRuns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.seen = []
        cls.run_ = ripstop.steady(small.case(), progress=cls.seen.append)

    def test_the_numbers_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "case.toml")
            file.write_text(self.run_.case.to_toml())
            out = pathlib.Path(folder, "run")
            status, _, text = small.program("steady", file, "--out", out)
            self.assertEqual(status, 0, text)
            result = json.loads((out / "result.json").read_text())
            self.assertEqual(numbers(self.run_.asdict()), numbers(result))
            again = ripstop.steady(ripstop.read_case(file), out=out)  # is read, not computed
            self.assertEqual(again.to_json(), (out / "result.json").read_text())
            numpy.testing.assert_array_equal(again.shape, self.run_.shape)
            self.assertIsNone(again.flow)
            for mass in (1, 3):
                self.assertEqual(ripstop.descent(self.run_, mass).heights[0].speed_m_s, ripstop.descent(out, mass).heights[0].speed_m_s)
            _, lines, _ = small.program("export", "rocketpy", out)
            self.assertEqual(ripstop.export(out).rocketpy(), lines)
            self.assertEqual(ripstop.export(self.run_).drag_area_m2, ripstop.export(out).drag_area_m2)
            memory, loaded = ripstop.load(self.run_.case, 2, 20, steady=self.run_), ripstop.load(self.run_.case, 2, 20, steady=out)
            self.assertEqual(memory.peak_load_n, loaded.peak_load_n)

    def test_a_folder_run_in_python_is_a_run_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            run = ripstop.steady(small.case(), out=folder)
            self.assertEqual(numbers(run.asdict()), numbers(self.run_.asdict()))
            numpy.testing.assert_array_equal(run.flow.velocity, self.run_.flow.velocity)
            numpy.testing.assert_array_equal(run.shape, self.run_.shape)
            self.assertEqual(pathlib.Path(folder, "result.json").read_text(), run.to_json())
            status, text, _ = small.program("descent", folder, "--mass", 2, "--json")
            self.assertEqual((status, text), (0, ripstop.descent(folder, 2).to_json()))

    def test_a_run_starts_from_a_finished_one(self):
        warm = ripstop.steady(small.case(), start=self.run_)
        self.assertLess(warm.coupling_iterations, self.run_.coupling_iterations)
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(ValueError, "starts from a run in a folder"):
                ripstop.steady(small.case(), out=folder, start=self.run_)

    def test_a_sweep_has_a_run_for_each_value(self):
        runs = ripstop.sweep(small.case(coupling__max_iterations=2), {"flow.speed_m_s": [15, 20]}, jobs=1)
        self.assertEqual([run.values for run in runs], [{"flow.speed_m_s": "15"}, {"flow.speed_m_s": "20"}])
        self.assertEqual([run.speed_m_s for run in runs], [15, 20])
        self.assertGreater(runs[1].drag_n, runs[0].drag_n)
        with self.assertRaises(ValueError):
            ripstop.sweep(small.case(), {"flow.speed_m_s": []})

    def test_cloth_under_a_pressure(self):
        cloth = ripstop.fabric(small.case(), pressure_pa=300)
        self.assertEqual(cloth.pressure_pa, 300)
        self.assertAlmostEqual(cloth.line_tension_n / cloth.pressure_load_n, 1, delta=0.01)
        self.assertEqual(cloth.shape.shape[1], 3)
        for pressure in (-1, float("nan"), 2e6):
            with self.assertRaises(ripstop.Error):
                ripstop.fabric(small.case(), pressure_pa=pressure)

    def test_a_report_of_a_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            ripstop.steady(small.case(coupling__max_iterations=1), out=pathlib.Path(folder, "run"))
            page = ripstop.report([pathlib.Path(folder, "run")], out=pathlib.Path(folder, "page.html"))
            self.assertIn("<html", pathlib.Path(page).read_text()[:400])

    def test_progress_comes_with_every_iteration(self):
        self.assertEqual([i.iteration for i in self.seen], list(range(1, self.run_.coupling_iterations + 1)))
        numpy.testing.assert_array_equal([i.drag_n for i in self.seen], self.run_.iterations["drag_n"])
        self.assertEqual(self.seen[-1].drag_n, self.run_.drag_n)

    def test_arrays_say_what_the_numbers_say(self):
        run = self.run_
        highest = run.stress["von_mises_n_m"].max()  # of a cell; the number is a mean over 50 mm
        self.assertLessEqual(run.max_von_mises_n_m, highest)
        self.assertGreater(run.max_von_mises_n_m, 0.9 * highest)
        cells = run.cells[run.cells[:, 0] >= 0]
        a, b, c, d = (run.shape[cells[:, i]] for i in range(4))
        area = 0.5 * numpy.cross(c - a, d - b)
        load = (run.pressure_difference[run.cells[:, 0] >= 0, None] * area).sum(axis=0)
        self.assertAlmostEqual(abs(load[2]) / run.ledger.nodal_load_n, 1, delta=0.02)
        self.assertEqual(run.flow.velocity.shape, (30, 20, 20, 3))
        self.assertEqual([len(edges) for edges in run.flow.edges], [21, 21, 31])
        stream = run.flow.velocity[0, :, :, 2]
        self.assertAlmostEqual(stream[0, 0] / run.speed_m_s, 1, delta=0.05)

    def test_arrays_share_memory_and_outlive_their_result(self):
        run = ripstop.steady(small.case(coupling__max_iterations=1))
        arrays = [run.shape, run.cells, run.pressure_difference, run.iterations, run.stress, run.flow.pressure, run.flow.velocity]
        again = [run.shape, run.cells, run.pressure_difference, run.iterations, run.stress, run.flow.pressure, run.flow.velocity]
        for one, other in zip(arrays, again):
            self.assertTrue(numpy.shares_memory(one, other))
            self.assertFalse(one.flags.owndata or one.flags.writeable)
        copies = [array.copy() for array in arrays]
        place = run.max_von_mises_at_m
        expected = place.copy()
        del run, again
        gc.collect()
        ripstop.check(small.case())
        for array, values in zip(arrays, copies):
            numpy.testing.assert_array_equal(array, values)
        numpy.testing.assert_array_equal(place, expected)
        self.assertFalse(ripstop.steady(small.case(coupling__max_iterations=1)).converged)

    def test_a_run_that_has_not_converged_carries_no_payload(self):
        run = ripstop.steady(small.case(coupling__max_iterations=1))
        with self.assertRaisesRegex(ripstop.Error, "has not converged") as caught:
            ripstop.descent(run, 2)
        self.assertEqual(caught.exception.exit_code, 3)


class Openings(unittest.TestCase):
    def test_the_numbers_are_those_of_the_program(self):
        seen = []
        run = ripstop.inflate(small.opening_case(), progress=seen.append)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "case.toml")
            file.write_text(small.opening_case().to_toml())
            out = pathlib.Path(folder, "run")
            status, text, error = small.program("inflate", file, "--out", out, "--json", "--threads", 1)
            self.assertEqual(status, 0, error)
            printed = numbers(json.loads(text))
            # The written case has the density of the measured row as its own.
            self.assertEqual(printed.pop("air_from"), "flow.density_kg_m3 of the case")
            self.assertEqual({**numbers(run.asdict()), "air_from": None}, {**printed, "air_from": None})
            history = numpy.genfromtxt(out / "history.csv", delimiter=",", names=True)
            read = ripstop.inflate(ripstop.read_case(file), out=out)
            self.assertEqual((read.to_json(), len(read.history)), (text, 0))
        # Only the file of a reefed opening has columns of a reefing line.
        of_reefing = ("reefing_line_mean_n", "reefing_line_largest_n")
        self.assertEqual(run.history.dtype.names, history.dtype.names + of_reefing)
        self.assertEqual(run.history["reefing_line_largest_n"].max(), 0)
        numpy.testing.assert_allclose(run.history["load_mean_n"], history["load_mean_n"], rtol=1e-5)
        self.assertEqual(run.history["load_largest_n"].max(), run.peak_load_n)
        self.assertEqual(run.line_peaks.max(), run.max_line_tension_n)
        self.assertEqual(seen[-1].load_n, run.history["load_mean_n"][-1])
        self.assertGreater(len(run.shots), 1)
        self.assertEqual(run.shots[0].positions.shape, run.shape.shape)
        times = [progress.time_s for progress in seen]
        self.assertEqual(times, sorted(times))

    def test_the_drag_of_a_run_in_memory_sets_the_pressure(self):
        steady = ripstop.steady(small.case())
        run = ripstop.inflate(small.case(), steady=steady)
        self.assertEqual(run.steady_drag_asked_n, steady.drag_n)
        with self.assertRaisesRegex(ripstop.Error, "a different speed"):
            ripstop.inflate(small.case(flow__speed_m_s=10), steady=steady)

    def test_it_begins_at_the_deployment_speed_unless_the_speed_is_set(self):
        case = ripstop.Case.from_dict({**small.TABLES, "payload": {"deployment_speed_m_s": 30}})
        run = ripstop.inflate(case, pressure_pa=300)
        self.assertEqual((run.speed_m_s, run.speed_from), (30, "payload.deployment_speed_m_s of the case"))
        case.set("flow.speed_m_s", 25)
        run = ripstop.inflate(case, pressure_pa=300)
        self.assertEqual((run.speed_m_s, run.speed_from), (25, "flow.speed_m_s, given by set"))

    def test_a_damping_is_found_and_told_on_the_way(self):
        case = small.opening_case()
        case.set("inflation.measured_peak_n", 500)
        seen = []
        found = ripstop.calibrate_damping(case, points=3, refinements=0, progress=seen.append)
        self.assertEqual(len(found.trials), 3)
        self.assertEqual(min(trial.misfit for trial in seen), found.misfit)


class Interruptions(unittest.TestCase):
    def test_what_a_callback_raises_ends_the_run_and_arrives(self):
        class Enough(Exception):
            pass

        calls = []

        def stop(progress):
            calls.append(progress)
            raise Enough("of this")

        for call in (lambda: ripstop.steady(small.case(), progress=stop), lambda: ripstop.inflate(small.opening_case(), progress=stop),
                     lambda: ripstop.fit(small.SOURCE / "examples/fit-ripstop/bench.toml", threads=1, progress=stop)):
            calls.clear()
            with self.assertRaisesRegex(Enough, "of this"):
                call()
            self.assertEqual(len(calls), 1)

    def test_only_what_can_be_called_is_a_callback(self):
        with self.assertRaises(TypeError):
            ripstop.steady(small.case(), progress=3)

    def stopped(self, case, call, wait):
        """Seconds from the signal to the end."""
        code = STOPPED.format(path=[str(pathlib.Path(__file__).parent)], case=case, call=call)
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as child:
            self.assertEqual(child.stdout.readline(), "begun\n")
            time.sleep(wait)
            begin = time.monotonic()
            child.send_signal(signal.SIGINT)
            output, _ = child.communicate(timeout=60)
            self.assertEqual((output, child.returncode), ("stopped\n", 0))
        return time.monotonic() - begin

    def test_ctrl_c_stops_a_steady_run_within_a_flow_iteration_or_so(self):
        # Without the signal the run takes minutes on any machine, since it never meets this tolerance.
        long = "case(flow__cells=[50, 50, 60], coupling__drag_tolerance=1e-12, coupling__max_iterations=1000)"
        self.assertLess(self.stopped(long, "steady(case)", 1.5), 3)

    def test_ctrl_c_stops_an_opening_and_a_calibration(self):
        long = "opening_case(); case.update({'inflation.duration_s': 5, 'inflation.measured_peak_n': 500})"
        self.assertLess(self.stopped(long, "inflate(case)", 0.7), 2)
        self.assertLess(self.stopped(long, "calibrate_damping(case)", 0.7), 2)

    def test_other_threads_run_while_the_library_computes(self):
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)

        counter = threading.Thread(target=count)
        counter.start()
        before = counted[0]
        begin = time.monotonic()
        ripstop.steady(small.case(coupling__max_iterations=1))
        passed, steps = time.monotonic() - begin, counted[0] - before
        done.set()
        counter.join()
        # If the lock were not released, it would count once or twice.
        self.assertGreater(steps, 20 * passed)
        self.assertGreater(steps, 10)

    def test_two_runs_at_once_have_the_numbers_of_one(self):
        results = [None, None]

        def run(i):
            results[i] = ripstop.steady(small.case(coupling__max_iterations=2)).drag_n

        threads = [threading.Thread(target=run, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(results[0], results[1])
        self.assertIsNotNone(results[0])


class Engines(unittest.TestCase):
    """A flow engine written in Python."""

    @classmethod
    def setUpClass(cls):
        cls.answer = None
        ripstop.add_engine("python", lambda *given: cls.answer(*given))

    def case(self, **keys):
        return small.case(flow__engine="python", flow__porosity_model="sheet", **keys)

    def test_a_uniform_pressure_has_the_drag_of_the_projected_area(self):
        given = []

        def uniform(triangles, velocity, density):
            given.append((triangles.shape, velocity, density))
            return numpy.full(len(triangles), 180.0)

        type(self).answer = staticmethod(uniform)
        run = ripstop.steady(self.case())
        same = ripstop.fabric(small.case(flow__porosity_model="sheet"), pressure_pa=180)
        self.assertTrue(run.converged)
        self.assertEqual(run.engine, "python")
        self.assertEqual(given[0][1:], ((0.0, 0.0, 20.0), 1.2))
        self.assertEqual(given[0][0][1:], (3, 3))
        self.assertAlmostEqual(run.drag_n / same.pressure_load_n, 1, delta=0.01)
        self.assertAlmostEqual(run.projected_area_m2 / same.projected_area_m2, 1, delta=0.01)

    def test_an_answer_that_is_no_pressure_of_each_triangle_is_refused(self):
        for wrong in (lambda triangles, *_: [1.0, 2.0], lambda triangles, *_: numpy.full(len(triangles), numpy.nan),
                      lambda triangles, *_: "much", lambda *_: None):
            type(self).answer = staticmethod(wrong)
            with self.assertRaisesRegex(ripstop.Error, 'the engine "python"'):
                ripstop.steady(self.case())

    def test_an_exception_of_the_function_ends_the_run(self):
        def fails(*_):
            raise LookupError("no pressure")

        type(self).answer = staticmethod(fails)
        with self.assertRaisesRegex(LookupError, "no pressure"):
            ripstop.steady(self.case())

    def test_names_and_porous_cells_are_checked(self):
        for word in ("python", "builtin", "My Engine", ""):
            with self.assertRaises(ValueError):
                ripstop.add_engine(word, len)
        with self.assertRaisesRegex(ripstop.Error, "sheet"):
            ripstop.steady(small.case(flow__engine="python", flow__porosity_model="paper"))


class OwnMeshes(unittest.TestCase):
    """A canopy that is put together in Python."""

    def test_the_mesh_of_the_case_has_the_numbers_of_the_case(self):
        case = small.case(coupling__max_iterations=2)
        mesh = ripstop.Mesh.of(case)
        plain, own = ripstop.steady(case), ripstop.steady(case, mesh=mesh)
        self.assertEqual(own.drag_n, plain.drag_n)
        numpy.testing.assert_array_equal(own.shape, plain.shape)
        numpy.testing.assert_array_equal(own.cells, plain.cells)
        self.assertEqual(own.reference_area_m2, mesh.cloth_area_m2)  # without that of the vent
        self.assertLess(own.reference_area_m2, plain.reference_area_m2)
        self.assertIsNone(own.known_drag_coefficient)
        self.assertEqual(ripstop.fabric(case, pressure_pa=100, mesh=mesh).line_tension_n, ripstop.fabric(case, pressure_pa=100).line_tension_n)

    def test_a_square_on_four_lines_carries_its_pressure(self):
        case = small.case()
        mesh = ripstop.Mesh.empty(case)
        x, y = numpy.meshgrid(numpy.linspace(-0.4, 0.4, 13), numpy.linspace(-0.4, 0.4, 13))
        cloth = mesh.add_cloth("square", numpy.dstack([x, y, 0 * x]))  # columns along x, rows along y: the outer side is downstream
        end, = mesh.add_nodes([[0, 0, -1]])
        for corner in (cloth[0, 0], cloth[0, -1], cloth[-1, -1], cloth[-1, 0]):
            mesh.add_line([end, corner], [1.2])
        mesh.fix(end)
        mesh.set_skirt(numpy.concatenate([cloth[0, :-1], cloth[:-1, -1], cloth[-1, :0:-1], cloth[:0:-1, 0]]))
        self.assertEqual(mesh.nodes.shape, (170, 3))
        self.assertAlmostEqual(mesh.cloth_area_m2, 0.64)
        square = ripstop.fabric(case, pressure_pa=50, mesh=mesh)
        self.assertTrue(square.converged)
        self.assertAlmostEqual(square.line_tension_n / square.pressure_load_n, 1, delta=0.01)
        self.assertGreater(square.max_line_tension_n, square.line_tension_n / 4)  # they are inclined
        self.assertLess(square.projected_area_m2, 0.64)
        run = ripstop.steady(small.case(coupling__max_iterations=1), mesh=mesh)
        self.assertEqual(run.reference_area_m2, mesh.cloth_area_m2)
        self.assertEqual(len(run.shape), 170)
        self.assertIn('"square"', run._page())  # the part of this mesh, not of that of the case
        self.assertGreater(run.drag_n, 0)
        for use in (lambda: ripstop.descent(run, 2), lambda: ripstop.export(run), lambda: ripstop.load(small.case(), 2, 20, steady=run),
                    lambda: ripstop.inflate(small.case(), steady=run)):
            with self.assertRaisesRegex(ripstop.Error, "mesh of your own"):
                use()

    def test_input_that_no_mesh_can_have_is_refused(self):
        mesh = ripstop.Mesh.empty(small.case())
        with self.assertRaisesRegex(ripstop.Error, "no cloth"):
            ripstop.fabric(small.case(), pressure_pa=10, mesh=mesh)
        for points in (numpy.zeros((2, 2, 3)), numpy.full((2, 2, 3), numpy.nan)):
            with self.assertRaises(ripstop.Error):
                mesh.add_cloth("a", points)
        for points in (numpy.zeros((2, 2)), numpy.zeros((2, 2, 2)), numpy.zeros(3)):
            with self.assertRaises(ValueError):
                mesh.add_cloth("a", points)
        with self.assertRaisesRegex(ripstop.Error, "no node 7"):
            mesh.fix(7)
        for wrong in ("everything", 0.5, None, [0, 1.5]):
            with self.subTest(wrong), self.assertRaises(TypeError):
                mesh.fix(wrong)
        for wrong in (-1, 2**40):
            with self.assertRaisesRegex(ValueError, "no node"):
                mesh.fix(wrong)
        whole = ripstop.Mesh.of(small.case())
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(ripstop.Error, "leave out `out`"):
            ripstop.steady(small.case(), mesh=whole, out=folder)
        with self.assertRaisesRegex(ripstop.Error, "payload.mass_kg"):
            ripstop.steady(small.case(payload__mass_kg=2, flow__speed_m_s=None), mesh=whole)


if __name__ == "__main__":
    unittest.main()
