"""Validates every TOML file that follows the schema in the arguments: one line a file, "valid" or "invalid"."""

import json
import sys
import tomllib

import jsonschema

with open(sys.argv[1], "rb") as file:
    schema = json.load(file)
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
for path in sys.argv[2:]:
    with open(path, "rb") as file:
        print("valid" if validator.is_valid(tomllib.load(file)) else "invalid")
