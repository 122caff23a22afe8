"""The version is in CMakeLists.txt only: program, Python package, wheel, packages, manual pages and documentation take it from there."""
import gzip
import os
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ["RIPSTOP_BUILD"])
PROGRAM = os.environ["RIPSTOP_PROGRAM"]
sys.path.insert(0, str(SOURCE / "packaging"))
import release  # noqa: E402

VERSION = release.version_of(SOURCE)


class Version(unittest.TestCase):
    def found(self, file, pattern):
        self.assertEqual(re.findall(pattern, (BUILD / file).read_text())[:1], [VERSION], file)

    def test_of_everything_that_is_built(self):
        self.assertEqual(subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1], VERSION)
        import ripstop
        self.assertEqual(ripstop.__version__, VERSION)
        self.found("python/pyproject.toml", r'(?m)^version = "(.*)"')
        self.found("CPackConfig.cmake", r'set\(CPACK_PACKAGE_VERSION "(.*)"\)')
        self.found("ripstop-config-version.cmake", r'set\(PACKAGE_VERSION "(.*)"\)')
        for package in ("ripstop", "libripstop-dev", "ripstop-doc", "python3-ripstop"):
            text = gzip.decompress((BUILD / f"debian/{package}/changelog.gz").read_bytes()).decode()
            self.assertTrue(text.startswith(f"{package} ({VERSION}) "), text)
        pages = list((BUILD / "terminal/man1").glob("*.gz"))
        self.assertGreater(len(pages), 20)
        for page in pages:
            self.assertIn(f"Ripstop {VERSION}", gzip.decompress(page.read_bytes()).decode())

    def test_no_other_file_of_the_sources_states_it(self):
        done = subprocess.run(["git", "-C", str(SOURCE), "grep", "--files-with-matches", "--fixed-strings", "--word-regexp", VERSION],
                              capture_output=True, text=True)
        if done.returncode not in (0, 1):
            self.skipTest("this copy of the sources has no git")
        records = ("CMakeLists.txt", "CITATION.cff", "CHANGELOG.md", "docs/", "validation/", "tests/", "src/ripstop/report/vendor/")
        self.assertEqual([file for file in done.stdout.splitlines() if not file.startswith(records)], [])
        self.assertRegex((SOURCE / "CITATION.cff").read_text(), rf"(?m)^version: {re.escape(VERSION)}$")
        self.assertIn(f"\n## {VERSION}\n", (SOURCE / "CHANGELOG.md").read_text())


if __name__ == "__main__":
    unittest.main()
