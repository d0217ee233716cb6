"""The machine forms against docs/records.schema.json, which users hold them against."""
import functools
import json
import os
import re

import jsonschema  # the Debian package python3-jsonschema

DOCS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs")


def closed(schema):
    """The schema with no room for fields that it does not name: readers skip them, we say what each is."""
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
    """What of a document is not as the schema has this form: "table", "diff", ..."""
    errors = sorted(validator(form).iter_errors(document), key=lambda error: list(map(str, error.absolute_path)))
    return ["%s --json: %s: %s" % (form, "/".join(map(str, error.absolute_path)), error.message[:300]) for error in errors[:5]]


def unsealed(record):
    """A record of a table whose cells have no checksum, as those of before there were any: it can be changed."""
    for cell in record["cells"]:
        cell.pop("checksum", None)
    return record


def names(part):
    """The names of all fields of a schema."""
    found = set(part.get("properties", {})) if isinstance(part, dict) else set()
    for inner in part.values() if isinstance(part, dict) else part if isinstance(part, list) else []:
        found |= names(inner)
    return found


def undocumented():
    """Fields of the schema that docs/records.md does not tell of."""
    with open(os.path.join(DOCS, "records.md")) as file:
        told = {word for span in re.findall(r"`([^`]+)`", file.read()) for word in re.findall(r"[a-z0-9_]+", span)}
    return sorted(names(schema()) - told - {"format"})
