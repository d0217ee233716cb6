"use strict";
// What verify, diff, baseline and doctor found.

// --- verify, diff, baseline ---

const statusClass = status => status === "ok" ? "yes" : status === "unsupported" || status === "nothing" ? "other" : "no";
const status = (text, title) => el("span", {class: "verdict " + statusClass(text), title: title || null}, el("span", {"aria-hidden": "true"}, {yes: "✓", no: "✗", other: "○"}[statusClass(text)]), " " + text);

function verifyPart(record) {
  const checks = objectsOf(record.document.checks), devices = [...new Set(checks.map(c => c.device))], rows = [...new Set(checks.map(c => `${c.technique}, ${c.check}`))];
  const bad = checks.filter(c => statusClass(c.status) === "no");
  return part("Verified: " + [...new Set(checks.map(c => c.technique))].join(", "), el("p", {}, bad.length ? `${bad.length} of ${plural(checks.length, "check")} ${bad.length === 1 ? "does" : "do"} not hold.` : checks.length ? `None of ${plural(checks.length, "check")} fails.` : "Nothing was checked."),
    sheet("Whether states and pictures are those of the reference, and whether laws hold", ["check", ...devices], rows.map(row => [row, ...devices.map(d => { const c = checks.find(k => `${k.technique}, ${k.check}` === row && k.device === d); return c ? [status(c.status), el("small", {}, c.detail || "")] : ""; })])),
    tierNote(checks.map(c => c.detail)), note(record.file));
}
// How closely two pictures agree, the strictest that holds (docs/records.md).
const TIERS = {T0: ["identical (T0)", "yes", "to the last bit of linear light"],
  T1: ["up to rounding (T1)", "bound", "equal up to rounding, as a GPU may round in its own way; two software drivers owe each other identical light"],
  T2: ["the same scene (T2)", "bound", "drawn in another way, as by an API's own rasteriser"], none: ["differs", "no", "by more than any tier allows"]};
// What tiers are, if a text names one.
const tierNote = texts => texts.some(text => /\bT[012]\b/.test(text)) ? note("T0, T1 and T2 are tiers, which say how closely two pictures agree: T0 to the last bit, T1 up to rounding, T2 in the same scene, drawn in another way. A tier that “would hold” is looser than the one that the two owe each other.") : null;
const tierOf = tier => TIERS[tier] || [String(tier), "no", "a tier that this page does not know"];
function diffPart(record, number, params) {
  const pairs = objectsOf(record.document.pairs), names = [...new Set(pairs.flatMap(p => [p.a, p.b]))], of = (x, y) => pairs.find(p => (p.a === x && p.b === y) || (p.a === y && p.b === x));
  const same = pairs.filter(p => p.tier === "T0").length, blamed = p => { const {text, device} = objectOf(p.blame), found = stageOf(text); return found ? stageText(found, device === p.a ? [p.b, p.a] : device === p.b ? [p.a, p.b] : []) : text || ""; };
  const tell = p => p ? [el("span", {class: "verdict " + tierOf(p.tier)[1], title: tierOf(p.tier)[2]}, tierOf(p.tier)[0]), p.tier === "T0" ? null : el("small", {}, `${plural(p.differing || 0, "linear value")} ${p.differing === 1 ? "differs" : "differ"}, ${p.max ? `by at most ${plural(p.max, "code")} of 255` : "by less than a code"}`)] : "";
  return part("Pictures of every two devices", el("p", {}, `${same} of ${plural(pairs.length, "pair")} ${same === 1 ? "is" : "are"} identical to the last bit of linear light, before it is rounded to the codes that a screen shows. A code is 1/255 of a channel; pictures of the same codes can differ in linear light. A tier, T0 to T2, says how closely two agree:`),
    el("ul", {class: "key"}, [...new Set([...Object.keys(TIERS), ...pairs.map(p => p.tier)])].map(tier => el("li", {}, el("span", {class: "verdict " + tierOf(tier)[1]}, tierOf(tier)[0]), ": ", tierOf(tier)[2]))),
    sheet("How closely the linear light of each two agrees", ["device", ...names], names.map(x => [x, ...names.map(y => x === y ? "–" : tell(of(x, y)))])),
    devicePictures(record, number, params), pairs.filter(p => p.blame).map(p => el("p", {}, `First stage that differs between ${p.a} and ${p.b}: `, blamed(p))), objectsOf(record.document.failures).map(f => el("p", {class: "warn"}, `${f.device}: ${f.status}. ${f.detail || ""}`)), note(record.file));
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
    SEVERAL ? part("Machines", sheet("Machines that tables were measured on; another driver or setting makes another machine", ["machine", "processor", "comparison key", `not as ${MACHINES[0].name}`, "devices"],
      MACHINES.map(m => [m.name, m.text || "", m.key, m.differs || "", kindsText(measuredOn(TABLES.filter(t => t.key === m.key)))]))) : null,
    doctors.map(record => {
      const devices = objectsOf(record.document.devices), others = notExamined(record);
      return part("Doctor", el("p", {}, wellText(devices), others.length ? ` ${othersText(others)}` : ""), arrayOf(record.document.warnings).map(w => el("p", {class: "warn"}, w)), arrayOf(record.document.missing).map(m => note(m)),
        sheet("What each device can do at most, as measured", ["device", "status", {text: "memory, GB/s", number: true}, {text: "cache, GB/s", number: true}, {text: "arithmetic, Gop/s", number: true}, {text: "dispatch, µs", number: true}, "timer"],
          devices.map(d => [[d.name, kindOf(d) ? el("small", {}, kindOf(d)) : null], [status(d.status, d.why), d.why ? el("small", {}, d.why) : null], ...["memory_gb_s", "cache_gb_s", "arithmetic_gop_s"].map(k => digits(objectOf(d.ceilings)[k])), digits(objectOf(d.timer).dispatch_us), d.timer ? d.timer.ratio === null ? "none" : d.timer.trusted ? "tells the truth" : "not trusted" : ""])), note(record.file));
    }),
    part("Drivers", sheet("Who draws", ["device", "kind", "API", "driver", "names itself"], DEVICES.map(d => [d.name, ...[kindOf(d), d.api, d.driver, d.device].map(text => text || "not recorded")])))];
}
// Devices of other records that a doctor's record has not.
const notExamined = record => DEVICES.map(d => d.name).filter(name => !objectsOf(record.document.devices).some(d => d.name === name));
const othersText = names => `${plural(names.length, "other")} ${names.length === 1 ? "was" : "were"} not examined (${list(names)}).`;
function wellText(devices) {
  const well = devices.filter(d => d.status === "ok").length;
  return `${well} of ${plural(devices.length, "device")} ${well === 1 ? "is well: it works, and computes" : "are well: they work, and compute"} what C computes.`;
}
