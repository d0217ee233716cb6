"use strict";
// What verify, diff, baseline and doctor found.

// --- verify, diff, baseline ---

const statusClass = status => status === "ok" ? "yes" : status === "unsupported" || status === "nothing" ? "other" : "no";
const status = (text, title) => el("span", {class: "verdict " + statusClass(text), title: title || null}, el("span", {"aria-hidden": "true"}, {yes: "✓", no: "✗", other: "○"}[statusClass(text)]), " " + text);

function verifyPart(record) {
  const checks = objectsOf(record.document.checks), devices = [...new Set(checks.map(c => c.device))], rows = [...new Set(checks.map(c => `${c.technique}, ${c.check}`))];
  const bad = checks.filter(c => statusClass(c.status) === "no");
  return part("Verified: " + [...new Set(checks.map(c => c.technique))].join(", "), el("p", {}, bad.length ? `${bad.length} of ${plural(checks.length, "check")} do not hold.` : checks.length ? `None of ${plural(checks.length, "check")} fails.` : "Nothing was checked."),
    sheet("Whether states and pictures are those of the reference, and whether laws hold", ["check", ...devices], rows.map(row => [row, ...devices.map(d => { const c = checks.find(k => `${k.technique}, ${k.check}` === row && k.device === d); return c ? [status(c.status), el("small", {}, c.detail || "")] : ""; })])),
    note(record.file));
}
function diffPart(record, number, params) {
  const pairs = objectsOf(record.document.pairs), names = [...new Set(pairs.flatMap(p => [p.a, p.b]))], of = (x, y) => pairs.find(p => (p.a === x && p.b === y) || (p.a === y && p.b === x));
  const same = pairs.filter(p => p.tier === "T0").length;
  const tell = p => p ? [el("span", {class: "verdict " + (p.tier === "T0" ? "yes" : p.tier === "none" ? "no" : "bound")}, p.tier === "T0" ? "identical" : p.tier), p.tier === "T0" ? null : el("small", {}, `${(p.differing || 0).toLocaleString("en")} values, at most ${p.max} of 255`)] : "";
  return part("Pictures of every two devices", el("p", {}, `Identical to the last bit: ${same} of ${plural(pairs.length, "pair")}.`),
    sheet("How closely each two agree", ["device", ...names], names.map(x => [x, ...names.map(y => x === y ? "–" : tell(of(x, y)))])),
    devicePictures(record, number, params), pairs.filter(p => p.blame).map(p => el("p", {}, el("strong", {}, `${p.a} and ${p.b}: `), objectOf(p.blame).text || "")), objectsOf(record.document.failures).map(f => el("p", {class: "warn"}, `${f.device}: ${f.status}. ${f.detail || ""}`)), note(record.file));
}
const median = xs => d3.median(arrayOf(xs).filter(isNumber));
function baselinePart(record) {
  const cells = objectsOf(record.document.baseline), devices = [...new Set(cells.map(c => c.device))], names = [...new Set(cells.map(c => c.cell))];
  return part("A baseline", el("p", {}, `${plural(names.length, "cell")} on ${plural(devices.length, "device")}, against which later gates are held. ${cells.filter(c => c.outcome !== "ok").length} did not run well.`),
    sheet("Median time of a frame over launches, with the fastest and the slowest launch", ["cell", ...devices.map(d => ({text: d, number: true}))], names.map(name => [name, ...devices.map(d => {
      const c = cells.find(k => k.cell === name && k.device === d), times = c ? arrayOf(c.launches_ms).filter(isNumber) : [];
      return !c ? "" : c.outcome !== "ok" ? status(c.outcome, c.why) : times.length ? [`${digits(median(times))} ms`, el("small", {}, between(d3.min(times), d3.max(times)))] : "not timed";
    })])), note(record.file));
}
function viewChecks(params) {
  const parts = [...records("verify").map(verifyPart), ...records("diff").map((record, i) => diffPart(record, i, params)), ...records("baseline").map(baselinePart), ...records("bisect").map(bisectPart)];
  return [head("Checks", el("p", {}, "Whether devices compute and draw what the reference does.")), parts];
}
function bisectPart(record) {
  const d = record.document;
  return part("A bisect", el("p", {}, d.end === "found" ? `The first bad one of ${d.candidates}: ${arrayOf(d.first_bad).join(", ")}.` : `${d.end}${arrayOf(d.first_bad).length ? ": " + list(arrayOf(d.first_bad)) : ""}`),
    sheet("In the order in which they were judged", ["candidate", "verdict", {text: "took", number: true}], objectsOf(d.judged).map(j => [j.candidate, j.verdict, seconds(j.seconds)])), note(record.file));
}

// --- devices ---

function viewDevices() {
  const doctors = records("doctor");
  return [head("Devices", el("p", {}, "A device is an API with a driver. Each is asked for the same work.")),
    SEVERAL ? part("Machines", sheet("Machines that tables were measured on; another driver or setting makes another machine", ["machine", "processor", "comparison key", `not as ${MACHINES[0].name}`], MACHINES.map(m => [m.name, m.text || "", m.key, m.differs || ""]))) : null,
    doctors.map(record => {
      const devices = objectsOf(record.document.devices);
      return part("Doctor", el("p", {}, wellText(devices)), arrayOf(record.document.warnings).map(w => el("p", {class: "warn"}, w)), arrayOf(record.document.missing).map(m => note(m)),
        sheet("What each device can do at most, as measured", ["device", "status", {text: "memory, GB/s", number: true}, {text: "cache, GB/s", number: true}, {text: "arithmetic, Gop/s", number: true}, {text: "dispatch, µs", number: true}, "timer"],
          devices.map(d => [d.name, [status(d.status, d.why), d.why ? el("small", {}, d.why) : null], ...["memory_gb_s", "cache_gb_s", "arithmetic_gop_s"].map(k => digits(objectOf(d.ceilings)[k])), digits(objectOf(d.timer).dispatch_us), d.timer ? d.timer.ratio === null ? "none" : d.timer.trusted ? "tells the truth" : "not trusted" : ""])), note(record.file));
    }),
    part("Drivers", sheet("Who draws", ["device", "API", "driver", "names itself", "kind"], DEVICES.map(d => [d.name, d.api || "", d.driver || "", d.device || "", d.software === true ? "software" : d.software === false ? "hardware" : ""])))];
}
const wellText = devices => `${devices.filter(d => d.status === "ok").length} of ${plural(devices.length, "device")} are well: they work, and compute what C computes.`;
