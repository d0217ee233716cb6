"""What `trace` writes: a timeline that Perfetto opens."""
import collections
import json
import os
import tempfile

from cases import SMALL

FRAMES = 3
TRACKS = {1: "frames, wall clock", 2: "frames, the API's clock", 3: "frames that wait after each pass"}


def slices_of(events, process, track):
    return [event for event in events if event["ph"] == "X" and (event["pid"], event["tid"]) == (process, track)]


def problems_of_passes(slices):
    """A frame's slice is filled by those of its passes, one after the other."""
    frames = [one for one in slices if one["name"].startswith("frame ")]
    passes = [one for one in slices if one not in frames]
    problems = [] if len(frames) == FRAMES else ["%d frames that wait" % len(frames)]
    for frame in frames:
        inside = [one for one in passes if frame["ts"] - 1e-6 <= one["ts"] and one["ts"] + one["dur"] <= frame["ts"] + frame["dur"] + 1e-3]
        if len(inside) < 5 or abs(sum(one["dur"] for one in inside) - frame["dur"]) > 1e-3 or not any(one["name"] == "flow_slide" for one in inside):
            problems.append("%s of %g us has %s" % (frame["name"], frame["dur"], [one["name"] for one in inside]))
    return problems


def check_trace(runner):
    """trace has a process for each device, with frames by the wall clock and by the API's, and each pass within its frame"""
    with tempfile.TemporaryDirectory() as tmp:
        path = os.path.join(tmp, "trace.json")
        done = runner.run(("trace flow --device cpu,new=gl --count %d -o %s " % (FRAMES, path) + SMALL).split())
        if done.returncode or done.stderr or done.stdout != "%s: %d frames, and as many by pass, on 2 devices\n" % (path, FRAMES):
            return ["status %d: %s%s" % (done.returncode, done.stdout, done.stderr)]
        with open(path, encoding="utf-8") as file:
            trace = json.load(file)
    events, problems = trace["traceEvents"], []
    names = collections.defaultdict(dict)
    for event in events:
        if event["ph"] == "M":
            names[event["pid"]][event["tid"]] = event["args"]["name"]
    if [names[process][0].split(":")[0] for process in names] != ["cpu", "new"] or len(trace["otherData"]["passport"]["devices"]) != 2:
        problems.append("names %s" % dict(names))
    for process in (1, 2):
        if {track: name for track, name in names[process].items() if track} != TRACKS:
            problems.append("tracks %s" % names[process])
        wall, api = (slices_of(events, process, track) for track in (1, 2))
        frames = ["frame %d" % (2 * i + 1) for i in range(FRAMES)]
        if [one["name"] for one in wall] != ["open", *frames] or [one["name"] for one in api] != frames:
            problems.append("process %d: %s and %s" % (process, [one["name"] for one in wall], [one["name"] for one in api]))
        problems += problems_of_passes(slices_of(events, process, 3))
        if min(one["dur"] for one in wall) <= 0 or any(one["ts"] < 0 for one in wall):
            problems.append("process %d has slices of no duration" % process)
    return problems


CHECKS = [check_trace]
