"""The wheel installs into a fresh environment without a network, and Debian's Python finds the module that CMake installs."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import small

# Paths of module and data, after a call that uses both.
ASK = "import ripstop; print(ripstop.__file__, ripstop.data_directory()); print(ripstop.read_case({!r}).title)".format(str(small.STRATOS))


def run(*arguments, **environment):
    own = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "RIPSTOP_DATA")}
    return subprocess.run(list(map(str, arguments)), capture_output=True, text=True, check=True, env=own | environment).stdout


class Installation(unittest.TestCase):
    def test_a_wheel_in_a_fresh_environment(self):
        run("cmake", "--build", small.BUILD, "--target", "wheel")
        wheels = list((small.BUILD / "wheel").glob("*.whl"))
        self.assertEqual(len(wheels), 1)
        self.assertRegex(wheels[0].name, r"^ripstop-[\d.]+-cp3\d+-cp3\d+-manylinux_2_\d+_\w+\.whl$")
        with tempfile.TemporaryDirectory() as folder:
            run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", folder)
            python = pathlib.Path(folder, "bin/python")
            run(sys.executable, "-m", "pip", "--python", python, "install", "--quiet", "--no-index", wheels[0])
            found, data = run(python, "-c", ASK).splitlines()[0].split()
            self.assertTrue(found.startswith(folder), found)
            self.assertTrue(data.startswith(folder), data)
            for name in ("_ripstop.pyi", "py.typed", "data/materials/f-111.toml", "data/examples/families.json"):
                self.assertTrue((pathlib.Path(found).parent / name).exists(), name)
            program = pathlib.Path(folder, "bin/ripstop")
            self.assertEqual(run(program, "--version"), run(small.PROGRAM, "--version"))
            self.assertEqual(run(program, "check", small.STRATOS), run(small.PROGRAM, "check", small.STRATOS))
            loaded = run("ldd", pathlib.Path(found).parent / "bin/ripstop")
            self.assertRegex(loaded, rf"libcairo-[0-9a-f]{{8}}\.so\.2 => {re.escape(folder)}")

    def test_where_cmake_installs(self):
        version = f"python{sys.version_info.major}.{sys.version_info.minor}"
        with tempfile.TemporaryDirectory() as folder:
            run("cmake", "--install", small.BUILD, "--component", "python", "--prefix", folder)
            place = pathlib.Path(folder, "lib", version, "dist-packages")
            self.assertTrue(run(sys.executable, "-c", ASK, PYTHONPATH=str(place)).startswith(str(place)))
        path = run(sys.executable, "-c", "import sys; print(sys.path)")
        self.assertIn(f"/usr/local/lib/{version}/dist-packages", path)
        self.assertIn("/usr/lib/python3/dist-packages", path)
        with tempfile.TemporaryDirectory() as folder:  # a Debian package's prefix
            run("cmake", "--install", small.BUILD, "--component", "python", "--prefix", "/usr", DESTDIR=folder)
            self.assertTrue(pathlib.Path(folder, "usr/lib/python3/dist-packages/ripstop/__init__.py").exists())


if __name__ == "__main__":
    unittest.main()
