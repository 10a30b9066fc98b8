#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""JSON files of the programs against the schemas in share/schemas.
usage: schemas.py TREE                      checks the schemas of TREE themselves
       schemas.py TREE [NAME=]FILE|FOLDER...
Of a folder, every *.json below it is validated by the schema of its name; NAME=FILE names the
schema of a file with a free name. Prints each fault with file and place. Exit code 1: there are
some; 77: the Python module jsonschema is missing.
"""
import json
import pathlib
import re
import sys

try:
    import jsonschema
except ImportError:
    print("schemas.py: skipped: no Python module jsonschema (Debian: python3-jsonschema)")
    sys.exit(77)

# Files whose schema has another name than the file.
NAMES = {"planes_truth": "planes", "table": "suite_table", "run": "run_record"}


def read_schemas(tree):
    """The schemas by name."""
    folder = pathlib.Path(tree, "share/schemas")
    return {path.name.split(".")[0]: json.loads(path.read_text(encoding="utf-8"))
            for path in sorted(folder.glob("*.schema.json"))}


def refuse_constant(word):
    """NaN and Infinity are no JSON, though Python reads them."""
    raise ValueError(f"{word} is no number of JSON")


def schema_of(path, value):
    """Name of the schema of a file. Both tables of a suite have one file name."""
    if path.stem == "table" and "by_damage" in value:
        return "trust_table"
    if path.parent.name == "data":
        return "run_record"
    return NAMES.get(path.stem, path.stem)


def read_json(path):
    """The value of a file, by the rules of JSON alone."""
    return json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse_constant)


def validator_of(schema):
    """The rules of a schema."""
    return jsonschema.Draft7Validator(schema)


def errors_of(schema, value):
    """What a schema finds wrong."""
    return list(validator_of(schema).iter_errors(value))


def faults_of(schemas, path, name=None):
    """Faults of a file, each in one line."""
    try:
        value = read_json(path)
    except (OSError, ValueError) as error:
        return [f"{path}: cannot be read as JSON: {error}"]
    name = name or schema_of(path, value)
    if name not in schemas:
        return [f"{path}: there is no schema share/schemas/{name}.schema.json"]
    return [f"{path}: /{'/'.join(map(str, error.absolute_path))}: {error.message[:200]}"
            for error in errors_of(schemas[name], value)]


def files_of(argument):
    """(file, name of its schema or None) of an argument."""
    name, equals, file = argument.partition("=")
    path = pathlib.Path(file if equals else name)
    if path.is_dir():
        return [(one, None) for one in sorted(path.rglob("*.json"))]
    return [(path, name if equals else None)]


def objects_in(schema, place=""):
    """(place, schema) of each object inside a schema."""
    if isinstance(schema, dict):
        if isinstance(schema.get("properties"), dict):
            yield place, schema
        for key, value in schema.items():
            yield from objects_in(value, f"{place}/{key}")
    elif isinstance(schema, list):
        for index, value in enumerate(schema):
            yield from objects_in(value, f"{place}/{index}")


def faults_of_schema(name, schema):
    """Properties without a description, objects that take any key, references into nothing."""
    faults = []
    for place, part in objects_in(schema):
        if part.get("additionalProperties", True) is True:
            faults.append(f"{name}: {place}: takes unknown keys")
        if not set(part.get("required", [])) <= set(part["properties"]):
            faults.append(f"{name}: {place}: requires a key that is not described")
        faults += [f"{name}: {place}/{key}: no description"
                   for key, value in part["properties"].items() if not value.get("description")]
    used = set(re.findall(r'"#/definitions/(\w+)"', json.dumps(schema)))
    for missing in used ^ set(schema.get("definitions", {})):
        faults.append(f"{name}: {missing}: not defined, or not used")
    return faults


def faults_of_schemas(tree, schemas):
    """Faults of the schemas: each alone, against the others, and against the sources."""
    faults, defined = [], {}
    for name, schema in schemas.items():
        jsonschema.Draft7Validator.check_schema(schema)
        faults += faults_of_schema(name, schema)
        for key, definition in schema.get("definitions", {}).items():
            first = defined.setdefault(key, (name, definition))
            if first[1] != definition:
                faults.append(f"{name}: {key} differs from {key} in {first[0]}")
    source = pathlib.Path(tree, "modules/common/src/rejection.cpp").read_text(encoding="utf-8")
    words = re.findall(r'Reason::k\w+,\s*"([a-z-]+)"', source)
    rejection = schemas["summary"]["definitions"]["rejection"]
    for word in set(words) ^ set(rejection["properties"]["reason"]["enum"]):
        faults.append(f"summary: the reason {word} is not the same in rejection.cpp and here")
    return faults


def main():
    """Checks what the arguments name."""
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    schemas = read_schemas(sys.argv[1])
    if not schemas:
        sys.exit(f"{sys.argv[1]}/share/schemas: no schemas")
    files = [one for argument in sys.argv[2:] for one in files_of(argument)]
    if len(sys.argv) == 2:
        faults = faults_of_schemas(sys.argv[1], schemas)
        checked = f"{len(schemas)} schemas"
    else:
        faults = [fault for path, name in files for fault in faults_of(schemas, path, name)]
        checked = f"{len(files)} files"
    print(*faults, sep="\n", end="\n" if faults else "")
    print(f"{checked}, {len(faults)} faults")
    sys.exit(1 if faults or (len(sys.argv) > 2 and not files) else 0)


if __name__ == "__main__":
    main()
