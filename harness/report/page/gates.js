"use strict";
// Gates: whether B is worse than A. Two views of the same cases: for who writes a driver, and for who owns the CI.

const CALM = {"unsupported": "other", "skipped": "other", "improved": "good", "pass": "good"};
// Worst first, as the command lists them. Those that fail are bad, and so is one that the command does not know.
// What each means, in the words of docs/ci.md.
const ABOUT = {
  crash: "a driver ended its process", timeout: "a driver did not come back in time", error: "the case could not be run, or a required device is missing or compared nothing",
  "set-up": "a driver is installed, but a file, library or variable of its set-up is broken", lacking: "raingauge itself lacked memory, a process, an open file or room on the disk",
  differs: "pictures, states or counters differ", "unexpected pass": "the case passes, but was expected to fail", "nothing measured": "the picture shows no rain, or there is no sample to decide on",
  regressed: "B is slower, by more than the margin allows", inconclusive: "the times do not decide, so that the exit status is 3 if nothing fails", flake: "a known flake", "expected failure": "the case fails as expected",
  unsupported: "the device or the machine lacks what was asked for", skipped: "an expectation skips the case, or there is nothing to compare it with", improved: "B is faster, by more than the margin allows", pass: "nothing is worse",
};
const aboutEnding = name => ABOUT[name] || "this page does not know this ending, and counts it as a failure";
const ENDINGS = new Map(arrayOf(DATA.endings).map(({name, fails}, i) => [name, {order: i, cls: fails ? "bad" : CALM[name] || "open"}]));
const endingClass = ending => ENDINGS.has(ending) ? ENDINGS.get(ending).cls : "bad";
const endingOrder = ending => ENDINGS.has(ending) ? ENDINGS.get(ending).order : -1;
// A ratio with its interval, without what is no ratio.
const positive = x => Object.fromEntries(Object.entries(objectOf(x)).filter(([, v]) => isNumber(v) && v > 0));
const ratioOf = c => c.ratio.value || 0;
// Gates with their cases, the worst ending first, and of one ending the slowest.
const gatesOf = source => records("gate", source).map(record => ({file: record.file, document: objectOf(record.document),
  cases: objectsOf(objectOf(record.document).gated).map(c => ({...c, name: String(c.name), ratio: positive(c.ratio), time_ms: objectOf(c.time_ms), attachments: arrayOf(c.attachments), devices: arrayOf(c.devices)}))
    .map((c, i) => [c, i]).sort((a, b) => endingOrder(a[0].ending) - endingOrder(b[0].ending) || ratioOf(b[0]) - ratioOf(a[0]) || a[1] - b[1]).map(([c]) => c)})).map(gate => ({...gate, named: new Map(gate.cases.map(c => [c.name, c]))}));
const GATES = gatesOf(DATA);
const fails = c => endingClass(c.ending) === "bad";
// How many cases have each value: [value, number], in the order in which they come.
const tally = values => [...values.reduce((counts, value) => counts.set(value, (counts.get(value) || 0) + 1), new Map())];
const countsOf = gate => tally(gate.cases.map(c => c.ending));
const ending = text => el("span", {class: "ending " + endingClass(text), title: aboutEnding(text)}, text);
const endingKey = cases => el("ul", {class: "key endings"}, tally(cases.map(c => c.ending)).map(([name]) => el("li", {}, ending(name), ": ", aboutEnding(name))));

// --- what a gate found ---

const RESTS = {pass: ["passes", "pass"], flake: ["is a known flake", "are known flakes"], "expected failure": ["fails as expected", "fail as expected"], improved: ["is faster", "are faster"]};
const commas = parts => parts.flatMap((p, i) => i ? [", ", p] : [p]);
// Parts of one line, in which each count leads to its cases.
function verdictOfGate(gate, view = "ci") {
  const n = GATES.indexOf(gate), to = (name, text) => link(view, {gate: n === GATES.length - 1 ? null : n, ending: name}, text);
  const counts = countsOf(gate), isBad = ([name]) => endingClass(name) === "bad", failing = gate.cases.filter(fails).length;
  const rest = commas(counts.filter(count => !isBad(count)).map(([name, k]) => to(name, `${k} ${RESTS[name] ? RESTS[name][k === 1 ? 0 : 1] : `${k === 1 ? "is" : "are"} ${name}`}`)));
  if (!gate.cases.length) return ["The gate has no case: nothing was compared."];
  if (failing) return [el("span", {class: "bad"}, `The gate fails: ${failing} of ${plural(gate.cases.length, "case")} ${failing === 1 ? "fails" : "fail"} (`, commas(counts.filter(isBad).map(([name, k]) => to(name, `${k} ${name}`))), ")."), " ", rest, rest.length ? "." : ""];
  return [{open: "The gate is undecided", good: "The gate passes", other: "The gate compared nothing"}[standOfGate(gate)], ": ", rest, "."];
}
// What it comes to, as its exit status says: an inconclusive case makes it 3, and none that was compared 4.
function standOfGate(gate) {
  if (gate.cases.some(fails)) return "bad";
  return gate.cases.some(c => c.ending === "inconclusive") ? "open" : gate.cases.some(c => !["unsupported", "skipped"].includes(c.ending) && !(c.compared === false && ["flake", "expected failure"].includes(c.ending))) ? "good" : "other";
}

// The run before a gate: the gate before it, or the last of the earlier records.
const earlierOf = gate => GATES[GATES.indexOf(gate) - 1] || (BEFORE && BEFORE.gates[BEFORE.gates.length - 1]) || null;
const NEWS = {new: "it did not fail in the run before", "as before": "it ended so in the run before", "failed before too": "in the run before it failed in another way", "first run": "the run before has no such case"};
// What is new of a case that fails; null of one that does not.
function newsOf(c, earlier) {
  const then = earlier && earlier.named.get(c.name);
  return !fails(c) ? null : !then ? "first run" : then.ending === c.ending ? "as before" : fails(then) ? "failed before too" : "new";
}
const newsTag = news => news && el("span", {class: "tag " + (news === "new" ? "new" : ""), title: NEWS[news]}, news);
function newsLine(gate, view) {
  const earlier = earlierOf(gate), counts = tally(gate.cases.map(c => newsOf(c, earlier)).filter(Boolean)), n = GATES.indexOf(gate);
  if (!earlier) return "These records have no earlier run to compare with.";
  if (!counts.length) return `Nothing fails that could be new since the run before (${fileText(earlier.file)}).`;
  const found = Object.keys(NEWS).filter(news => counts.some(([name]) => name === news)), first = found[0];
  return [`Since the run before (${fileText(earlier.file)}): `, commas(found.map(news => {
    const [, k] = counts.find(([name]) => name === news), is = k === 1 ? "is" : "are";
    return link(view, {gate: n === GATES.length - 1 ? null : n, news}, `${k}${news === first ? k === 1 ? " failure" : " failures" : ""} ${{new: `${is} new`, "as before": `${is} as before`, "failed before too": "failed in another way", "first run": "ran for the first time"}[news]}`);
  })), "."];
}

const fileText = file => String(file).replace(/^\.\//, "");
const ratioDigits = x => x < 10 ? x.toFixed(3) : digits(x);
const ratioText = c => isNumber(c.ratio.value) ? ratioDigits(c.ratio.value) : "–";
const intervalText = c => isNumber(c.ratio.low) && isNumber(c.ratio.high) ? `${ratioDigits(c.ratio.low)} to ${ratioDigits(c.ratio.high)}` : "";

// A and B, as the passport has them, if it is JSON.
function sides(gate) {
  const devices = objectsOf(passportOf(gate.document).devices);
  if (!devices.length) return el("pre", {class: "passport"}, gate.document.passport_text || "");
  const named = (d, i) => [devices.length === 2 ? "AB"[i] + ": " + d.name : d.name, [d.driver || "not recorded", kindOf(d) ? el("small", {}, kindOf(d)) : null], d.device, objectsOf(d.libraries).map(l => `${l.path} (${String(l.build).slice(0, 12)})`).join(", ")].map(text => text || "not recorded");
  return sheet("What was compared; B is held against A", ["side", "driver", "device", "code that draws, and its build"], devices.map(named));
}

function gateChoice(params) {
  const asked = params.get("gate"), n = asked !== null && GATES[asked] ? Number(asked) : GATES.length - 1;
  return [GATES[n], choice("choose-gate", "Gate", GATES.map((g, i) => [String(i), fileText(g.file)]), String(n), gate => choose({gate, case: ""}))];
}
function chosenCases(gate, params) {
  const earlier = earlierOf(gate), news = tally(gate.cases.map(c => newsOf(c, earlier)).filter(Boolean));
  const asked = {ending: params.get("ending") || "", news: params.get("news") || "", technique: params.get("technique") || "", q: params.get("q") || ""};
  const found = gate.cases.filter(c => (!asked.ending || c.ending === asked.ending) && (!asked.news || newsOf(c, earlier) === asked.news) && (!asked.technique || c.technique === asked.technique) && (!asked.q || (c.name + " " + c.message).toLowerCase().includes(asked.q.toLowerCase())));
  const form = [el("label", {class: "choice"}, "Search ", el("input", {type: "search", id: "cases-q", value: asked.q, oninput: event => choose({q: event.target.value})})),
    choice("cases-ending", "Ending", [["", "all"], ...countsOf(gate).map(([name, n]) => [name, `${name} (${n})`])], asked.ending, x => choose({ending: x})),
    news.length ? choice("cases-news", "Failures that are", [["", "any"], ...news.map(([name, k]) => [name, `${name} (${k})`])], asked.news, x => choose({news: x})) : null,
    choice("cases-technique", "Technique", [["", "all"], ...[...new Set(gate.cases.map(c => c.technique))].map(t => [t, t])], asked.technique, x => choose({technique: x}))];
  return [found, form];
}
const MOST = 60;
const more = (found, params, what = "") => found.length > MOST && !params.get("all") ? el("p", {}, `The worst ${MOST} of ${found.length}${what}. `, el("button", {type: "button", id: "all", onclick: () => choose({all: "1"})}, "Show all")) : null;
const first = (found, params) => params.get("all") ? found : found.slice(0, MOST);

// All looks, cells and devices of a gate share an error of 1 % (docs/ci.md).
const GATE_LEVEL = "99 %";
// Which of the cases that are looked for a chart of ratios leaves out, then the worst of the others.
function forestOf(found, params, margin) {
  const timed = found.filter(ratioOf), others = found.filter(c => !ratioOf(c)), endings = tally(others.map(c => c.ending)).map(([name, k]) => `${k} ${name}`);
  if (!timed.length) return note("No case has a ratio: nothing was timed.");
  return [more(timed, params, " with times"), others.length ? el("p", {class: "untimed"}, `Of ${plural(found.length, "case")} ${others.length} ${others.length === 1 ? "has" : "have"} no times, and ${others.length === 1 ? "is" : "are"} not in this chart: ${list(endings)}.`) : null, forest(first(timed, params), margin)];
}
// Ratios of B by A with intervals, the worst first, on the margin's band.
function forest(timed, margin) {
  const width = widthOf(), isNarrow = width < 560, step = isNarrow ? 40 : 26, isLong = timed.length > 12;
  const edge = {left: isNarrow ? 10 : 270, right: isNarrow ? 12 : 150, top: isLong ? 28 : 8, bottom: 44};
  const height = edge.top + edge.bottom + timed.length * step, bottom = height - edge.bottom;
  const ends = timed.flatMap(c => [c.ratio.value, c.ratio.low, c.ratio.high]).filter(x => isNumber(x) && x > 0);
  const x = d3.scaleLog().domain([Math.min(d3.min(ends), 1 / (1 + 2 * margin)) / 1.02, Math.max(d3.max(ends), 1 + 2 * margin) * 1.02]).range([edge.left, width - edge.right]);
  const svg = svgOf(width, height, "Time of B over time of A, with intervals; the numbers stand in the table of cases");
  svg.append("rect").attr("class", "band").attr("x", x(1 / (1 + margin))).attr("width", x(1 + margin) - x(1 / (1 + margin))).attr("y", edge.top).attr("height", bottom - edge.top);
  svg.append("path").attr("class", "one").attr("d", `M${x(1)},${edge.top}V${bottom}`);
  const ticks = x.domain()[1] / x.domain()[0] > 4 ? ticksOf(x, true, 7) : d3.ticks(...x.domain(), isNarrow ? 4 : 7);
  svg.append("g").attr("class", "axis").attr("transform", `translate(0,${bottom})`).call(d3.axisBottom(x).tickValues(ticks).tickFormat(tickText));
  if (isLong) svg.append("g").attr("class", "axis").attr("transform", `translate(0,${edge.top})`).call(d3.axisTop(x).tickValues(ticks).tickFormat(tickText));
  svg.append("text").attr("class", "title").attr("x", (edge.left + width - edge.right) / 2).attr("y", height - 6).attr("text-anchor", "middle").text("time of B over time of A");
  timed.forEach((c, i) => {
    const y = edge.top + step * (i + (isNarrow ? 0.7 : 0.5)), group = svg.append("g").attr("class", "point ending " + endingClass(c.ending));
    const name = c.name.length > 38 ? c.name.slice(0, 37) + "…" : c.name;
    group.append("title").text(`${c.name}: ${c.ending}, ${ratioText(c)} ${intervalText(c)}`);
    group.append("text").attr("class", "label").attr("x", isNarrow ? 2 : edge.left - 10).attr("y", isNarrow ? y - 12 : y).attr("dy", isNarrow ? 0 : "0.32em").attr("text-anchor", isNarrow ? "start" : "end").text(isNarrow ? `${name}, ${ratioText(c)}` : name);
    if (isNumber(c.ratio.low) && isNumber(c.ratio.high)) group.append("path").attr("class", "interval").attr("d", `M${x(c.ratio.low)},${y}H${x(c.ratio.high)}M${x(c.ratio.low)},${y - 4}v8M${x(c.ratio.high)},${y - 4}v8`);
    group.append("path").attr("class", "mark").attr("d", d3.symbol().type(fails(c) ? d3.symbolSquare : d3.symbolCircle).size(50)()).attr("transform", `translate(${x(c.ratio.value)},${y})`);
    if (!isNarrow) group.append("text").attr("class", "value").attr("x", width - edge.right + 8).attr("y", y).attr("dy", "0.32em").text(`${ratioText(c)} ${intervalText(c) ? `(${intervalText(c)})` : ""}`);
  });
  return el("figure", {class: "plot"}, note(`Each mark is the time of B over the time of A, with its interval: right of 1 B is slower. All intervals hold together with ${GATE_LEVEL} confidence. The grey band is the margin of ${digits(100 * margin)} %, within which a change does not matter. A square fails, a circle does not.`), svg.node());
}
const marginOf = gate => isNumber(gate.document.margin) ? gate.document.margin : 0.05;

// --- a case ---

// The first stage that differs, as the first line of a case's details tells it: [line, stage, frame, the rest].
function stageOf(details) {
  const found = /^frame (\d+), (?:stage (\S+)|opening) ?: (.*)$/m.exec(details || "");
  return found && [found[0], found[2] || "opening, before any stage", found[1], found[3]];
}
// The same for people. `of`: the names of the side that is right, which the line names last, and of the other.
function stageText([, stage, frame, rest], of) {
  const found = of.length && rest.length < 500 ? /^(.+?),? is (.+?), not (.+?), off by (.+)$/.exec(rest) : null;
  return [el("strong", {}, stage), ` in frame ${frame}: `, el("small", {}, found ? `${found[1]}: ${of[0]} has ${found[3]}, ${of[1]} has ${found[2]}, off by ${found[4]}` : rest)];
}
// A's and B's names; a baseline's case is judged by the reference.
const namesOf = c => c.devices.length > 1 ? ["A", "B"] : c.devices.length ? ["cpu:reference", c.devices[0]] : [];

function viewCase(gate, c) {
  const time = isNumber(c.time_ms.value) ? `${timeDigits(c.time_ms.value)} ms${between(c.time_ms.low, c.time_ms.high) ? ` (${between(c.time_ms.low, c.time_ms.high, timeDigits)})` : ""}` : "", earlier = earlierOf(gate), then = earlier && earlier.named.get(c.name), stage = stageOf(c.details);
  const facts = [["Ending", [ending(c.ending), ": ", aboutEnding(c.ending)]], ["In the run before", then ? [ending(then.ending), " ", newsTag(newsOf(c, earlier))] : ""], ["First stage that differs", stage ? stageText(stage, namesOf(c)) : ""], ["Technique", c.technique], ["Devices", c.devices.join(", ")],
    ["Time of B over time of A", isNumber(c.ratio.value) ? `${ratioText(c)}${intervalText(c) ? `, ${GATE_LEVEL} interval ${intervalText(c)}` : ""}` : ""],
    ["Time of A", isNumber(c.baseline_ms) ? `${timeDigits(c.baseline_ms)} ms` : ""], ["Time of B", time], ["Smallest change that could have been seen", isNumber(c.smallest_visible) ? `${digits(100 * c.smallest_visible)} %` : ""], ["Took", seconds(c.seconds)]];
  const replay = c.devices.length > 1 && c.technique ? `raingauge shrink ${shell(c.technique)} --device ${shell(c.devices.join(","))} -o case.txt` : null, details = stage ? c.details.replace(stage[0], "").trim() : c.details;
  return el("article", {class: "case", id: "case"}, el("h2", {tabindex: "-1"}, c.name), c.message ? el("p", {class: "lead"}, c.message) : null, tierNote([c.message, c.details]),
    el("dl", {class: "facts"}, facts.filter(([, text]) => text && text !== "–").map(([name, text]) => [el("dt", {}, name), el("dd", {}, text)])),
    details ? el("pre", {}, details) : null, comparer(c.attachments),
    replay && fails(c) ? [el("h3", {}, "Make a case to send of it"), command(replay)] : null,
    el("p", {}, el("button", {type: "button", onclick: () => choose({case: ""})}, "Close this case")));
}

function caseRows(cases, view, isCi, earlier) {
  return [endingKey(cases), tierNote(cases.map(c => c.message)),
    sheet("Cases, the worst first. B / A is the time of B over the time of A: above 1 is slower", ["case", "ending", ...(earlier ? [{text: "run before", title: `How the case ended in the run before, ${fileText(earlier.file)}`}] : []), {text: "B / A", number: true, title: "Time of B over time of A; above 1 is slower"},
    {text: `${GATE_LEVEL} interval`, number: true, title: `For all cases together it holds with ${GATE_LEVEL} confidence`}, {text: "A,\u00a0ms", number: true}, {text: "B,\u00a0ms", number: true}, {text: "took", number: true}, ...(isCi ? ["pictures"] : [])],
    cases.map(c => [el("a", {href: href(view, {...Object.fromEntries(place().params), to: null, case: c.name})}, c.name), [ending(c.ending), " ", newsTag(newsOf(c, earlier)), c.message ? el("small", {}, c.message) : null], ...(earlier ? [earlier.named.has(c.name) ? ending(earlier.named.get(c.name).ending) : "–"] : []),
      ratioText(c), intervalText(c), timeDigits(c.baseline_ms), timeDigits(c.time_ms.value), seconds(c.seconds), ...(isCi ? [thumbnails(c.attachments)] : [])]), "cases")];
}
// How many of a gate's cases are chosen, then the cases.
const casesPart = (gate, found, params, view) => partOf("cases", "Cases", el("p", {role: "status"}, `${found.length} of ${plural(gate.cases.length, "case")}`), view === "ci" || found.filter(ratioOf).length <= MOST ? more(found, params) : null, caseRows(first(found, params), view, view === "ci", earlierOf(gate)));

// A view of a gate: for whom it is, what it found, what is new of that, the choices, the chosen case, then parts.
function gateView(title, about, view, params, parts) {
  if (!GATES.length) return [head(title), note("This page holds no gate.")];
  const [gate, gates] = gateChoice(params), [found, form] = chosenCases(gate, params), one = gate.cases.find(c => c.name === params.get("case"));
  const {lead, below} = parts(gate, found);
  return [head(title, note(about), el("p", {class: "lead verdicts"}, verdictOfGate(gate, view)), el("p", {class: "news"}, newsLine(gate, view)),
      gate.cases.some(c => c.ending === "inconclusive") ? note("Exit status: 1 if any case fails (71 if raingauge itself lacked something); 3, not 0, if none fails and one is inconclusive, which means that its times do not decide.") : null, lead),
    el("form", {class: "choices", role: "search", onsubmit: event => event.preventDefault()}, gates, form), one ? viewCase(gate, one) : null, below];
}
function viewGate(params) {
  return gateView("Gate: A and B", "For driver engineers: what differs between A and B, where, and by how much.", "gate", params, (gate, found) => ({below: [part("A and B", sides(gate)),
    part("How much slower or faster", forestOf(found, params, marginOf(gate))), casesPart(gate, found, params, "gate")]}));
}

// --- the owner of CI ---

const timedCases = cases => cases.filter(c => isNumber(c.seconds) && c.seconds >= 0).sort((a, b) => b.seconds - a.seconds);
const secondsOf = cases => d3.sum(cases, c => c.seconds);
const shareText = x => x >= 0.01 ? `${Math.round(100 * x)} %` : x < 0.001 ? "< 0.1 %" : `${(100 * x).toFixed(1)} %`;
// Which cases took longest, and their share of all seconds: one, or all that took as long.
function longestText(timed) {
  const longest = seconds(timed[0].seconds), most = timed.filter(c => seconds(c.seconds) === longest), all = secondsOf(timed), told = `${longest} or ${shareText(all ? timed[0].seconds / all : 0)} of that`;
  return most.length === 1 ? `${most[0].name} took longest, ${told}` : `${most.length} cases took longest, ${told} each${most.length > 3 ? "" : ": " + list(most.map(c => c.name))}`;
}
const allText = (timed, all) => timed.length > 1 ? `${timed.length === all ? `All ${all}` : `${timed.length} of ${all}`} cases took ${seconds(secondsOf(timed))}; ${longestText(timed)}. ` : `${timed[0].name} took ${seconds(timed[0].seconds)}. `;
// Bars of the seconds that the chosen cases took, the longest first.
function secondsSheet(gate, found) {
  const every = timedCases(gate.cases), all = secondsOf(every), timed = timedCases(found), top = timed.slice(0, 12), isAll = found.length === gate.cases.length;
  return top.length ? [el("p", {}, allText(every, gate.cases.length), isAll ? null : `The table shows only the ${found.length === 1 ? "case" : plural(found.length, "case")} chosen above, which took ${seconds(secondsOf(timed))}.`),
    sheet(`The cases that took longest${isAll ? "" : " of those chosen above"}, and their share of the seconds of all cases`, ["case", {text: "took", number: true}, {text: "share", number: true}],
      top.map(c => [c.name, seconds(c.seconds), [shareText(all ? c.seconds / all : 0), " ", el("meter", {min: 0, max: 1, value: all ? c.seconds / all : 0, "aria-hidden": "true"})]]), "took")] : note("No case says how long it took.");
}
// The ratios of a case over the runs, as a line around no change; each mark has the colour of the ending.
function spark(name, runs) {
  const cases = runs.map(g => g.named.get(name)), ratios = cases.map(c => c && c.ratio.value > 0 ? c.ratio.value : null), known = ratios.filter(isNumber), width = 140;
  const x = d3.scaleLinear().domain([0, runs.length - 1]).range([6, width - 6]), y = d3.scaleLog().domain([Math.min(0.95, d3.min(known) || 1), Math.max(1.05, d3.max(known) || 1)]).range([27, 5]);
  const svg = svgOf(width, 32, `${name}, run by run: ${cases.map((c, i) => c ? `${c.ending}${ratios[i] ? ` ${ratioDigits(ratios[i])}` : ""}` : "not there").join(", ")}`);
  svg.append("path").attr("class", "one").attr("d", `M3,${y(1)}H${width - 3}`);
  svg.append("path").attr("class", "line d1").attr("d", d3.line().defined(isNumber).x((v, i) => x(i)).y(v => y(v))(ratios));
  cases.forEach((c, i) => { if (c) svg.append("path").attr("class", "mark ending " + endingClass(c.ending)).attr("d", d3.symbol().type(fails(c) ? d3.symbolSquare : d3.symbolCircle).size(36)()).attr("transform", `translate(${x(i)},${y(ratios[i] || 1)})`); });
  return svg.node();
}
// The last runs of the worst cases of those that are looked for, oldest first.
function lastRuns(found) {
  const runs = GATES.slice(-30), names = found.slice(0, MOST).map(c => c.name);
  if (runs.length < 2) return null;
  const end = c => [ending(c.ending), isNumber(c.ratio.value) ? el("small", {}, `B / A ${ratioText(c)}`) : null];
  return partOf("runs", "The last runs", el("p", {}, `${plural(runs.length, "run")} in the order of their files, from ${fileText(runs[0].file)} to ${fileText(runs[runs.length - 1].file)}${DATA.gates_left_out ? `; ${plural(DATA.gates_left_out, "earlier one")} left out` : ""}. A mark is a run: a square fails, a circle does not.`),
    sheet("How cases ended from run to run", ["case", `B / A of ${plural(runs.length, "run")}`, "first ending", "last ending", {text: "runs", number: true}], names.map(name => {
      const at = runs.map(g => g.named.get(name)).filter(Boolean);
      return [name, spark(name, runs), end(at[0]), end(at[at.length - 1]), String(at.length)];
    }), "last"));
}
function viewCi(params) {
  return gateView("Gate in CI", "For owners of CI: whether the gate passes, what is new, and what takes long.", "ci", params, (gate, found) => {
    const timed = timedCases(gate.cases), runs = lastRuns(found);
    return {lead: timed.length ? el("p", {class: "longest"}, allText(timed, gate.cases.length), jump("seconds", "Where the seconds went"), runs ? [", ", jump("runs", "the last runs")] : null) : null,
      below: [casesPart(gate, found, params, "ci"), partOf("seconds", "Where the seconds went", secondsSheet(gate, found)), runs,
        part("What is known to go wrong", el("p", {}, "The file of expectations says which failures are known. Where this run makes it untrue, the same gate writes it anew:"), command("raingauge gate A B --expectations results/expectations.txt --update"))]};
  });
}
