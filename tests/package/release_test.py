"""The artefacts of a release: complete, of one version, with checksums; anything else is refused with its reason."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
NAMES = ("portable/ripstop-1.2.3-linux-x86_64.tar.gz", "wheel/ripstop-1.2.3-cp311-cp311-manylinux_2_36_x86_64.whl", "ripstop_1.2.3_amd64.deb",
         "ripstop-doc_1.2.3_all.deb")


class Release(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root, self.build, self.out = (pathlib.Path(self.folder.name, name) for name in ("tree", "build", "out"))
        self.root.mkdir()
        for name, text in (("CMakeLists.txt", "project(ripstop VERSION 1.2.3)\n"), ("CHANGELOG.md", "# Changelog\n\n## 1.2.3\n"),
                           ("CITATION.cff", "version: 1.2.3\n")):
            (self.root / name).write_text(text)
        self.git("init", "--quiet")
        self.commit()
        for name in NAMES:
            (self.build / name).parent.mkdir(parents=True, exist_ok=True)
            (self.build / name).write_text(name)

    def git(self, *words):
        subprocess.run(["git", "-C", str(self.root), "-c", "user.name=a", "-c", "user.email=a@example.org", *words], check=True,
                       env={**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null"}, stdout=subprocess.DEVNULL)

    def commit(self):
        self.git("add", ".")
        self.git("commit", "--quiet", "--message", "change")

    def release(self, *options):
        return subprocess.run([sys.executable, str(SOURCE / "packaging/release.py"), "--root", str(self.root), "--build", str(self.build),
                               "--out", str(self.out), *options], capture_output=True, text=True)

    def refused(self, reason):
        done = self.release()
        self.assertEqual(done.returncode, 1)
        self.assertIn(reason, done.stdout)
        self.assertFalse(self.out.exists())

    def test_all_files_have_a_checksum(self):
        done = self.release()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual({file.name for file in self.out.iterdir()},
                         {pathlib.Path(name).name for name in NAMES} | {"ripstop-1.2.3-source.tar.gz", "SHA256SUMS"})
        subprocess.run(["sha256sum", "--check", "--strict", "--quiet", "SHA256SUMS"], cwd=self.out, check=True)
        self.assertEqual(len((self.out / "SHA256SUMS").read_text().splitlines()), len(NAMES) + 1)

    def test_a_missing_or_older_artefact_is_refused(self):
        (self.build / NAMES[2]).rename(self.build / "ripstop_1.2.2_amd64.deb")
        self.refused("ripstop_1.2.2_amd64.deb is not of version 1.2.3")
        (self.build / NAMES[1]).unlink()
        self.refused("there is no wheel")
        (self.build / NAMES[3]).unlink()
        self.refused("there is no Debian package of the documentation")
        self.assertEqual(self.release("--draft").returncode, 1)

    def test_a_tree_that_is_no_release_is_refused_but_for_a_draft(self):
        (self.root / "CHANGELOG.md").write_text("# Changelog\n\n## Unreleased\n\n## 1.2.3\n")
        self.refused("changes that are not committed: M CHANGELOG.md")
        self.commit()
        self.refused("the first section of CHANGELOG.md is Unreleased, not 1.2.3")
        done = self.release("--draft")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("Warning: the first section", done.stdout)


if __name__ == "__main__":
    unittest.main()
