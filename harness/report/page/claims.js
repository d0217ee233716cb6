"use strict";
// Claims: what papers say of their tables, and whether it holds on each device.

// The papers, by the keys that records have: who wrote them, and what stands in a bibliography.
const PAPERS = {
  creus: {short: "Creus 2010", about: "rain as particles that fall through a city", author: "Creus, Carles", title: "Real-time realistic rain rendering", year: "2010", type: "mastersthesis"},
  stuppacher: {short: "Stuppacher 2007", about: "water drops on panes", author: "Stuppacher, Ines and Supan, Peter", title: "Rendering of Water Drops in Real-Time", year: "2007", type: "inproceedings"},
  chin: {short: "Chin 2016", about: "raindrops that run down a window", author: "Chin, Alina", title: "Animating Raindrops on a Surface", year: "2016", type: "misc"},
  feng: {short: "Feng 2005", about: "rain drawn as a cartoon", author: "Feng, Zhong-Xin and Tang, Min and Dong, Jin-Xiang and Chou, Shang-Ching", title: "Real-time Rain Simulation in Cartoon Style", year: "2005", type: "inproceedings"},
  ye: {short: "Ye", about: "rain as a particle system", author: "Ye, Li-na", title: "Raining Simulation based on Improved Particle Systems algorithms", year: "", type: "inproceedings"},
};
const SOFTWARE = {author: "{raingauge contributors}", title: "raingauge: the rain of published papers on every graphics API", type: "software"};

const VERDICTS = {
  "reproduced": {mark: "✓", word: "holds", cls: "yes", about: "confirmed by many launches, at an error of 1 %, or by pictures, which every launch draws alike"},
  "not reproduced": {mark: "✗", word: "does not hold", cls: "no", about: "refuted by many launches, at an error of 1 %, or by pictures"},
  "at the bound": {mark: "≈", word: "at the bound", cls: "bound", about: "what was measured lies where the claim's bound is, so that no more of it would decide"},
  "undecided": {mark: "?", word: "open", cls: "open", about: "launches have not settled it yet"},
  "one launch: fits": {mark: "(✓)", word: "one launch fits", cls: "fits", about: "figures of one launch fit the claim, which is no verdict"},
  "one launch: misses": {mark: "(✗)", word: "one launch misses", cls: "misses", about: "figures of one launch do not fit the claim, which is no verdict"},
  "one launch: near the bound": {mark: "(≈)", word: "one launch, near the bound", cls: "open", about: "figures of one launch lie near the bound, which is no verdict"},
  "not seen": {mark: "○", word: "not seen", cls: "open", about: "rows that the claim needs were not measured"},
  "other work": {mark: "≠", word: "other work", cls: "open", about: "what was measured is not the work that was printed"},
};
const verdictOf = text => VERDICTS[text] || {mark: "•", word: String(text), cls: "other", about: "a verdict that this page does not know"};

// Figures of one launch are no verdict, but they say which way it may go.
const FIGURES = {fits: "fits", misses: "misses", near: "near the bound"};
const withFigures = v => v.verdict === "one launch" && FIGURES[v.figures] ? {...v, verdict: `one launch: ${FIGURES[v.figures]}`} : v;

// Where a verdict stands: its device, and of several machines which.
const withMachine = (v, document) => { const key = machineKey(document, v.machine); return {...v, key, on: onMachine(v.device, key)}; };

// Claims of the records, and those that were judged from their tables; each once.
function claimsOf(source) {
  const all = new Map();
  for (const document of [objectOf(source.claims), ...records("claims", source).map(record => objectOf(record.document))])
    for (const claim of objectsOf(document.claims)) if (typeof claim.id === "string") all.set(claim.id, {...claim, verdicts: objectsOf(claim.verdicts).map(withFigures).map(v => withMachine(v, document))});
  return [...all.values()];
}
const CLAIMS = claimsOf(DATA);
// Devices that have verdicts, each on every machine: "cpu", or "cpu on A", "cpu on B".
const CLAIM_PLACES = DEVICES.flatMap(d => [...new Set(CLAIMS.flatMap(c => c.verdicts.filter(v => v.device === d.name).map(v => v.on)))].sort());
const judged = (claim, place) => claim.verdicts.find(v => v.on === place);

// Explains words of the totals and of the verdicts.
const LAUNCH_ABOUT = "A launch is a new process, which gives one figure. One launch decides nothing; a verdict takes many.";
const OPEN_ABOUT = "Open: not measured, measured by other work than the paper's, near the bound, or not decided yet.";
// How a claim stands on all devices together. Verdicts go before figures of one launch.
const STANDS = {holds: ["holds", "hold", "yes"], mixed: ["holds on some devices only", "hold on some devices only", "bound"], fails: ["does not hold", "do not hold", "no"],
  fits: ["fits by one launch alone", "fit by one launch alone", "fits"], misses: ["misses by one launch alone", "miss by one launch alone", "misses"], open: ["is open", "are open", "open"]};
function standOf(claim, key = null) {
  const has = verdict => claim.verdicts.some(v => v.verdict === verdict && (!key || v.key === key));
  if (has("reproduced") || has("not reproduced")) return has("reproduced") ? has("not reproduced") ? "mixed" : "holds" : "fails";
  return has("one launch: misses") ? "misses" : has("one launch: fits") ? "fits" : "open";
}
const standing = (stand, claims = CLAIMS) => claims.filter(claim => standOf(claim) === stand).length;
// How claims stand, of those that there are: [stand, "14 hold", class, how many].
const standings = (claims = CLAIMS) => Object.entries(STANDS).map(([stand, [one, many, cls]]) => [stand, `${standing(stand, claims)} ${standing(stand, claims) === 1 ? one : many}`, cls, standing(stand, claims)]).filter(([, , , n]) => n);

// Verdicts on a device that differ between machines: [claim, device, verdicts]. Those that are not seen do not count.
const differing = claims => claims.flatMap(claim => [...new Set(claim.verdicts.map(v => v.device))].map(device => [claim, device, claim.verdicts.filter(v => v.device === device && !["not seen", "one launch"].includes(v.verdict))]))
  .filter(([, , verdicts]) => new Set(verdicts.map(v => v.verdict)).size > 1);
// How many of the claims that were judged on a machine stand so there: "5 of 8".
const standingOn = (stand, key, claims = CLAIMS) => { const here = claims.filter(c => c.verdicts.some(v => v.key === key)); return `${here.filter(c => standOf(c, key) === stand).length} of ${here.length}`; };
// Machines that claims were judged on.
const judgingMachines = (claims = CLAIMS) => MACHINES.filter(m => claims.some(c => c.verdicts.some(v => v.key === m.key)));
function machinesPart(claims) {
  const judgedOn = judgingMachines(claims), differ = differing(claims);
  if (judgedOn.length < 2) return null;
  return [part("Machines", sheet("How claims stand on each machine", ["machine", "", ...Object.values(STANDS).map(([one]) => ({text: one, number: true}))],
      judgedOn.map(m => [m.name, [m.text, m.differs ? el("small", {}, `not as ${MACHINES[0].name}: ${m.differs}`) : null], ...Object.keys(STANDS).map(stand => standingOn(stand, m.key, claims))]), "machines")),
    part("Verdicts that differ between machines", differ.length ? sheet("Claims with another verdict on another machine", ["claim", "device", ...judgedOn.map(m => m.name)],
      differ.map(([claim, device, verdicts]) => [link("claim", {id: claim.id}, claimWords(claim)), device, ...judgedOn.map(m => { const v = verdicts.find(x => x.key === m.key); return v ? badge(v.verdict) : "–"; })]), "differing") : note("None: every verdict that is seen on several machines is the same on each."))];
}

const claimWords = claim => [claim.source === "said" ? `“${claim.words}”` : claim.words, claim.part ? `, ${claim.part}` : ""].join("");
// Tests in words; `row` names a row by its number and its place on the axis.
const RULES = objectOf(DATA.rules);
const TESTS = {
  falls: () => `frames get slower from row to row: in all by a factor of at least ${RULES.fall}, and no row is more than ${RULES.reversal} times as fast as the one before it`,
  order: () => "rows stand in the order of print", ratio: (c, row) => `${row(c.rows[0])} is at least ${digits(c.least)} times as fast as ${row(c.rows[1])}`,
  times: (c, row) => `${row(c.rows[0])} is from ${digits(c.least)} to ${digits(c.most)} times as fast as ${row(c.rows[1])}`,
  alike: c => `no two rows are more than ${digits(c.most)} times apart`, apart: c => `some two rows are more than ${digits(c.least)} times apart`,
  exponent: c => `rates go with the axis to a power between ${c.least} and ${c.most}`, faster: c => `in each row ${words(c.variant)} is at least ${digits(c.least)} times as fast as ${words(c.other_variant)}`,
  rate: c => `each row makes at least ${digits(c.least)} frames a second`, optimum: (c, row) => c.knee[0] === c.knee[1] ? `${row(c.knee[0])} is faster than all others` : `one of the rows from ${row(c.knee[0])} to ${row(c.knee[1])} is faster than all others`,
  slowest: (c, row) => `${row(c.knee[0])} is slower than all others`,
  crosses: (c, row) => `${words(c.variant)} is slower than ${words(c.other_variant)} before ${row(c.knee[0])}, and faster from there on`,
  flattens: (c, row) => `up to ${row(c.knee[0])} the error of the picture falls at least ${digits(c.least)} times as far as after it`,
};
const testOf = claim => TESTS[claim.test] ? TESTS[claim.test]({...claim, rows: arrayOf(claim.rows), knee: arrayOf(claim.knee_rows)}, n => rowName(tableOf(claim.table), n)) : words(claim.test || "");
const rowsText = claim => {
  const [from, to] = arrayOf(claim.rows), row = n => rowName(tableOf(claim.table), n);
  return from === to ? `It is about ${row(from)}` : ["ratio", "times"].includes(claim.test) ? `It is about ${row(from)} and ${row(to)}` : `It is about the rows from ${row(from)} to ${row(to)}`;
};
// Who chose the bound.
const boundText = claim => claim.test === "falls" || claim.is_ours ? "The paper gives no number for this, so the bound is our choice." : !isNumber(claim.least) && !isNumber(claim.most) ? "" : claim.source === "said" ? "The bound is that of the paper's words, with the margin of such words." : "The bound is that of the paper's printed numbers.";

function badge(verdict, isShort = false) {
  const v = verdictOf(verdict);
  return el("span", {class: "verdict claimed " + v.cls, title: v.about}, el("span", {"aria-hidden": "true"}, v.mark), isShort ? el("span", {class: "unseen"}, v.word) : " " + v.word);
}
const badges = claim => el("ul", {class: "badges"}, CLAIM_PLACES.map(place => judged(claim, place)).filter(Boolean)
  .map(v => el("li", {}, el("span", {class: "device"}, v.on), " ", badge(v.verdict))));

// Claims as rows, devices as columns, by paper.
function matrix(claims) {
  const papers = [...new Set(claims.map(claim => claim.paper))];
  return el("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": "Claims by paper and device"}, el("table", {class: "matrix"},
    el("caption", {class: "unseen"}, "What papers claim, and whether it holds on each device"),
    el("thead", {}, el("tr", {}, el("th", {scope: "col"}, "claim"), CLAIM_PLACES.map(p => el("th", {scope: "col"}, p)))),
    papers.map(paper => el("tbody", {}, el("tr", {class: "paper"}, el("th", {scope: "rowgroup", colspan: CLAIM_PLACES.length + 1}, paperTitle(paper), PAPERS[paper] ? el("small", {}, " " + PAPERS[paper].about) : null)),
      claims.filter(c => c.paper === paper).map(claim => el("tr", {}, el("th", {scope: "row"}, link("claim", {id: claim.id}, claimWords(claim)), el("small", {}, " " + claim.table)),
        CLAIM_PLACES.map(place => { const v = judged(claim, place); return el("td", {class: v ? verdictOf(v.verdict).cls : null}, v ? badge(v.verdict, true) : ""); })))))));
}
const verdictKey = claims => el("ul", {class: "key"}, el("li", {}, LAUNCH_ABOUT), Object.keys(VERDICTS).filter(v => claims.some(c => c.verdicts.some(x => x.verdict === v)))
  .map(v => el("li", {}, badge(v), ": ", verdictOf(v).about)));

function claimBrief(claim) {
  return el("article", {class: "brief"}, el("h3", {}, link("claim", {id: claim.id}, claimWords(claim))), badges(claim));
}

// How those claims stand that are looked for: on all devices first.
function foundClaims(found, paper) {
  const all = found.filter(claim => claim.verdicts.length && claim.verdicts.every(v => v.verdict === "reproduced")).length, some = found.filter(claim => standOf(claim) === "holds").length - all;
  const rest = [some ? `${some} on some and ${some === 1 ? "fails" : "fail"} on none` : "", ...standings(found).filter(([stand]) => stand !== "holds").map(([, text]) => text)].filter(Boolean);
  return `${all} of ${plural(found.length, "claim")}${paper ? ` of ${paperTitle(paper)}` : ""} ${all === 1 ? "holds" : "hold"} on all devices${rest.length ? `; ${list(rest)}` : ""}.`;
}

function viewClaims(params) {
  const asked = {paper: params.get("paper") || "", verdict: params.get("verdict") || "", device: params.get("device") || "", stand: params.get("stand") || "", q: params.get("q") || ""};
  const found = CLAIMS.filter(claim => (!asked.paper || claim.paper === asked.paper) && (!asked.stand || standOf(claim) === asked.stand)
    && (!(asked.verdict || asked.device) || claim.verdicts.some(v => (!asked.verdict || v.verdict === asked.verdict) && (!asked.device || v.on === asked.device)))
    && (!asked.q || [claim.words, claim.part, claim.table, claim.id].join(" ").toLowerCase().includes(asked.q.toLowerCase())));
  const any = [["", "all"]];
  return [head("Claims", el("p", {}, "A claim is a sentence of a paper about its table, or what the table shows. Each is put to a test on each device.")),
    el("form", {class: "choices", role: "search", onsubmit: event => event.preventDefault()},
      el("label", {class: "choice"}, "Search ", el("input", {type: "search", id: "claims-q", value: asked.q, oninput: event => choose({q: event.target.value})})),
      choice("claims-paper", "Paper", [...any, ...[...new Set(CLAIMS.map(c => c.paper))].map(p => [p, paperTitle(p)])], asked.paper, paper => choose({paper})),
      choice("claims-stand", "Claims that", [...any, ...standings().map(([stand]) => [stand, STANDS[stand][1]])], asked.stand, stand => choose({stand})),
      choice("claims-verdict", "Verdict", [...any, ...Object.keys(VERDICTS).map(v => [v, verdictOf(v).word])], asked.verdict, verdict => choose({verdict})),
      choice("claims-device", "Device", [...any, ...CLAIM_PLACES.map(d => [d, d])], asked.device, device => choose({device}))),
    el("p", {role: "status", class: "lead"}, foundClaims(found, asked.paper)),
    found.length ? [verdictKey(found), matrix(found), machinesPart(found)] : note("No claim is so. Choose less.")];
}

// The rows that decide a claim, of which the plot shows the medians with their intervals.
function evidence(claim, table) {
  const span = arrayOf(claim.rows);
  if (span.length < 2) return null;
  const work = worksOf(table)[0], inside = [...table.rows.keys()].filter(n => ["ratio", "times"].includes(claim.test) ? span.includes(n) : n >= Math.min(...span) && n <= Math.max(...span));
  if (claim.test === "flattens") return errorPlot(table, inside, claim.variant, work);
  const variants = [claim.variant, claim.other_variant].filter(v => v && table.variants.includes(v));
  return variants.map(variant => {
    const lines = linesOf(table, inside, variant, work), {axis} = axisOf(table);
    return lines.length ? [variants.length > 1 ? el("h3", {}, words(variant)) : null, plot({lines, axis: axis && axisOf(table).groups.length === 1 && inside.length > 2 ? words(axis) : null, value: "frames a second", name: `${table.id}-${variant}`, isLog: true})] : null;
  });
}
// The error of each row's picture: one line if devices draw the same pictures.
function errorPlot(table, numbers, variant, work) {
  const {axis} = axisOf(table), lines = DEVICES.map(({name}) => ({name, points: numbers.map(n => ({row: n, x: axis ? table.rows.get(n)[axis] : null, label: rowText(table.rows.get(n), keysOf(table)),
    value: objectOf((cellOf(table, n, name, variant, work) || {}).error).flip_mask_mean, low: null, high: null})).filter(p => isNumber(p.value))})).filter(line => line.points.length);
  const isOne = lines.length > 1 && new Set(lines.map(line => JSON.stringify(line.points))).size === 1;
  return lines.length ? [isOne ? note(`One line serves ${list(lines.map(line => line.name))}: they draw the same pictures, so that the error is the same.`) : null,
    plot({lines: isOne ? [{...lines[0], name: "each device"}] : lines, axis: axis && words(axis), value: "error of the picture, FLIP", name: table.id + "-error", isLog: false})] : null;
}
// How many launches a verdict rests on, and how many more would probably decide it.
function launchesOf(v) {
  const counted = v.launches || v.launches_disturbed ? `${plural(v.launches || 0, "launch", "launches")}${v.launches_disturbed ? `, ${v.launches_disturbed} disturbed` : ""}` : "";
  const more = v.launches_needed ? `${v.launches_needed} more would probably decide it${v.hours_needed ? `, in ${hoursText(v.hours_needed)}` : ""}` : "";
  const today = v.today ? `today's figures: ${v.today}` : "";
  return [counted, more, today].filter(Boolean).join("; ");
}
// How many launches would decide a claim, and how long they take where the judge knows.
function launchesText(claim) {
  const looks = arrayOf(RULES.looks).filter(isNumber), wanted = claim.verdicts.filter(v => v.launches_needed).map(v => `${v.launches_needed} more on ${v.on}${v.hours_needed ? ` (${hoursText(v.hours_needed)})` : ""}`);
  const course = looks.length ? ` The first verdict is sought after ${looks[0]} on a device and the last after ${looks[looks.length - 1]}; as many again must confirm it, so that it takes from ${2 * looks[0]} to ${2 * looks[looks.length - 1]}.` : "";
  return `Launches: new processes, each of which gives one figure.${course} ${wanted.length ? `Probably it takes ${list(wanted)}.` : "How long one takes is not known before the first was run."}`;
}
// Where a claim is decided, and by what.
function decidedText(claim, decided) {
  const by = decided.filter(v => v.launches).map(v => `${plural(v.launches, "launch", "launches")} on ${v.on}`);
  const on = decided.length < claim.verdicts.length || decided.length === 1 ? `on ${list(decided.map(v => v.on))}` : "on every device";
  return `It is decided ${on}${by.length ? ` by ${list(by)}` : claim.test === "flattens" ? " by pictures: the error of a picture is the same in every launch, so that it needs no launches" : ""}.`;
}
const hoursText = hours => hours < 1 ? `about ${Math.max(1, Math.round(60 * hours))} min` : `about ${digits(hours)} h`;
// What a verdict says besides, as newer records have it: launches, intervals.
function extras(verdict) {
  const known = ["device", "machine", "on", "key", "verdict", "why", "probability", "rows_judged", "rows_needed", "figures", "launches", "launches_disturbed", "launches_needed", "hours_needed", "kept", "today"];
  return Object.entries(verdict).filter(([key, x]) => !known.includes(key) && (isNumber(x) || typeof x === "string" || (Array.isArray(x) && x.length <= 4 && x.every(isNumber))))
    .map(([key, x]) => `${words(key)}: ${Array.isArray(x) ? x.map(digits).join(" to ") : isNumber(x) ? digits(x) : x}`).join("; ");
}
function bibtex(key, p) {
  const fields = [["author", p.author], ["title", `{${p.title}}`], ["year", p.year]].filter(([, x]) => x);
  return `@${p.type}{${key},\n${fields.map(([name, x]) => `  ${name} = {${x}}`).join(",\n")}\n}`;
}

function viewClaim(params) {
  const claim = CLAIMS.find(c => c.id === params.get("id")) || null;
  if (!claim) return [head("Claim"), note("This page holds no such claim. "), link("claims", {}, "All claims")];
  const paper = PAPERS[claim.paper], i = CLAIMS.indexOf(claim), near = [CLAIMS[i - 1], CLAIMS[i + 1]], open = claim.verdicts.some(v => v.verdict === "undecided" || String(v.verdict).startsWith("one launch"));
  const decided = claim.verdicts.filter(v => ["reproduced", "not reproduced"].includes(v.verdict)), isByLaunches = claim.verdicts.some(v => "launches" in v), hasChance = claim.verdicts.some(v => isNumber(v.probability));
  return [head(claimWords(claim), el("p", {class: "lead"}, `${paperTitle(claim.paper)}, section ${claim.section}, about `, link("table", {id: claim.table}, claim.table), claim.source === "said" ? "." : "; the words are ours, and say what the table shows."),
      el("p", {}, "It holds where ", testOf(claim), `. ${boundText(claim)}`), el("p", {}, `${rowsText(claim)}${claim.variant && claim.variant !== "full" ? `; what is timed is ${words(claim.variant)}` : ""}.`),
      claim.print_contradicts ? el("p", {class: "warn"}, "The paper's own table contradicts it.") : null),
    part("Verdicts", sheet("The verdict on each device, and why", ["device", "verdict, and why", ...(hasChance ? [{text: "chance", number: true, title: "How probable such samples would be if the opposite were true"}] : [])],
      claim.verdicts.map(v => [v.on, [badge(v.verdict), " ", v.why || "", v.rows_judged < v.rows_needed ? ` (by ${v.rows_judged} of ${v.rows_needed} rows)` : "", launchesOf(v) ? el("small", {}, launchesOf(v)) : null, extras(v) ? el("small", {}, extras(v)) : null], ...(hasChance ? [isNumber(v.probability) ? v.probability < 0.001 ? "< 0.001" : digits(v.probability) : "–"] : [])])),
      hasChance ? note("Chance: how probable such samples would be if the opposite were true.") : null),
    tablesNamed(claim.table).map(table => part(SEVERAL ? `The rows that decide, ${table.id}` : "The rows that decide", evidence(claim, table))),
    part(open ? "What would decide it" : decided.length ? "What it takes" : "Measure it yourself", decided.length ? el("p", {}, decidedText(claim, decided)) : null, open ? el("p", {}, isByLaunches ? launchesText(claim) : "More samples, of the paper's own settings.") : null,
      open || decided.length ? el("h3", {}, "Measure it yourself") : null, command(isByLaunches ? `raingauge claims ${shell(claim.table)} -o mine` : `raingauge table ${shell(claim.table)} --full --claims -o mine`)),
    paper ? part("Cite", el("pre", {}, bibtex(claim.paper, paper) + "\n\n" + bibtex("raingauge", {...SOFTWARE, type: "misc"}))) : null,
    el("p", {class: "near"}, near[0] ? link("claim", {id: near[0].id}, "Previous claim") : null, " ", link("claims", {}, "All claims"), " ", near[1] ? link("claim", {id: near[1].id}, "Next claim") : null)];
}
