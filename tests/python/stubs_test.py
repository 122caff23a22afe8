"""Every public name is in the stub and has a docstring with its unit."""
import ast
import inspect
import pathlib
import unittest

import ripstop
from ripstop import _ripstop

PACKAGE = pathlib.Path(ripstop.__file__).parent
# Endings of names that are units; docstrings have the unit in brackets.
UNITS = ("_m", "_m2", "_m3", "_kg", "_n", "_s", "_pa", "_m_s", "_n_m", "_hz", "_deg", "_kg_m3", "_j")


def public(names):
    return {name for name in names if not name.startswith("_")}


def defined(body):
    found = {}
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = node
    return found


class Stubs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stub = defined(ast.parse((PACKAGE / "_ripstop.pyi").read_text()).body)

    def test_every_public_name_is_in_the_stub_and_no_other(self):
        self.assertEqual(public(dir(_ripstop)), public(self.stub))
        self.assertEqual(set(ripstop.__all__), public(dir(_ripstop)))
        self.assertLessEqual({"Case", "Error", "check", "steady", "inflate", "fit", "pattern", "size", "load"}, set(ripstop.__all__))
        self.assertTrue((PACKAGE / "py.typed").exists())
        self.assertEqual(public(dir(ripstop)), set(ripstop.__all__))

    def test_every_member_of_a_class_is_in_the_stub(self):
        for name in ripstop.__all__:
            member = getattr(ripstop, name)
            if not inspect.isclass(member) or issubclass(member, Exception):
                continue
            with self.subTest(name):
                self.assertEqual(public(vars(member)), public(defined(self.stub[name].body)))
                self.assertEqual(member.__module__, "ripstop")

    def test_signatures_have_the_arguments_and_types(self):
        for name, node in self.stub.items():
            member = getattr(_ripstop, name)
            if not isinstance(node, ast.FunctionDef):
                continue
            with self.subTest(name):
                first = member.__doc__.splitlines()[0]
                for argument in [*node.args.args, *node.args.kwonlyargs]:
                    self.assertIn(argument.arg + ":", first)
                    self.assertNotIn(ast.unparse(argument.annotation), ("Any", "object"))
                self.assertNotIn(ast.unparse(node.returns), ("Any", "object"))

    def test_the_types_of_a_result_are_those_of_the_stub(self):
        import small
        for result in (ripstop.check(small.case()), ripstop.pattern(small.case()), ripstop.load(small.case(), 2, 20)):
            properties = defined(self.stub[type(result).__name__].body)
            for name in type(result).__match_args__:
                kind, value = ast.unparse(properties[name].returns), getattr(result, name)
                with self.subTest(name):
                    if value is None:
                        self.assertTrue(kind.startswith("Optional["))
                    else:
                        bare = kind.removeprefix("Optional[").split("[")[0].rstrip("]").split(".")[-1]
                        self.assertEqual(type(value).__name__, bare)

    def test_everything_has_a_docstring_and_numbers_their_unit(self):
        for name in ripstop.__all__:
            member = getattr(ripstop, name)
            self.assertTrue((member.__doc__ or "").strip(), name)
            if not inspect.isclass(member) or issubclass(member, Exception):
                continue
            for key in public(vars(member)):
                with self.subTest(f"{name}.{key}"):
                    doc = getattr(member, key).__doc__ or ""
                    self.assertTrue(doc.strip())
                    coefficient = key in ("c_m", "c_n")  # of moment and normal force
                    if key.endswith(UNITS) and not coefficient and isinstance(vars(member)[key], property):
                        self.assertRegex(doc, r"\[.+\]")
        for name in ("check", "steady", "inflate", "fit", "pattern", "size", "load", "descent", "calibrate_damping"):
            self.assertRegex(getattr(ripstop, name).__doc__, r"\[(m|N|kg|Pa)", name)


if __name__ == "__main__":
    unittest.main()
