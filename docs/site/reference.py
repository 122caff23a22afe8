#!/usr/bin/env python3
"""Writes the generated pages of docs/reference: all keys, all commands, and the Python package. The texts come from the program
(`schema --reference`, `--help`) and from the stub of the built Python module.

    docs/site/reference.py --program build-check/bin/ripstop --stub build-check/python/ripstop/_ripstop.pyi
"""
import argparse
import ast
import pathlib
import re
import subprocess

PAGES = pathlib.Path(__file__).resolve().parent.parent / "reference"

COMMANDS = """# All commands

`make reference` writes this page from `ripstop --help` and the `--help` of every command. The column "values" has
the type of the values of an option, or the words that it accepts. Every command also has `--help`. Exit codes are listed
in [conventions](../conventions.md#exit-codes).
"""

PYTHON = """# Python package

`make reference` writes this page from the docstrings of the package `ripstop`. The [guide](../guide/python.md) shows how to use it.
Names of numbers end with their unit, and arrays are NumPy arrays. All names are in the module `ripstop`.
"""


def help_of(program, command):
    result = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True)
    return result.stdout


def sections(text):
    """Parts of a help text: the description, the rows (name, meaning) of each titled section, and the footer."""
    head, rows, footer, title = [], {}, [], ""
    column = next(match.end() for line in text.splitlines() if (match := re.match(r"  -h, ?--help\s+", line)))  # of the meanings
    for line in text.splitlines():
        if match := re.fullmatch(r"(Positionals|Options|Subcommands):", line, re.IGNORECASE):
            title = match[1].capitalize()
            rows[title] = []
        elif title and line.startswith("  ") and not footer:
            name, meaning = line[:column].strip(), line[column:].strip()
            if len(line) > column and (not line[:column].endswith(" ") or name.endswith(":")):  # a long name has its line for itself
                name, meaning = line.strip(), ""
            if re.match(r"  \S", line):
                rows[title].append([name, meaning])
            else:
                rows[title][-1][1] = " ".join([rows[title][-1][1], line.strip()]).strip()
        elif title and (line.strip() or footer):
            footer.append(line)
        elif not title and not line.startswith("Usage:") and line.strip():
            head.append(line.strip())
    return " ".join(head), rows, "\n".join(footer).strip()


def cell(text):
    """Text of a table's cell, in which Markdown has no meaning."""
    return re.sub(r"([|*_\[\]])", r"\\\1", text.replace("<", "&lt;").replace(">", "&gt;"))


def options_table(rows):
    lines = ["| argument | values | meaning |", "| --- | --- | --- |"]
    for name, meaning in rows:
        names, _, kind = name.partition(" ")
        if "--help" in names:
            continue
        shown = ", ".join(f"`{one}`" for one in names.split(","))
        lines.append(f"| {shown} | {cell(kind)} | {cell(meaning)} |")
    return "\n".join(lines) + "\n" if len(lines) > 2 else ""


def commands(program, command=()):
    """Names of the commands that have no commands of their own, and of their groups, each with its help text."""
    text = help_of(program, command)
    _, rows, _ = sections(text)
    if command:
        yield command, text
    for name, _ in rows.get("Subcommands", []):
        yield from commands(program, (*command, name))


def commands_page(program):
    page = COMMANDS
    for command, text in commands(program):
        head, rows, footer = sections(text)
        page += f"\n## `ripstop {' '.join(command)}`\n\n{cell(head)}.\n"
        if "Subcommands" in rows:
            page += "\nIts commands: " + ", ".join(f"`{name}`" for name, _ in rows["Subcommands"]) + ".\n"
            continue
        if table := options_table(rows.get("Positionals", []) + rows.get("Options", [])):
            page += "\n" + table
        text, _, example = re.sub(r"^Examples?:", "Example:", footer, flags=re.MULTILINE).partition("Example:")
        if text.strip():
            page += "\n" + cell(" ".join(text.split())) + "\n"
        if example.strip():
            page += "\n" + re.sub(r"^\s*", "    ", example.strip(), flags=re.MULTILINE) + "\n"
    return page


def kind_of(node):
    """A type in short: `str | None` for Optional[str]."""
    text = ast.unparse(node)
    text = text.replace("Union[str, os.PathLike[str]]", "path").replace("typing.", "").replace("numpy.", "")
    while match := re.search(r"Optional\[((?:[^\[\]]|\[(?:[^\[\]]|\[[^\[\]]*\])*\])*)\]", text):
        text = text.replace(match[0], match[1] + " | None")
    return re.sub(r"Union\[(\w+), (\w+)\]", r"\1 | \2", text)


def call_of(node, method):
    """The call of a function or method, one argument on a line if it is long."""
    arguments = node.args
    positional = arguments.args[1:] if method and arguments.args and arguments.args[0].arg == "self" else arguments.args
    defaults = [None] * (len(positional) - len(arguments.defaults)) + arguments.defaults
    shown = []
    for argument, default in [*zip(positional, defaults), *([(None, None)] if arguments.kwonlyargs else []),
                              *zip(arguments.kwonlyargs, arguments.kw_defaults)]:
        if argument is None:
            shown.append("*")
            continue
        text = argument.arg + (f": {kind_of(argument.annotation)}" if argument.annotation else "")
        shown.append(text + (f" = {ast.unparse(default)}" if default is not None else ""))
    result = f" -> {kind_of(node.returns)}" if node.returns else ""
    line = f"{node.name}({', '.join(shown)}){result}"
    if len(line) <= 100:
        return line
    return f"{node.name}(\n    " + ",\n    ".join(shown) + f"){result}"


def text_of(node):
    return (ast.get_docstring(node) or "").strip()


def paragraphs(doc):
    """A docstring as Markdown: a line `name, name: meaning` becomes an item of a list, and an indented example a block of code."""
    parts = []
    for block in re.split(r"\n\s*\n", doc):
        if block.startswith("    "):
            parts.append(block)
            continue
        lines = []
        for line in block.splitlines():
            item = re.match(r"(\w+(?:, \w+)*): (.*)", line)
            if item and parts:
                names = ", ".join(f"`{name}`" for name in item[1].split(", "))
                lines.append(f"- {names}: {cell(item[2])}")
            elif lines:
                lines[-1] += " " + cell(line.strip())
            else:
                lines.append(cell(line.strip()))
        parts.append("\n".join(lines))
    return "\n\n".join(parts) + "\n" if doc else ""


def function_text(node, level, method=False):
    return f"\n{'#' * level} `{node.name}()`\n\n```python\n{call_of(node, method)}\n```\n\n{paragraphs(text_of(node))}"


def class_text(node):
    bases = ", ".join(ast.unparse(base) for base in node.bases)
    page = f"\n### `{node.name}`\n\n" + (f"An exception, derived from `{bases}`.\n\n" if bases else "") + paragraphs(text_of(node))
    rows = []
    for member in node.body:
        if isinstance(member, ast.FunctionDef) and any(ast.unparse(one) == "property" for one in member.decorator_list):
            doc = " ".join(text_of(member).split())
            rows.append((member.name, kind_of(member.returns), doc))
    if rows:
        page += "\n| attribute | type | meaning |\n| --- | --- | --- |\n"
        page += "".join(f"| `{name}` | {cell(kind)} | {cell(doc)} |\n" for name, kind, doc in rows)
    for member in node.body:
        if isinstance(member, ast.FunctionDef) and not any(ast.unparse(one) == "property" for one in member.decorator_list):
            page += function_text(member, 4, method=True)
    return page


def python_page(stub):
    body = ast.parse(stub.read_text()).body
    page = PYTHON + "\n## Functions\n"
    page += "".join(function_text(node, 3) for node in body if isinstance(node, ast.FunctionDef))
    page += "\n## Classes\n"
    return page + "".join(class_text(node) for node in body if isinstance(node, ast.ClassDef))


def pages(program=None, stub=None):
    """Text of each generated page by its file name."""
    made = {}
    if program:
        made["case-keys.md"] = subprocess.run([program, "schema", "--reference"], capture_output=True, text=True, check=True).stdout
        made["commands.md"] = commands_page(program)
    if stub:
        made["python.md"] = python_page(pathlib.Path(stub))
    return made


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", help="the built program; without it, keys and commands are left as they are")
    parser.add_argument("--stub", help="_ripstop.pyi of the built module; without it, the page of Python is left as it is")
    options = parser.parse_args()
    for name, text in pages(options.program, options.stub).items():
        (PAGES / name).write_text(text)
        print(PAGES / name)
