#!/usr/bin/env python3
"""Checks every page and source file: links exist, pages describe the present state, prose has one line width, and files are short."""
import collections
import fnmatch
import importlib.util
import json
import pathlib
import re
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LONGEST = 500
WIDEST = 120

PAGES = sorted([ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "SECURITY.md", ROOT / "CODE_OF_CONDUCT.md",
                ROOT / "CHANGELOG.md", ROOT / "src/README.md", ROOT / "materials/README.md",
                *ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/**/README.md"), *ROOT.glob("validation/*/README.md")])
TABLES = ROOT / "docs/tables"  # made by commands, with their day
GENERATED = [ROOT / f"docs/reference/{page}.md" for page in ("case-keys", "commands", "python")]  # by make reference

MONTHS = "January|February|March|April|May|June|July|August|September|October|November|December"
HISTORY = re.compile(rf"\b20\d\d-\d\d-\d\d\b|\b(?:{MONTHS}) 20\d\d\b|[Cc]ommit [0-9a-f]{{7}}|[Uu]ntil 20\d\d|[Bb]efore the law|"
                     r"\*[Oo]ld:?\*|\b[Ww]ithdrawn\b|\b[Ff]ormerly\b|\b[Pp]reviously\b|\bused to (?:be|have)\b")


def anchors(page):
    """The anchors of a page's headings, as GitHub makes them."""
    found = set()
    for line in page.read_text().splitlines():
        if line.startswith("#"):
            words = re.sub(r"[^\w\- ]", "", line.lstrip("#").strip().lower())
            found.add(words.replace(" ", "-"))
    return found


def prose(page):
    """The numbered lines of a page that are neither code, table, nor one link that cannot be broken."""
    in_code = False
    for number, line in enumerate(page.read_text().splitlines(), 1):
        fence = line.lstrip().startswith("```")
        in_code ^= fence
        if not (fence or in_code or line.startswith(("    ", "|")) or " " not in line.strip()):
            yield number, line


def at(page, number):
    return f"{page.relative_to(ROOT)}:{number}"


def program_of(test):
    """The name of the test program test_<...> to which a test belongs (tests/CMakeLists.txt)."""
    parts = test.relative_to(ROOT / "tests").parts
    return "cartesian" if parts[:2] == ("flow", "cartesian") else parts[0]


class Docs(unittest.TestCase):
    maxDiff = None

    def test_every_relative_link_leads_to_a_file_and_a_heading(self):
        broken = []
        for page in PAGES:
            for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
                path, _, anchor = target.partition("#")
                if "://" in target:
                    continue
                file = (page.parent / path).resolve() if path else page
                if not file.exists() or (anchor and anchor not in anchors(file)):
                    broken.append(f"{page.relative_to(ROOT)}: {target}")
        self.assertEqual(broken, [])

    def test_pages_say_what_is_and_not_what_was(self):
        told = [f"{at(page, number)}: {line.strip()}" for page in PAGES if TABLES not in page.parents and page.name != "CHANGELOG.md"
                for number, line in enumerate(page.read_text().splitlines(), 1) if HISTORY.search(line)]
        self.assertEqual(told, [])

    def test_prose_is_wrapped(self):
        wide = [f"{at(page, number)}: {len(line)}" for page in PAGES if TABLES not in page.parents and page not in GENERATED
                for number, line in prose(page) if len(line) > WIDEST]
        self.assertEqual(wide, [])

    def test_every_block_of_toml_can_be_read(self):
        broken = []
        for page in PAGES:
            for block in re.findall(r"^```toml\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL):
                try:
                    tomllib.loads(block)
                except tomllib.TOMLDecodeError as error:
                    broken.append(f"{at(page, 0)}: {error}")
        self.assertEqual(broken, [])

    def test_every_table_of_a_command_names_it_and_the_day(self):
        silent = [page.name for page in TABLES.glob("*.md") if not re.search(rf"(?:{MONTHS}) 20\d\d", page.read_text())
                  or not re.search(r"`[^`]+`|^    \S", page.read_text(), re.MULTILINE)]
        self.assertEqual(silent, [])

    def test_every_table_of_a_command_is_linked(self):
        text = "".join(page.read_text() for page in PAGES)
        self.assertEqual([page.name for page in TABLES.glob("*.md") if f"tables/{page.name}" not in text], [])

    def test_defaults_in_the_help_are_values_of_variables_or_words(self):
        """show_defaults() appends them; a number typed into a description would not follow the code."""
        typed = []
        for file in sorted((ROOT / "apps/ripstop").glob("*.cpp")):
            text = re.sub(r'"\s*\n\s*"', "", file.read_text())
            if file.name != "option.cpp" and "(default" in text:
                typed.append(f"{file.name}: a default in a description")
            typed += [f"{file.name}: {word}" for word in re.findall(r'default_str\("([^"]*)"\)', text) if re.search(r"(?<!\w)[\d.]+(?!\w)", word)]
        self.assertEqual(typed, [])

    def test_the_scoreboard_shows_the_present_tables(self):
        spec = importlib.util.spec_from_file_location("scoreboard", ROOT / "validation/scoreboard.py")
        board = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(board)
        self.assertEqual(board.PAGE.read_text(), board.scoreboard(), "run python3 validation/scoreboard.py")

    def test_every_test_that_holds_a_promise_exists(self):
        missing = []
        for room, suite, name in re.findall(r"`(\w+)\.(\w+)\.(\w+)`", (ROOT / "docs/reliability.md").read_text()):
            text = "".join(file.read_text() for file in (ROOT / "tests").rglob("*.cpp") if program_of(file) == room)
            if not re.search(rf"TEST(_[FP])?\({suite},\s*{name}\)", text):
                missing.append(f"{room}.{suite}.{name}")
        self.assertEqual(missing, [])

    def test_every_file_and_test_that_a_page_names_exists(self):
        tests = collections.defaultdict(list)
        for file in (ROOT / "tests").glob("*/**/*.cpp"):
            for suite, name in re.findall(r"\bTEST(?:_[FP])?\((\w+),\s*(\w+)\)", file.read_text()):
                tests[program_of(file)] += [f"{suite}.{name}", f"All/{suite}.{name}/0"]
        words = set(re.findall(r"\w+", "".join(file.read_text() for folder in ("src/ripstop", "python") for file in (ROOT / folder).rglob("*.*")
                                             if file.suffix in (".h", ".cpp", ".py"))))
        wrong = []
        for page in PAGES:
            if page.name == "CHANGELOG.md" or TABLES in page.parents:
                continue
            text = page.read_text()
            named = [*re.findall(r"`((?:[\w.-]+/)+[\w-]+\.(?:h|cpp|py))`", text), *re.findall(r"`((?:src|tests)/[\w./-]+)/?`", text)]
            wrong += [f"{at(page, 0)} {name}" for name in named
                      if not any((folder / name).exists() for folder in (ROOT, ROOT / "src/ripstop", ROOT / "tests", page.parent))]
            wrong += [f"{at(page, 0)} {name}()" for name in re.findall(r"`(?:\w+::)?(\w+)\(\)`", text) if name not in words]
            wrong += [f"{at(page, 0)} bench_{name}" for name in re.findall(r"\bbench_(\w+)", text)
                      if not (ROOT / f"bench/{name}.cpp").exists()]
            for room, patterns in re.findall(r"\btest_(\w+)\s+--gtest_filter='([^']*)'", text):
                wrong += [f"{at(page, 0)} test_{room} {pattern}" for pattern in patterns.split(":")
                          if not any(fnmatch.fnmatchcase(name, pattern) for name in tests[room])]
        self.assertEqual(wrong, [])

    def test_every_label_of_studio_that_a_page_names_exists(self):
        shown = "\n".join(file.read_text() for file in sorted((ROOT / "src/ripstop/studio/page").glob("*.*")))
        keys = (ROOT / "examples/case.schema.json").read_text()
        pages = [ROOT / "docs/tutorials/7-design-in-the-browser.md", ROOT / "docs/guide/studio.md"]
        labels = [(page, label) for page in pages for label in re.findall(r"(?<!\*)\*([^*\n]+)\*(?!\*)", page.read_text())]
        self.assertGreater(len(labels), 30)
        self.assertEqual([f"{at(page, 0)} {label}" for page, label in labels
                          if not re.search(rf"[\"'>`]{re.escape(label)}(?!\w)", shown)  # a text of the page
                          and not re.search(rf'"{label.strip("[]").split(".")[-1].replace(" ", "_")}(?:_m)?": ', keys)], [])  # the name of a key

    def test_rooms_look_to_their_left_only(self):
        left = collections.defaultdict(set)
        for line in re.findall(r"^    (\w[\w, ]* <- .*)$", (ROOT / "src/README.md").read_text(), re.MULTILINE):
            groups = [group.split(", ") for group in line.split(" <- ")]
            for known, rooms in zip(groups, groups[1:]):
                for room in rooms:
                    left[room].update(known)

        def seen_from(room):
            return {room}.union(*(seen_from(other) for other in left[room]))

        rooms = {folder.name for folder in (ROOT / "src/ripstop").iterdir() if folder.is_dir()}
        self.assertEqual(rooms - set(left), {"core"})
        wrong = [f"{file.relative_to(ROOT)}: {other}" for room in rooms for file in (ROOT / "src/ripstop" / room).rglob("*.*")
                 if file.suffix in (".h", ".cpp")
                 for other in re.findall(r'#include "ripstop/(\w+)/', file.read_text()) if other not in seen_from(room)]
        self.assertEqual(wrong, [])

    def test_tests_mirror_the_sources(self):
        sources = ROOT / "src/ripstop"
        wrong = []
        for file in sorted((ROOT / "tests").rglob("*_test.cpp")):
            folder = file.parent.relative_to(ROOT / "tests")
            if folder == pathlib.Path("app"):  # the program, apps/ripstop
                continue
            subject = file.name.removesuffix("_test.cpp")
            homes = {source.parent.relative_to(sources) for source in (sources / folder.parts[0]).rglob(f"{subject}.*")}
            # A part of a room also tests subjects of the room, as flow/cartesian the mean of a flow.
            if not (sources / folder).is_dir() or homes and not homes & {folder, *folder.parents}:
                wrong.append(f"{file.relative_to(ROOT)}: {subject} is in {sorted(map(str, homes))}")
        self.assertEqual(wrong, [])

    def test_solvers_name_no_keys(self):
        """They name quantities (core/quantity_error.h). The parachutes check their own table [parachute]."""
        tables = json.loads((ROOT / "examples/case.schema.json").read_text())["properties"]
        key = re.compile(rf"(?<![\w./])({'|'.join(tables)})\.[a-z_]+(?![\w(])")
        wrong = []
        for room in ("core", "material", "mesh", "parachute", "cloth", "flow", "canopy", "flight", "fsi", "calibration", "output"):
            for file in sorted((ROOT / "src/ripstop" / room).rglob("*.*")):
                name = file.relative_to(ROOT / "src/ripstop").as_posix()
                if file.suffix not in (".h", ".cpp") or name.startswith("core/toml/") or name == "core/words.cpp":
                    continue
                text = re.sub(r"^\s*(?://|#include).*$", "", file.read_text(), flags=re.MULTILINE)
                own = "parachute" if room == "parachute" and "Findings& findings" in text else None
                wrong += [f"{name}: {found[0]}" for literal in re.findall(r'"((?:[^"\\]|\\.)*)"', text)
                          for found in key.finditer(literal) if found[1] != own]
        self.assertEqual(wrong, [])

    def test_the_citation_has_the_version_and_the_licence(self):
        citation = (ROOT / "CITATION.cff").read_text()
        version = re.search(r"^project\(ripstop VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]
        self.assertIn(f"\nversion: {version}\n", citation)
        self.assertIn("Apache License", (ROOT / "LICENSE").read_text()[:200])
        self.assertIn("\nlicense: Apache-2.0\n", citation)
        for line in citation.splitlines():  # a subset of YAML: keys with a value in quotes, a word, or a list below
            self.assertRegex(line, r'^ *(?:- )?(?:[a-z-]+: (?:"[^"]*"|[\w.-]+)|[a-z-]+:|[\w -]+)$')

    def test_the_hosted_workflow_runs_the_script_of_every_ci(self):
        self.assertIn("bash .ci/run", (ROOT / ".github/workflows/ci.yml").read_text())

    def test_no_file_is_longer_than_one_reads(self):
        files = [*(page for page in PAGES if page not in GENERATED), *(file for folder in ("src", "apps", "python", "tests", "bench", "examples", "validation") for ending in ("h", "cpp", "py")
                           for file in ROOT.glob(f"{folder}/**/*.{ending}"))]
        long = [f"{file.relative_to(ROOT)}: {lines}" for file in files if (lines := file.read_bytes().count(b"\n")) > LONGEST]
        self.assertEqual(long, [])


if __name__ == "__main__":
    unittest.main()
