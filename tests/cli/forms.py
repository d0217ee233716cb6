"""Compares the machine forms with docs/records.schema.json, by which users check them."""
import functools
import json
import os
import re

import jsonschema  # the Debian package python3-jsonschema

DOCS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs")


def closed(schema):
    """The schema without room for unnamed fields: readers skip these, but raingauge documents every field."""
    if isinstance(schema, list):
        return [closed(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    shut = {name: closed(part) for name, part in schema.items()}
    if schema.get("type") == "object" and "properties" in schema:
        shut.setdefault("additionalProperties", False)
    return shut


@functools.lru_cache
def schema():
    with open(os.path.join(DOCS, "records.schema.json")) as file:
        text = json.load(file)
    jsonschema.Draft202012Validator.check_schema(text)
    return closed(text)


@functools.lru_cache
def validator(form):
    return jsonschema.Draft202012Validator({"$ref": "#/$defs/" + form, "$defs": schema()["$defs"]})


def problems(form, document):
    """Problems: places where a document departs from the schema of a form: "table", "diff", ..."""
    errors = sorted(validator(form).iter_errors(document), key=lambda error: list(map(str, error.absolute_path)))
    return ["%s --json: %s: %s" % (form, "/".join(map(str, error.absolute_path)), error.message[:300]) for error in errors[:5]]


def unsealed(record):
    """A table's record without checksums, as before there were any, so that it can be changed."""
    for cell in record["cells"]:
        cell.pop("checksum", None)
    return record


def described(part):
    """Whether a field's schema, or the one that it refers to, describes the field; a constant needs no words."""
    target = schema()["$defs"].get(part.get("$ref", "").split("/")[-1], {})
    return bool("const" in part or part.get("description") or target.get("description"))


def silent(part, place):
    """The places of all fields of a schema without a description."""
    if isinstance(part, list):
        return [name for inner in part for name in silent(inner, place)]
    if not isinstance(part, dict):
        return []
    fields = part["properties"] if "object" in part.get("type", ()) and "properties" in part else {}
    found = ["%s.%s" % (place, name) for name, field in fields.items() if not described(field)]
    inside = {**fields, **{key: part[key] for key in ("items", "oneOf", "anyOf", "additionalProperties") if key in part}}
    return found + [name for key, inner in inside.items() for name in silent(inner, "%s.%s" % (place, key) if key in fields else place)]


def undocumented():
    """Fields that the schema does not describe, and forms that docs/records.md does not name."""
    with open(os.path.join(DOCS, "records.md")) as file:
        told = set(re.findall(r"`([^`]+)`", file.read()))
    every = [form["$ref"].split("/")[-1] for form in schema()["oneOf"]]
    return [name for form, part in schema()["$defs"].items() for name in silent(part, form)] + sorted(set(every) - told)
