#!/usr/bin/env python3
"""Language of the documentation and of the program: standard terms, sentence length, headings and typeset equations of every
rewritten page; terms and sentence length of the generated reference (--help, keys, docstrings) and of all text in the sources; terms in
comments and docstrings; the code names of the glossary. Pages that are not yet rewritten are printed as open."""
import ast
import io
import pathlib
import re
import statistics
import tokenize
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
GLOSSARY = "docs/reference/glossary.md"
LONGEST_SENTENCE = 30  # words
MEAN_SENTENCE = 18     # words, of a page
LONGEST_HEADING = 9    # words

REWRITTEN = [
    "README.md", "CONTRIBUTING.md", "SECURITY.md", "CODE_OF_CONDUCT.md", "src/README.md", "materials/README.md", "validation/nylon-ribbons/README.md",
    "validation/ojf/README.md", "validation/stratos-iv/README.md", GLOSSARY,
    *sorted(str(page.relative_to(ROOT)) for page in ROOT.glob("examples/**/README.md")),
    *(f"docs/{page}.md" for page in ("README", "conventions", "performance", "reliability", "validation")),
    *sorted(str(page.relative_to(ROOT)) for folder in ("guide", "theory", "tutorials") for page in ROOT.glob(f"docs/{folder}/*.md")),
    *(f"docs/validation/{page}.md" for page in (
        "canopies", "cloth", "coupling", "fit", "flow", "flow-in-time", "flow-openfoam", "inflation", "ojf", "opening-load",
        "scoreboard", "tunnel"))]

TABLES = "docs/tables/"  # made by commands
GENERATED = [f"docs/reference/{page}.md" for page in ("case-keys", "commands", "python")]  # by make reference
ALL = sorted(str(page.relative_to(ROOT)) for page in
             [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "SECURITY.md", ROOT / "CODE_OF_CONDUCT.md",
                ROOT / "src/README.md", ROOT / "materials/README.md", *ROOT.glob("docs/**/*.md"),
              *ROOT.glob("examples/**/README.md"), *ROOT.glob("validation/*/README.md")])

SOURCES = ("apps", "src/ripstop", "python/bindings")  # their string literals: help, keys, output, messages, docstrings

# Words that are used in a figurative sense, with the standard term or the reason.
FIGURATIVE = {
    r"stands?|stood|standing": "is; represents; remains",
    r"(?:go|goes|went|going) on": "continues",
    r"holds": "is valid; contains; carries",
    r"tells?|told|says?|said": "states; reports",
    r"worth": "contributes; name the metric",
    r"besides?": "compared with; in addition to; next to",
    r"gone": "elapsed",
    r"what(?!ever)": "name the quantity",
    r"of which": "two sentences",
    r"for good": "until the end of the run",
    r"by turns|now so|once more": "alternately; again",
    r"in (?:its|their) own air": "coupled inflation",
    r"gives? way|yields?|yielding": "compliance",
    r"hangs? on": "depends on",
    r"judges?|judgement": "cross-validation; criterion",
    r"eased": "start-up under-relaxation",
    r"thickening": "density ratio",
    r"small eddies": "subgrid-scale model",
    r"play(?:s|ed)? together": "feedback",
    r"forgets?|forgotten|knows?|asks?|wants?": "programs and canopies do not think",
    r"by chance|chance": "scatter",
    r"a day|the way": "state the quantity",
    r"come(?:s)? of it|comes? out": "result; is",
    r"as it were|so much as|what is left": "state the quantity",
}
WORDS = [(re.compile(rf"\b(?:{pattern})\b", re.IGNORECASE), term) for pattern, term in FIGURATIVE.items()]

# Parts of an equation that is drawn in ASCII; code spans and typeset equations are taken out first.
ASCII_EQUATION = re.compile(r"[A-Za-z)\]]\s?\^\s?[-{(\w]|\bsqrt\s?\(|\b(?:sum|div|grad|sqrt)\s?\(|[<>]=|\b[A-Za-z]_[A-Za-z0-9]{1,3}\b|"
                            r"\bd[a-zA-Z]/d[a-z]\b|\b(?:rho|omega|kappa|gamma|epsilon|xi|mu)\b(?=\s?[=*/^])")
COMMAND = re.compile(r"^\s+(?:make|ripstop|build\S*/|python3?|cmake|ctest|sbatch|pip|apt|sudo|mpirun|cd|export|git|curl|--|OMP_|\.|/|[$#>])|"
                     r"^\s+.*(?:<-|\\$|#|//|\[.*\]$)")


def page_lines(text):
    """Lines outside fences."""
    in_code = False
    for line in text.splitlines():
        fence = line.lstrip().startswith("```")
        in_code ^= fence
        yield "" if fence or in_code else line


def plain(text):
    """Text without code spans, link targets and equations: each code span and each equation counts as one word."""
    text = re.sub(r"\$\$.*?\$\$", " ", text, flags=re.DOTALL)
    text = re.sub(r"\$[^$\n]+\$", "FORMULA", text)
    text = re.sub(r"``[^`]+``|`[^`]+`", "CODE", text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"<[^>]+>", " ", text)
    return re.sub(r"\*|(?<!\w)_|_(?!\w)", "", text)


def blocks(text):
    """Paragraphs, list items and table rows of a page."""
    block = []
    display = False
    for line in [*page_lines(text), ""]:
        code = re.match(r" {4,}\S", line) and not block and not display
        display ^= line.count("$$") % 2 == 1
        new = re.match(r"\s*(?:[-*]|\d+\.)\s", line) or line.startswith(("|", "#")) or not line.strip() or code
        if new and not display and block:
            yield " ".join(block)
            block = []
        if line.strip() and not line.startswith("#") and not code:
            block.append(line.strip() if not new else re.sub(r"^\s*(?:[-*]|\d+\.)\s+", "", line))
    if block:
        yield " ".join(block)


def sentences(text):
    text = re.sub(r"\b(Eq|Eqs|Fig|Figs|Sec|No|e\.g|i\.e|vs|cf|et al)\.", r"\1", text)
    for block in blocks(text):
        for cell in (block.strip("|").split("|") if block.startswith("|") else [block]):
            for sentence in re.split(r"(?<=[.!?])[)\"]?\s+(?=[A-Z\d`\"(\[*$])", plain(cell).strip()):
                words = [word for word in sentence.split() if re.search(r"\w", word)]
                if words:
                    yield sentence, len(words)


def headings(text):
    found = [re.match(r"(#+) (.*)", line) for line in page_lines(text)]
    return [(len(match[1]), match[2]) for match in found if match]


def literals(source):
    """The string literals of a C++ source, adjacent ones joined, with their line numbers."""
    source = re.sub(r"^#include.*$|//.*$", "", source, flags=re.MULTILINE)
    for match in re.finditer(r'"(?:[^"\\\n]|\\.)*"(?:\s*\n\s*"(?:[^"\\\n]|\\.)*")*', source):
        yield source.count("\n", 0, match.start()) + 1, re.sub(r'"\s*\n\s*"', "", match.group())[1:-1]


def comments(source):
    """The comments of a C++ source with their line numbers, one line each."""
    for number, line in enumerate(source.splitlines(), 1):
        if match := re.match(r'(?:[^"/]|"(?:[^"\\]|\\.)*"|/(?!/))*//[/!<]*\s?(.*)', line):
            yield number, match[1]


def python_texts(source):
    """The comments and docstrings of a Python source with their line numbers."""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT and not token.string.startswith(("#!", "# pylint:")):
            yield token.start[0], token.string.lstrip("# ")
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node):
            yield node.body[0].lineno, ast.get_docstring(node)


def test_names(source):
    """The names of the tests of a C++ source as sentences."""
    for suite, name in re.findall(r"^\s*TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\)", source, re.MULTILINE):
        yield f"{suite}.{name}", re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", " ", name)


def figurative(text):
    return [f"'{match.group()}' ({term}): {text}" for pattern, term in WORDS for match in pattern.finditer(plain(text))]


def faults_of_text(text):
    """Words in a figurative sense and long sentences of a text that is no page: a message, a help text, a table cell."""
    found = [f"'{match.group()}' ({term}): {text}" for pattern, term in WORDS for match in pattern.finditer(text)]
    parts = re.split(r"\n|\\n|(?<=[.!?:;])\s", text)
    return found + [f"{len(part.split())} words: {part}" for part in parts if len(part.split()) > LONGEST_SENTENCE]


def faults_of_docstring(text):
    """The same of a docstring, whose lines are wrapped; indented lines are commands or code."""
    paragraphs = re.split(r"\n\s*\n", "\n".join(line for line in text.splitlines() if not line.startswith("    ")))
    return [fault for paragraph in paragraphs for fault in faults_of_text(plain(paragraph.replace("\n", " ")))]


def faults(text):
    """Everything in a page that the rules of the language do not allow."""
    found = []
    shown = plain("\n".join([*blocks(text), *(title for _, title in headings(text))]))
    for pattern, term in WORDS:
        found += [f"'{match.group()}' ({term}): ...{shown[max(0, match.start() - 40):match.end() + 30]!r}" for match in pattern.finditer(shown)]
    found += [f"ASCII equation: ...{shown[max(0, match.start() - 30):match.end() + 30]!r}" for match in ASCII_EQUATION.finditer(shown)]
    found += [f"equation in a code block: {line.strip()}" for line in page_lines(text)
              if re.match(r" {4,}\S", line) and not COMMAND.match(line) and re.search(r"\S \^|\w\^|\bsum\b|\s[<>]=?\s|\w / \w|d\w+/dt", line)
              and " = " in line]
    found += [f"GitHub drops the backslash of '{match[1]}' in an equation: {math}" for math in
              re.findall(r"\$\$.*?\$\$|\$[^$\n]+\$", re.sub(r"`[^`]*`", "", "\n".join(page_lines(text))), re.DOTALL)
              if (match := re.search(r"(\\[,;:!{}|])", math))]
    found += [f"line of an equation that Markdown reads as a list: {line}" for math in re.findall(r"\$\$.*?\$\$", text, re.DOTALL)
              for line in math.splitlines() if re.match(r"\s*[-+*] ", line)]
    lengths = list(sentences(text))
    found += [f"{length} words: {sentence}" for sentence, length in lengths if length > LONGEST_SENTENCE]
    if lengths and (mean := statistics.mean(length for _, length in lengths if length > 3 or len(lengths) < 3)) > MEAN_SENTENCE:
        found.append(f"mean sentence of {mean:.1f} words")
    titles = headings(text)
    if titles:
        if [level for level, _ in titles].count(1) != 1 or titles[0][0] != 1:
            found.append("a page has one title, at its top")
        if len({title.lower() for _, title in titles}) < len(titles):
            found.append("two headings of one name")
        for (before, _), (level, title) in zip([(0, ""), *titles], titles):
            if level > before + 1:
                found.append(f"level skipped: {title}")
            if not re.match(r"[A-Z`\d]", title) or title.endswith((".", ":", "?")) or len(plain(title).split()) > LONGEST_HEADING:
                found.append(f"heading: {title}")
    return found


class Vocabulary(unittest.TestCase):
    maxDiff = None

    def test_rewritten_pages_follow_the_rules(self):
        for page in REWRITTEN:
            with self.subTest(page=page):
                self.assertEqual(faults((ROOT / page).read_text()), [])

    def test_generated_reference_follows_the_rules(self):
        for page in GENERATED:
            with self.subTest(page=page):
                cells = [plain(cell).strip() for block in blocks((ROOT / page).read_text())
                         for cell in (block.strip("|").split("|") if block.startswith("|") else [block])]
                self.assertGreater(len(cells), 100)
                self.assertEqual([fault for cell in cells for fault in faults_of_text(cell)], [])

    def test_texts_of_the_program_follow_the_rules(self):
        sources = [file for folder in SOURCES for file in sorted((ROOT / folder).rglob("*")) if file.suffix in (".h", ".cpp")]
        texts = [(f"{file.relative_to(ROOT)}:{line}", text) for file in sources for line, text in literals(file.read_text())
                 if re.search(r"[a-z]{2,} [a-z]", text)]
        self.assertGreater(len(texts), 1000)
        self.assertEqual([f"{place}: {fault}" for place, text in texts for fault in faults_of_text(text)], [])

    def test_comments_and_test_names_have_standard_terms(self):
        sources = [file for folder in (*SOURCES, "tests", "bench") for file in sorted((ROOT / folder).rglob("*")) if file.suffix in (".h", ".cpp")]
        lines = [(f"{file.relative_to(ROOT)}:{line}", text) for file in sources for line, text in comments(file.read_text())]
        names = [name for file in sources for name in test_names(file.read_text())]
        self.assertGreater(len(lines), 5000)
        self.assertGreater(len(names), 1000)
        self.assertEqual([f"{place}: {fault}" for place, text in lines + names for fault in figurative(text)], [])

    def test_comments_and_docstrings_of_python_follow_the_rules(self):
        folders = ("apps", "bench", "docs", "examples", "packaging", "python", "tests", "validation")
        sources = [file for folder in folders for file in sorted((ROOT / folder).rglob("*.py"))]
        texts = [(f"{file.relative_to(ROOT)}:{line}", text) for file in sources for line, text in python_texts(file.read_text())]
        self.assertGreater(len(texts), 400)
        self.assertEqual([f"{place}: {fault}" for place, text in texts for fault in faults_of_docstring(text)], [])

    def test_texts_in_the_old_language_are_refused(self):
        old = ('row("no {} that holds",\n    "the load goes on "\n    "as it was");  // says nothing', 'throw Error("what presses is the air");')
        for source in old:
            with self.subTest(source=source):
                self.assertNotEqual([fault for _, text in literals(source) for fault in faults_of_text(text)], [])
        self.assertEqual(list(comments('f("// none");  // what it tells\n/// Area [m2].')), [(1, "what it tells"), (2, "Area [m2].")])
        self.assertNotEqual([fault for _, text in test_names("TEST(Load, WhatCannotBeIsRefused)") for fault in figurative(text)], [])
        self.assertEqual(list(python_texts('"""Area."""\nx = "none"  # [m2]\n')), [(2, "[m2]"), (1, "Area.")])
        self.assertNotEqual(faults_of_docstring("What a run\nsays."), [])
        self.assertEqual(list(literals('f("one "\n  "text", "two");  // "none"')), [(1, "one text"), (2, "two")])

    def test_open_pages_are_listed(self):
        self.assertEqual([page for page in REWRITTEN if page not in ALL], [])
        pages = [page for page in ALL if page not in REWRITTEN + GENERATED and not page.startswith(TABLES)]
        print(f"{len(REWRITTEN)} pages follow the rules; {len(pages)} are open:", *pages, sep="\n  ")

    def test_figurative_sentences_are_refused(self):
        for sentence in ["An unsteady flow answers the same shape now so, now so.", "The load goes on as it was.",
                         "What presses is the air as it flows.", "Stratos IV opens in its own air.", "The grid is worth 14 %.",
                         "The drag beside it is 3 N.", "How far the two differ stands in every row.", "Time gone: 10 s.",
                         "The cloth gives way to the air.", "A run that fails is told in its row.", "The boundary holds the pressure.",
                         "The drag is C_D S q.", "The stress is limited by k^2.", "A force of sqrt(2) N acts.",
                         "Here " + "one word " * 17 + "ends."]:
            with self.subTest(sentence=sentence):
                self.assertNotEqual(faults(sentence), [])

    def test_plain_sentences_are_accepted(self):
        for sentence in ["The load remains within 10 % of the steady load.", "The mean absolute error is 3.0 %.",
                         "The drag area is $C_D S = F / q$.", "The key `flow.watch.eddies` selects the model."]:
            with self.subTest(sentence=sentence):
                self.assertEqual(faults(sentence), [])

    def test_code_blocks_show_commands_and_no_equations(self):
        self.assertEqual(faults("Text.\n\n    ripstop steady case.toml --speed 20\n"), [])
        self.assertNotEqual(faults("Text.\n\n    T(e) = w sum_k K_k e^k\n"), [])

    def test_every_code_name_of_the_glossary_exists(self):
        source = "".join(file.read_text() for file in (ROOT / "src/ripstop").rglob("*") if file.suffix in (".h", ".cpp"))
        words = set(re.findall(r"\w+", source))
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in (ROOT / GLOSSARY).read_text().splitlines()
                if line.startswith("| ") and not line.startswith("| term")]
        names = [name for row in rows for name in re.findall(r"`([^`]+)`", row[3])]
        self.assertGreater(len(names), 80)
        self.assertEqual([name for name in names if name not in words], [])

    def test_terms_of_the_glossary_are_defined_once(self):
        terms = [line.split("|")[1].strip() for line in (ROOT / GLOSSARY).read_text().splitlines() if line.startswith("| ")]
        terms = [term for term in terms if term != "term"]
        self.assertEqual(sorted(term for term in set(terms) if terms.count(term) > 1), [])


if __name__ == "__main__":
    unittest.main()
