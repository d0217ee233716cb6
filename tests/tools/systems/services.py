"""GitHub's and GitLab's runners, as far as docs/ci needs them: they take the steps of a file, in order, and refuse what they do not know.

A place runs a step: `project` is the folder of the project and `temporary` another one, as this process names them; `at(path)` is such a
path as a step names it; `check_out()` brings the project; `run(script, variables)` has bash run a script in the project's folder, and
returns its exit status and what it printed.
"""
import collections
import os
import re

import yaml  # the Debian package python3-yaml

BASH = ("bash", "--noprofile", "--norc", "-eo", "pipefail")
ALWAYS = "always()"
URL = "https://ci.example/artifacts/1"
# actions/upload-artifact accepts no file with these in its path.
NOT_IN_PATHS = set('":<>|*?\r\n')

Ended = collections.namedtuple("Ended", "status log summary kept")

class Refused(Exception):
    """What a service does not know, or would refuse."""

def known(found, names, where):
    for name in found:
        if name not in names:
            raise Refused("%s: %r is not known" % (where, name))

def read(path):
    with open(path) as file:
        return yaml.safe_load(file)

def files_of(place, path):
    """All files of a path in the project, as the project names them. A path that is not there is refused, for a service only warns of it."""
    whole = os.path.join(place.project, path)
    found = [whole] if os.path.isfile(whole) else [os.path.join(folder, name) for folder, _, names in os.walk(whole) for name in names]
    if not found:
        raise Refused("%s: is not there, so that nothing is kept" % path)
    return sorted(os.path.relpath(name, place.project) for name in found)

# --- GitHub ---

def expanded(text, variables, outputs):
    """A text with its ${{ }}: variables of the repository, outputs of steps, words in quotes, and || between them."""
    def term(word):
        if re.fullmatch(r"'[^']*'", word):
            return word[1:-1]
        of_step = re.fullmatch(r"steps\.(\w+)\.outputs\.([\w-]+)", word)
        if of_step and of_step[1] in outputs:
            return outputs[of_step[1]].get(of_step[2], "")
        if re.fullmatch(r"vars\.\w+", word):
            return variables.get(word[5:], "")
        raise Refused("${{ %s }}: is not known" % word)

    return re.sub(r"\$\{\{(.*?)\}\}", lambda found: next(filter(None, (term(word.strip()) for word in found[1].split("||"))), ""), text)

def upload(place, settings):
    known(settings, ("name", "path"), "upload-artifact")
    if NOT_IN_PATHS & set(settings["name"]) or "/" in settings["name"]:
        raise Refused("upload-artifact: the name %r" % settings["name"])
    found = [name for path in settings["path"].split() for name in files_of(place, path)]
    for name in found:
        if NOT_IN_PATHS & set(name):
            raise Refused("upload-artifact: the path %r" % name)
    return found

def act(place, step, kept):
    """An action: its outputs."""
    action = step["uses"].split("@")[0]
    if action == "actions/checkout":
        place.check_out()
        return {}
    if action == "actions/upload-artifact":
        kept += upload(place, step["with"])
        return {"artifact-url": URL}
    raise Refused("uses %s: is not known" % action)

def github_image(path, variables):
    (job,) = read(path)["jobs"].values()
    return expanded(job["container"], variables, {})

def github(path, place, variables, given, without=None):
    """Takes the steps of the one job of a workflow, but the one `without`. `variables` are the repository's, `given` replaces the job's."""
    workflow = read(path)
    known(workflow, ("name", True, "permissions", "defaults", "jobs"), "the workflow")  # YAML takes `on` for True
    (job,) = workflow["jobs"].values()
    known(job, ("runs-on", "container", "env", "steps"), "the job")
    if workflow["defaults"] != {"run": {"shell": "bash"}}:
        raise Refused("defaults: only bash is known")
    summary = os.path.join(place.temporary, "summary.md")
    outside = {name: expanded(text, variables, {}) for name, text in job["env"].items()}
    outside.update({"CI": "true", "GITHUB_ACTIONS": "true", "GITHUB_STEP_SUMMARY": place.at(summary), **given})
    status, log, kept, outputs = "success", "", [], {}
    for step in job["steps"]:
        if without and without in (step.get("name"), step.get("uses")):
            continue
        known(step, ("name", "id", "if", "uses", "with", "env", "run"), "a step")
        if step.get("if", ALWAYS) != ALWAYS:
            raise Refused("if: %s" % step["if"])
        if status == "failure" and "if" not in step:
            continue
        if "uses" in step:
            outputs[step.get("id", "")] = act(place, step, kept)
            continue
        inside = {name: expanded(text, variables, outputs) for name, text in step.get("env", {}).items()}
        ended, said = place.run(step["run"], {**outside, **inside})
        log += said
        if ended:
            status = "failure"
    if not os.path.exists(summary):
        return Ended(status, log, "", kept)
    with open(summary) as file:
        return Ended(status, log, file.read(), kept)


# --- GitLab ---

def merged(below, above):
    """GitLab's `extends`: maps are joined, and all else is replaced."""
    both = dict(below)
    for name, value in above.items():
        both[name] = merged(below[name], value) if isinstance(value, dict) and isinstance(below.get(name), dict) else value
    return both

def job_of(path, name):
    jobs = read(path)
    job = jobs[name]
    while "extends" in job:
        base = job.pop("extends")
        job = merged(jobs[base], job)
    known(job, ("stage", "image", "variables", "before_script", "script", "after_script", "allow_failure", "artifacts", "parallel", "when"),
          name)
    return job

def gitlab_image(path, name, given):
    job = job_of(path, name)
    return {**job["variables"], **given}[job["image"].lstrip("$")]

def check_exposed(artifacts):
    """Artifacts with a name for merge requests: GitLab shows only plain paths, and folders that end in a slash."""
    if not re.fullmatch(r"[\w -]{1,100}", artifacts["expose_as"]):
        raise Refused("expose_as: %r" % artifacts["expose_as"])
    for path in artifacts["paths"]:
        if re.search(r"[$*]|^\./", path) or not ("." in os.path.basename(path) or path.endswith("/")):
            raise Refused("expose_as does not show the path %r" % path)

def keep(place, artifacts, is_failed):
    known(artifacts, ("when", "expose_as", "paths", "reports"), "artifacts")
    known(artifacts.get("reports", {}), ("junit",), "reports")
    if "expose_as" in artifacts:
        check_exposed(artifacts)
    if is_failed and artifacts.get("when") != "always":
        return []
    paths = artifacts["paths"] + ([] if is_failed else list(artifacts.get("reports", {}).values()))
    return sorted({name for path in paths for name in files_of(place, path)})

def gitlab(path, name, place, given):
    """Takes a job's steps. `given` are variables of the project, which replace those of the file. The summary is what ran last."""
    job = job_of(path, name)
    variables = {"CI": "true", "GITLAB_CI": "true", "CI_JOB_URL": URL, "CI_PROJECT_DIR": place.at(place.project)}
    variables.update({**job["variables"], **given})
    place.check_out()
    ended, log = place.run("\n".join(job.get("before_script", []) + job["script"]), variables)
    allowed = job.get("allow_failure", False)
    is_allowed = allowed if isinstance(allowed, bool) else ended in allowed["exit_codes"]
    after = place.run("\n".join(job["after_script"]), variables)[1] if "after_script" in job else ""
    status = "success" if not ended else "warning" if is_allowed else "failed"
    return Ended(status, log, after, keep(place, job["artifacts"], bool(ended)))
