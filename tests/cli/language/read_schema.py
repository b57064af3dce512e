"""read_schema.py SCHEMA FILE...: checks the schema itself, then prints for each TOML file the keys whose values the
schema refuses, as taut names them (body.left.shape), or "the file", or "valid"."""
import json
import sys
import tomllib
from pathlib import Path

from jsonschema import Draft7Validator

NAMED = {"body", "wall", "probe", "line", "measure"}  # taut names these by their name, other lists as a whole


def is_other_kind(error):
    """Whether the value is of another type than this branch, or of another kind of shape, probe or measure."""
    return not error.relative_path and error.validator == "type" or error.validator == "const"


def reason(error):
    """The error in the branch of anyOf or oneOf that the file most likely means."""
    branches = {}
    for inner in error.context:
        branches.setdefault(inner.relative_schema_path[0], []).append(inner)
    meant = [errors for errors in branches.values() if not any(map(is_other_kind, errors))]
    if len(meant) == 1:
        return reason(meant[0][0])
    if branches and not meant and all(errors[0].validator == "const" for errors in branches.values()):
        return error.context[0]  # an unknown kind
    return error


def keys_of(error, document):
    path, value, names = list(error.absolute_path), document, []
    for k, step in enumerate(path):
        value = value[step]
        if isinstance(step, str):
            names.append(step)
        elif k == 1 and path[0] in NAMED:
            names.append(value["name"])
    if error.validator == "additionalProperties":
        return [".".join(names + [key]) for key in error.instance if key not in error.schema["properties"]]
    if error.validator == "required":
        return [".".join(names + [key]) for key in error.validator_value if key not in error.instance]
    return [".".join(names) or "the file"]


schema = json.loads(Path(sys.argv[1]).read_text())
Draft7Validator.check_schema(schema)
validator = Draft7Validator(schema)
for file in sys.argv[2:]:
    document = tomllib.loads(Path(file).read_text())
    keys = [key for error in validator.iter_errors(document) for key in keys_of(reason(error), document)]
    print(" ".join(sorted(set(keys))) or "valid")
