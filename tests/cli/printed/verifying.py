"""verify's output; its mutants have their own scene."""
import re

from machine import lacking, run_json

VERIFY = "verify raster --frame 5 --device cpu --size 96x96 "


def check_verify_json(runner):
    """verify --json has a record for every check on every device"""
    report, status, problems = run_json(runner, VERIFY)
    for check in report["checks"]:
        problems += lacking("check", check, dict.fromkeys(("technique", "check", "device", "status", "detail"), str))
    named = {(check["check"], check["device"], check["status"]) for check in report["checks"]}
    if (report["format"], status) != (1, 0) or not {("state", "cpu", "ok"), ("image", "cpu", "ok"), ("mutants", "cpu", "ok")} <= named:
        problems.append("format %s, exit status %d, checks %s" % (report["format"], status, sorted(named)))
    return problems


def check_verify_mutants(runner):
    """mutants run on cpu, even if only cpu:reference is named"""
    report, status, problems = run_json(runner, VERIFY.replace("--device cpu ", "--device cpu:reference "))
    on = [check["device"] for check in report["checks"] if check["check"] == "mutants"]
    return problems + ([] if status == 0 and on == ["cpu"] else ["exit status %d, mutants on %s" % (status, on)])


def check_verify_dry(runner):
    """verify ends with 4 for an image without rain, which proves nothing, and reports no other check wrongly"""
    result = runner.run((VERIFY + "--set share=0").split())
    driver, *lines = result.stdout.splitlines()
    failed = [line for line in lines[:-1] if not line.startswith("ok ")]
    problems = ["stderr: " + line for line in result.stderr.splitlines()]
    if result.returncode != 4 or not driver.startswith("cpu: ") or len(lines) != 6 or len(failed) != 1 or lines[-1] != "5 checks, 4 ok, 1 nothing":
        problems.append("exit status %d, printed:\n%s" % (result.returncode, result.stdout))
    if not re.match(r"nothing +raster +image +cpu .*: no rain in the image, which therefore proves nothing; take another --frame, size or setting$", failed[0] if failed else ""):
        problems.append("failed: %s" % failed)
    return problems


LONG = [check_verify_json, check_verify_mutants, check_verify_dry]
