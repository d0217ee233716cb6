"use strict";
// The first screen, and the way from the address to a view.

// --- the first screen ---

const CELLS = TABLES.flatMap(table => table.cells);
function bar(parts) {
  const sum = d3.sum(parts, p => p[1]), known = parts.filter(p => p[1]);
  const svg = d3.create("svg").attr("class", "bar").attr("viewBox", "0 0 300 12").attr("preserveAspectRatio", "none").attr("aria-hidden", "true");
  const LEAST = 6, room = 300 - LEAST * known.length; // of each part, so that one of a thousand is seen
  let at = 0;
  for (const [cls, n] of known) { svg.append("rect").attr("class", cls).attr("x", at).attr("width", room * n / sum + LEAST - 2).attr("height", 12); at += room * n / sum + LEAST; }
  return svg.node();
}
const total = (title, number, text, more, to) => el("section", {class: "total"}, el("h2", {}, title), el("p", {class: "number"}, number), more, el("p", {}, text), to || null);

function claimsTotal() {
  const stands = standings(), decided = ["holds", "mixed", "fails"].map(stand => standing(stand)), open = CLAIMS.length - d3.sum(decided);
  return total("Claims", [`${decided[0]} ${decided[0] === 1 ? "holds" : "hold"}, ${decided[1] + decided[2]} ${decided[1] + decided[2] === 1 ? "does" : "do"} not`, " ", el("small", {}, `of ${plural(CLAIMS.length, "claim")}${open ? `; ${open} ${open === 1 ? "has" : "have"} no verdict yet` : ""}`)],
    [LAUNCH_ABOUT, stands.some(([stand]) => stand === "open") ? ` ${OPEN_ABOUT}` : ""], [bar(stands.map(([, , cls, n]) => [cls, n])),
      el("ul", {class: "plain"}, stands.map(([stand, text, cls]) => el("li", {}, el("span", {class: "dot " + cls, "aria-hidden": "true"}), link("claims", {stand}, text))),
      SEVERAL ? el("li", {}, el("span", {class: "dot", "aria-hidden": "true"}), "Hold: ", list(judgingMachines().map(m => `${standingOn("holds", m.key)} on ${m.name}`))) : null)]);
}
function devicesTotal() {
  const doctor = records("doctor")[0], asked = doctor ? objectsOf(doctor.document.devices) : DEVICES.filter(d => CELLS.some(c => c.device === d.name));
  const failed = d => doctor ? d.status : (CELLS.find(c => c.device === d.name && ["fail", "error", "crash", "timeout"].includes(c.status)) || {status: "ok"}).status;
  const well = asked.filter(d => failed(d) === "ok"), ill = asked.filter(d => failed(d) !== "ok"), others = doctor ? notExamined(doctor) : [];
  if (!asked.length) return null;
  return total("Devices", [`${well.length} `, el("small", {}, `of ${plural(asked.length, "device")} ${well.length === 1 ? "is" : "are"} well`)], [doctor ? "A device is well if it computes and draws what plain C does. " : "Each did all that was asked of it, if it is well. ",
    well.length ? ["Well: ", commas([...d3.group(well, kindOf)].map(([kind, found]) => [commas(found.map(d => el("code", {}, d.name))), kind ? ` (${kind})` : ""])), ". "] : "",
    ill.length ? ["Not well: ", commas(ill.map(d => [el("code", {}, d.name), ` (${[failed(d), kindOf(d)].filter(Boolean).join(", ")})`])), ". "] : "", others.length ? `${othersText(others)} ` : "", link("devices", {}, "The devices")], bar([["yes", well.length], ["no", ill.length]]));
}
function picturesTotal() {
  const cells = CELLS.filter(c => ["ok", "fail"].includes(c.status) && objectOf(c.measured).ms !== undefined || c.status === "fail"), pairs = records("diff").flatMap(r => objectsOf(r.document.pairs));
  const gated = GATES.flatMap(g => g.cases.map(c => ({...c, gate: GATES.indexOf(g)}))).filter(c => c.technique !== "fixed" && ["pass", "differs", "regressed", "improved", "inconclusive"].includes(c.ending));
  const software = name => (DEVICES.find(d => d.name === name) || {}).software !== false, isExact = DEVICES.every(d => software(d.name)), what = isExact ? "identical" : "as the reference's";
  // Records of before say not what two devices owe each other.
  const rank = tier => ["T0", "T1", "T2"].indexOf(tier), isSame = p => p.tier === "T0", isFine = p => rank(p.tier) >= 0 && rank(p.tier) <= rank(p.owed || (isExact ? "T0" : "T1"));
  const all = cells.length + pairs.length + gated.length, others = [...gated.filter(c => c.ending === "differs").map(c => ["none", link("gate", {gate: c.gate === GATES.length - 1 ? null : c.gate, case: c.name}, c.name)]),
    ...pairs.filter(p => !isSame(p)).map(p => [isFine(p) ? p.tier : "none", link("checks", {}, `${p.a} and ${p.b}`)]),
    ...cells.filter(c => c.status === "fail").map(c => { const table = TABLES.find(t => t.cells.includes(c)); return ["none", link("table", {id: table.id}, `${table.id} on ${c.device}`)]; })], same = all - others.length;
  const of = tier => others.filter(([t]) => t === tier).map(([, to]) => to), tell = (text, found) => found.length ? [text, commas(found.slice(0, 5)), found.length > 5 ? ` and ${found.length - 5} more` : "", ". "] : "";
  if (!all) return null;
  return total("Pictures", [same.toLocaleString("en") + " ", el("small", {}, `of ${plural(all, "picture")} that ${all === 1 ? "was" : "were"} compared ${same === 1 ? "is" : "are"} ${what}`)],
    [tell(of("none").length === 1 ? "One differs: " : `${of("none").length} differ: `, of("none")), tell("Equal up to rounding, as a GPU may be: ", of("T1")), tell("The same scene, drawn in another way: ", of("T2")),
    VIEWS.checks[1]() ? [link("checks", {}, "The checks"), ". "] : "", isExact ? "Every device must draw what the plain C reference draws, to the last bit, before its speed counts." : "Every device must draw what the plain C reference draws: to the last bit on software, up to rounding on GPUs."],
    bar([["yes", same], ["bound", of("T1").length + of("T2").length], ["no", of("none").length]]));
}
function gateTotal() {
  const gate = GATES[GATES.length - 1], stand = standOfGate(gate), failing = gate.cases.filter(fails).length, open = gate.cases.filter(c => endingClass(c.ending) === "open").length;
  return total("Gate", [el("span", {class: stand}, {bad: "fails", open: "undecided", good: "passes", other: "nothing compared"}[stand]), " ", el("small", {}, `${failing} of ${plural(gate.cases.length, "case")} ${failing === 1 ? "fails" : "fail"}`)],
    [newsLine(gate, "ci"), " ", link("ci", {}, "The gate in CI"), ", ", link("gate", {}, "A and B"), "."], bar([["no", failing], ["open", open], ["yes", gate.cases.length - failing - open]]));
}

function foundText() {
  const papers = new Set(CLAIMS.map(c => c.paper)).size, texts = [];
  if (CLAIMS.length) texts.push(`Of ${plural(CLAIMS.length, "claim")} that ${plural(papers, "paper")} make about speed and quality, ${list(standings().map(([, text]) => text))}.${standing("fits") + standing("misses") ? " One launch is no verdict." : ""}${SEVERAL ? ` ${plural(differing(CLAIMS).length, "verdict")} of devices ${differing(CLAIMS).length === 1 ? "differs" : "differ"} between ${judgingMachines().length} machines.` : ""}`);
  for (const gate of GATES.slice(-1)) texts.push(verdictOfGate(gate));
  const checks = records("verify").flatMap(r => objectsOf(r.document.checks)), bad = checks.filter(c => statusClass(c.status) === "no");
  if (checks.length) texts.push(bad.length ? `${bad.length} of ${plural(checks.length, "check")} of the models ${bad.length === 1 ? "does" : "do"} not hold.` : `None of ${plural(checks.length, "check")} of the models fails.`);
  for (const doctor of records("doctor")) texts.push(wellText(objectsOf(doctor.document.devices)));
  if (BEFORE) texts.push(changedText());
  if (!texts.length && TABLES.length) texts.push(`${plural(TABLES.length, "table")} with ${plural(CELLS.length, "cell")} ${TABLES.length === 1 ? "was" : "were"} measured; no paper claims anything of ${TABLES.length === 1 ? "it" : "them"}.`);
  if (!texts.length && shots().length) texts.push(`${plural(shots().length, "picture")}, with what each shows.`);
  return texts.length ? texts.map(text => el("span", {class: "finding"}, text, " ")) : "The records hold nothing that was measured or compared.";
}
function overviewPlot() {
  const table = [tableOf("creus-5.4"), ...TABLES].filter(Boolean).find(t => t.isTimed && axisOf(t).axis && linesOf(t, axisOf(t).groups[0][1], t.variants[0], worksOf(t)[0]).length);
  if (!table) return null;
  const {axis, groups} = axisOf(table), lines = linesOf(table, groups[0][1], table.variants[0], worksOf(table)[0]);
  return part("One table as a picture", el("p", {}, link("table", {id: table.id}, table.id), ": ", table.about, ". ", story(table, groups[0], lines)), plot({lines, hidden: [], axis: words(axis), value: "frames a second", name: table.id, isLog: true}));
}
// How such a page is made, and what adds its other parts.
const makePart = () => partOf("make", "Make this yourself", el("p", {}, "The program is in the Git repository ", el("code", {}, "raingauge"), ". On Debian 12, in its folder, the first line installs what it needs, builds it and measures for four minutes; the second makes this page:"),
  command("make tables"), command("build/harness/raingauge report build/tables -o page.html"),
  el("p", {}, "These records add devices, checks, pictures and a gate of two drivers, if you name them before ", el("code", {}, "-o"), ":"),
  command("build/harness/raingauge doctor --json > doctor.json"), command("build/harness/raingauge verify flow --json > verify.json"),
  command("build/harness/raingauge diff flow --device cpu,gl,vulkan -o flow --json > diff.json"), command("build/harness/raingauge gate vulkan new=vulkan@DRIVER=/opt/mesa-25 -o gate --json > gate.json"));
function viewOverview() {
  const totals = [CLAIMS.length ? claimsTotal() : null, devicesTotal(), picturesTotal(), GATES.length ? gateTotal() : null].filter(Boolean), pictures = shots().slice(0, 3);
  return [el("div", {class: "head hero"}, el("h1", {}, CLAIMS.length ? "Does rain still fall as papers say?" : GATES.length ? "Is B worse than A?" : TABLES.length ? "How fast does it rain?" : "What was found"),
      el("p", {class: "lead"}, "raingauge runs the rain of published papers on graphics drivers, checks that every driver draws the same picture, and measures how fast. ", jump("make", "Make this page yourself"), "."),
      el("p", {class: "found"}, foundText())),
    totals.length ? el("div", {class: "totals"}, totals) : null,
    pictures.length ? el("div", {class: "gallery three"}, pictures.map(shot)) : null,
    GATES.length ? part("The gate", el("p", {}, link("gate", {}, "What differs between A and B"), ", ", link("ci", {}, "what CI needs of it")), caseRows(GATES[GATES.length - 1].cases.slice(0, 5), "gate", false, earlierOf(GATES[GATES.length - 1]))) : null,
    overviewPlot(), makePart(),
    CLAIMS.length ? part("Claim by claim", verdictKey(CLAIMS), matrix(CLAIMS)) : null];
}

// --- views ---

const VIEWS = {
  overview: ["Overview", () => true, viewOverview], claims: ["Claims", () => CLAIMS.length, viewClaims], claim: [null, () => CLAIMS.length, viewClaim],
  tables: ["Tables", () => TABLES.length, viewTables], table: [null, () => TABLES.length, viewTable], changes: ["Changes", () => BEFORE, viewChanges], gate: ["Gate: A and B", () => GATES.length, viewGate], ci: ["Gate in CI", () => GATES.length, viewCi],
  checks: ["Checks", () => ["verify", "diff", "baseline", "bisect"].some(kind => records(kind).length), viewChecks], devices: ["Devices", () => DEVICES.length, viewDevices], pictures: ["Pictures", () => shots().length + STRIPS.length, viewPictures],
};
const PARENT = {claim: "claims", table: "tables"};

let lastPlace = null;
function show() {
  const {view, params} = place(), name = VIEWS[view] && VIEWS[view][1]() ? view : "overview", main = document.getElementById("main");
  const focused = document.activeElement && main.contains(document.activeElement) ? document.activeElement : null, id = focused && focused.id, at = focused && "selectionStart" in focused ? focused.selectionStart : null;
  document.getElementById("nav").replaceChildren(...Object.entries(VIEWS).filter(([, [text, has]]) => text && has()).map(([key, [text]]) => el("a", {href: href(key), "aria-current": (PARENT[name] || name) === key ? "page" : null}, text)));
  let shown;
  try { shown = VIEWS[name][2](params); } catch (error) { shown = [head("This view cannot be shown"), note(`A record is not as docs/records.md says: ${error.message}. The other views may be whole.`)]; }
  main.replaceChildren(...shown.flat(9).filter(Boolean));
  const title = main.querySelector("h1");
  document.title = name === "overview" ? "raingauge" : `${title ? title.textContent : name} - raingauge`;
  const again = id && document.getElementById(id);
  if (again) { again.focus(); if (at !== null && again.setSelectionRange) try { again.setSelectionRange(at, at); } catch (error) { /* a select has no text to mark */ } }
  else if (lastPlace !== null && lastPlace !== name + (params.get("id") || "")) { window.scrollTo(0, 0); main.focus({preventScroll: true}); }
  const opened = params.get("case") ? document.getElementById("case") : params.get("to") && main.querySelector(`section#${CSS.escape(params.get("to"))}`);
  if (opened && !again) { opened.scrollIntoView(); opened.querySelector("h2").focus({preventScroll: true}); }
  lastPlace = name + (params.get("id") || "");
}
document.getElementById("foot").append(el("p", {}, `raingauge ${DATA.version}, commit ${String(DATA.commit).slice(0, 12)}. ${plural(arrayOf(DATA.records).length, "record")}. This file needs no other and no network. Drawn with D3, copyright Mike Bostock, BSD-3-Clause.`));
document.getElementById("skip").addEventListener("click", () => document.getElementById("main").focus());
window.addEventListener("hashchange", show);
let resizing = null, lastWidth = document.documentElement.clientWidth;
window.addEventListener("resize", () => {
  clearTimeout(resizing);
  resizing = setTimeout(() => { if (lastWidth !== document.documentElement.clientWidth) { lastWidth = document.documentElement.clientWidth; show(); } }, 150);
});
show();
