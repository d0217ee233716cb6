"""The contents of machine forms: a command's JSON, compared with docs/records.md."""
import json

import forms


def run_json(runner, args, env={}, form=None):
    """The command's JSON, its exit status, and its messages as a list of problems."""
    result = runner.run((args + " --json").split(), env)
    document = json.loads(result.stdout)
    problems = forms.problems(form or args.split()[0], document)
    return document, result.returncode, problems + ["stderr: " + line for line in result.stderr.splitlines()]


def lacking(where, record, fields):
    """Problems: `fields` that a record lacks, and values of another type."""
    return ["%s: %s is %r" % (where, name, record.get(name)) for name, kind in fields.items()
            if not isinstance(record.get(name), kind) or isinstance(record.get(name), bool) != (kind is bool)]
