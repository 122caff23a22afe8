"""Cases, errors and results without a coupled run: they have the numbers and texts of the program."""
import copy
import gc
import inspect
import json
import pathlib
import pickle
import tempfile
import unittest

import numpy
import ripstop
import small


class Materials(unittest.TestCase):
    def test_are_those_that_the_program_lists(self):
        status, text, error = small.program("materials", "--json")
        self.assertEqual(status, 0, error)
        listed = json.loads(text)["materials"]
        self.assertEqual([(m.name, m.kind, m.strength_n) for m in ripstop.materials()],
                         [(m["name"], m["kind"], m.get("strength_n")) for m in listed])
        cloth = ripstop.material("f-111-physical")
        self.assertAlmostEqual(cloth.permeability_cfm, 3, 3)
        self.assertEqual(cloth.curve[-1].strain, cloth.tested_strain)
        self.assertEqual(len(cloth.air), 6)
        with self.assertRaisesRegex(ripstop.Error, "did you mean"):
            ripstop.material("f-111-physicl")


class Cases(unittest.TestCase):
    def test_a_case_file_and_its_settings_are_what_the_program_makes_of_them(self):
        case = ripstop.Case.read(small.STRATOS, set={"flow.speed_m_s": 20, "parachute.canopy_material": "f-111"})
        status, text, _ = small.program("check", small.STRATOS, "--resolved", "--speed", 20)
        self.assertEqual((status, case.to_toml()), (0, text))
        self.assertEqual(case.file, str(small.STRATOS))

    def test_a_case_from_a_dictionary_is_that_from_text(self):
        case = small.case()
        again = ripstop.Case.from_toml(case.to_toml(), "again")
        self.assertEqual(case.to_toml(), again.to_toml())
        self.assertEqual(case.get("flow.cells"), [20, 20, 30])
        self.assertEqual(case.asdict()["title"], small.TABLES["title"])
        with self.assertRaises(KeyError):
            case.get("flow.nothing")

    def test_every_kind_of_value_can_be_set(self):
        case = small.case()
        case.set("flow.speed_m_s", numpy.float64(12.5))
        case.set("flow.cells", numpy.array([16, 16, 26]))
        case.set("flow.unsteady", True)
        case.set("title", 'A "new" [canopy] = 1, of cloth\\')
        case.set("measured", [{"nominal_speed_m_s": 10, "measured_speed_m_s": 9.5, "density_kg_m3": 1.2}])
        self.assertEqual([case.get(key) for key in ("flow.speed_m_s", "flow.cells", "flow.unsteady", "title")],
                         [12.5, [16, 16, 26], True, 'A "new" [canopy] = 1, of cloth\\'])
        self.assertEqual(case.get("measured")[0]["measured_speed_m_s"], 9.5)
        with self.assertRaises(TypeError):
            case.set("flow.speed_m_s", object())

    def test_a_dictionary_that_is_deep_or_contains_itself_is_refused(self):
        loop = {"flow": {}}
        loop["flow"]["flow"] = loop
        deep = {}
        for _ in range(100000):
            deep = {"a": deep}
        chain = []
        chain.append(chain)
        for tables in (loop, deep, {"measured": chain}, {"measured": [loop]}):
            with self.assertRaisesRegex(ValueError, "32 levels deep"):
                ripstop.Case.from_dict(tables)

    def test_none_removes_a_key_or_a_table(self):
        case = small.case(payload__mass_kg=2)
        case.set("payload", None)
        self.assertIsNone(case.asdict().get("payload", {}).get("mass_kg"))
        self.assertEqual(pickle.loads(pickle.dumps(case)).to_toml(), case.to_toml())
        with self.assertRaises(ripstop.InputError):
            case.set("payload", None)

    def test_ranges_are_those_of_the_command_line(self):
        case = small.case()
        for wrong in ({"seam_allowance_m": -1}, {"hem_allowance_m": float("nan")}, {"packing_density_kg_m3": 1}):
            with self.assertRaises(ripstop.Error):
                ripstop.pattern(case, **wrong)
        for wrong in ({"speed_m_s": float("nan")}, {"payload_mass_kg": float("inf")}, {"height_m": float("nan")}):
            with self.assertRaises(ripstop.Error):
                ripstop.load(case, **({"payload_mass_kg": 2, "speed_m_s": 20} | wrong))

    def test_a_load_begins_at_the_height_of_the_case(self):
        case = ripstop.Case.from_dict(small.TABLES | {"flow": {"speed_m_s": 20, "height_m": 2500}})
        self.assertEqual(ripstop.load(case, 2, 20).flight["height_m"][0], 2500)
        self.assertEqual(ripstop.load(case, 2, 20, height_m=500).flight["height_m"][0], 500)
        # Without a height, that of the standard atmosphere with the density of the case.
        height = (1 - (1.2 / 1.225) ** (1 / 4.2559)) / 2.25577e-5
        self.assertAlmostEqual(ripstop.load(small.case(), 2, 20).flight["height_m"][0], height, delta=1)

    def test_recovery_and_fastest_deployment_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            main, drogue = small.case(), small.case().scaled(0.8)
            (folder / "main.toml").write_text(main.to_toml(), encoding="utf-8")
            (folder / "drogue.toml").write_text(drogue.to_toml(), encoding="utf-8")
            landed = ripstop.recovery(main, drogue, 3, 1000, ground_m=200, sections_kg=[1, 2])
            text = small.program("recovery", folder / "main.toml", "--drogue", folder / "drogue.toml", "--mass", 3, "--apogee", 1000,
                                 "--ground", 200, "--section", "1,2", "--out", folder / "landed", "--json")[1]
            self.assertEqual(landed.to_json(), text)
            self.assertEqual(landed.trajectory["height_m"][-1], 200)
            safe = ripstop.fastest_deployment(main, 3, margin=0.5, reefing=[(0.3, 2)])
            text = small.program("load", folder / "main.toml", "--mass", 3, "--fastest", "--margin", 0.5, "--reef", "0.3:2",
                                 "--out", folder / "safe", "--json")[1]
            self.assertEqual(safe.to_json(), text)
        infinite = ripstop.fastest_deployment(main, 3, margin=9).methods[0]
        self.assertLess(infinite.lowest_m_s, infinite.speed_m_s)
        with self.assertRaises(ripstop.Error):
            ripstop.recovery(main, drogue, 3, 200)  # the main opens above the apogee

    def test_a_wrong_setting_leaves_the_case_as_it_was(self):
        case = small.case()
        before = case.to_toml()
        with self.assertRaises(ripstop.InputError):
            case.set("flow.speed_m_s", -3)
        self.assertEqual(case.to_toml(), before)

    def test_copies_and_pickles_are_cases_of_their_own(self):
        case = small.case()
        others = [case.copy(), copy.copy(case), copy.deepcopy(case), pickle.loads(pickle.dumps(case))]
        case.set("flow.speed_m_s", 7)
        for other in others:
            self.assertEqual(other.get("flow.speed_m_s"), 20)
            other.set("flow.speed_m_s", 8)
        self.assertEqual(case.get("flow.speed_m_s"), 7)

    def test_an_object_cannot_be_made_without_its_function(self):
        classes = [member for name in ripstop.__all__ for member in [getattr(ripstop, name)]
                   if inspect.isclass(member) and not issubclass(member, Exception) and member.__module__ == "ripstop"]
        self.assertGreater(len(classes), 40)
        for made in (lambda one: one.__new__(one), lambda one: one(), lambda one: object.__new__(one)):
            for one in classes:
                with self.subTest(one.__name__), self.assertRaises(TypeError):
                    made(one)
        with self.assertRaises(TypeError):
            copy.copy(ripstop.check(small.case()))

    def test_another_size_scales_the_area_by_the_square(self):
        case = small.case()
        self.assertAlmostEqual(ripstop.check(case.scaled(1.5)).nominal_area_m2, 2.25 * ripstop.check(case).nominal_area_m2, places=9)


class Errors(unittest.TestCase):
    def both(self, error, call, *arguments, words=()):
        """The exception of a call and the program's end state the same, with arguments in place of the program's options."""
        with self.assertRaises(error) as caught:
            call()
        status, _, text = small.program(*arguments)
        for option, argument in dict(words).items():
            self.assertIn(option, text)
            text = text.replace(option, argument)
        self.assertEqual(f"ripstop: {caught.exception}\n", text)
        self.assertNotRegex(str(caught.exception).split("ripstop ")[0], "--[a-z]")
        self.assertEqual(caught.exception.exit_code, status)
        return caught.exception

    def test_every_mistake_of_a_case_file_is_told_at_its_place(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "case.toml")
            file.write_text(small.STRATOS.read_text().replace("gores = 6", "gores = -6\ngorse = 7"))
            error = self.both(ripstop.InputError, lambda: ripstop.read_case(file), "check", file)
        self.assertEqual(len(error.problems), 2)
        self.assertEqual({(p.key, p.file) for p in error.problems}, {("parachute.gores", str(file)), ("parachute.gorse", str(file))})
        self.assertEqual("\n".join(map(str, error.problems)), "\n".join(line.strip() for line in str(error).splitlines() if "case.toml:" in line))

    def test_settings_are_refused_as_those_of_the_command_line(self):
        for key, value, text in [("flow.speed_m_s", -3, "-3"), ("flow.spede", 3, "3"), ("materials.f-1111.darcy_1_m2", 1, "1"),
                                 ("flow.cells", [1, 2], "[1, 2]"), ("flow.engine", "openfaom", "openfaom")]:
            with self.subTest(key):
                self.both(ripstop.InputError, lambda: ripstop.read_case(small.STRATOS, set={key: value}),
                          "check", small.STRATOS, "--set", f"{key}={text}", words={"--set": "set"})

    def test_an_old_key_is_read_with_a_warning_that_names_the_new_one(self):
        with self.assertWarnsRegex(DeprecationWarning, "write materials.f-111.darcy_1_m2"):
            case = ripstop.read_case(small.STRATOS, set={"materials.f-111.darcy": 60})
        self.assertEqual(case.get("materials.f-111.darcy_1_m2"), 60)
        self.assertIn("materials.f-111.darcy is a deprecated key", ripstop.check(case).warnings[0])

    def test_a_missing_file_and_a_folder_without_a_run(self):
        with tempfile.TemporaryDirectory() as folder:
            none = pathlib.Path(folder, "none.toml")
            self.assertEqual(self.both(ripstop.Error, lambda: ripstop.read_case(none), "check", none).exit_code, 7)
            self.both(ripstop.Error, lambda: ripstop.descent(folder, 2), "descent", folder, "--mass", 2)

    def test_an_opening_without_a_pressure(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "case.toml")
            file.write_text(small.case().to_toml())
            self.both(ripstop.Error, lambda: ripstop.inflate(small.case()), "inflate", file, "--out", pathlib.Path(folder, "run"),
                      words={"--pressure": "pressure_pa", "--steady RUN": "steady"})

    def test_a_folder_of_other_inputs_is_refused_with_the_arguments_of_the_function(self):
        with tempfile.TemporaryDirectory() as folder:
            file, run = pathlib.Path(folder, "case.toml"), pathlib.Path(folder, "run")
            file.write_text(small.case(coupling__max_iterations=1).to_toml())
            other = small.case(coupling__max_iterations=1, flow__speed_m_s=21)
            ripstop.steady(other, out=run)
            case = ripstop.read_case(file)
            self.both(ripstop.Error, lambda: ripstop.steady(case, out=run), "steady", file, "--out", run,
                      words={"--out": "out", "--fresh": "fresh=True"})
            self.both(ripstop.Error, lambda: ripstop.size(1e-3, 0.1), "size", "--mass", 1e-3, "--descent-rate", 0.1, "--out", file, "--force")

    def test_angles_of_attack_that_do_not_rise(self):
        case = ripstop.Case.read(small.STRATOS)
        for angles, words in [([10, 5], "5 after 10 degrees"), ([], "no angle"), ([0, 91], "91 degrees")]:
            with self.subTest(angles), self.assertRaisesRegex(ripstop.Error, words):
                ripstop.stability(case, angles)

    def test_an_error_of_the_input_is_an_error(self):
        self.assertTrue(issubclass(ripstop.InputError, ripstop.Error))
        self.assertFalse(issubclass(ripstop.Error, RuntimeError))


class Results(unittest.TestCase):
    def same_as_program(self, result, *arguments):
        status, text, _ = small.program(*arguments, "--json")
        self.assertEqual((status, result.to_json()), (0, text))
        self.assertEqual(result.asdict(), json.loads(text))
        for name, value in json.loads(text).items():
            if isinstance(value, (int, float, str, bool)) and hasattr(result, name):
                self.assertEqual(getattr(result, name), value, name)

    def test_check(self):
        case = ripstop.read_case(small.STRATOS)
        check = ripstop.check(case)
        self.same_as_program(check, "check", small.STRATOS)
        self.assertEqual(check.mass_kg.total, check.asdict()["mass_kg"]["total"])
        self.assertEqual({"key", "value", "unit", "given", "from"}, set(check.sources[0]))

    def test_pattern(self):
        with tempfile.TemporaryDirectory() as folder:
            result = ripstop.pattern(ripstop.read_case(small.STRATOS), seam_allowance_m=0.02, out=pathlib.Path(folder, "a"))
            self.same_as_program(result, "pattern", small.STRATOS, "--seam-allowance", 0.02, "--out", pathlib.Path(folder, "b"))
            for file in pathlib.Path(folder, "a").iterdir():
                self.assertEqual(file.read_bytes(), pathlib.Path(folder, "b", file.name).read_bytes(), file.name)
        disk = result.pieces[0]
        x, y = disk.outline.T
        area = 0.5 * (x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1))
        self.assertGreater(area, 0)
        self.assertEqual(len(disk.hems), len(disk.outline))

    def test_size_and_load(self):
        with tempfile.TemporaryDirectory() as folder:
            size = ripstop.size(2.4, 5, "cross", height_m=300)
            file = pathlib.Path(folder, "cross.toml")
            self.same_as_program(size, "size", "--mass", 2.4, "--descent-rate", 5, "--family", "cross", "--height", 300, "--out", file)
            self.assertEqual(size.case_text, file.read_text())
            load = ripstop.load(size.case, 2.4, 25, height_m=300, reefing=[(0.1, 2)])
            self.same_as_program(load, "load", file, "--mass", 2.4, "--speed", 25, "--height", 300, "--reef", "0.1:2",
                                 "--out", pathlib.Path(folder, "load"))
            table = numpy.genfromtxt(pathlib.Path(folder, "load", "trajectory.csv"), delimiter=",", names=True)
        self.assertEqual(load.flight.dtype.names, table.dtype.names)
        numpy.testing.assert_allclose(load.flight["force_n"], table["force_n"], rtol=1e-5)

    def test_fit(self):
        bench = small.SOURCE / "examples/fit-ripstop/bench.toml"
        with tempfile.TemporaryDirectory() as folder:
            fit = ripstop.fit(bench, coupons=False, threads=1)
            status, text, _ = small.program("fit", bench, "--no-coupons", "--json", "--out", folder)
            self.assertEqual((status, fit.to_json()), (0, text))
            self.assertEqual(fit.to_toml(), next(pathlib.Path(folder).glob(fit.name + ".toml")).read_text())
        warp = fit.directions[0]
        powers = numpy.arange(1, warp.degree + 1)
        numpy.testing.assert_allclose(warp.fit, warp.offset.value + (warp.strain[:, None] ** powers) @ warp.coefficients["value"], rtol=1e-9)
        self.assertEqual((fit.kind, fit.shear_fraction, fit.coupons), ("fabric", None, []))

    def test_a_result_reads_like_a_dataclass(self):
        check = ripstop.check(small.case())
        match check.mass_kg:
            case ripstop.PartMasses(cloth, tape, lines, riser, total):
                self.assertAlmostEqual(cloth + tape + lines + riser, total, places=12)
        self.assertTrue(repr(check).startswith("Check(nominal_area_m2="))
        self.assertEqual(tuple(type(check).__annotations__), type(check).__match_args__)
        with self.assertRaises(AttributeError):
            check.nodes = 3


class Memory(unittest.TestCase):
    def test_arrays_are_views_that_keep_their_result(self):
        pattern = ripstop.pattern(small.case())
        outline = pattern.pieces[0].outline
        self.assertTrue(numpy.shares_memory(outline, pattern.pieces[0].outline))
        self.assertFalse(outline.flags.owndata)
        self.assertFalse(outline.flags.writeable)
        with self.assertRaises(ValueError):
            outline[0, 0] = 1
        with self.assertRaises(ValueError):
            outline.flags.writeable = True
        values = outline.copy()
        del pattern
        gc.collect()
        others = [ripstop.pattern(small.case()) for _ in range(5)]  # freed memory would be used again
        numpy.testing.assert_array_equal(outline, values)
        self.assertFalse(any(numpy.shares_memory(outline, other.pieces[0].outline) for other in others))

    def test_a_table_lies_in_the_rows_of_the_library(self):
        load = ripstop.load(small.case(), 2, 20)
        force = load.flight["force_n"]
        self.assertTrue(numpy.shares_memory(force, load.flight))
        self.assertEqual(force.strides[0], load.flight.dtype.itemsize)
        self.assertEqual(force.max(), load.peak_load_n)
        expected = force.copy()
        del load
        gc.collect()
        numpy.testing.assert_array_equal(force, expected)


if __name__ == "__main__":
    unittest.main()
