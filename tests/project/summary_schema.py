#!/usr/bin/env python3
"""Every summary.json of the fixtures obeys assembly/summary.schema.json, and the schema names the keys of FORMAT.md.

    summary_schema.py REPOSITORY [SUMMARY ...]

Further summaries are checked as well. The check knows the words of JSON Schema that the schema uses, and no others.
"""
import json
import pathlib
import re
import sys

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}
NOTES = {"$schema", "title", "description", "x-stability"}
ONLY_LIMITS = {"critical_parameter", "critical_value", "bracket"}  # described in a sentence of FORMAT.md


def has_type(value, name):
    if name in ("number", "integer"):
        return type(value) is int or (name == "number" and type(value) is float)
    return isinstance(value, TYPES[name])


def faults(value, schema, place="summary"):
    """What is wrong with a value, as a list of sentences."""
    known = NOTES | {"type", "enum", "minimum", "items", "minItems", "maxItems", "properties", "required",
                     "additionalProperties"}
    assert set(schema) <= known, f"{place}: the check does not know {set(schema) - known}"
    types = schema.get("type", [])
    types = [types] if isinstance(types, str) else types
    if types and not any(has_type(value, name) for name in types):
        return [f"{place}: {value!r} is no {' or '.join(types)}"]
    found = []
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{place}: {value!r} is none of {schema['enum']}")
    if "minimum" in schema and value < schema["minimum"]:
        found.append(f"{place}: {value} is less than {schema['minimum']}")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{place}: {len(value)} items")
        for index, item in enumerate(value):
            found += faults(item, schema.get("items", {}), f"{place}[{index}]")
    if isinstance(value, dict):
        found += [f"{place}: {key} is missing" for key in schema.get("required", []) if key not in value]
        others = schema.get("additionalProperties", True)
        for key, item in value.items():
            if key in schema.get("properties", {}):
                found += faults(item, schema["properties"][key], f"{place}.{key}")
            elif others is False:
                found.append(f"{place}: unknown key {key}")
            elif isinstance(others, dict):
                found += faults(item, others, f"{place}.{key}")
    return found


def documented_keys(format_page):
    section = format_page[format_page.index("\n### summary.json\n"):]
    table = re.search(r"^\| key \| meaning \|\n\|---\|---\|\n((?:\|.*\n)+)", section, re.M)[1]
    return set(re.findall(r"^\| `(\w+)` \|", table, re.M))


def check_the_check(schema, summary):
    """Every kind of fault is seen."""
    assert faults({**summary, "status": "fine"}, schema) and faults({**summary, "blocks": -1}, schema)
    assert faults({**summary, "weight_N": "heavy"}, schema) and faults({**summary, "weigth_N": 1.0}, schema)
    assert faults({**summary, "applied_load_N": [0.0, 1.0]}, schema) and faults({**summary, "blocks": 1.5}, schema)
    assert faults({key: value for key, value in summary.items() if key != "message"}, schema)


def main(repository, *more):
    root = pathlib.Path(repository)
    schema = json.loads((root / "assembly/summary.schema.json").read_text())
    files = [*sorted(root.glob("tests/fixtures/*/*/results/summary.json")), *map(pathlib.Path, more)]
    found = [] if files else ["no summary in tests/fixtures"]
    for file in files:
        summary = json.loads(file.read_text())
        found += [f"{file}: {fault}" for fault in faults(summary, schema)]
    keys, documented = set(schema["properties"]), documented_keys((root / "assembly/FORMAT.md").read_text())
    found += [f"{key}: in FORMAT.md, not in the schema" for key in sorted(documented - keys)]
    found += [f"{key}: in the schema, not in FORMAT.md" for key in sorted(keys - documented - ONLY_LIMITS - {"format_version"})]
    found += [f"{key}: neither stable nor experimental" for key, value in schema["properties"].items()
              if value.get("x-stability") not in ("stable", "experimental")]
    if not found:
        check_the_check(schema, json.loads(files[0].read_text()))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
