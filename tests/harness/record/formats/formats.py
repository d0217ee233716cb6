#!/usr/bin/env python3
"""The promise about formats (docs/records.md): formats.py RAINGAUGE. A folder of each version of the formats has what make.sh wrote then.

Today's raingauge reads those files, their values come out again, and today's schema describes them. A schema may add fields and words, but
what an older schema tells a reader stays true.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import jsonschema

HERE = pathlib.Path(__file__).resolve().parent
VERSIONS = sorted(path.parent for path in HERE.glob("*/records.schema.json"))
SCHEMA = HERE.parent.parent.parent.parent / "docs" / "records.schema.json"
FORMS = {"list-devices": "list", "list-figures": "list", "list-params": "list", "list-tables": "list", "list-techniques": "list"}
RAINGAUGE = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else None


def loaded(path):
    return json.loads(path.read_text())


# --- what a newer schema must keep ---

class Kept:
    """Compares an older schema with a newer one: `lost` has what a reader of the older one would miss."""

    def __init__(self, older, newer):
        self.documents, self.lost, self.seen = (older, newer), [], set()
        for form in (part["$ref"] for part in older["oneOf"]):
            if form not in (part["$ref"] for part in newer["oneOf"]):
                self.lost.append(form + " is gone")
            else:
                self.compare({"$ref": form}, {"$ref": form}, form.split("/")[-1])

    def whole(self, part, side):
        """A part with what it refers to."""
        while "$ref" in part:
            target = self.documents[side]["$defs"][part["$ref"].split("/")[-1]]
            part = {**target, **{name: value for name, value in part.items() if name != "$ref"}}
        return part

    def compare(self, older, newer, place):
        pair = older.get("$ref"), newer.get("$ref")
        if all(pair):
            if pair in self.seen:
                return
            self.seen.add(pair)
        older, newer = self.whole(older, 0), self.whole(newer, 1)
        for name in ("type", "const", "pattern"):
            if older.get(name) != newer.get(name):
                self.lost.append(f"{place}: {name} was {older.get(name)}, is {newer.get(name)}")
        self.words(older, newer, place)
        for name, field in older.get("properties", {}).items():
            if name not in newer.get("properties", {}):
                self.lost.append(f"{place}.{name} is gone")
            else:
                self.compare(field, newer["properties"][name], f"{place}.{name}")
        for name in ("items", "additionalProperties"):
            if isinstance(older.get(name), dict):
                self.compare(older[name], newer.get(name, {}), f"{place}.{name}")
        for name in ("oneOf", "anyOf", "prefixItems"):
            for index, part in enumerate(older.get(name, [])):
                self.compare(part, dict(enumerate(newer.get(name, []))).get(index, {}), f"{place}.{name}.{index}")

    def words(self, older, newer, place):
        """Words of an enumeration and fields that are always there."""
        for name in ("enum", "required"):
            gone = [word for word in older.get(name, []) if word not in newer.get(name, [])]
            if gone and not (name == "enum" and "enum" not in newer):
                self.lost.append(f"{place}: {name} lacks {', '.join(map(str, gone))}")


def lost(older, newer):
    return Kept(older, newer).lost


class Schemas(unittest.TestCase):
    def test_a_newer_schema_keeps_what_an_older_one_tells(self):
        for version in VERSIONS:
            with self.subTest(version.name):
                self.assertEqual(lost(loaded(version / "records.schema.json"), loaded(SCHEMA)), [])
        self.assertTrue(VERSIONS)

    def test_what_breaks_the_promise_is_noticed(self):
        def without_field(schema):
            del schema["$defs"]["diff"]["properties"]["pairs"]

        def of_another_type(schema):
            schema["$defs"]["baseline"]["properties"]["format"] = {"const": 2}

        def no_longer_always_there(schema):
            schema["$defs"]["gate"]["required"].pop()

        def without_a_word(schema):
            schema["$defs"]["outcome"]["enum"].pop()

        def without_a_form(schema):
            schema["oneOf"].pop()

        for change in (without_field, of_another_type, no_longer_always_there, without_a_word, without_a_form):
            newer = loaded(SCHEMA)
            change(newer)
            with self.subTest(change.__name__):
                self.assertEqual(len(lost(loaded(SCHEMA), newer)), 1)

    def test_what_is_added_breaks_nothing(self):
        newer = loaded(SCHEMA)
        newer["$defs"]["diff"]["properties"]["new"] = {"type": "string"}
        newer["$defs"]["outcome"]["enum"].append("new")
        self.assertEqual(lost(loaded(SCHEMA), newer), [])


# --- kept files ---

def parts_of(older, newer, place=""):
    """Places where a value of the older document is not the newer one's; fields may be new."""
    if isinstance(older, dict) and isinstance(newer, dict):
        return [fault for name, value in older.items() for fault in (parts_of(value, newer[name], f"{place}.{name}") if name in newer else
                                                                     [f"{place}.{name} is gone"])]
    if isinstance(older, list) and isinstance(newer, list) and len(older) == len(newer):
        return [fault for index, value in enumerate(older) for fault in parts_of(value, newer[index], f"{place}.{index}")]
    return [] if older == newer else [f"{place} was {older}, is {newer}"]


class Files:
    """Tests of one version's folder."""
    version = None

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_it(self, *arguments):
        """Exit status, output and messages."""
        variables = {**os.environ, "OMP_NUM_THREADS": "1", "RG_FEW_SAMPLES": "1", "XDG_STATE_HOME": self.folder.name}
        done = subprocess.run([RAINGAUGE, *arguments], cwd=self.version, env=variables, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, check=False)
        return done.returncode, done.stdout, done.stderr

    def read(self, *arguments, ends=(0,)):
        """What a command prints as JSON."""
        status, out, messages = self.run_it(*arguments, "--json")
        self.assertIn(status, ends, messages)
        return json.loads(out)

    def test_todays_schema_describes_them(self):
        defs = loaded(SCHEMA)["$defs"]
        kept = [path for path in sorted(self.version.glob("*.json")) if path.stem not in ("records.schema", "lights")]
        self.assertGreater(len(kept), 10)
        for path in kept:
            form = FORMS.get(path.stem, path.stem)
            errors = list(jsonschema.Draft202012Validator({"$ref": "#/$defs/" + form, "$defs": defs}).iter_errors(loaded(path)))
            self.assertEqual([f"{path.name}: {error.message[:300]}" for error in errors], [])

    def test_values_of_a_table_come_out_again(self):
        again = self.read("table", "--from", "table.json")
        self.assertEqual(parts_of(loaded(self.version / "table.json"), again), [])

    def test_launches_are_judged_again(self):
        again = self.read("claims", "./panes.table", "--from", "launches.journal")
        self.assertEqual(parts_of(loaded(self.version / "claims.json")["claims"], again["claims"]), [])

    def test_a_table_of_ones_own_is_measured(self):
        again = self.read("table", "./panes.table", "--quick", "--device", "cpu", "--fresh")
        self.assertEqual([cell["status"] for cell in again["cells"]], ["ok"] * 4)

    def test_a_baseline_is_compared_with(self):
        again = self.read("gate", "--baseline", "baseline.json", "--device", "cpu", "--cells", "cells.txt", "--pictures", ends=(0, 1))
        self.assertEqual([case["name"] for case in again["gated"]], ["raster/torus.cpu", "flow/pane.cpu"])
        self.assertLessEqual({case["ending"] for case in again["gated"]}, {"pass", "fail"})

    def test_expectations_are_met(self):
        status, _, messages = self.run_it("gate", "cpu", "cpu", "--cells", "cells.txt", "--expectations", "expectations.txt", "--pictures")
        self.assertEqual(status, 1, messages)  # one was expected to fail, and passed

    def test_a_case_is_replayed(self):
        status, out, messages = self.run_it("render", "--case", "case.txt", "--device", "cpu")
        self.assertTrue(status in (0, 1) or "write one anew" in messages, messages)
        self.assertTrue(status == 2 or out.startswith(("same", "other")), out)

    def test_lights_and_winds_are_drawn(self):
        for technique, settings in (("streaks", ["--set", "lights_file=lights.json", "--set", "atlas=small"]), ("cartoon", ["--set", "wind_script=wind.txt"])):
            picture = os.path.join(self.folder.name, technique + ".png")
            status, _, messages = self.run_it("render", technique, *settings, "--size", "64x48", "--frame", "1", "--device", "cpu", "-o", picture)
            self.assertEqual(status, 0, messages)


for folder in VERSIONS:
    name = "Files of " + folder.name
    globals()[name] = type(name, (Files, unittest.TestCase), {"version": folder})

if __name__ == "__main__":
    unittest.main()
