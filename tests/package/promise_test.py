"""Names that users rely on within one MAJOR version (docs/guide/compatibility.md): keys of cases, commands with their options, the names of
the Python package with their arguments, and exit codes. The recorded ones, promised.json, must exist; new ones may be added.

    promise_test.py --write     records the present names: before a release, and after a change that is allowed before 1.0
"""
import ast
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
RECORD = pathlib.Path(__file__).with_name("promised.json")
PROGRAM = os.environ["RIPSTOP_PROGRAM"]
sys.path.insert(0, str(SOURCE / "docs/site"))
import reference  # noqa: E402


def keys_of(schema, path=""):
    """All keys of a JSON schema; "*" for a table that the user names."""
    inner = [*schema.get("properties", {}).items()]
    if isinstance(schema.get("additionalProperties"), dict):
        inner.append(("*", schema["additionalProperties"]))
    for name, value in inner:
        yield f"{path}{name}"
        for one in (value, value.get("items", {}), *value.get("anyOf", []), *value.get("oneOf", [])):
            yield from keys_of(one, f"{path}{name}.")


def options_of(program):
    for command, text in reference.commands(program):
        _, rows, _ = reference.sections(text)
        names = [name for row, _ in rows.get("Options", []) for name in row.split(" ")[0].split(",")]
        yield " ".join(command), sorted(names + [row.split(" ")[0] for row, _ in rows.get("Positionals", [])])


def names_of(stub):
    """Functions and methods with their arguments, classes with their attributes."""
    def arguments(node):
        return [one.arg for one in node.args.args + node.args.kwonlyargs if one.arg != "self"]
    for node in ast.parse(stub.read_text()).body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, arguments(node)
        elif isinstance(node, ast.ClassDef):
            members = [member for member in node.body if isinstance(member, ast.FunctionDef)]
            is_property = {member.name: any(ast.unparse(one) == "property" for one in member.decorator_list) for member in members}
            yield node.name, sorted(name for name, yes in is_property.items() if yes)
            for member in members:
                if not is_property[member.name]:
                    yield f"{node.name}.{member.name}", arguments(member)


def present():
    schema = json.loads(subprocess.run([PROGRAM, "schema"], capture_output=True, text=True, check=True).stdout)
    codes = re.search(r"enum class ExitCode[^{]*\{(.*?)\};", (SOURCE / "src/ripstop/core/error.h").read_text(), re.DOTALL)[1]
    stub = pathlib.Path(os.environ["RIPSTOP_BUILD"], "python/ripstop/_ripstop.pyi")
    return {"exit codes": {name: int(value) for name, value in re.findall(r"(\w+) = (\d+)", codes)}, "keys": sorted(set(keys_of(schema))),
            "commands": dict(options_of(PROGRAM)), "Python": dict(sorted(names_of(stub)))}


def written(names):
    """One command or one Python name on a line."""
    lists = {key: (",\n".join(f"    {json.dumps(name)}: {json.dumps(value)}" for name, value in part.items()) if isinstance(part, dict) else
                   ",\n".join(f"    {json.dumps(name)}" for name in part)) for key, part in names.items()}
    return "{\n" + ",\n".join(f"  {json.dumps(key)}: {'{' if isinstance(names[key], dict) else '['}\n{text}\n  "
                              f"{'}' if isinstance(names[key], dict) else ']'}" for key, text in lists.items()) + "\n}\n"


class Promise(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.promised, self.present = json.loads(RECORD.read_text()), present()

    def test_every_promised_key_option_and_name_exists(self):
        self.assertEqual(sorted(set(self.promised["keys"]) - set(self.present["keys"])), [])
        for part in ("commands", "Python"):
            missing = [f"{name}: {one}" for name, names in self.promised[part].items() for one in names
                       if one not in self.present[part].get(name, [])]
            self.assertEqual(missing, [], part)
            self.assertEqual(sorted(set(self.promised[part]) - set(self.present[part])), [])

    def test_exit_codes_keep_their_meaning(self):
        self.assertEqual(self.present["exit codes"] | self.promised["exit codes"], self.present["exit codes"])

    def test_arguments_keep_their_order(self):
        for name, names in self.promised["Python"].items():
            now = [one for one in self.present["Python"].get(name, []) if one in names]
            self.assertEqual(now, names, name)

    def test_the_record_is_not_empty(self):
        self.assertGreater(len(self.promised["keys"]), 200)
        self.assertIn("--speed", self.promised["commands"]["steady"])
        self.assertIn("case", self.promised["Python"]["steady"])


if __name__ == "__main__":
    if "--write" in sys.argv:
        RECORD.write_text(written(present()))
    else:
        unittest.main()
