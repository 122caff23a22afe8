#!/usr/bin/env python3
"""The reference pages equal the output of the program and the Python package, and the program accepts every command quoted in a
page. No run is computed. RIPSTOP_PROGRAM names the program; RIPSTOP_BUILD the build folder, if it has the Python package."""
import functools
import importlib.util
import json
import os
import pathlib
import re
import shlex
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
REFERENCE = ROOT / "docs/reference"
PROGRAM = os.environ["RIPSTOP_PROGRAM"]
STUB = pathlib.Path(os.environ.get("RIPSTOP_BUILD", "")) / "python/ripstop/_ripstop.pyi"
WITH_PYTHON = "RIPSTOP_BUILD" in os.environ

spec = importlib.util.spec_from_file_location("reference", ROOT / "docs/site/reference.py")
reference = importlib.util.module_from_spec(spec)
spec.loader.exec_module(reference)

PAGES = sorted([ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "src/README.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("materials/*.md"),
                *ROOT.glob("examples/**/README.md"), *ROOT.glob("validation/*/README.md")])
# A part of a path in capitals, or an ellipsis: a placeholder.
PLACEHOLDER = re.compile(r"(?:^|.*/)[A-Z][A-Z_]*\d?(?:/.*|$)|.*\.\.\..*")


@functools.cache
def commands():
    """For each command its options with their numbers of values, its number of positional arguments (required, at most), and whether
    it is a group of commands."""
    known = {}
    for command, text in reference.commands(PROGRAM):
        _, rows, _ = reference.sections(text)
        options = {"--help": 0, "-h": 0}
        for name, _ in rows.get("Options", []):
            names, _, kind = name.partition(" ")
            kind = re.sub(r"\b(?:Excludes|Needs): .*|\bREQUIRED\b", "", kind).strip()
            values = int(match[1]) if (match := re.search(r" x (\d+)$", kind)) else 1 if kind else 0
            options.update({one: values for one in names.split(",")})
        places = [kind for name, kind in (name.split(" ", 1) for name, _ in rows.get("Positionals", []))]
        required = sum("REQUIRED" in kind for kind in places)
        most = 1000 if any("..." in kind for kind in places) else len(places)
        known[command] = (options, required, most, "Subcommands" in rows)
    return known


def quoted(text):
    """Commands of Ripstop in the blocks of code and in the code spans of a page; True where the whole line is a command. The first
    line of a sealed file is not a command."""
    text = re.sub(r"\\\n\s*", " ", text)
    program = r"(?:\$ )?(?:\S*/)?ripstop (?!sealed file )"
    lines = re.findall(rf"^(?: {{4,}}|)({program}.*)$", re.sub(r"^```.*$", "", text, flags=re.MULTILINE), re.MULTILINE)
    spans = [" ".join(span.split()) for span in re.findall(r"`([^`]+)`", text)]
    return [(line, True) for line in lines] + [(span, False) for span in spans if re.match(program, span)]


def words_of(line):
    """Words of the command before a pipe, a redirection, a comment or the next command."""
    lexer = shlex.shlex(re.sub(r"<([^<>]*)>", r"...", line.removeprefix("$ ")), posix=True, punctuation_chars="|>&;")
    lexer.whitespace_split = True
    lexer.commenters = "#"
    words = []
    for word in lexer:
        if re.fullmatch(r"[|>&;]+", word):
            break
        words.append(word)
    return words[1:]


def fault(line, whole):
    """Reason why the program would refuse the command, or None. A code span may leave out required arguments."""
    try:
        words = words_of(line)
    except ValueError as error:
        return str(error)
    command = ()
    while words and (*command, words[0]) in commands():
        command = (*command, words.pop(0))
    if not command:
        return None if words and words[0] in ("--help", "--version") else "unknown command"
    options, required, most, is_group = commands()[command]
    if is_group and words and not words[0].startswith("-"):
        return f"unknown command {words[0]}"
    places = []
    while words:
        word, _, value = words.pop(0).partition("=") if words[0].startswith("--") else (words.pop(0), "", "")
        if word.startswith("-"):
            if word not in options:
                return f"unknown option {word}"
            values = 0 if value else min(options[word], 1) if words and "," in words[0] else options[word]
            if len(words) < values and whole:
                return f"too few values of {word}"
            words = words[values:]
        else:
            places.append(word)
    missing = [word for word in places if word.startswith("examples/") and not PLACEHOLDER.fullmatch(word) and not (ROOT / word).exists()]
    if missing:
        return f"no such file: {missing[0]}"
    if len(places) > most:
        return f"too many arguments: {places}"
    return f"too few arguments: {places}" if whole and len(places) < required else None


class Reference(unittest.TestCase):
    maxDiff = 2000

    def test_pages_are_those_of_the_program(self):
        for name, text in reference.pages(PROGRAM, STUB if WITH_PYTHON else None).items():
            with self.subTest(name):
                self.assertEqual((REFERENCE / name).read_text(), text, "run: make reference")

    def test_every_key_of_the_schema_is_in_the_reference(self):
        def keys(schema):
            for name, inner in schema.get("properties", {}).items():
                yield name
                yield from keys(inner)
            for part in ("items", "additionalProperties", "then", "else", "if", "not", "allOf", "anyOf", "oneOf"):
                for inner in schema.get(part, []) if isinstance(schema.get(part), list) else [schema.get(part)]:
                    if isinstance(inner, dict):
                        yield from keys(inner)
        schema = json.loads(subprocess.run([PROGRAM, "schema"], capture_output=True, text=True, check=True).stdout)
        page = (REFERENCE / "case-keys.md").read_text()
        found = set(keys(schema))
        self.assertGreater(len(found), 150)
        self.assertEqual(sorted(key for key in found if f"`{key}`" not in page and f"[{key}" not in page and f".{key}" not in page), [])

    def test_every_command_and_option_of_the_source_is_in_the_reference(self):
        source = "".join(file.read_text() for file in (ROOT / "apps/ripstop").glob("*.cpp"))
        page = (REFERENCE / "commands.md").read_text()
        names = re.findall(r'add_subcommand\(\s*"([\w-]+)"', source)
        self.assertGreater(len(names), 18)
        self.assertEqual([name for name in names if not re.search(rf"^## `ripstop (?:\w+ )?{name}`$", page, re.MULTILINE)], [])
        options = set(re.findall(r'(?:add_\w+|number)\(\s*(?:\*?\w+,\s*)?"(--[\w-]+)', source))
        self.assertGreater(len(options), 60)
        self.assertEqual(sorted(option for option in options if f"`{option}`" not in page), [])

    @unittest.skipUnless(WITH_PYTHON, "built without the Python package")
    def test_every_public_name_of_the_python_package_is_in_the_reference(self):
        import inspect
        import ripstop
        page = (REFERENCE / "python.md").read_text()
        missing = [name for name in ripstop.__all__ if f"### `{name}" not in page]
        for name in ripstop.__all__:
            member = getattr(ripstop, name)
            if inspect.isclass(member) and not issubclass(member, Exception):
                section = page.split(f"### `{name}`\n")[1].split("\n### ")[0]
                missing += [f"{name}.{key}" for key in vars(member) if not key.startswith("_")
                            and f"| `{key}` |" not in section and f"#### `{key}()`" not in section]
        self.assertEqual(missing, [])

    def test_every_attribute_without_a_unit_has_more_than_its_name_as_meaning(self):
        page = (REFERENCE / "python.md").read_text().replace(r"\|", "or").replace("\\", "")
        rows = re.findall(r"^\| `(\w+)` \| [^|]* \| ([^|]*) \|$", page, re.MULTILINE)
        self.assertGreater(len(rows), 500)
        self.assertEqual([name for name, meaning in rows if meaning.strip() in ("", name.replace("_", " "))], [])

    def test_quoted_commands_parse(self):
        found, wrong = 0, []
        for page in PAGES:
            for line, whole in quoted(page.read_text()):
                found += 1
                if reason := fault(line, whole):
                    wrong.append(f"{page.relative_to(ROOT)}: {line}: {reason}")
        self.assertGreater(found, 150)
        self.assertEqual(wrong, [])

    def test_commands_that_the_program_refuses_are_found(self):
        for line in ["ripstop glide examples/stratos-iv/case.toml", "ripstop steady examples/stratos-iv/case.toml --pressures 3",
                     "ripstop steady examples/none/case.toml", "ripstop check", "ripstop calibrate drag CASE", "ripstop check a.toml b.toml",
                     "ripstop steady CASE --speed"]:
            with self.subTest(line):
                self.assertIsNotNone(fault(line, True))
        for line in ["ripstop steady CASE --speed 30  # a comment", "build/bin/ripstop schema > case.json", "ripstop --version",
                     "ripstop check examples/stratos-iv/case.toml --set flow.speed_m_s=20 | head"]:
            with self.subTest(line):
                self.assertIsNone(fault(line, True))


if __name__ == "__main__":
    unittest.main()
