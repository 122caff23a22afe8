"""Manual pages and shell completion made from --help: every command has a page, and each installed shell completes in the same way.
The progress of a run fits into a line of the terminal."""
import fcntl
import gzip
import os
import pathlib
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAM = os.environ["RIPSTOP_PROGRAM"]
BASH = """source "$0"
COMP_WORDS=("$@"); COMP_CWORD=$(( $# - 1 )); _ripstop; printf '%s\\n' "${COMPREPLY[@]}"
"""


def run(*words):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, check=True).stdout


def on_a_terminal(columns, *words):
    """Bytes that the program sends to a terminal of so many columns, as its standard error."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    process = subprocess.Popen([PROGRAM, *map(str, words)], stderr=theirs, stdout=subprocess.DEVNULL)
    os.close(theirs)
    sent = b""
    while True:
        try:
            part = os.read(ours, 65536)
        except OSError:  # the program has ended
            break
        if not part:
            break
        sent += part
    os.close(ours)
    process.wait()
    return sent.decode()


class Terminal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = pathlib.Path(cls.folder.name)
        run(sys.executable, SOURCE / "packaging/terminal.py", "--program", PROGRAM, "--version", "1.2.3", "--out", cls.out)
        listed = run(PROGRAM, "--help").partition("SUBCOMMANDS:" if "SUBCOMMANDS:" in run(PROGRAM, "--help") else "Subcommands:")[2]
        cls.commands = [line.split()[0] for line in listed.splitlines() if line.startswith("  ") and line[2] != " "]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def complete(self, *words):
        return run("bash", "--norc", "-c", BASH, self.out / "bash/ripstop", "ripstop", *words).split()

    def test_every_command_has_a_page_with_its_options(self):
        self.assertIn("steady", self.commands)
        for command in self.commands:
            page = gzip.decompress((self.out / f"man1/ripstop-{command}.1.gz").read_bytes()).decode()
            self.assertIn("Ripstop 1.2.3", page)
            self.assertIn(".SH NAME", page)
            self.assertIn("\\-\\-help", page)
        self.assertTrue((self.out / "man1/ripstop-calibrate-porosity.1.gz").exists())

    def test_bash_completes_commands_options_and_values(self):
        self.assertLessEqual({*self.commands, "--version"}, set(self.complete("")))
        self.assertEqual(self.complete("stea"), ["steady"])
        self.assertEqual(self.complete("steady", "case.toml", "--flo"), ["--flow"])
        self.assertEqual(self.complete("steady", "--flow", ""), ["builtin", "openfoam"])
        self.assertIn("porosity", self.complete("calibrate", ""))
        self.assertIn("--measured", self.complete("calibrate", "porosity", "--"))
        self.assertEqual(self.complete("steady", "ca"), [])  # a file of the folder, which bash completes

    def test_progress_is_one_line_of_the_terminal(self):
        for columns in (80, 30):
            sent = on_a_terminal(columns, "steady", SOURCE / "examples/stratos-iv/case.toml", "--grid", "40,40,60", "--set",
                                 "parachute.mesh.cloth_nodes=1500", "--set", "coupling.max_iterations=1", "--set", "coupling.threads=1", "--out",
                                 self.out / f"run-{columns}")
            shown = re.findall(r"\r\x1b\[K([^\r\n]+)(?=\r\x1b\[K)", sent)  # replaced by the next; a line that stays ends otherwise
            self.assertGreater(len(shown), 2, sent)
            self.assertLess(max(map(len, shown)), columns)
            self.assertGreater(max(map(len, shown)), 25)

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_completes_commands_and_values(self):
        def complete(line):
            words = run("fish", "--no-config", "-c", f"source {self.out}/fish/ripstop.fish; complete -C '{line}'").splitlines()
            return [word.split("\t")[0] for word in words]
        self.assertLessEqual(set(self.commands), set(complete("ripstop ")))
        self.assertEqual(complete("ripstop steady --flow "), ["builtin", "openfoam"])
        self.assertIn("--measured", complete("ripstop calibrate porosity --me"))

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_accepts_its_file(self):
        run("zsh", "-n", self.out / "zsh/_ripstop")


if __name__ == "__main__":
    unittest.main()
