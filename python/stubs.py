#!/usr/bin/env python3
"""Writes _ripstop.pyi next to a built module. It has every public name with the signature of pybind11, its docstring, and
the members of each class (__annotations__)."""
import inspect
import pathlib
import re
import sys

HEAD = '''"""Made by python/stubs.py of the built module: change the bindings, not this."""
import os
import typing
from typing import Any, Callable, Optional, Union

import numpy

__version__: str
'''


def typed(text):
    """A type as pybind11 prints it, in the words of a stub."""
    text = text.replace("ripstop.", "")
    text = re.sub(r"\b(List|Dict|Tuple)\[", lambda m: m[1].lower() + "[", text)
    text = text.replace("os.PathLike", "Union[str, os.PathLike[str]]")
    text = text.replace(": function", ": Callable")  # as pybind11 2.13 and later have it
    return re.sub(r"\bobject\b", "Any", text)


def signature(name, doc):
    """(arguments and result, the rest of the docstring) of a function of pybind11."""
    first, _, rest = doc.partition("\n")
    if not first.startswith(name + "("):
        return "(self) -> Any", doc.strip()
    text = typed(first[len(name):])
    return re.sub(r"^\(self: [^,)]*", "(self", text), rest.strip()


def docstring(text, indent):
    if not text:
        return ""
    text = re.sub('"$', r'\\"', text.replace("\\", "\\\\").replace('"""', '\\"\\"\\"'))
    lines = ('"""' + text + '"""').split("\n")
    return "".join((indent + line).rstrip() + "\n" for line in lines)


def function(name, member, indent=""):
    doc = member.__doc__ or ""
    static = indent and isinstance(member, type(len))
    arguments, rest = signature(name, doc)
    text = f"{indent}@staticmethod\n" if static else ""
    body = docstring(rest, indent + "    ")
    return text + f"{indent}def {name}{arguments}:" + (f"\n{body}" if body else " ...\n")


def attribute(name, member, annotations):
    getter = member.fget.__doc__ or ""
    kind = annotations.get(name)
    if kind is None:
        found = re.search(r"-> (.*)", getter)
        kind = typed(found[1]) if found else "Any"
    doc = docstring((member.__doc__ or "").strip(), "        ")
    return f"    @property\n    def {name}(self) -> {kind}:\n{doc}"


def class_text(name, member):
    bases = [base.__name__ for base in member.__bases__ if base.__name__ not in ("object", "pybind11_object")]
    text = f"class {name}" + (f"({', '.join(bases)})" if bases else "") + ":\n" + docstring(member.__doc__, "    ")
    if issubclass(member, Exception):
        own = "    problems: list[Problem]\n" if name == "InputError" else "    exit_code: int\n"
        return text + own
    annotations = member.__dict__.get("__annotations__", {})
    for key, value in member.__dict__.items():
        if key.startswith("_"):
            continue
        text += attribute(key, value, annotations) if isinstance(value, property) else function(key, inspect.unwrap(getattr(member, key)), "    ")
    return text


def stub_of(module):
    text = HEAD
    for name in sorted(vars(module)):
        if name.startswith("_"):
            continue
        member = getattr(module, name)
        text += "\n" + (class_text(name, member) if inspect.isclass(member) else function(name, member))
    return text


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    sys.path.insert(0, str(folder.parent))
    sys.dont_write_bytecode = True
    import ripstop._ripstop
    (folder / "_ripstop.pyi").write_text(stub_of(ripstop._ripstop))
