"use strict";
// Gates: whether B is worse than A. Two views of the same cases: for who writes a driver, and for who owns the CI.

const CALM = {"unsupported": "other", "skipped": "other", "improved": "good", "pass": "good"};
// Worst first, as the command lists them. Those that fail are bad, and so is one that the command does not know.
const ENDINGS = new Map(arrayOf(DATA.endings).map(({name, fails}, i) => [name, {order: i, cls: fails ? "bad" : CALM[name] || "open"}]));
const endingClass = ending => ENDINGS.has(ending) ? ENDINGS.get(ending).cls : "bad";
const endingOrder = ending => ENDINGS.has(ending) ? ENDINGS.get(ending).order : -1;
// A ratio with its interval, without what is no ratio.
const positive = x => Object.fromEntries(Object.entries(objectOf(x)).filter(([, v]) => isNumber(v) && v > 0));
const gatesOf = source => records("gate", source).map(record => ({file: record.file, document: objectOf(record.document),
  cases: objectsOf(objectOf(record.document).gated).map(c => ({...c, name: String(c.name), ratio: positive(c.ratio), time_ms: objectOf(c.time_ms), attachments: arrayOf(c.attachments), devices: arrayOf(c.devices)}))
    .map((c, i) => [c, i]).sort((a, b) => endingOrder(a[0].ending) - endingOrder(b[0].ending) || a[1] - b[1]).map(([c]) => c)}));
const GATES = gatesOf(DATA);
const fails = c => endingClass(c.ending) === "bad";
const countsOf = gate => [...d3.rollup ? d3.rollup(gate.cases, v => v.length, c => c.ending) : d3.nest().key(c => c.ending).rollup(v => v.length).entries(gate.cases).map(e => [e.key, e.value])];
const ending = text => el("span", {class: "ending " + endingClass(text)}, text);

// One line: what a gate found.
function verdictLine(gate) {
  const bad = gate.cases.filter(fails), open = gate.cases.filter(c => endingClass(c.ending) === "open");
  const counts = list(countsOf(gate).map(([name, n]) => `${n} ${name}`));
  if (!gate.cases.length) return "The gate has no case: nothing was compared.";
  return bad.length ? `${plural(bad.length, "case")} of ${gate.cases.length} ${bad.length === 1 ? "fails" : "fail"}: ${counts}.`
    : open.length ? `No case fails; ${open.length} of ${gate.cases.length} decide nothing: ${counts}.` : `All is well: ${counts}.`;
}
const ratioDigits = x => x < 10 ? x.toFixed(3) : digits(x);
const ratioText = c => isNumber(c.ratio.value) ? ratioDigits(c.ratio.value) : "–";
const intervalText = c => isNumber(c.ratio.low) && isNumber(c.ratio.high) ? `${ratioDigits(c.ratio.low)} to ${ratioDigits(c.ratio.high)}` : "";

// A and B, as the passport has them, if it is JSON.
function sides(gate) {
  let passport = {};
  try { passport = objectOf(JSON.parse(gate.document.passport_text)); } catch (error) { return el("pre", {class: "passport"}, gate.document.passport_text || ""); }
  const devices = objectsOf(passport.devices), named = (d, i) => [devices.length === 2 ? "AB"[i] + ": " + d.name : d.name, d.driver, d.device, objectsOf(d.libraries).map(l => `${l.path} (${String(l.build).slice(0, 12)})`).join(", ")];
  return sheet("What was compared; B is held against A", ["side", "driver", "device", "code that draws"], devices.map(named));
}

function gateChoice(params) {
  const asked = params.get("gate"), n = asked !== null && GATES[asked] ? Number(asked) : GATES.length - 1;
  return [GATES[n], choice("choose-gate", "Gate", GATES.map((g, i) => [String(i), g.file]), String(n), gate => choose({gate, case: ""}))];
}
function chosenCases(gate, params) {
  const asked = {ending: params.get("ending") || "", technique: params.get("technique") || "", q: params.get("q") || ""};
  const found = gate.cases.filter(c => (!asked.ending || c.ending === asked.ending) && (!asked.technique || c.technique === asked.technique) && (!asked.q || (c.name + " " + c.message).toLowerCase().includes(asked.q.toLowerCase())));
  const form = [el("label", {class: "choice"}, "Search ", el("input", {type: "search", id: "cases-q", value: asked.q, oninput: event => choose({q: event.target.value})})),
    choice("cases-ending", "Ending", [["", "all"], ...countsOf(gate).map(([name, n]) => [name, `${name} (${n})`])], asked.ending, x => choose({ending: x})),
    choice("cases-technique", "Technique", [["", "all"], ...[...new Set(gate.cases.map(c => c.technique))].map(t => [t, t])], asked.technique, x => choose({technique: x}))];
  return [found, form];
}
const MOST = 60;
const more = (found, params) => found.length > MOST && !params.get("all") ? el("p", {}, `The worst ${MOST} of ${found.length}. `, el("button", {type: "button", id: "all", onclick: () => choose({all: "1"})}, "Show all")) : null;
const first = (found, params) => params.get("all") ? found : found.slice(0, MOST);

// Ratios of B by A with intervals, the worst first, on the margin's band.
function forest(cases, margin) {
  const timed = cases.filter(c => isNumber(c.ratio.value) && c.ratio.value > 0);
  if (!timed.length) return note("No case has a ratio: nothing was timed.");
  const width = widthOf(), isNarrow = width < 560, step = isNarrow ? 40 : 26, edge = {left: isNarrow ? 10 : 270, right: isNarrow ? 12 : 150, top: 8, bottom: 44};
  const height = edge.top + edge.bottom + timed.length * step, bottom = height - edge.bottom;
  const ends = timed.flatMap(c => [c.ratio.value, c.ratio.low, c.ratio.high]).filter(x => isNumber(x) && x > 0);
  const x = d3.scaleLog().domain([Math.min(d3.min(ends), 1 / (1 + 2 * margin)) / 1.02, Math.max(d3.max(ends), 1 + 2 * margin) * 1.02]).range([edge.left, width - edge.right]);
  const svg = svgOf(width, height, "Time of B by time of A, with intervals; the numbers stand in the table of cases");
  svg.append("rect").attr("class", "band").attr("x", x(1 / (1 + margin))).attr("width", x(1 + margin) - x(1 / (1 + margin))).attr("y", edge.top).attr("height", bottom - edge.top);
  svg.append("path").attr("class", "one").attr("d", `M${x(1)},${edge.top}V${bottom}`);
  const ticks = x.domain()[1] / x.domain()[0] > 4 ? ticksOf(x, true, 7) : d3.ticks(...x.domain(), isNarrow ? 4 : 7);
  svg.append("g").attr("class", "axis").attr("transform", `translate(0,${bottom})`).call(d3.axisBottom(x).tickValues(ticks).tickFormat(tickText));
  svg.append("text").attr("class", "title").attr("x", (edge.left + width - edge.right) / 2).attr("y", height - 6).attr("text-anchor", "middle").text(isNarrow ? "time of B by time of A" : "time of B by time of A: right of the band is slower");
  timed.forEach((c, i) => {
    const y = edge.top + step * (i + (isNarrow ? 0.7 : 0.5)), group = svg.append("g").attr("class", "point ending " + endingClass(c.ending));
    const name = c.name.length > 38 ? c.name.slice(0, 37) + "…" : c.name;
    group.append("title").text(`${c.name}: ${c.ending}, ${ratioText(c)} ${intervalText(c)}`);
    group.append("text").attr("class", "label").attr("x", isNarrow ? 2 : edge.left - 10).attr("y", isNarrow ? y - 12 : y).attr("dy", isNarrow ? 0 : "0.32em").attr("text-anchor", isNarrow ? "start" : "end").text(isNarrow ? `${name}, ${ratioText(c)}` : name);
    if (isNumber(c.ratio.low) && isNumber(c.ratio.high)) group.append("path").attr("class", "interval").attr("d", `M${x(c.ratio.low)},${y}H${x(c.ratio.high)}M${x(c.ratio.low)},${y - 4}v8M${x(c.ratio.high)},${y - 4}v8`);
    group.append("path").attr("class", "mark").attr("d", d3.symbol().type(fails(c) ? d3.symbolSquare : d3.symbolCircle).size(50)()).attr("transform", `translate(${x(c.ratio.value)},${y})`);
    if (!isNarrow) group.append("text").attr("class", "value").attr("x", width - edge.right + 8).attr("y", y).attr("dy", "0.32em").text(`${ratioText(c)} ${intervalText(c) ? `(${intervalText(c)})` : ""}`);
  });
  return el("figure", {class: "plot"}, svg.node(), note(`The band is a margin of ${digits(100 * margin)} %: within it a change does not matter.`));
}
const marginOf = gate => isNumber(gate.document.margin) ? gate.document.margin : 0.05;

// --- a case ---

function viewCase(gate, c) {
  const time = isNumber(c.time_ms.value) ? `${digits(c.time_ms.value)} ms${between(c.time_ms.low, c.time_ms.high) ? ` (${between(c.time_ms.low, c.time_ms.high)})` : ""}` : "";
  const facts = [["Ending", ending(c.ending)], ["Technique", c.technique], ["Devices", c.devices.join(", ")], ["Ratio", isNumber(c.ratio.value) ? `${ratioText(c)} ${intervalText(c) ? `(${intervalText(c)})` : ""}` : ""],
    ["Time of B", time], ["Time of A", isNumber(c.baseline_ms) ? `${digits(c.baseline_ms)} ms` : ""], ["Smallest change that could have been seen", isNumber(c.smallest_visible) ? `${digits(100 * c.smallest_visible)} %` : ""], ["Took", seconds(c.seconds)]];
  const replay = c.devices.length > 1 && c.technique ? `raingauge shrink ${shell(c.technique)} --device ${shell(c.devices.join(","))} -o case.txt` : null;
  return el("article", {class: "case", id: "case"}, el("h2", {tabindex: "-1"}, c.name), c.message ? el("p", {class: "lead"}, c.message) : null,
    el("dl", {class: "facts"}, facts.filter(([, text]) => text && text !== "–").map(([name, text]) => [el("dt", {}, name), el("dd", {}, text)])),
    c.details ? el("pre", {}, c.details) : null, comparer(c.attachments),
    replay && fails(c) ? [el("h3", {}, "Make a case to send of it"), command(replay)] : null,
    el("p", {}, el("button", {type: "button", onclick: () => choose({case: ""})}, "Close this case")));
}

function caseRows(cases, view, isCi) {
  return sheet("Cases, the worst first", ["case", "ending", {text: "B by A", number: true}, {text: "interval", number: true, title: "For all cases together it holds with 99 % confidence"}, {text: "B, ms", number: true}, {text: "took", number: true}, ...(isCi ? ["pictures"] : [])],
    cases.map(c => [el("a", {href: href(view, {...Object.fromEntries(place().params), case: c.name})}, c.name), [ending(c.ending), c.message ? el("small", {}, c.message) : null], ratioText(c), intervalText(c), isNumber(c.time_ms.value) ? digits(c.time_ms.value) : "–", seconds(c.seconds),
      ...(isCi ? [thumbnails(c.attachments)] : [])]), "cases");
}

function viewGate(params) {
  if (!GATES.length) return [head("A and B"), note("This page holds no gate.")];
  const [gate, gates] = gateChoice(params), [found, form] = chosenCases(gate, params), one = gate.cases.find(c => c.name === params.get("case"));
  return [head("A and B", el("p", {class: "lead"}, verdictLine(gate))), el("form", {class: "choices", role: "search", onsubmit: event => event.preventDefault()}, gates, form),
    one ? viewCase(gate, one) : null, part("What is held against what", sides(gate)),
    part("How much slower or faster", more(found, params), forest(first(found, params), marginOf(gate))), part("Cases", el("p", {role: "status"}, `${found.length} of ${plural(gate.cases.length, "case")}`), caseRows(first(found, params), "gate", false))];
}

// --- the owner of CI ---

// Bars of the seconds that cases took, the longest first.
function secondsSheet(gate) {
  const sum = d3.sum(gate.cases, c => isNumber(c.seconds) ? c.seconds : 0), top = [...gate.cases].filter(c => isNumber(c.seconds)).sort((a, b) => b.seconds - a.seconds).slice(0, 12);
  return top.length ? [el("p", {}, `All cases took ${seconds(sum)}.`), sheet("The cases that took longest", ["case", {text: "took", number: true}, {text: "share", number: true}],
    top.map(c => [c.name, seconds(c.seconds), [`${Math.round(100 * c.seconds / sum)} % `, el("meter", {min: 0, max: 1, value: c.seconds / sum, "aria-hidden": "true"})]]), "took")] : note("No case says how long it took.");
}
// The last runs of the worst cases of those that are looked for, oldest first, as a line around no change.
function lastRuns(found) {
  const runs = GATES.slice(-30), names = found.slice(0, MOST).map(c => c.name);
  if (runs.length < 2) return null;
  const spark = name => {
    const values = runs.map(g => (g.cases.find(c => c.name === name) || {ratio: {}}).ratio.value), known = values.filter(v => isNumber(v) && v > 0);
    if (!known.length) return "–";
    const x = d3.scaleLinear().domain([0, runs.length - 1]).range([3, 137]), y = d3.scaleLog().domain([Math.min(0.95, d3.min(known)), Math.max(1.05, d3.max(known))]).range([25, 3]);
    const svg = svgOf(140, 28, `${name}: ${known.map(digits).join(", ")}`);
    svg.append("path").attr("class", "one").attr("d", `M3,${y(1)}H137`);
    svg.append("path").attr("class", "line d0").attr("d", d3.line().defined(v => isNumber(v) && v > 0).x((v, i) => x(i)).y(v => y(v))(values));
    return svg.node();
  };
  return part("The last runs", sheet(`Ratios of ${plural(runs.length, "run")}, in the order of their files${DATA.gates_left_out ? `; ${plural(DATA.gates_left_out, "earlier one")} left out` : ""}`, ["case", "B by A", {text: "first", number: true}, {text: "last", number: true}, "last ending"], names.map(name => {
    const at = runs.map(g => g.cases.find(c => c.name === name)).filter(Boolean);
    return [name, spark(name), ratioText(at[0]), ratioText(at[at.length - 1]), ending(at[at.length - 1].ending)];
  }), "last"));
}
function viewCi(params) {
  if (!GATES.length) return [head("CI"), note("This page holds no gate.")];
  const [gate, gates] = gateChoice(params), [found, form] = chosenCases(gate, params), one = gate.cases.find(c => c.name === params.get("case"));
  return [head("CI", el("p", {class: "lead " + (gate.cases.some(fails) ? "bad" : "good")}, verdictLine(gate))), el("form", {class: "choices", role: "search", onsubmit: event => event.preventDefault()}, gates, form),
    one ? viewCase(gate, one) : null, part("Cases", el("p", {role: "status"}, `${found.length} of ${plural(gate.cases.length, "case")}`), more(found, params), caseRows(first(found, params), "ci", true)),
    part("Where the seconds went", secondsSheet(gate)), lastRuns(found),
    part("What is known to go wrong", el("p", {}, "The file of expectations says which failures are known. Where this run makes it untrue, the same gate writes it anew:"), command("raingauge gate A B --expectations results/expectations.txt --update"))];
}
